// Finds the next layer of blended surfaces: the depth test keeps the nearest of what lies behind the layer before it and
// before the bodies.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "surface_textures.glsl"

layout(set = 0, binding = 2) uniform sampler2D depthImage;
layout(set = 0, binding = 3) uniform sampler2D previousLayer;

layout(location = 2) in float inDepth;
layout(location = 3) in vec4 inColor;
layout(location = 4) in vec2 inUv[textureSlotCount];

/// Texels of less alpha are not there: half a step of 8 bits.
const float leastCoverage = 0.5 / 255.0;

void main() {
    float coverage = textureColor(inUv[baseColorSlot], inColor).a;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool isSeen = draw.index.y == 0u || gl_FragCoord.z < texelFetch(previousLayer, pixel, 0).r;
    if (coverage < leastCoverage || !isSeen || inDepth > texelFetch(depthImage, pixel, 0).r) {
        discard;
    }
}
