// What C++ and GLSL share: bindings, table sizes, and the structures of uniform and storage buffers. Included by both;
// vec4-aligned so that std140, std430 and C++ agree, which the static_asserts at the end check.
#ifndef NACRE_EFFECT_BLOCKS_H
#define NACRE_EFFECT_BLOCKS_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>

namespace nacre::effect {

using uint = std::uint32_t;
struct vec2 {
    float x, y;
};
struct ivec2 {
    std::int32_t x, y;
};
struct ivec4 {
    std::int32_t x, y, z, w;
};
struct vec4 {
    float x, y, z, w;
};
struct uvec2 {
    uint x, y;
};
struct uvec4 {
    uint x, y, z, w;
};
struct mat4 {
    vec4 columns[4];
};
#define NACRE_CONSTANT inline constexpr uint
#define NACRE_FUNCTION constexpr
#else
#define NACRE_CONSTANT const uint
#define NACRE_FUNCTION
#endif

// Bindings of set 0. Scatter and transmit have one layout each; a number means the same in both.
NACRE_CONSTANT bindingParameters = 0;  // uniform: ScatterParameters or TransmitParameters
NACRE_CONSTANT bindingMaterials = 1;   // storage: uint slots[materialIdCount], MaterialParameters[slot]
NACRE_CONSTANT bindingTables = 2;      // storage: the technique's table, one block a material
NACRE_CONSTANT bindingDepth = 3;
NACRE_CONSTANT bindingMaterialId = 4;
NACRE_CONSTANT bindingNormal = 5;
NACRE_CONSTANT bindingStrength = 6;
NACRE_CONSTANT bindingIrradiance = 7;  // scatter
NACRE_CONSTANT bindingAlbedo = 8;      // scatter
NACRE_CONSTANT bindingScattered = 9;   // scatter, output
NACRE_CONSTANT bindingThickness = 10;  // transmit
NACRE_CONSTANT bindingLights = 11;     // transmit, storage: LightParameters[]
NACRE_CONSTANT bindingShadowMaps = 12; // transmit, array of maxShadowMaps
NACRE_CONSTANT bindingTransmitted = 13;  // transmit, output
NACRE_CONSTANT bindingThicknessOut = 14; // transmit, output
NACRE_CONSTANT bindingIntermediates = 16; // + Intermediate

// The order of enum class Intermediate (technique.hpp), for layout(binding = bindingIntermediates + ...).
NACRE_CONSTANT intermediateRows = 0;
NACRE_CONSTANT intermediatePixels = 1;
NACRE_CONSTANT intermediateNoShadowMap = 2;
NACRE_CONSTANT intermediateBankRaw = 3;
NACRE_CONSTANT intermediateBankBlurred = 4;
NACRE_CONSTANT intermediateBankSurfaces = 5;
NACRE_CONSTANT intermediateBankAreas = 6;
NACRE_CONSTANT intermediateBankTiles = 7;
NACRE_CONSTANT intermediateBankMaterials = 8;
NACRE_CONSTANT intermediateBankSeconds = 9;

NACRE_CONSTANT maxShadowMaps = 16; // NACRE_MAX_SHADOW_MAPS

// ViewParameters::flags: which optional images are given, and what is asked for.
NACRE_CONSTANT flagNormal = 1u;
NACRE_CONSTANT flagStrength = 2u;
NACRE_CONSTANT flagAlbedo = 4u;
NACRE_CONSTANT flagThickness = 8u;
NACRE_CONSTANT flagThicknessOut = 16u;
NACRE_CONSTANT flagThesisTransmittance = 32u;
NACRE_CONSTANT flagHardwareDepth = 64u;
NACRE_CONSTANT flagSkipUnscattered = 128u; // NacreScatterInfo::skipUnscattered
NACRE_CONSTANT flagAlbedoBefore = 256u;    // with flagAlbedo: some material may apply it before scattering, too

// A camera. Lengths in mm, pixels are those of the whole image. A pixel's view-space position at view depth z is
// (ray·z + origin, z) with ray = rayX·pixel.x + rayY·pixel.y + rayBias and origin alike (pixel_geometry.glsl).
struct ViewParameters {
    mat4 viewFromWorld; // rotation only
    mat4 worldFromView; // view space in mm -> world space in scene units
    // Clip z along a pixel's ray = depthSlope·z + depthBias, each of them x·pixel.x + y·pixel.y + z.
    vec4 depthSlope, depthBias;
    vec2 rayX, rayY;
    vec2 rayBias, originBias;
    vec2 originX, originY;
    vec2 clipW;         // clip w = clipW.x·z + clipW.y
    ivec2 areaOffset;   // px
    ivec2 areaExtent;   // px
    float mmPerUnit;
    float normalScale;
    float normalBias;
    uint flags;
    uint lightCount;
    float distanceOrigin; // view z that distances along rays are counted from, mm; behind all that can be drawn
};

struct ScatterParameters {
    ViewParameters view;
    float pixelWidth; // mm a pixel spans at clip w 1, geometric mean of x and y
    uint burleySampleBudget;
    uint burleyRotation;
    uint thesisRadius; // taps on either side
    float thesisStrength;
    float unused0, unused1, unused2;
    // Of `bank`, per level of the pyramid from 1 on: its first texel, width, height, and, from 2 on, first block of the blur.
    ivec4 bankLevels[7];
};

struct TransmitParameters {
    ViewParameters view;
    float normalOffset; // texels
    float filterRadius; // texels
    float unused0, unused1;
};

// A material that is set has a slot, from 1 on; `material` in the shaders is one. slots[id] is 0 where none is set.
NACRE_CONSTANT materialIdCount = 65536; // NACRE_MAX_MATERIALS + 1
struct MaterialParameters {
    float radius; // mm, 99.9 % of the light leaves within it; 0 = light leaves where it enters
    float strength;
    float translucency;
    float thickness; // mm, 0 = not authored
    uint exchangeGroups;
    uint preAndPost;
    uint secondSurfaces; // NacreMaterial::secondSurfaces, which no shader asks
    uint unused0;
};

// Line-spread table of `separable`: entry i is the light between 0 and x = radius·(i / (entries - 1))², so the last
// is half the light within the radius. The square puts entries where narrow layers need them.
NACRE_CONSTANT lineSpreadEntries = 128;

// Radial table of `brute`: entry i is R(r) in 1/mm² at r = radius·(i / (entries - 1))²; used from bruteCellRadius px on.
NACRE_CONSTANT radialEntries = 256;
NACRE_CONSTANT maxLayers = 32; // NACRE_MAX_LAYERS
struct BruteTable {
    vec4 meanFreePath; // w: number of layers; 0 = Burley's profile
    vec4 layers[maxLayers];
    vec4 radial[radialEntries];
};
struct BrutePixel {
    vec4 light;    // irradiance; w: surface area in mm², 0 = contributes nothing
    vec4 position; // view space, mm; w: material id
    vec2 slope;    // of its patch, mm of view z per pixel in x and y
    vec2 unused;
};

// Mixture table of `bank` in 16-byte words: bins at the same scales for every material, so that a pixel finds its own without
// asking where its material's begin; each is a line of a cache, 128 bytes. A bin is eight kernels: halves red and green; those
// of the next bin; blue and that of the next bin; of kernels 0, 2 and 4 the material's strength, a float whose eight lowest
// bits are those of the kernels that have a weight; else nothing.
NACRE_CONSTANT bankBinWords = 8;
NACRE_CONSTANT bankTableBins = 193;
NACRE_CONSTANT bankTableWords = bankTableBins * bankBinWords;
// Workgroups along x of the combination's dispatches; longer lists take several rows. Those of 3840x2160 fit one.
NACRE_CONSTANT bankDispatchWidth = 65535;
struct BankDispatch {
    uint x, y, z; // VkDispatchIndirectCommand
    uint count;   // regions on the list, where it may be longer than a row
};

// Tables of `burley`, entry i: R in 1/mm² and share of the light within r = radius·share², share = i / (entries - 1).
// radial's w is r² at which this part of the light within the radius has left in the widest channel: 1 - (1 - share)².
NACRE_CONSTANT burleyEntries = 256;
struct BurleyTable {
    vec4 meanFreePath; // of Burley's profile; r = 0: the profile is in the tables
    uint widest;       // the channel with the largest radius
    float share;       // of its light within the radius
    uint unused0, unused1;
    vec4 radial[burleyEntries];
    vec4 cumulative[burleyEntries];
};

// Table of `thesis`: the slice kernels of radius 1 … thesisMaxRadius, one after the other. Of each, the taps from the
// middle on: weight, and the offset in w. They are symmetric.
NACRE_CONSTANT thesisMaxRadius = 16;
NACRE_CONSTANT thesisTaps = 152;      // = thesisKernelStart(thesisMaxRadius + 1)
NACRE_CONSTANT thesisGroupSize = 128; // pixels of a row per thread group
NACRE_FUNCTION uint thesisKernelStart(uint radius) {
    return (radius - 1u) * (radius + 2u) / 2u;
}

// Transmittance table over x = 1 + scale·d in [1, 2^octaves], as dense as floats: x's exponent and the first bits of
// its mantissa are the entry's index. An entry holds T where it begins, three half floats; from the last on T is 0. And the
// profile's layers, for thesisTransmittance: weights, and 1/mm² of variance in w.
NACRE_CONSTANT transmittanceOctaves = 8;
NACRE_CONSTANT transmittanceMantissaBits = 4;
NACRE_CONSTANT transmittanceEnd = (1u << transmittanceOctaves) - 1u; // scale·d where the table ends
NACRE_CONSTANT transmittanceLast = transmittanceOctaves << transmittanceMantissaBits;
struct TransmitTable {
    float scale;     // 1/mm
    uint layerCount; // 0 = Burley's profile
    uint unused0, unused1;
    uvec2 transmittance[transmittanceLast + 2];
    vec4 layers[maxLayers];
};

// A light of nacreCmdTransmit; world space, scene units.
struct LightParameters {
    // Directional, spot: rows that project an offset from `position` to its shadow map, texel · w and w.
    vec4 shadowX, shadowY, shadowW;
    vec4 position;   // w: range, 0 = unlimited
    vec4 direction;  // normalised; w: shadowRange
    vec4 irradiance; // w: millimetres per unit times 1e-3, i.e. metres per unit
    float coneScale; // KHR_lights_punctual: spot attenuation = saturate(cos·coneScale + coneOffset)²
    float coneOffset;
    uint kind;
    uint shadowMap; // NACRE_NO_SHADOW_MAP = none
    uint shadowLayer;
    float shadowTexel; // scene units, size of a texel where w is 1
    vec2 shadowSize; // texels
};

#ifdef __cplusplus
static_assert(offsetof(ViewParameters, depthSlope) == 128 && offsetof(ViewParameters, rayX) == 160 &&
              offsetof(ViewParameters, clipW) == 208 && offsetof(ViewParameters, mmPerUnit) == 232 &&
              sizeof(ViewParameters) == 256);
static_assert(offsetof(ScatterParameters, pixelWidth) == 256 && offsetof(ScatterParameters, bankLevels) == 288 &&
              sizeof(ScatterParameters) == 288 + 7 * sizeof(ivec4));
static_assert(offsetof(TransmitParameters, normalOffset) == 256 && sizeof(TransmitParameters) == 272);
static_assert(offsetof(MaterialParameters, exchangeGroups) == 16 && sizeof(MaterialParameters) == 32);
static_assert(offsetof(BruteTable, radial) == 16 * (1 + maxLayers) && sizeof(BruteTable) == 16 * 289);
static_assert(sizeof(BrutePixel) == 48);
static_assert(sizeof(BankDispatch) == 16);
static_assert(offsetof(BurleyTable, radial) == 32 && sizeof(BurleyTable) == 16 * (2 + 2 * burleyEntries));
static_assert(thesisKernelStart(1) == 0 && thesisKernelStart(thesisMaxRadius + 1) == thesisTaps);
static_assert(offsetof(TransmitTable, transmittance) == 16 &&
              sizeof(TransmitTable) == 16 * (1 + maxLayers) + 8 * (transmittanceLast + 2));
static_assert(offsetof(LightParameters, position) == 48 && offsetof(LightParameters, coneScale) == 96 &&
              offsetof(LightParameters, shadowSize) == 120 && sizeof(LightParameters) == 128);

} // namespace nacre::effect
#endif
#undef NACRE_CONSTANT
#undef NACRE_FUNCTION
#endif
