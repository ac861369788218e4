/* The effect as passes that an engine dispatches by itself, without a context: for engines with a layer of their own over
 * Vulkan, Direct3D or Metal. They make the pipelines, the memory and the barriers; the functions here list the passes and what
 * they bind as data, and fill what the passes read. A NacreContext is made of the same lists and filled by the same functions.
 *
 * None of them needs a device, keeps memory or has a state; they may be called on any thread at any time. Of Vulkan only
 * the headers are used.
 *
 * HOW
 *  set up    nacreGetBindings lists descriptor set 0 of a technique, nacreGetPasses its compute passes: SPIR-V, or the name
 *            under which the GLSL, HLSL and MSL lie. The pipeline layout has that set and, for passes with perMaterial or
 *            several repeats, a push constant of 4 bytes at offset 0. A pass has a pipeline for every combination of its
 *            NacrePass::constants that its calls ask for.
 *            Every pass may have the constants 1000, a VkBool32, and 1001, a uint32_t, by default 0: that there are no ids, and
 *            how normals are encoded (interface/encoded_inputs.glsl).
 *  materials The buffer "materials" starts with 65536 uint32_t: the slot of every material id, 0 where none is set. Slots
 *            count from 1. nacreFillMaterial fills a slot's element there, nacreFillTable its element of "tables".
 *            A buffer of n materials is head + (n + 1) * stride bytes. Change a material only when no frame reads it.
 *  a call    nacreFillScatterParameters, or nacreFillTransmitParameters and nacreFillLights; then the passes in order, with
 *            the pipelines of nacreGetScatterConstants or nacreGetTransmitConstants.
 *            Those with perMaterial come last and run together, once for every slot, which is pushed.
 *  barriers  Between two passes where the later one reads or writes what an earlier one wrote, or writes what it read:
 *            from compute shader writes to compute shader reads and writes and to indirect arguments; these only before
 *            the first pass with an indirectBinding, since waiting for them takes longer. Before the first pass the
 *            same, against the call before that used these intermediates. They need no contents to begin with.
 *  images    As in nacre.h, at their binding, in a layout of yours; outputs and intermediates are written as storage
 *            images. Where an optional image is not given any other sampled image stands in, and is not read; for
 *            "thicknessOut" the output does, and for shadow maps that are not given any 2D array image.
 *
 * Blocks are laid out as the structures of interface/blocks.h and of each technique's ..._blocks.h among the shaders (C++ and
 * GLSL), which say what is in them.
 */
#ifndef NACRE_PASSES_H
#define NACRE_PASSES_H

#include "nacre/nacre.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Transmission, which the functions below take beside the techniques of scatter. */
#define NACRE_TECHNIQUE_TRANSMIT ((NacreTechnique)0x1000)

/** A binding of descriptor set 0: a buffer, an image of yours, or an intermediate. */
typedef struct NacreBinding {
    const char* name;      /**< "parameters", "materials", "tables", "lights"; an image's field in
                                NacreScatterInfo or NacreTransmitInfo; an intermediate's own name. Static storage */
    uint32_t binding;      /**< [0 … 31] */
    VkDescriptorType type;
    uint32_t count;        /**< descriptors: NACRE_MAX_SHADOW_MAPS of "shadowMaps", else 1 */
    NacreImageSlot image;  /**< your image; NACRE_IMAGE_SLOT_COUNT = it is none */
    VkBool32 intermediate; /**< made by you for the passes alone; storage, and for a buffer indirect, usage */
    VkFormat format;       /**< of an intermediate image */
    VkExtent2D extent;     /**< px, of an intermediate image */
    VkBool32 array;        /**< an intermediate image that is seen as a 2D array */
    VkDeviceSize head;     /**< bytes, of a buffer before its elements; all of it where stride is 0 */
    VkDeviceSize stride;   /**< bytes of a buffer's element: a material's slot, or a light */
} NacreBinding;

/** A compute pass. Entry point "main". */
typedef struct NacrePass {
    const char* name;            /**< as in NacreCost::passNames. Static storage */
    const char* file;            /**< of its files without suffix: .spv in spirv/ of the package, .hlsl and .metal among
                                      the translations. Static storage */
    const uint32_t* spirv;       /**< Vulkan 1.2. Static storage */
    size_t spirvSize;            /**< bytes */
    const char* halfFile;        /**< as file, of the same pass with half floats, for devices with shaderFloat16; null = none */
    const uint32_t* halfSpirv;   /**< as spirv; null = none */
    size_t halfSpirvSize;        /**< bytes */
    uint32_t reads;              /**< intermediates, bits 1u << NacreBinding::binding */
    uint32_t writes;             /**< likewise */
    VkBool32 perMaterial;        /**< run for every material's slot */
    uint32_t repeats;            /**< dispatches of it for this area, a barrier before each but the first; their number,
                                      from 0, is pushed where there are several. At least 1 */
    uint32_t constants;          /**< the specialization constants that it has, VkBool32s: bits 1u << constant_id. A
                                      pipeline without one of them does less, and is quicker */
    VkExtent3D groups;           /**< workgroups to dispatch; 0 where indirectBinding is not */
    uint32_t indirectBinding;    /**< the intermediate that holds the VkDispatchIndirectCommand; 0 = none does */
    VkDeviceSize indirectOffset; /**< bytes, where in it */
} NacrePass;

/** What set 0 of a technique binds, with intermediates for render areas up to maxExtent [1 … 16384] px.
 *  bindings null: *bindingCount becomes their number. Else it is how many fit into bindings, and becomes how many were
 *  written; NACRE_ERROR_LIMIT_EXCEEDED when that is not all. */
NACRE_API NacreResult nacreGetBindings(NacreTechnique technique, VkExtent2D maxExtent, uint32_t* bindingCount,
                                       NacreBinding* bindings);
/** The passes of a technique in order, for a render area of this extent [1 … 16384] px; counted as nacreGetBindings does.
 *  Not among them are the passes of nacreBakeThesisKernel. */
NACRE_API NacreResult nacreGetPasses(NacreTechnique technique, VkExtent2D area, uint32_t* passCount, NacrePass* passes);

/* What follows fills a block of `size` bytes at `data`: one element, or the parameters. `size` is at least the stride, or
 * head, of the binding. On error nothing is written, and `messages` (null = none) hears which field is to blame. */

/** A material's element of "materials" (MaterialParameters). */
NACRE_API NacreResult nacreFillMaterial(const NacreMaterial* material, const NacreMessages* messages, size_t size,
                                        void* data);
/** A material's element of "tables": its profile, and of NACRE_TECHNIQUE_BANK its strength, as the technique reads them.
 *  NACRE_TECHNIQUE_BANK_SURFACES has the same: which of the two a frame takes, for NacreMaterial::secondSurfaces, is the
 *  caller's. */
NACRE_API NacreResult nacreFillTable(NacreTechnique technique, const NacreMaterial* material,
                                     const NacreMessages* messages, size_t size, void* data);
/** "parameters" of a scatter technique (ScatterParameters). Of info's images only the extents of depth and materialId are
 *  looked at, and irradiance's where view.renderArea is zero; frame, technique and timestamps are not.
 *  NacreBaselineSettings::thesisBakedKernel must be VK_FALSE. As for materials some of which have NACRE_ALBEDO_PRE_AND_POST: with an albedo image
 *  the passes ask every pixel's.
 *  images: bits 1u << NacreImageSlot of the optional images that are bound. */
NACRE_API NacreResult nacreFillScatterParameters(const NacreScatterInfo* info, uint32_t images,
                                                 const NacreMessages* messages, size_t size, void* data);
/** "parameters" of transmission (TransmitParameters). Of info's images only depth.extent is looked at, where
 *  view.renderArea is zero; lights, frame and timestamps are not. images: as above; the normals are always bound. */
NACRE_API NacreResult nacreFillTransmitParameters(const NacreTransmitInfo* info, uint32_t images,
                                                  const NacreMessages* messages, size_t size, void* data);
/** Elements of "lights" that a call takes: one a light and one a cascade. 0 where info is null. */
NACRE_API uint32_t nacreGetLightElementCount(const NacreTransmitInfo* info);
/** All elements of "lights" (LightParameters), so size is at least nacreGetLightElementCount times the stride. Of shadowMaps
 *  only their extents and formats are looked at. */
NACRE_API NacreResult nacreFillLights(const NacreTransmitInfo* info, const NacreMessages* messages, size_t size,
                                      void* data);

/* The specialization constants that a call's pipelines have as VK_TRUE, bits 1u << constant_id: of a pass, those that are
 * among its NacrePass::constants, too. Its others are VK_FALSE. */

/** 0: some materials share no exchange group with some others. 1: there is an image of albedo, strength or scale, or a
 *  material of strength below 1. images: as for nacreFillScatterParameters; materials: all that are set, of which the layers are not read. */
NACRE_API uint32_t nacreGetScatterConstants(uint32_t images, uint32_t materialCount, const NacreMaterial* materials);
/** 0: there is more than one shadow map; without, all lights with a shadow map have the first. 1: a light has hardware depth,
 *  culled front faces, a rectangle, cascades or an attenuation, or there is an image of scales. images: as for
 *  nacreFillTransmitParameters. 0 where info is null. */
NACRE_API uint32_t nacreGetTransmitConstants(uint32_t images, const NacreTransmitInfo* info);

#ifdef __cplusplus
}
#endif

#endif
