// Light on every visible surface: diffuse irradiance without albedo, and specular reflection beside it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "ggx.glsl"
#include "environment.glsl"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0, std140) uniform View {
    ViewConstants view;
};
layout(set = 0, binding = 1, std140) uniform EnvironmentBlock {
    EnvironmentConstants environment;
};
layout(set = 0, binding = 2, std430) readonly buffer Lights {
    LightConstants lights[];
};
layout(set = 0, binding = 3, std430) buffer Coverage {
    uint subsurfacePixels;
};
layout(set = 0, binding = 4) uniform sampler2D depthImage;
layout(set = 0, binding = 5) uniform sampler2D shadingNormalImage;
layout(set = 0, binding = 6) uniform sampler2D vertexNormalImage;
layout(set = 0, binding = 7) uniform sampler2D reflectionImage;
layout(set = 0, binding = 8) uniform usampler2D materialIdImage;
layout(set = 0, binding = 9) uniform sampler2D occlusionImage;
layout(set = 0, binding = 10) uniform sampler2DArray shadowMaps;
layout(set = 0, binding = 11) uniform samplerCube specularEnvironment;
layout(set = 0, binding = 12) uniform sampler2D reflectanceImage;
layout(set = 0, binding = 13, rgba16f) uniform writeonly image2D outIrradiance;
layout(set = 0, binding = 14, rgba16f) uniform writeonly image2D outSpecular;
layout(set = 0, binding = 15, std430) readonly buffer Lobes {
    LobeConstants lobes[]; // by material id
};
layout(push_constant) uniform Push {
    uint lightCount;
};

#include "camera_rays.glsl"
#include "shadow_filter.glsl"
#include "shading.glsl"

shared uint groupSubsurfacePixels;

Light shade(ivec2 pixel, vec4 shadingNormal) {
    vec4 reflection = texelFetch(reflectionImage, pixel, 0);
    Surface surface;
    surface.position = worldPosition(pixel, texelFetch(depthImage, pixel, 0).r);
    surface.normal = normalize(shadingNormal.xyz);
    surface.vertexNormal = normalize(texelFetch(vertexNormalImage, pixel, 0).xyz);
    surface.toView = -viewDirection(pixel);
    surface.f0 = reflection.rgb;
    surface.alpha = alphaOf(reflection.a);
    vec4 second = lobes[texelFetch(materialIdImage, pixel, 0).r].second;
    surface.secondLobe = second.x;
    surface.secondAlpha = alphaOf(min(reflection.a * second.y, 1.0));
    return lightOn(surface, lightCount, texelFetch(occlusionImage, pixel, 0).r);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        groupSubsurfacePixels = 0u;
    }
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(view.size.xy)))) {
        vec4 shadingNormal = texelFetch(shadingNormalImage, pixel, 0);
        Light light = Light(vec3(0.0), vec3(0.0));
        if (shadingNormal.w > 0.0) {
            light = shade(pixel, shadingNormal);
        }
        imageStore(outIrradiance, pixel, vec4(min(light.diffuse, 65504.0), 1.0));
        imageStore(outSpecular, pixel, vec4(min(light.specular, 65504.0), 1.0));
        if (texelFetch(materialIdImage, pixel, 0).r != 0u) {
            atomicAdd(groupSubsurfacePixels, 1u);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && groupSubsurfacePixels != 0u) {
        atomicAdd(subsurfacePixels, groupSubsurfacePixels);
    }
}
