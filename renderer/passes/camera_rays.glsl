// From pixels to the world. Included after `view`, a uniform block of ViewConstants, is declared.

vec2 viewPlane(ivec2 pixel) {
    vec2 ndc = (vec2(pixel) + 0.5) / vec2(view.size.xy) * 2.0 - 1.0;
    return (ndc + view.unproject.zw) * view.unproject.xy;
}

vec3 worldPosition(ivec2 pixel, float linearDepth) {
    vec2 plane = viewPlane(pixel) * (view.size.z != 0u ? linearDepth : 1.0);
    return (view.worldFromView * vec4(plane, -linearDepth, 1.0)).xyz;
}

/// The way the camera looks through the pixel.
vec3 viewDirection(ivec2 pixel) {
    vec3 direction = view.size.z != 0u ? vec3(viewPlane(pixel), -1.0) : vec3(0.0, 0.0, -1.0);
    return normalize(mat3(view.worldFromView) * direction);
}
