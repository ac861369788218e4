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

bool has(uint flag) {
    return (draw.index.w & flag) != 0u;
}

/// `vertexColor` is the vertices' own, which multiplies the surface's.
vec4 baseColor(SurfaceConstants surface, vec2 uv, vec4 vertexColor) {
    vec4 color = surface.baseColor * vertexColor;
    return has(hasBaseColorTexture) ? color * texture(baseColorTexture, uv) : color;
}
