// Surface constants and textures, for the shaders that draw triangles.
layout(push_constant, std430) uniform Push {
    DrawConstants draw;
};

layout(set = 0, binding = 1, std430) readonly buffer Surfaces {
    SurfaceConstants surfaces[];
};

layout(set = 1, binding = 0) uniform sampler2D baseColorTexture;
layout(set = 1, binding = 1) uniform sampler2D normalTexture;
layout(set = 1, binding = 2) uniform sampler2D metallicRoughnessTexture;
layout(set = 1, binding = 3) uniform sampler2D thicknessTexture;
layout(set = 1, binding = 4) uniform sampler2D emissionTexture;
layout(set = 1, binding = 5) uniform sampler2D scaleTexture;
layout(set = 1, binding = 6) uniform sampler2D transmissionTexture;
layout(set = 1, binding = 7) uniform sampler2D transmissionColorTexture;

/// Texture coordinates without the rounding of their interpolation, which at the edge of a body could lead to the
/// other side of a picture that repeats: whole steps of 2^-20, a 64th of a texel of the largest pictures.
vec2 settled(vec2 uv) {
    return round(uv * 1048576.0) / 1048576.0;
}

bool hasTexture(uint slot) {
    return (draw.index.w & 1u << slot) != 0u;
}

/// What multiplies the surface's base colour; `vertexColor` is the vertices' own.
vec4 textureColor(vec2 uv, vec4 vertexColor) {
    return hasTexture(baseColorSlot) ? vertexColor * texture(baseColorTexture, settled(uv)) : vertexColor;
}
