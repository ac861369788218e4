// What C++ and GLSL share of every pass: bindings, and the structures of uniform and storage buffers. What is one
// technique's alone is in its folder, in a header of the same kind.
#ifndef NACRE_EFFECT_BLOCKS_H
#define NACRE_EFFECT_BLOCKS_H

#include "glsl_types.h"

#ifdef __cplusplus
namespace nacre::effect {
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
NACRE_CONSTANT bindingScale = 15;
NACRE_CONSTANT bindingIntermediates = 16; // + the intermediate… constants

// The techniques' blocks have the other intermediates; a number means the same in all of them.
NACRE_CONSTANT intermediateNoIds = 15; // stands in for the ids where a context has none; never read
NACRE_CONSTANT intermediateRows = 0; // light after a pass over rows: `separable` and `thesis`

// ViewParameters::flags: which optional images are given, and what is asked for.
NACRE_CONSTANT flagNormal = 1u;
NACRE_CONSTANT flagStrength = 2u;
NACRE_CONSTANT flagAlbedo = 4u;
NACRE_CONSTANT flagScale = 2048u;
NACRE_CONSTANT flagThickness = 8u;
NACRE_CONSTANT flagThicknessOut = 16u;
NACRE_CONSTANT flagThesisTransmittance = 32u;
NACRE_CONSTANT flagHardwareDepth = 64u;
NACRE_CONSTANT flagSkipUnscattered = 128u; // NacreScatterInfo::skipUnscattered
NACRE_CONSTANT flagTransmitted = 512u;        // compose: there is transmitted light
NACRE_CONSTANT flagScatteredHasAlbedo = 1024u; // NacreComposeInfo::scatteredHasAlbedo
NACRE_CONSTANT flagAlbedoBefore = 256u;    // with flagAlbedo: some material may apply it before scattering, too

// Ids of the specialization constants of encoded_inputs.glsl, and the bits of normalEncoding.
NACRE_CONSTANT constantNoMaterialIds = 1000;
NACRE_CONSTANT constantNormalEncoding = 1001;
NACRE_CONSTANT normalOctahedral = 1u;
NACRE_CONSTANT normalInViewSpace = 2u;

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

// A material that is set has a slot, from 1 on; `material` in the shaders is one. slots[id] is 0 where none is set.
NACRE_CONSTANT materialIdCount = 65536; // NACRE_MAX_MATERIALS + 1
NACRE_CONSTANT maxLayers = 32;          // NACRE_MAX_LAYERS
struct MaterialParameters {
    float radius; // mm, 99.9 % of the light leaves within it; 0 = light leaves where it enters
    float strength;
    float translucency;
    float thickness; // mm, 0 = not authored
    uint exchangeGroups;
    uint preAndPost;
    uint secondSurfaces; // NacreMaterial::secondSurfaces, which no shader asks
    uint thinWall;
};

#ifdef __cplusplus
static_assert(offsetof(ViewParameters, depthSlope) == 128 && offsetof(ViewParameters, rayX) == 160 &&
              offsetof(ViewParameters, clipW) == 208 && offsetof(ViewParameters, mmPerUnit) == 232 &&
              sizeof(ViewParameters) == 256);
static_assert(offsetof(ScatterParameters, pixelWidth) == 256 && offsetof(ScatterParameters, bankLevels) == 288 &&
              sizeof(ScatterParameters) == 288 + 7 * sizeof(ivec4));
static_assert(offsetof(MaterialParameters, exchangeGroups) == 16 && sizeof(MaterialParameters) == 32);

} // namespace nacre::effect
#endif
#endif
