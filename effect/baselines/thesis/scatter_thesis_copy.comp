// First pass of `thesis`: the pixels that no material's pass pair writes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scatter.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    ivec2 pixel = local + view.areaOffset;
    uint material = materialAt(pixel);
    if (material == 0u || !isValidZ(viewZ(pixel)) || strengthAt(pixel, material) == 0.0) {
        writeUnscattered(pixel, material);
    }
}
