/* Nacre: real-time subsurface scattering and translucency for any Vulkan 1.2 renderer. Plain C, the library's ABI.
 *
 * THE CONTRACT
 *  1. Recording (nacreCmd*) never submits, waits, allocates, compiles or prints. Create, resize and set-materials may.
 *     A frame is: nacreBeginFrame, then one nacreCmdScatter and nacreCmdTransmit per view, in any order. Best is scatter
 *     first, then transmit without a barrier between them: transmit with shadow maps waits for nothing recorded before
 *     it, so that the device runs both side by side.
 *  2. The caller's images keep their layout: NacreImage says which one they are in, and they leave in it. The library
 *     puts barriers only around its own intermediates.
 *       on entry  every input image is visible to VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT / VK_ACCESS_SHADER_READ_BIT;
 *                 every output image may be written by VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT / VK_ACCESS_SHADER_WRITE_BIT
 *       on exit   outputs were written by VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT / VK_ACCESS_SHADER_WRITE_BIT
 *     Recorded outside a render pass, into a command buffer whose queue computes.
 *     Clobbered: the command buffer's compute pipeline, compute descriptor sets and push constants.
 *  3. Vulkan 1.2 core. What a device and its images must bring can be asked before a device exists.
 *  4. No globals. Contexts are independent; one context is used by one thread at a time, and its recorded work runs on
 *     one queue (intermediates are shared by the frames in flight). Frames in flight and records per frame are
 *     create-time numbers; exceeding them is NACRE_ERROR_LIMIT_EXCEEDED.
 *  5. An error is a result code and a message (NacreContextInfo::messageCallback) that names the field and its value.
 *     After an error the command buffer is as it was. Every struct is zero-initialisable; 0 is stated per field.
 *  6. Optional inputs are NacreImages with a null view; each states its fallback.
 *  7. Masks are explicit: material id 0 means "no subsurface scattering here" and copies the irradiance, or leaves
 *     the pixel alone (NacreScatterInfo::skipUnscattered). Black is a colour. What a rejected neighbour would have
 *     given is renormalised: a constant field stays constant to 1e-3. An irradiance or depth that is not finite makes
 *     its pixel a source of nothing; it does not spread.
 *  8. Cost can be asked: dispatches, bytes of intermediates, pass names; every pass can be timed.
 *
 * CONVENTIONS
 *  Matrices are column-major and multiply column vectors. View space is right-handed and looks along -Z. Clip space is
 *  Vulkan's (y down, depth 0 to 1 in either direction). Lengths are scene units; metersPerUnit turns them into metres.
 *  Materials are in millimetres. Light is linear. Irradiance is diffuse light without albedo and without specular.
 *
 * WHAT TO DO WITH THE RESULTS
 *  nacreCmdCompose does all of this and gives one image to add. By hand:
 *  Closed bodies:  diffuse = albedo / pi * (scattered + transmitted)
 *  `scattered` is nacreCmdScatter's output: light that entered where the camera sees it. `transmitted` is
 *  nacreCmdTransmit's: light that entered where the camera does not see it, times the material's translucency. Each
 *  entry point counts once, so the two are added as they are. Where transmit is not used, transmitted is 0. With an
 *  albedo image given to nacreCmdScatter, its output already has the albedo in it, as the material's albedoUse says.
 *  Thin walls (one sheet without an inside: a leaf, paper, cloth) divide the light between their two sides. Of a wall
 *  that lets the share f through, in the colour c:
 *                  diffuse = albedo / pi * (1 - f) * scattered + c / pi * transmitted
 *  with f as the material's translucency. Light that no NacreLight brings (ambient light, an environment) is not in
 *  `transmitted`: closed bodies need nothing of it; to a thin wall the caller adds c / pi * f * (the irradiance of that
 *  light on the other side). Where transmit is not used, a wall is drawn with f = 0.
 */
#ifndef NACRE_H
#define NACRE_H

#include <stdint.h>
#include <string.h>
#include <vulkan/vulkan_core.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32) && defined(NACRE_SHARED)
#ifdef NACRE_BUILDING
#define NACRE_API __declspec(dllexport)
#else
#define NACRE_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define NACRE_API __attribute__((visibility("default")))
#else
#define NACRE_API
#endif

/** Version of this header; nacreCreateContext compares it with the library's. */
#define NACRE_VERSION_MAJOR 0
#define NACRE_VERSION_MINOR 1
#define NACRE_VERSION_PATCH 0
#define NACRE_HEADER_VERSION ((uint32_t)(NACRE_VERSION_MAJOR << 16 | NACRE_VERSION_MINOR << 8 | NACRE_VERSION_PATCH))

/** Most layers a material may have. */
#define NACRE_MAX_LAYERS 32u
/** Largest material id, and upper limit of NacreContextInfo::maxMaterials. */
#define NACRE_MAX_MATERIALS 65535u
/** NacreLight::shadowMap of a light without a shadow map. */
#define NACRE_NO_SHADOW_MAP 0xffffffffu
/** Most cascades of a light. */
#define NACRE_MAX_CASCADES 16u
/** Most shadow-map images one nacreCmdTransmit takes (each may have many array layers). */
#define NACRE_MAX_SHADOW_MAPS 16u

typedef struct NacreContext_T* NacreContext;

typedef enum NacreResult {
    NACRE_SUCCESS = 0,
    NACRE_ERROR_INVALID_ARGUMENT = -1,   /**< a field is null, out of range, not finite or contradicts another */
    NACRE_ERROR_UNSUPPORTED_DEVICE = -2, /**< the device lacks a version, feature or limit of nacreGetRequirements */
    NACRE_ERROR_UNSUPPORTED_FORMAT = -3, /**< an image's format or usage is not among nacreGetImageRequirements */
    NACRE_ERROR_LIMIT_EXCEEDED = -4,     /**< more frames, records, materials, lights or pixels than created for */
    NACRE_ERROR_OUT_OF_MEMORY = -5,      /**< host or device memory */
    NACRE_ERROR_VERSION_MISMATCH = -6,   /**< header and library differ */
    NACRE_ERROR_VULKAN = -7,             /**< a Vulkan call failed; the message names it and its VkResult */
    NACRE_ERROR_UNSUPPORTED = -8,        /**< this library was built without what is asked for: a baseline */
    NACRE_RESULT_MAX_ENUM = 0x7fffffff
} NacreResult;

/** How light is spread. Two are baselines, which others are compared with; a library may be built without them
 *  (nacre_baselines.h). */
typedef enum NacreTechnique {
    NACRE_TECHNIQUE_DEFAULT = 0,   /**< the library's choice: NACRE_TECHNIQUE_BANK */
    NACRE_TECHNIQUE_SEPARABLE = 1, /**< two passes, line-spread kernels, world-space bilateral weights */
    NACRE_TECHNIQUE_BRUTE = 2,     /**< baseline: every pixel within the 99.9 % radius; slow, the reference of the others */
    NACRE_TECHNIQUE_BANK = 3,      /**< mixtures of one bank of blurs; flat in radius and layers, nearly so in materials */
    NACRE_TECHNIQUE_BURLEY = 4,    /**< one pass, importance samples of a disc, one per 4 px of it up to a budget; noisy */
    NACRE_TECHNIQUE_THESIS = 5,    /**< baseline: a pass pair per material, a radius in texels, rules of its own */
    NACRE_TECHNIQUE_BANK_SURFACES = 6, /**< NACRE_TECHNIQUE_BANK that keeps two surfaces where one is in front of another:
                                            more accurate at folds and thin parts, and slower there. Materials may ask
                                            for it (NacreMaterial::secondSurfaces) */
    NACRE_TECHNIQUE_COUNT = 7,     /**< one more than the last */
    NACRE_TECHNIQUE_MAX_ENUM = 0x7fffffff
} NacreTechnique;

/** How an image holds depth, of the camera (NacreView) or of a light (NacreLight). */
typedef enum NacreDepthEncoding {
    NACRE_DEPTH_LINEAR = 0,   /**< camera: distance along the view direction in scene units, > 0; light: that of
                                   NacreLight::shadowRange, in a colour format */
    NACRE_DEPTH_HARDWARE = 1, /**< the depth buffer's value, decoded with the matrix it was drawn with: of the camera
                                   NacreView::clipFromView, of a light shadowClipFromWorld. Perspective or orthographic,
                                   reversed or not, finite or not */
    NACRE_DEPTH_ENCODING_MAX_ENUM = 0x7fffffff
} NacreDepthEncoding;

/** How a normal image holds a normal, after normalScale and normalBias. */
typedef enum NacreNormalEncoding {
    NACRE_NORMAL_XYZ = 0,        /**< a vector, of any length */
    NACRE_NORMAL_OCTAHEDRAL = 1, /**< two numbers in [-1, 1]: n / (|x| + |y| + |z|), of which x and y are kept where z >= 0,
                                      else (1 - |y|, 1 - |x|) with the signs of x and y (Cigolle et al. 2014, "oct") */
    NACRE_NORMAL_ENCODING_MAX_ENUM = 0x7fffffff
} NacreNormalEncoding;

typedef enum NacreNormalSpace {
    NACRE_NORMAL_WORLD = 0,
    NACRE_NORMAL_VIEW = 1, /**< of the view that the call has: right-handed, looks along -Z */
    NACRE_NORMAL_SPACE_MAX_ENUM = 0x7fffffff
} NacreNormalSpace;

typedef enum NacreAlbedoUse {
    NACRE_ALBEDO_POST = 0,         /**< scatter irradiance, multiply by the albedo afterwards */
    NACRE_ALBEDO_PRE_AND_POST = 1, /**< multiply by the albedo's square root before and after; while any material has
                                        it, scatter with an albedo image takes longer */
    NACRE_ALBEDO_USE_MAX_ENUM = 0x7fffffff
} NacreAlbedoUse;

typedef enum NacreLightKind {
    NACRE_LIGHT_DIRECTIONAL = 0,
    NACRE_LIGHT_SPOT = 1,
    NACRE_LIGHT_POINT = 2,
    NACRE_LIGHT_KIND_MAX_ENUM = 0x7fffffff
} NacreLightKind;

/** Which of a light's cascades tells about a point. */
typedef enum NacreCascadeChoice {
    NACRE_CASCADE_BY_MAP = 0,        /**< the first whose map has the point in it */
    NACRE_CASCADE_BY_VIEW_DEPTH = 1, /**< the first that reaches as far from the camera (NacreShadowCascade::farDepth) */
    NACRE_CASCADE_CHOICE_MAX_ENUM = 0x7fffffff
} NacreCascadeChoice;

/** The slots of NacreScatterInfo and NacreTransmitInfo, for nacreGetImageRequirements. */
typedef enum NacreImageSlot {
    NACRE_IMAGE_IRRADIANCE = 0,
    NACRE_IMAGE_DEPTH = 1,
    NACRE_IMAGE_MATERIAL_ID = 2,
    NACRE_IMAGE_NORMAL = 3,
    NACRE_IMAGE_STRENGTH = 4,
    NACRE_IMAGE_SCALE = 5,
    NACRE_IMAGE_THICKNESS = 6,
    NACRE_IMAGE_ALBEDO = 7,
    NACRE_IMAGE_SHADOW_MAP = 8,
    NACRE_IMAGE_SCATTERED = 9,
    NACRE_IMAGE_TRANSMITTED = 10,
    NACRE_IMAGE_THICKNESS_OUT = 11,
    NACRE_IMAGE_COMPOSED = 12,
    NACRE_IMAGE_SLOT_COUNT = 13,
    NACRE_IMAGE_SLOT_MAX_ENUM = 0x7fffffff
} NacreImageSlot;

typedef enum NacreSeverity {
    NACRE_SEVERITY_INFO = 0,
    NACRE_SEVERITY_ERROR = 1,
    NACRE_SEVERITY_MAX_ENUM = 0x7fffffff
} NacreSeverity;

typedef void (*NacreMessageCallback)(NacreSeverity severity, const char* message, void* userData);

/** Where messages go that are no context's. */
typedef struct NacreMessages {
    NacreMessageCallback callback; /**< null = nowhere */
    void* userData;                /**< handed to it */
} NacreMessages;

/** What a device must bring. Enable `features` and `features12` (only the members set to VK_TRUE) when creating it. */
typedef struct NacreRequirements {
    uint32_t apiVersion; /**< VK_API_VERSION_1_2 */
    VkPhysicalDeviceFeatures features;
    VkPhysicalDeviceVulkan12Features features12; /**< sType set, pNext null */
    uint32_t maxPerStageDescriptorSampledImages;  /**< least VkPhysicalDeviceLimits member of that name */
    uint32_t maxPerStageDescriptorStorageImages;  /**< likewise */
    uint32_t maxPerStageDescriptorStorageBuffers; /**< likewise */
} NacreRequirements;

/** What an image must bring. */
typedef struct NacreImageRequirements {
    const char* name;        /**< the field's name, e.g. "irradiance" */
    uint32_t formatCount;
    const VkFormat* formats; /**< any of these; static storage */
    VkImageUsageFlags usage; /**< all of these */
    VkBool32 optional;       /**< may be left out (null view) */
} NacreImageRequirements;

/** A piece of the caller's device memory. It belongs to the context alone until that is destroyed. */
typedef struct NacreMemory {
    VkDeviceMemory memory; /**< VK_NULL_HANDLE = not given */
    VkDeviceSize offset;   /**< a multiple of the alignment required */
    VkDeviceSize size;     /**< what may be used from offset on; at least the size required */
    void* mapped;          /**< where the host sees `offset`; needed for NacreContextInfo::hostMemory alone */
} NacreMemory;

/** What NacreContextInfo::deviceMemory and hostMemory need: size, alignment, and the memory types to choose from. */
typedef struct NacreMemoryRequirements {
    VkMemoryRequirements device; /**< intermediates, at maxExtent; device-local memory is fastest */
    VkMemoryRequirements host;   /**< materials and parameters; host-visible and host-coherent memory */
} NacreMemoryRequirements;

typedef struct NacreContextInfo {
    uint32_t headerVersion; /**< NACRE_HEADER_VERSION. This and the next two stand first in every version, so that
                                 NACRE_ERROR_VERSION_MISMATCH can be told */
    NacreMessageCallback messageCallback; /**< null = silent */
    void* userData;                       /**< handed to messageCallback */
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr; /**< required; every entry point is reached through it */
    const VkAllocationCallbacks* allocator;        /**< host allocation callbacks, copied; null = Vulkan's own, and
                                    pipelines are compiled on as many threads as the host has */
    VkPipelineCache pipelineCache;                 /**< VK_NULL_HANDLE = none. Compiling bank may take seconds; from a cache
                                    that has its pipelines, milliseconds (docs/integration.md has figures) */
    VkExtent2D maxExtent;      /**< [1 … 16384] px, the largest render area, or scissor where one is given; see nacreResize */
    uint32_t techniques;       /**< bits 1u << NacreTechnique: those the context is made for; 0 = all. Fewer techniques
                                    take less memory per pixel and per material (see nacreGetScatterCost) */
    uint32_t framesInFlight;   /**< [1 … 8] 0 = 2; frames given to nacreBeginFrame are below it */
    uint32_t recordsPerFrame;  /**< [1 … 64] scatter calls, and transmit calls, per frame (views); 0 = 1 */
    uint32_t maxMaterials;     /**< [1 … 65535] most materials that are set, whatever their ids; 0 = 64. Each takes
                                    NacreCost::materialBytes of every technique (bank and bank-surfaces share theirs),
                                    in buffers no larger than the device's maxStorageBufferRange: where that is 128 MiB,
                                    65535 of separable, 5432 of bank */
    uint32_t maxLights;        /**< [1 … 1024] lights per transmit call, and their cascades; 0 = 16 */
    NacreMemory deviceMemory;  /**< for the intermediates; null = the library allocates. nacreResize has to do with it, too */
    NacreMemory hostMemory;    /**< for materials and parameters; null = the library allocates */
    VkBool32 shaderFloat16;    /**< the device was made with VkPhysicalDeviceVulkan12Features::shaderFloat16: where there
                                    are no edges, bank then interpolates in half floats, which is faster (docs/scatter.md).
                                    NACRE_ERROR_UNSUPPORTED_DEVICE where physicalDevice lacks the feature */
    const VkPhysicalDeviceFeatures* enabledFeatures; /**< what the device was created with, to have a feature that was
                                    forgotten told; null = not stated, not checked */
    uint32_t materialIdMask;   /**< [0 … 65535] bits of a value of the materialId image that are the id; 0 = all. With a
                                    stencil, those that the caller's other passes leave alone */
    uint32_t materialIdShift;  /**< [0 … 15] id = (value & materialIdMask) >> materialIdShift */
    VkBool32 noMaterialIds;    /**< calls have no materialId image: material 1 is wherever their strength image is above 0,
                                    without one everywhere. VK_FALSE: they have one */
    NacreNormalEncoding normalEncoding; /**< of the normal images of all calls */
    NacreNormalSpace normalSpace;       /**< likewise */
} NacreContextInfo;

/** One layer of a material: adds weight · exp(-r² / 2 variance) / (2 pi variance). */
typedef struct NacreLayer {
    float weight[3]; /**< [>= 0] RGB; normalised per channel over the layers */
    float variance;  /**< [0, 4e9] mm² */
} NacreLayer;

/** A subsurface material. Either layers, or meanFreePath with layerCount 0. */
typedef struct NacreMaterial {
    const NacreLayer* layers; /**< copied; may be freed after nacreSetMaterials */
    uint32_t layerCount;      /**< [0 … NACRE_MAX_LAYERS] */
    float meanFreePath[3];    /**< [1e-6, 1e4] mm, d of Burley's normalised diffusion; used when layerCount is 0 */
    NacreAlbedoUse albedoUse;
    float strength;           /**< [0, 1] result = mix(irradiance, scattered, strength); 0 = no scattering */
    float translucency;       /**< [0, 1] multiplies `transmitted`: 1 = as much as the profile says, 0 = none. For thin
                                   walls, the share f of the light that goes through (see WHAT TO DO WITH THE RESULTS) */
    float scale;              /**< [1e-6, 1e4] multiplies the profile's lengths, which keep to
                                  their ranges; 0 = 1 */
    float thickness;          /**< [>= 0] mm, authored thickness across the body: bounds the shadow maps' estimate, or stands
                                   in for it where a light has none or its texels are as large as light goes far. What a
                                   map shows much farther towards the light is another body, which shadows. 0 = not
                                   authored: where a map cannot tell, nothing shines through */
    uint32_t exchangeGroups;  /**< bit mask: light crosses between two materials on one surface (with the receiver's
                                   profile) when they share a bit; 0 = only within the material */
    VkBool32 secondSurfaces;  /**< frames with a material that has it are scattered as by
                                   NACRE_TECHNIQUE_BANK_SURFACES where NACRE_TECHNIQUE_BANK is asked for: for light that
                                   reaches from fold to fold of a body, as in jade; slower at edges (docs/scatter.md).
                                   Only in contexts made for both techniques. VK_FALSE: as asked for */
    VkBool32 thinWall;        /**< a sheet without an inside: nacreCmdCompose leaves the share translucency of the scattered
                                   light to the other side. VK_FALSE: a closed body */
} NacreMaterial;

/** Physical defaults: strength 1, translucency 1, scale 1, all exchange groups, no second surfaces; the profile is the
 *  caller's. */
static inline NacreMaterial nacreDefaultMaterial(void) {
    NacreMaterial material;
    memset(&material, 0, sizeof(material));
    material.strength = 1.0f;
    material.translucency = 1.0f;
    material.scale = 1.0f;
    material.exchangeGroups = 0xffffffffu;
    return material;
}

/** An image of the caller's: a 2D view (a 2D array view for shadow maps). */
typedef struct NacreImage {
    VkImageView view;        /**< VK_NULL_HANDLE = not given */
    VkFormat format;
    VkImageLayout layout;    /**< the layout it is in, and stays in: outputs VK_IMAGE_LAYOUT_GENERAL, inputs that or
                                  SHADER_READ_ONLY_OPTIMAL, READ_ONLY_OPTIMAL, DEPTH_READ_ONLY_OPTIMAL,
                                  STENCIL_READ_ONLY_OPTIMAL,
                                  DEPTH_STENCIL_READ_ONLY_OPTIMAL or DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL */
    VkExtent2D extent;       /**< px */
    VkImageUsageFlags usage; /**< what it was created with; 0 = not stated, not checked */
} NacreImage;

/** A camera and its part of the images. */
typedef struct NacreView {
    float clipFromView[16];           /**< any perspective or orthographic projection: reversed, infinite, off-centre,
                                           jittered; maps the render area to [-1, 1] */
    float viewFromWorld[16];          /**< rotation and translation; used by transmit and by normals */
    NacreDepthEncoding depthEncoding;
    float metersPerUnit;              /**< [> 0] 0 = 1 */
    VkRect2D renderArea;              /**< px, the same in all images: the viewport that clipFromView maps to; zero extent =
                                           the irradiance's (transmit: the depth's) whole extent */
    VkRect2D scissor;                 /**< px: the part of the render area that is read and written, e.g. around a
                                           character; larger than that by what its materials reach, since light from beyond
                                           is not seen. Zero extent = the whole render area */
} NacreView;

/** Timestamps around every pass: passCount + 1 queries from firstQuery on (see nacreGetScatterCost and
 *  nacreGetTransmitCost). The caller resets them. */
typedef struct NacreTimestamps {
    VkQueryPool pool;    /**< VK_NULL_HANDLE = none */
    uint32_t firstQuery;
} NacreTimestamps;

typedef struct NacreScatterInfo {
    NacreView view;
    NacreTechnique technique; /**< 0 = default */
    NacreImage irradiance;    /**< diffuse light without albedo and specular, linear, [0, 65504]; what lies beyond may be
                                   taken for the nearer of the two */
    NacreImage depth;
    NacreImage materialId;    /**< unsigned integers, or the stencil aspect of a depth buffer, in the view's first channel
                                   (a swizzle chooses another one); see NacreContextInfo::materialIdMask. Id 0 or one
                                   never set = no subsurface scattering. Not given with NacreContextInfo::noMaterialIds */
    NacreImage normal;        /**< optional, value·normalScale + normalBias, as NacreContextInfo::normalEncoding and
                                   normalSpace say; `brute` and `burley` take the surface's slope from it, without it from
                                   depth differences; others do not read it */
    float normalScale;        /**< 0 = 1 */
    float normalBias;
    NacreImage strength;      /**< optional, red: multiplies the material's strength; without it 1 */
    NacreImage scale;         /**< optional, red, [1e-3, 1e3]: multiplies the lengths of the material's profile, as a map of
                                   radii does; where light leaves decides. What lies beyond is the nearer of the two, what is
                                   no number 1. `thesis`, whose radius is in texels, does not read it. Without it 1, and
                                   nothing slower */
    NacreImage albedo;        /**< optional; without it the output is scattered irradiance and carries no albedo */
    uint32_t burleySampleBudget; /**< [1 … 256] most samples per pixel; 0 = 64 */
    uint32_t burleyRotation;     /**< turns the samples; equal values (modulo 64) give equal pictures. Counting frames
                                      suits temporal anti-aliasing */
    const struct NacreBaselineSettings* baselines; /**< of nacre_baselines.h; null = their defaults */
    NacreImage scattered;     /**< output; not the irradiance image. Where there is no subsurface scattering it is the
                                   irradiance (times the albedo when one is given) */
    VkBool32 skipUnscattered; /**< leaves the pixels of `scattered` whose material id is 0 or was never set as they are:
                                   for callers that ask the id before they read it, as when the scattered light is added
                                   where a stencil or the id says so. VK_FALSE: they get the irradiance, as above */
    NacreTimestamps timestamps;
} NacreScatterInfo;

/** One of several shadow maps of a light, drawn along its direction or from its position. */
typedef struct NacreShadowCascade {
    float clipFromWorld[16]; /**< as NacreLight::shadowClipFromWorld */
    uint32_t shadowMap;      /**< index into NacreTransmitInfo::shadowMaps */
    uint32_t layer;          /**< array layer */
    VkRect2D rectangle;      /**< px, as NacreLight::shadowRectangle; zero extent = the whole layer */
    float range;             /**< scene units, as NacreLight::shadowRange; 0 = the light's; linear depth alone */
    float farDepth;          /**< [> 0] scene units along the view direction: where it ends, larger from one to the next.
                                  NACRE_CASCADE_BY_VIEW_DEPTH alone */
} NacreShadowCascade;

/** A light and what its shadow map needs. World space. */
typedef struct NacreLight {
    NacreLightKind kind;
    float position[3];        /**< spot, point: where it is. Directional: the origin of the shadow map's linear depth; of
                                   hardware depth not read */
    float direction[3];       /**< directional, spot, point with a cone: the way the light travels; need not be normalised */
    float irradiance[3];      /**< directional: on a surface that faces it; spot, point: the same at one metre */
    float range;              /**< scene units, spot and point: falls to zero there (KHR_lights_punctual); 0 = unlimited */
    float attenuation[3];     /**< [>= 0] spot and point: irradiance is divided by a[0] + a[1]·d + a[2]·d², d in metres.
                                   All 0 = {0, 0, 1}, which is physical; {1, 0, 0} = the same at every distance, as where
                                   the caller has put the distance into `irradiance` */
    float innerConeAngle;     /**< [0 … outerConeAngle] rad, half angle, spot */
    float outerConeAngle;     /**< [0 … π/2] rad, half angle, spot. Of a point light: 0 = it shines all around; above, it is
                                   a spot whose map has six layers, as one wide cone needs */
    uint32_t shadowMap;       /**< index into NacreTransmitInfo::shadowMaps, or NACRE_NO_SHADOW_MAP */
    uint32_t shadowLayer;     /**< its first array layer; a point light has six, faces +X -X +Y -Y +Z -Z as in a cube map */
    float shadowClipFromWorld[16]; /**< directional, spot: the matrix the map was drawn with. Point with hardware depth: the
                                   projection of a face, of which [10], [11], [14] and [15] are read */
    float shadowRange;        /**< scene units: linear depth = |stored value| · shadowRange. Directional: along `direction`
                                   from `position`; spot, point: distance from `position`. 1: nothing is there. Below 0:
                                   the back of a body that has an inside, which shadows, but where no light enters */
    NacreDepthEncoding shadowDepthEncoding; /**< how the map's values become depth; maps in depth formats have
                                   NACRE_DEPTH_HARDWARE */
    VkRect2D shadowRectangle; /**< px: the light's part of the map's layers (an atlas), which shadowClipFromWorld maps to
                                   [-1, 1]; zero extent = all */
    VkBool32 shadowFrontFacesCulled; /**< the map has the faces that look away from the light. It then does not know where
                                   light enters a body: the thickness is the authored one (NacreMaterial::thickness,
                                   NacreTransmitInfo::thickness) plus the distance to what is nearer to the light; where
                                   none is authored, no light comes through */
    uint32_t cascadeCount;    /**< [0 … 16] maps of a directional or spot light in place of the one above; each counts
                                   towards NacreContextInfo::maxLights, too. shadowMap, shadowLayer, shadowClipFromWorld
                                   and shadowRectangle are not read then */
    const NacreShadowCascade* cascades;
    NacreCascadeChoice cascadeChoice;
    float cascadeBlend;       /**< [0, 1] the share of a cascade over which it goes over into the next: of its span of view
                                   depth, or of its half width; 0 = none */
} NacreLight;

typedef struct NacreTransmitInfo {
    NacreView view;
    NacreImage depth;
    NacreImage materialId;
    NacreImage normal;            /**< required, as in NacreScatterInfo */
    float normalScale;
    float normalBias;
    NacreImage thickness;         /**< optional, red in mm: as NacreMaterial::thickness, per pixel; 0 = not authored */
    NacreImage strength;          /**< optional, red: multiplies the material's translucency */
    NacreImage scale;             /**< optional, red: as in NacreScatterInfo. A call that has it is as quick as one whose
                                       lights have hardware depth */
    uint32_t lightCount;
    const NacreLight* lights;
    uint32_t shadowMapCount;      /**< [0 … NACRE_MAX_SHADOW_MAPS] images; quickest with one,
                                       in whose layers all lights have their map */
    const NacreImage* shadowMaps; /**< 2D array views, of the depth aspect where there are two; extent: the map, from the
                                       view's first texel */
    float normalOffset;           /**< [texels] how far the receiver shrinks along its normal; 0 = 1.5 */
    float filterRadius;           /**< [texels] radius of the thickness filter; 0 = 2 */
    const struct NacreBaselineSettings* baselines; /**< of nacre_baselines.h; null = their defaults */
    NacreImage transmitted;       /**< output: transmitted irradiance, without albedo; 0 where there is none, and where
                                       the light enters at a point that the camera sees */
    NacreImage thicknessOut;      /**< optional output, red: the thickness along the light, mm, smallest over the lights that
                                       reach the pixel from behind; 0 = none */
    NacreTimestamps timestamps;
} NacreTransmitInfo;

/** Puts scattered and transmitted light together (see WHAT TO DO WITH THE RESULTS; a wall's two sides have one colour). */
typedef struct NacreComposeInfo {
    VkRect2D renderArea;      /**< px, of all images; zero extent = the scattered image's whole extent */
    NacreImage materialId;    /**< as in NacreScatterInfo */
    NacreImage strength;      /**< optional, as in NacreTransmitInfo; read of thin walls, and with
                                   NacreContextInfo::noMaterialIds */
    NacreImage scattered;     /**< nacreCmdScatter's output, now sampled */
    NacreImage transmitted;   /**< optional: nacreCmdTransmit's output, now sampled; without it 0 */
    NacreImage albedo;        /**< optional; without it 1 */
    VkBool32 scatteredHasAlbedo; /**< nacreCmdScatter was given the albedo, so that `scattered` has it already */
    NacreImage composed;      /**< output: albedo / pi * (scattered + transmitted), to be added to the picture; 0 where there
                                   is no subsurface scattering, and in alpha */
    NacreTimestamps timestamps;
} NacreComposeInfo;

/** What one call of nacreCmdScatter, nacreCmdTransmit or nacreCmdCompose costs; the same for any number of layers and, but for
 *  dispatchesPerMaterial, of materials. */
typedef struct NacreCost {
    uint32_t dispatchCount;         /**< with the materials set so far, as everything here, and a render area of maxExtent;
                                         a baseline may take more of them for a larger area */
    uint32_t dispatchesPerMaterial; /**< how many of them each material takes; 0 but for a baseline */
    uint32_t passCount;             /**< what is timed: one a dispatch; all of dispatchesPerMaterial together are one, and
                                         so are all dispatches of a pass that is repeated */
    const char* const* passNames; /**< static storage */
    VkDeviceSize intermediateBytes; /**< device memory of the images and buffers between its passes, at maxExtent */
    VkDeviceSize materialBytes;     /**< device memory its tables take per material and frame in flight */
} NacreCost;

/** The library's NACRE_HEADER_VERSION. */
NACRE_API uint32_t nacreGetVersion(void);
/** The enumerator's name; "NACRE_ERROR_UNKNOWN" for other values. */
NACRE_API const char* nacreResultString(NacreResult result);
/** The techniques of scatter that this library has, the baselines last. techniques null: *techniqueCount becomes their
 *  number. Else it is how many fit into techniques, and becomes how many were written; NACRE_ERROR_LIMIT_EXCEEDED when
 *  that is not all. */
NACRE_API NacreResult nacreGetTechniques(uint32_t* techniqueCount, NacreTechnique* techniques);
/** A technique's name in options, files and messages, e.g. "bank-surfaces"; "default" for NACRE_TECHNIQUE_DEFAULT;
 *  "unknown" for what this library does not have. Static storage. */
NACRE_API const char* nacreTechniqueString(NacreTechnique technique);
/** What a device must bring; no device is needed to ask. */
NACRE_API NacreResult nacreGetRequirements(NacreRequirements* requirements);
/** What an image in this slot must bring. */
NACRE_API NacreResult nacreGetImageRequirements(NacreImageSlot slot, NacreImageRequirements* requirements);

/** What a context made with this info needs in memory; its members deviceMemory and hostMemory are not looked at. */
NACRE_API NacreResult nacreGetMemoryRequirements(const NacreContextInfo* info, NacreMemoryRequirements* requirements);
/** Allocates everything recording needs and compiles the pipelines. */
NACRE_API NacreResult nacreCreateContext(const NacreContextInfo* info, NacreContext* context);
/** The device must have finished with the context's work. Null is allowed. */
NACRE_API void nacreDestroyContext(NacreContext context);
/** Changes maxExtent. The device must have finished with the context's work. On failure the old extent stays.
 *  deviceMemory: in place of NacreContextInfo::deviceMemory from now on, which then is the caller's again (see
 *  nacreGetMemoryRequirements for what it needs); null = as before, which fails where memory that was given is too small. It
 *  may be the same memory. */
NACRE_API NacreResult nacreResize(NacreContext context, VkExtent2D maxExtent, const NacreMemory* deviceMemory);
/** Sets materials firstId … firstId + count - 1, ids in [1, NACRE_MAX_MATERIALS]. May be called while frames are in flight: a frame sees
 *  the materials set before its nacreBeginFrame, whole. On error nothing changes. */
NACRE_API NacreResult nacreSetMaterials(NacreContext context, uint32_t firstId, uint32_t count,
                                        const NacreMaterial* materials);
/** The names of the library's materials, e.g. "skin". names null: *nameCount becomes their number. Else it is how many fit into
 *  names, and becomes how many were written; NACRE_ERROR_LIMIT_EXCEEDED when that is not all. Static storage. */
NACRE_API NacreResult nacreGetPresets(uint32_t* nameCount, const char** names);
/** Sets material id to one of these, as nacreSetMaterials does. A material from a file: nacre_files.h. */
NACRE_API NacreResult nacreSetPreset(NacreContext context, uint32_t id, const char* name);
/** Starts a frame: frame [0 … framesInFlight) may be recorded anew, with the materials set so far. The device must have
 *  finished what was recorded with this number before. Host work only; nothing is allocated. */
NACRE_API NacreResult nacreBeginFrame(NacreContext context, uint32_t frame);
/** Light spreading under front-lit surfaces. */
NACRE_API NacreResult nacreCmdScatter(NacreContext context, VkCommandBuffer commandBuffer, const NacreScatterInfo* info);
/** Light coming through back-lit bodies. */
NACRE_API NacreResult nacreCmdTransmit(NacreContext context, VkCommandBuffer commandBuffer,
                                       const NacreTransmitInfo* info);
/** One image to add to the picture, from the outputs of the two. They are visible to it as inputs: between them and this
 *  stands the caller's barrier, from compute shader writes to compute shader reads. */
NACRE_API NacreResult nacreCmdCompose(NacreContext context, VkCommandBuffer commandBuffer, const NacreComposeInfo* info);
NACRE_API NacreResult nacreGetScatterCost(NacreContext context, NacreTechnique technique, NacreCost* cost);
NACRE_API NacreResult nacreGetTransmitCost(NacreContext context, NacreCost* cost);
NACRE_API NacreResult nacreGetComposeCost(NacreContext context, NacreCost* cost);

#ifdef __cplusplus
}
#endif

#endif
