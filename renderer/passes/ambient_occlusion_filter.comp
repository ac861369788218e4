// Averages the 4 by 4 pattern of ambient_occlusion.comp over the pixels that lie on the same surface.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0) uniform sampler2D visibilityImage;
layout(set = 0, binding = 1) uniform sampler2D depthImage;
layout(set = 0, binding = 2, r32f) uniform writeonly image2D outVisibility;

/// Relative difference in depth beyond which a pixel is another surface's.
const float depthTolerance = 0.02;

void main() {
    ivec2 size = imageSize(outVisibility);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    float depth = texelFetch(depthImage, pixel, 0).r;
    vec2 sum = vec2(texelFetch(visibilityImage, pixel, 0).r, 1.0) * 1e-3;
    for (int y = -2; y < 2; ++y) {
        for (int x = -2; x < 2; ++x) {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), size - 1);
            float difference = abs(texelFetch(depthImage, at, 0).r - depth) / depth;
            sum += vec2(texelFetch(visibilityImage, at, 0).r, 1.0) * max(0.0, 1.0 - difference / depthTolerance);
        }
    }
    imageStore(outVisibility, pixel, vec4(sum.x / sum.y));
}
