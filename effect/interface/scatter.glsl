// What every scatter pass includes: inputs, materials, and who gives light to whom. Declares `parameters`, `view`, `materials`
// and the images; needs nothing. POSSIBLE_FLAGS may be defined (pixel_geometry.glsl).
#extension GL_EXT_samplerless_texture_functions : require

#include "blocks.h"

layout(set = 0, binding = bindingParameters, std140) uniform Parameters {
    ScatterParameters parameters;
};
layout(set = 0, binding = bindingMaterials, std430) readonly buffer Materials {
    uint slots[materialIdCount];
    MaterialParameters materials[];
};
layout(set = 0, binding = bindingDepth) uniform texture2D depthImage;
layout(set = 0, binding = bindingMaterialId) uniform utexture2D materialIdImage;
layout(set = 0, binding = bindingNormal) uniform texture2D normalImage;
layout(set = 0, binding = bindingStrength) uniform texture2D strengthImage;
layout(set = 0, binding = bindingScale) uniform texture2D scaleImage;
layout(set = 0, binding = bindingIrradiance) uniform texture2D irradianceImage;
layout(set = 0, binding = bindingAlbedo) uniform texture2D albedoImage;
layout(set = 0, binding = bindingScattered) uniform writeonly image2D scatteredImage;

#define view parameters.view
#include "pixel_geometry.glsl"
#include "encoded_inputs.glsl"

// The largest light of an intermediate of half floats; larger would be infinite, and the next pass would spread it.
const float maxHalf = 65504.0;

// The slot of a pixel's material, 0 where there is no subsurface scattering.
uint materialOfId(uint id) {
    return slots[id & (materialIdCount - 1u)];
}

uint materialAt(ivec2 pixel) {
    return materialOfId(materialIdAt(pixel));
}

// Whether light that enters material `from` may leave material `to`: one material, or a common exchange group.
bool exchanges(uint from, uint to) {
    return from == to || (from != 0u && (materials[from].exchangeGroups & materials[to].exchangeGroups) != 0u);
}

// Whether a material applies the albedo before scattering, too. Asked of the material only where some material does.
bool isAlbedoBefore(uint material) {
    return hasFlag(flagAlbedoBefore) && materials[material].preAndPost != 0u;
}

// The albedo's share that is applied before scattering.
vec3 albedoBefore(ivec2 pixel, uint material) {
    return isAlbedoBefore(material) ? sqrt(texelFetch(albedoImage, pixel, 0).rgb) : vec3(1.0);
}

// The light that enters at a pixel of a material. Not finite where the irradiance is not.
vec3 enteringLight(ivec2 pixel, uint material) {
    return texelFetch(irradianceImage, pixel, 0).rgb * albedoBefore(pixel, material);
}

// What leaves a pixel where only a share of the light that enters has scattered, to `scattered`.
vec3 mixEntering(ivec2 pixel, uint material, vec3 scattered, float strength) {
    vec3 entering = enteringLight(pixel, material);
    return isFinite(entering) ? mix(entering, scattered, strength) : scattered;
}

// Writes a pixel without subsurface scattering, unless it has no material and is to be left as it is.
void writeUnscattered(ivec2 pixel, uint material) {
    if (material == 0u && hasFlag(flagSkipUnscattered)) {
        return;
    }
    vec3 light = texelFetch(irradianceImage, pixel, 0).rgb;
    vec3 albedo = hasFlag(flagAlbedo) ? texelFetch(albedoImage, pixel, 0).rgb : vec3(1.0);
    imageStore(scatteredImage, pixel, vec4(light * albedo, 1.0));
}

// The pixel's factor on how much of its light scatters, [0, 1].
float strengthAt(ivec2 pixel) {
    return hasFlag(flagStrength) ? clamp(texelFetch(strengthImage, pixel, 0).r, 0.0, 1.0) : 1.0;
}

// How much of a pixel's light scatters, [0, 1].
float strengthAt(ivec2 pixel, uint material) {
    return materials[material].strength * strengthAt(pixel);
}

// The albedo's share that is applied after scattering.
vec3 albedoAfter(ivec2 pixel, uint material) {
    vec3 albedo = hasFlag(flagAlbedo) ? texelFetch(albedoImage, pixel, 0).rgb : vec3(1.0);
    return isAlbedoBefore(material) ? sqrt(albedo) : albedo;
}

// Writes a pixel of a material, given its light before the albedo that is applied after scattering.
void writeLight(ivec2 pixel, uint material, vec3 light) {
    imageStore(scatteredImage, pixel, vec4(light * albedoAfter(pixel, material), 1.0));
}

// Writes a pixel of a material, given the light that leaves there before strength and albedo.
void writeScattered(ivec2 pixel, uint material, vec3 leaving) {
    float strength = strengthAt(pixel, material);
    if (strength < 1.0) {
        leaving = mixEntering(pixel, material, leaving, strength);
    }
    writeLight(pixel, material, leaving);
}
