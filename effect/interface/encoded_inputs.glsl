// What a pixel's material id and normal are, however the context's images hold them. Needs `view`, `materialIdImage`,
// `strengthImage`, `normalImage`, `scaleImage`, hasFlag and isFinite.

// NacreContextInfo::noMaterialIds: there is no image of ids, and the one material is where the strength says so.
layout(constant_id = constantNoMaterialIds) const bool noMaterialIds = false;
// NacreContextInfo::normalEncoding and normalSpace, the bits normalOctahedral and normalInViewSpace.
layout(constant_id = constantNormalEncoding) const uint normalEncoding = 0u;

uint materialIdAt(ivec2 pixel) {
    if (noMaterialIds) {
        return !hasFlag(flagStrength) || texelFetch(strengthImage, pixel, 0).r > 0.0 ? 1u : 0u;
    }
    return texelFetch(materialIdImage, pixel, 0).r;
}

// [1] What the scale image's values are bounded to.
const float leastScale = 1e-3;
const float largestScale = 1e3;

// The pixel's factor on the lengths of its material's profile; 1 where it is no number.
float scaleAt(ivec2 pixel) {
    if (!hasFlag(flagScale)) {
        return 1.0;
    }
    float scale = texelFetch(scaleImage, pixel, 0).r;
    return isFinite(scale) ? clamp(scale, leastScale, largestScale) : 1.0;
}

// The normal that two numbers hold: the octahedron |x| + |y| + |z| = 1, whose lower half is folded over its upper one.
vec3 octahedralNormal(vec2 value) {
    vec3 normal = vec3(value, 1.0 - abs(value.x) - abs(value.y));
    if (normal.z < 0.0) {
        normal.xy = (1.0 - abs(value.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(value, vec2(0.0)));
    }
    return normal;
}

// The normal image's value as a vector of any length, in the space that the image has.
vec3 storedNormal(vec3 stored) {
    vec3 value = stored * view.normalScale + view.normalBias;
    return (normalEncoding & normalOctahedral) != 0u ? octahedralNormal(value.xy) : value;
}

// The same in world space.
vec3 worldNormal(vec3 stored) {
    vec3 normal = storedNormal(stored);
    return (normalEncoding & normalInViewSpace) != 0u ? transpose(mat3(view.viewFromWorld)) * normal : normal;
}

// The same in view space, unit length.
vec3 viewNormal(vec3 stored) {
    vec3 normal = storedNormal(stored);
    return normalize((normalEncoding & normalInViewSpace) != 0u ? normal : mat3(view.viewFromWorld) * normal);
}
