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

bool has(uint flag) {
    return (draw.index.w & flag) != 0u;
}

vec4 baseColor(SurfaceConstants surface, vec2 uv) {
    return has(hasBaseColorTexture) ? surface.baseColor * texture(baseColorTexture, uv) : surface.baseColor;
}
