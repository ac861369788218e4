// One level of the prefiltered environment: radiance weighted by GGX with the view along the normal (Karis 2013), each
// sample read from the mip level its solid angle covers (Colbert and Krivanek 2007, GPU Gems 3 ch. 20).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "ggx.glsl"
#include "environment.glsl"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2DArray outSpecular;
layout(push_constant) uniform Push {
    float roughness;
};

const uint sampleCount = 64u;

/// Direction of a cube map's texel (Vulkan 1.3, 16.5.4).
vec3 cubeDirection(uint face, vec2 st) {
    switch (face) {
    case 0u:
        return vec3(1.0, -st.y, -st.x);
    case 1u:
        return vec3(-1.0, -st.y, st.x);
    case 2u:
        return vec3(st.x, 1.0, st.y);
    case 3u:
        return vec3(st.x, -1.0, -st.y);
    case 4u:
        return vec3(st.x, -st.y, 1.0);
    default:
        return vec3(-st.x, -st.y, -1.0);
    }
}

/// Radiance around `direction`, averaged over `solidAngle`.
vec3 average(vec3 direction, float solidAngle) {
    vec2 size = vec2(textureSize(radiance, 0));
    float texelAngle = 2.0 * pi * pi / (size.x * size.y) * max(sqrt(1.0 - direction.y * direction.y), 1.0 / size.y);
    return textureLod(radiance, equirectangular(direction), max(0.5 * log2(solidAngle / texelAngle), 0.0)).rgb;
}

void main() {
    ivec2 size = imageSize(outSpecular).xy;
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel.xy, size))) {
        return;
    }
    vec2 st = (vec2(texel.xy) + 0.5) / vec2(size) * 2.0 - 1.0;
    vec3 normal = normalize(cubeDirection(gl_GlobalInvocationID.z, st));
    float cubeTexelAngle = 4.0 * pi / (6.0 * float(size.x * size.y));
    if (roughness == 0.0) {
        imageStore(outSpecular, texel, vec4(average(normal, cubeTexelAngle), 1.0));
        return;
    }
    float alpha = roughness * roughness;
    vec3 tangent = normalize(cross(abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), normal));
    mat3 frame = mat3(tangent, cross(normal, tangent), normal);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (uint i = 0u; i < sampleCount; ++i) {
        vec3 h = sampleGgx(hammersley(i, sampleCount), alpha);
        vec3 toLight = reflect(vec3(0.0, 0.0, -1.0), h);
        if (toLight.z > 0.0) {
            // The density over directions is D n·h / (4 v·h), and here v·h = n·h.
            float density = ggxDistribution(h.z, alpha) / 4.0;
            float sampleAngle = 1.0 / (float(sampleCount) * density);
            sum += average(frame * toLight, max(sampleAngle, cubeTexelAngle)) * toLight.z;
            weight += toLight.z;
        }
    }
    imageStore(outSpecular, texel, vec4(sum / weight, 1.0));
}
