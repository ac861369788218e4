// The surface a pixel sees as a flat patch, whose slope the normal image or differences of depth give. Needs
// pixel_geometry.glsl and `normalImage`.

struct TangentPlane {
    vec3 x;     // how the surface point moves from one pixel to the next in x, mm
    vec3 y;     // the same in y
    float area; // of the surface the pixel sees, mm²: |x × y| = z²·dx·dy / (f²·cosθ)
};

// Steepest surface, as tangent of the angle between ray and normal's plane: area grows at most this many times.
const float maxStretch = 20.0;

// Change of view z towards the neighbour at an offset, as a step along the offset's axis. False without a surface there.
bool depthDifference(ivec2 pixel, float z, ivec2 offset, out float difference) {
    ivec2 neighbor = pixel + offset;
    difference = 0.0;
    if (!isInArea(neighbor) || materialAt(neighbor) == 0u) {
        return false;
    }
    float neighborZ = viewZ(neighbor);
    if (!isValidZ(neighborZ)) {
        return false;
    }
    difference = float(offset.x + offset.y) * (neighborZ - z);
    return true;
}

// Slopes in x and y from the normal image, mm of view z per pixel. False where the normal is across the ray.
bool slopeFromNormal(ivec2 pixel, float z, out vec2 slope) {
    vec3 normal = viewNormal(texelFetch(normalImage, pixel, 0).xyz);
    float facing = dot(normal, vec3(rayAt(pixel), 1.0));
    slope = -vec2(dot(normal.xy, stepX(z)), dot(normal.xy, stepY(z))) / facing;
    return facing != 0.0 && isFinite(slope.x) && isFinite(slope.y);
}

// Slope of a patch along one axis. Where the surface goes on at both sides, the normal's, which lies between both sides'
// differences of depth, or without a normal their mean. At a silhouette the nearer side's: a normal turns so fast there
// that the pixel's one says little of its patch. `size`: the pixel's, mm.
float patchStep(ivec2 pixel, float z, ivec2 direction, float size, bool hasNormal, float normalStep) {
    float before;
    float after;
    bool hasBefore = depthDifference(pixel, z, -direction, before);
    bool hasAfter = depthDifference(pixel, z, direction, after);
    if (!hasBefore || !hasAfter) {
        return before + after;
    }
    float smaller = min(abs(before), abs(after));
    float larger = max(abs(before), abs(after));
    if (larger > 2.0 * max(smaller, size)) {
        return abs(before) < abs(after) ? before : after;
    }
    return hasNormal ? clamp(normalStep, min(before, after), max(before, after)) : 0.5 * (before + after);
}

vec2 patchSlope(ivec2 pixel, float z) {
    vec2 normal = vec2(0.0);
    bool hasNormal = hasFlag(flagNormal) && slopeFromNormal(pixel, z, normal);
    return vec2(patchStep(pixel, z, ivec2(1, 0), length(stepX(z)), hasNormal, normal.x),
                patchStep(pixel, z, ivec2(0, 1), length(stepY(z)), hasNormal, normal.y));
}

// A slope steeper than maxStretch is taken for that.
TangentPlane tangentPlane(ivec2 pixel, float z, vec2 slope) {
    vec3 ray = vec3(rayAt(pixel), 1.0);
    vec3 flatX = vec3(stepX(z), 0.0);
    vec3 flatY = vec3(stepY(z), 0.0);
    float steepness = length(slope) / max(length(flatX), length(flatY));
    slope *= min(1.0, maxStretch / max(steepness, 1e-6));
    TangentPlane plane;
    plane.x = flatX + ray * slope.x;
    plane.y = flatY + ray * slope.y;
    plane.area = length(cross(plane.x, plane.y));
    return plane;
}

// The plane of the normal image alone or, where that has none, of depth.
TangentPlane normalPlane(ivec2 pixel, float z) {
    vec2 slope;
    return tangentPlane(pixel, z, slopeFromNormal(pixel, z, slope) ? slope : patchSlope(pixel, z));
}
