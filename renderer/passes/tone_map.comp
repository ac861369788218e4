// Radiance to an 8-bit picture: exposure, tone curve, average over the samples of a pixel, sRGB.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0) uniform sampler2D radianceImage;
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D outColor;
layout(push_constant) uniform Push {
    float exposure;
    uint samples; // per axis
    uint dither;
};

#include "tone_curve.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(outColor)))) {
        return;
    }
    vec3 sum = vec3(0.0);
    for (uint y = 0u; y < samples; ++y) {
        for (uint x = 0u; x < samples; ++x) {
            vec3 radiance = texelFetch(radianceImage, pixel * int(samples) + ivec2(x, y), 0).rgb;
            sum += clamp(toneCurve(radiance * exposure), 0.0, 1.0);
        }
    }
    vec3 color = encodeSrgb(sum / float(samples * samples));
    if (dither != 0u) {
        color += (noise(pixel) - 0.5) / 255.0;
    }
    imageStore(outColor, pixel, vec4(color, 1.0));
}
