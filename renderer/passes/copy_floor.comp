// Reads what every scatter technique must read, writes every pixel, as it must where all of them scatter, and does nothing else.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0) uniform sampler2D irradianceImage;
layout(set = 0, binding = 1) uniform sampler2D depthImage;
layout(set = 0, binding = 2) uniform usampler2D materialImage;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D outCopy;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(outCopy)))) {
        return;
    }
    // Depth and id end up in the result so that reading them cannot be left out.
    float rest = texelFetch(depthImage, pixel, 0).r + float(texelFetch(materialImage, pixel, 0).r);
    imageStore(outCopy, pixel, vec4(texelFetch(irradianceImage, pixel, 0).rgb, rest));
}
