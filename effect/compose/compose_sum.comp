// Puts the picture's diffuse light together: what nacreCmdScatter and nacreCmdTransmit gave, times the surface's colour, as one
// image that is added. 0 where there is no subsurface scattering.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scatter.glsl"

// It has scatter's bindings: the scattered light is at the irradiance's place, the transmitted at the normals'.
#define scatteredLightImage irradianceImage
#define transmittedImage normalImage

layout(local_size_x = 16, local_size_y = 8) in;

const float inversePi = 0.31830988618;

// What of the scattered light stays on this side: all, but of a thin wall what does not go through.
float keptShare(ivec2 pixel, uint material) {
    return materials[material].thinWall != 0u ? 1.0 - materials[material].translucency * strengthAt(pixel) : 1.0;
}

vec3 diffuseAt(ivec2 pixel, uint material) {
    vec3 albedo = hasFlag(flagAlbedo) ? texelFetch(albedoImage, pixel, 0).rgb : vec3(1.0);
    vec3 scattered = texelFetch(scatteredLightImage, pixel, 0).rgb * keptShare(pixel, material);
    vec3 diffuse = hasFlag(flagScatteredHasAlbedo) ? scattered : albedo * scattered;
    if (hasFlag(flagTransmitted)) {
        diffuse += albedo * texelFetch(transmittedImage, pixel, 0).rgb;
    }
    return diffuse * inversePi;
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    ivec2 pixel = local + view.areaOffset;
    uint material = materialAt(pixel);
    imageStore(scatteredImage, pixel, vec4(material != 0u ? diffuseAt(pixel, material) : vec3(0.0), 0.0));
}
