#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"

layout(set = 0, binding = 0, std430) readonly buffer Layers {
    ShadowLayer layers[];
};
#include "draw.glsl"

layout(location = 0) in vec3 position;
#ifdef ALPHA_MASK
layout(location = 1) in vec2 uv;
layout(location = 4) in vec4 color;
layout(location = 5) in vec2 secondUv;
layout(location = 1) out vec2 outUv;
layout(location = 2) out vec4 outColor;
#endif
layout(location = 0) out vec3 outFromOrigin;

void main() {
    ShadowLayer layer = layers[draw.index.y];
    vec4 world = draw.worldFromObject * vec4(position, 1.0);
    outFromOrigin = world.xyz - layer.origin.xyz;
#ifdef ALPHA_MASK
    outUv = textureUv(baseColorSlot, uv, secondUv);
    outColor = color;
#endif
    gl_Position = layer.clipFromWorld * world;
}
