// The specular reflectance of a white environment as F0 · r + g, over N·V and roughness (Karis 2013, the split sum's
// second factor).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "ggx.glsl"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0, rgba16f) uniform writeonly image2D outReflectance;

const uint sampleCount = 256u;

void main() {
    ivec2 size = imageSize(outReflectance);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec2 uv = (vec2(pixel) + 0.5) / vec2(size);
    float nDotV = uv.x;
    float alpha = max(uv.y * uv.y, 1e-3);
    vec3 toView = vec3(sqrt(1.0 - nDotV * nDotV), 0.0, nDotV);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < sampleCount; ++i) {
        vec3 h = sampleGgx(hammersley(i, sampleCount), alpha);
        vec3 toLight = reflect(-toView, h);
        float vDotH = max(dot(toView, h), 0.0);
        if (toLight.z > 0.0) {
            float weight = 4.0 * ggxVisibility(toLight.z, nDotV, alpha) * toLight.z * vDotH / max(h.z, 1e-6);
            float edge = pow(1.0 - vDotH, 5.0);
            sum += weight * vec2(1.0 - edge, edge);
        }
    }
    imageStore(outReflectance, pixel, vec4(sum / float(sampleCount), 0.0, 1.0));
}
