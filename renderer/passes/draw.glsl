// Constants of a draw and its surface, for vertex shaders.
layout(push_constant, std430) uniform Push {
    DrawConstants draw;
};

layout(set = 0, binding = 1, std430) readonly buffer Surfaces {
    SurfaceConstants surfaces[];
};

/// The coordinates of one texture. Done per vertex, so that every pixel of a quad has the coordinates its neighbours'
/// derivatives need: llvmpipe loads nothing from buffers for pixels outside the triangle.
vec2 textureUv(uint slot, vec2 uv, vec2 secondUv) {
    vec4 u = surfaces[draw.index.x].uvTransformU[slot];
    vec4 v = surfaces[draw.index.x].uvTransformV[slot];
    vec3 place = vec3(u.w != 0.0 ? secondUv : uv, 1.0);
    return vec2(dot(u.xyz, place), dot(v.xyz, place));
}
