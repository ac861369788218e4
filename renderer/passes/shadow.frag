#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "surface_textures.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Layers {
    ShadowLayer layers[];
};

layout(location = 0) in vec3 inFromOrigin;
#ifdef ALPHA_MASK
layout(location = 1) in vec2 inUv;
layout(location = 2) in vec4 inColor;
#endif
layout(location = 0) out float outDepth;

void main() {
#ifdef ALPHA_MASK
    SurfaceConstants surface = surfaces[draw.index.x];
    if (surface.baseColor.a * textureColor(inUv, inColor).a < surface.parameters.w) {
        discard;
    }
#endif
    ShadowLayer layer = layers[draw.index.y];
    float depth = layer.direction.w != 0.0 ? dot(inFromOrigin, layer.direction.xyz) : length(inFromOrigin);
    // The back of a body that has an inside is no place where light enters: less than 0 says so.
    bool showsBack = gl_FrontFacing == (layer.origin.w < 0.0) && (draw.index.w & isDoubleSided) == 0u;
    outDepth = depth * abs(layer.origin.w) * (showsBack ? -1.0 : 1.0);
}
