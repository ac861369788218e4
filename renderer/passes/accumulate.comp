// Adds a frame's image to the sum of one side of a window: as a display shows it, and as light.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "tone_curve.glsl"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0) uniform sampler2D radianceImage;
layout(set = 0, binding = 1) uniform sampler2D specularImage;
layout(set = 0, binding = 2) uniform sampler2D irradianceImage;
layout(set = 0, binding = 3) uniform sampler2D scatteredImage;
layout(set = 0, binding = 4) uniform sampler2D transmittedImage;
layout(set = 0, binding = 5) uniform sampler2D albedoImage;
layout(set = 0, binding = 6) uniform sampler2D shadingNormalImage;
layout(set = 0, binding = 7) uniform sampler2D depthImage;
layout(set = 0, binding = 8) uniform sampler2D thicknessImage;
layout(set = 0, binding = 9) uniform usampler2D materialIdImage;
layout(set = 0, binding = 10, std430) readonly buffer Given {
    vec4 given[];
};
layout(set = 0, binding = 11, std430) buffer Sums {
    vec4 sums[]; // two a pixel: for a display, then light
};
layout(set = 0, binding = 12) uniform sampler2DArray shadowMaps;
layout(set = 0, binding = 13, std430) readonly buffer Radii {
    vec4 radii[]; // of each material, from 1: rms radius of its widest channel, mm
};
layout(push_constant) uniform Push {
    AccumulateConstants constants;
};

#include "bank_regions.glsl"

const float pi = 3.14159265358979;

/// Colours of ids, far apart in hue.
vec3 idColor(uint id) {
    float hue = fract(float(id) * 0.61803399);
    return id == 0u ? vec3(0.05) : clamp(abs(fract(hue + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.1, 1.0);
}

/// px that light of the pixel's material travels there.
float footprint(ivec2 pixel, uint material) {
    float atDepth = constants.range.w > 0.0 ? texelFetch(depthImage, pixel, 0).r : -1.0;
    return material == 0u ? 0.0 : constants.range.w / atDepth * radii[material - 1u].x;
}

/// The map as a square in the middle of the picture, as bright as what stands there is near.
float shadowMapAt(ivec2 pixel) {
    vec2 size = vec2(constants.size.xy);
    vec2 place = (vec2(pixel) + 0.5 - 0.5 * size) / min(size.x, size.y) + 0.5;
    ivec2 texels = textureSize(shadowMaps, 0).xy;
    return all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(1.0)))
               ? 1.0 - texelFetch(shadowMaps, ivec3(ivec2(place * vec2(texels)), int(constants.image.z)), 0).r
               : 0.0;
}

/// Footprints from 1/4 px, black, to 256 px, white, as the heat of their logarithm.
vec3 footprintColor(float pixels) {
    float share = pixels > 0.0 ? clamp((log2(pixels) + 2.0) / 10.0, 0.0, 1.0) : 0.0;
    return clamp(vec3(3.0 * share - 0.6, 1.6 * share * share, share < 0.4 ? 2.0 * share : 3.0 * share - 2.0), 0.0, 1.0);
}

vec3 lightOf(ivec2 pixel, uint index) {
    bool isSurface = texelFetch(shadingNormalImage, pixel, 0).w > 0.0;
    uint material = texelFetch(materialIdImage, pixel, 0).r;
    switch (constants.image.x) {
    case shownPicture:
        return texelFetch(radianceImage, pixel, 0).rgb;
    case shownDiffuse:
        return isSurface ? max(texelFetch(radianceImage, pixel, 0).rgb - texelFetch(specularImage, pixel, 0).rgb, 0.0) : vec3(0.0);
    case shownIrradiance:
        return texelFetch(irradianceImage, pixel, 0).rgb / pi;
    case shownScattered: {
        if (constants.effect.x == 0u || material == 0u) {
            return texelFetch(irradianceImage, pixel, 0).rgb / pi;
        }
        vec3 share = constants.effect.y != 0u ? max(texelFetch(albedoImage, pixel, 0).rgb, 1e-4) : vec3(1.0);
        return texelFetch(scatteredImage, pixel, 0).rgb / share / pi;
    }
    case shownTransmitted:
        return constants.effect.z != 0u ? texelFetch(transmittedImage, pixel, 0).rgb / pi : vec3(0.0);
    case shownSpecular:
        return texelFetch(specularImage, pixel, 0).rgb;
    case shownAlbedo:
        return texelFetch(albedoImage, pixel, 0).rgb;
    case shownNormal:
        return isSurface ? texelFetch(shadingNormalImage, pixel, 0).xyz * 0.5 + 0.5 : vec3(0.0);
    case shownDepth:
        return isSurface ? vec3(1.0 - clamp((texelFetch(depthImage, pixel, 0).r - constants.range.x) /
                                            (constants.range.y - constants.range.x), 0.0, 1.0))
                         : vec3(0.0);
    case shownThickness:
        return constants.effect.z != 0u ? vec3(texelFetch(thicknessImage, pixel, 0).r / constants.range.y) : vec3(0.0);
    case shownMaterial:
        return isSurface ? idColor(material) : vec3(0.0);
    case shownFootprint:
        return vec3(footprint(pixel, material));
    case shownShadowMap:
        return vec3(shadowMapAt(pixel));
    case shownRegions: {
        vec3 exposed = texelFetch(radianceImage, pixel, 0).rgb * constants.range.z;
        return regionColor(pixel, 0.45 * clamp(dot(exposed, vec3(1.0 / 3.0)), 0.0, 1.0));
    }
    }
    return given[index].rgb;
}

/// What a display shows of it, before sRGB encoding. Images that are not light are shown as they are.
vec3 shown(vec3 light) {
    if (constants.image.x == shownFootprint) {
        return footprintColor(light.r);
    }
    bool isLight = constants.image.x <= shownSpecular || (constants.image.x == shownGiven && constants.image.w == 0u);
    if (!isLight) {
        return clamp(light, 0.0, 1.0);
    }
    vec3 exposed = light * constants.range.z;
    return clamp(constants.effect.w == curveNeutral ? toneCurve(exposed) : exposed, 0.0, 1.0);
}

void main() {
    if (constants.image.x == shownRegions) {
        classifyRegion();
    }
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, constants.size.xy))) {
        return;
    }
    uint index = pixel.y * constants.size.x + pixel.x;
    uint place = 2u * (constants.size.z + index);
    vec3 light = lightOf(ivec2(pixel), index);
    vec4 display = vec4(shown(light), 1.0);
    if (constants.image.x == shownPicture && constants.size.w != backdropSurroundings &&
        texelFetch(shadingNormalImage, ivec2(pixel), 0).w == 0.0) {
        const float backdrops[] = {0.0, 0.0, 0.18, 1.0};
        display.rgb = vec3(backdrops[constants.size.w]);
    }
    vec4 sum = vec4(light, 1.0);
    if (constants.image.y > 0u) {
        display += sums[place];
        sum += sums[place + 1u];
    }
    sums[place] = display;
    sums[place + 1u] = sum;
}
