// First pass of `brute`: what the gather reads of every pixel, once: entering light, position, material and the
// patch of surface the pixel sees.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scatter.glsl"
#include "interface/tangent_plane.glsl"
#include "brute_blocks.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = bindingIntermediates + intermediatePixels, std430) writeonly buffer Pixels {
    BrutePixel pixels[];
};

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    ivec2 pixel = local + view.areaOffset;
    uint material = materialAt(pixel);
    float z = viewZ(pixel);
    BrutePixel result = BrutePixel(vec4(0.0), vec4(0.0), vec2(0.0), vec2(0.0));
    if (material != 0u && isValidZ(z)) {
        vec3 light = enteringLight(pixel, material);
        result.slope = patchSlope(pixel, z);
        result.light = isFinite(light) ? vec4(light, tangentPlane(pixel, z, result.slope).area) : vec4(0.0);
        result.position = vec4(viewPosition(pixel, z), float(material));
    }
    pixels[local.y * view.areaExtent.x + local.x] = result;
}
