// Puts the picture's radiance together: albedo / pi · (scattered + transmitted) + specular + emission, with the light of
// thin walls divided between their two sides (include/nacre/nacre.h, "What to do with the results"), the surroundings where
// there is nothing, and blended surfaces before both.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "environment.glsl"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0, std140) uniform View {
    ViewConstants view;
};
layout(set = 0, binding = 1, std140) uniform EnvironmentBlock {
    EnvironmentConstants environment;
};
layout(set = 0, binding = 2, std430) readonly buffer Transmissions {
    TransmissionConstants transmissions[]; // by material id
};
layout(set = 0, binding = 3) uniform sampler2D shadingNormalImage;
layout(set = 0, binding = 4) uniform sampler2D albedoImage;
layout(set = 0, binding = 5) uniform sampler2D emissionImage;
layout(set = 0, binding = 6) uniform usampler2D materialIdImage;
layout(set = 0, binding = 7) uniform sampler2D irradianceImage;
layout(set = 0, binding = 8) uniform sampler2D specularImage;
layout(set = 0, binding = 9) uniform sampler2D scatteredImage; // written where there is a material
layout(set = 0, binding = 10) uniform sampler2D transmittedImage;
layout(set = 0, binding = 11) uniform sampler2D environmentImage;
layout(set = 0, binding = 12) uniform sampler2D occlusionImage;
layout(set = 0, binding = 13) uniform sampler2D transmissionImage; // r: thickness, gba: colour, as GBuffer::Transmission
layout(set = 0, binding = 14) uniform sampler2D blendedImage;
layout(set = 0, binding = 15) uniform sampler2D vertexNormalImage; // w: scale of the material's lengths
layout(set = 0, binding = 16, rgba16f) uniform writeonly image2D outRadiance;
layout(push_constant) uniform Push {
    uint scatter;
    uint scatteredHasAlbedo;
    uint transmit;
    uint hasThickness;
    uint hasScale;
    uint hasTransmissionColors;
    uint hasBlended;
};

#include "camera_rays.glsl"

/// Transmittance of a slab.
vec3 throughSlab(uint material, float millimetres) {
    float middle = transmissions[material].share.y;
    float place = float(throughSteps) * middle / (middle + millimetres);
    uint first = min(uint(place), throughSteps - 1u);
    return mix(transmissions[material].through[first].rgb, transmissions[material].through[first + 1u].rgb,
               place - float(first));
}

/// What the surroundings' light gains by coming through: what arrives behind comes in place of what arrives in front, which
/// is in the scattered light. So surroundings that are even change nothing. What occludes this side stands for what occludes
/// the other.
vec3 surroundingsThrough(ivec2 pixel, uint material, float share, float factor) {
    float millimetres = hasThickness != 0u && material != 0u ? texelFetch(transmissionImage, pixel, 0).r : 0.0;
    if (share <= 0.0 && millimetres <= 0.0) {
        return vec3(0.0);
    }
    vec3 normal = texelFetch(shadingNormalImage, pixel, 0).xyz;
    vec3 behind = environmentIrradiance(environment, -normal);
    float visibility = texelFetch(occlusionImage, pixel, 0).r;
    if (share > 0.0) { // a thin wall, which compose has taken its share from
        return share * visibility * behind;
    }
    if (hasScale != 0u) { // longer paths in a profile are a thinner body in it
        millimetres /= texelFetch(vertexNormalImage, pixel, 0).w;
    }
    return factor * throughSlab(material, millimetres) * visibility *
           (behind - environmentIrradiance(environment, normal));
}

/// Of what comes through. A texture multiplies the material's own colour, and stands in for the albedo where it has none.
vec3 colorThrough(ivec2 pixel, uint material, vec3 albedo) {
    vec4 own = transmissions[material].color;
    vec3 texel = hasTransmissionColors != 0u ? texelFetch(transmissionImage, pixel, 0).gba : vec3(-1.0);
    if (texel.r < 0.0) {
        return own.w > 0.0 ? own.rgb : albedo;
    }
    return own.w > 0.0 ? own.rgb * texel : texel;
}

vec3 diffuseRadiance(ivec2 pixel) {
    vec4 albedoAndFactor = texelFetch(albedoImage, pixel, 0);
    vec3 albedo = albedoAndFactor.rgb;
    uint material = texelFetch(materialIdImage, pixel, 0).r;
    bool isScattered = scatter != 0u && material != 0u;
    vec3 reflected = isScattered ? texelFetch(scatteredImage, pixel, 0).rgb : texelFetch(irradianceImage, pixel, 0).rgb;
    if (!isScattered || scatteredHasAlbedo == 0u) {
        reflected *= albedo;
    }
    if (transmit == 0u) {
        return reflected / pi;
    }
    vec3 transmitted = texelFetch(transmittedImage, pixel, 0).rgb;
    float factor = albedoAndFactor.a; // on the share of the light that comes through, which is in `transmitted`
    float share = transmissions[material].share.x * factor;
    transmitted += surroundingsThrough(pixel, material, share, factor);
    vec3 through = colorThrough(pixel, material, albedo) * transmitted;
    return max((1.0 - share) * reflected + through, 0.0) / pi;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) {
        return;
    }
    vec3 radiance;
    if (texelFetch(shadingNormalImage, pixel, 0).w > 0.0) {
        radiance = diffuseRadiance(pixel) + texelFetch(specularImage, pixel, 0).rgb +
                   texelFetch(emissionImage, pixel, 0).rgb;
    } else {
        vec3 direction = environmentDirection(viewDirection(pixel), environment.rotation.xy);
        radiance = textureLod(environmentImage, equirectangular(direction), 0.0).rgb * environment.rotation.z;
    }
    if (hasBlended != 0u) {
        vec4 blended = texelFetch(blendedImage, pixel, 0);
        radiance = (1.0 - blended.a) * radiance + blended.rgb;
    }
    imageStore(outRadiance, pixel, vec4(min(radiance, 65504.0), 1.0));
}
