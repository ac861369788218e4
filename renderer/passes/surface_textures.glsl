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

bool hasTexture(uint slot) {
    return (draw.index.w & 1u << slot) != 0u;
}

/// What multiplies the surface's base colour; `vertexColor` is the vertices' own.
vec4 textureColor(vec2 uv, vec4 vertexColor) {
    return hasTexture(baseColorSlot) ? vertexColor * texture(baseColorTexture, uv) : vertexColor;
}
