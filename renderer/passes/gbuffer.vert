#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"

layout(set = 0, binding = 0, std140) uniform View {
    ViewConstants view;
};
#include "draw.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 4) in vec4 color;
layout(location = 5) in vec2 secondUv;

#ifndef DEPTH_ALONE
layout(location = 2) in vec3 normal;
layout(location = 3) in vec4 tangent;
layout(location = 0) out vec3 outNormal;
layout(location = 1) out vec4 outTangent;
#endif
layout(location = 2) out float outDepth;
layout(location = 3) out vec4 outColor;
layout(location = 4) out vec2 outUv[textureSlotCount];

void main() {
    // The passes that draw blended surfaces compare depths for equality.
    precise vec4 world = draw.worldFromObject * vec4(position, 1.0);
    precise vec4 clip = view.clipFromWorld * world;
#ifndef DEPTH_ALONE
    mat3 linear = mat3(draw.worldFromObject);
    // Cofactors carry normals through any linear map; a mirroring one turns them round once too often.
    mat3 cofactors = mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
    float side = draw.index.z != 0u ? -1.0 : 1.0;
    outNormal = normalize(side * (cofactors * normal));
    outTangent = vec4(linear * tangent.xyz, tangent.w * side);
#endif
    for (uint slot = 0u; slot < textureSlotCount; ++slot) {
        outUv[slot] = textureUv(slot, uv, secondUv);
    }
    outColor = color;
    outDepth = dot(view.viewRow, world);
    gl_Position = clip;
}
