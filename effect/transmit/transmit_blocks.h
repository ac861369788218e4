// What C++ and GLSL share of transmission.
#ifndef NACRE_EFFECT_TRANSMIT_BLOCKS_H
#define NACRE_EFFECT_TRANSMIT_BLOCKS_H

#include "interface/blocks.h"

#ifdef __cplusplus
namespace nacre::effect {
#endif

// Intermediates (blocks.h).
NACRE_CONSTANT intermediateNoShadowMap = 2;

NACRE_CONSTANT maxShadowMaps = 16; // NACRE_MAX_SHADOW_MAPS

struct TransmitParameters {
    ViewParameters view;
    float normalOffset; // texels
    float filterRadius; // texels
    float unused0, unused1;
};

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
    float spread;    // mm, outside of which a quarter of the widest channel's light leaves
    uint unused;
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
    float coneScale; // KHR_lights_punctual: spot attenuation = saturate(cos·coneScale + coneOffset)²; 0: no cone
    float coneOffset;
    uint kind;
    uint shadowMap; // NACRE_NO_SHADOW_MAP = none
    uint shadowLayer;
    float shadowTexel; // scene units, size of a texel where w is 1
    vec2 shadowSize; // texels
    // The rest is read where the constant generalCall is true.
    // Hardware depth: from (texel, stored value, 1) to the homogeneous offset from `position`, of which a cube's face has the
    // length alone.
    mat4 offsetFromTexel;
    vec4 attenuation;    // xyz: the irradiance is divided by x + y·d + z·d², d in metres
    ivec2 shadowOrigin;  // px, of its part of the map
    vec2 cascadeSpan;    // mm of view depth, from where to where
    uint shadowFlags;
    uint firstCascade; // index of its first cascade, which is a light itself but for being dispatched
    uint cascadeCount;
    float cascadeBlend;
};

NACRE_CONSTANT shadowHardwareDepth = 1u;
NACRE_CONSTANT shadowFrontFacesCulled = 2u;
NACRE_CONSTANT shadowCascadeByViewDepth = 4u;

#ifdef __cplusplus
static_assert(offsetof(TransmitParameters, normalOffset) == 256 && sizeof(TransmitParameters) == 272);
static_assert(maxLayers % 2 == 0); // transmittance.glsl adds two a turn
static_assert(offsetof(TransmitTable, transmittance) == 16 &&
              sizeof(TransmitTable) == 16 * (1 + maxLayers) + 8 * (transmittanceLast + 2));
static_assert(offsetof(LightParameters, position) == 48 && offsetof(LightParameters, coneScale) == 96 &&
              offsetof(LightParameters, shadowSize) == 120 && offsetof(LightParameters, offsetFromTexel) == 128 &&
              offsetof(LightParameters, shadowOrigin) == 208 && sizeof(LightParameters) == 240);

} // namespace nacre::effect
#endif
#endif
