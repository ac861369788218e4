// Constants of a draw and its surface, for vertex shaders.
layout(push_constant, std430) uniform Push {
    DrawConstants draw;
};

layout(set = 0, binding = 1, std430) readonly buffer Surfaces {
    SurfaceConstants surfaces[];
};

/// Done per vertex, so that every pixel of a quad has the coordinates its neighbours' derivatives need: llvmpipe loads
/// nothing from buffers for pixels outside the triangle.
vec2 transformUv(vec2 uv) {
    SurfaceConstants surface = surfaces[draw.index.x];
    return vec2(dot(surface.uvTransformU.xyz, vec3(uv, 1.0)), dot(surface.uvTransformV.xyz, vec3(uv, 1.0)));
}
