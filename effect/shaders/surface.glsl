// The surface's tangent plane at a pixel, from the normal image or, without one, from differences of depth.

struct TangentPlane {
    vec3 x;     // how the surface point moves from one pixel to the next in x, mm
    vec3 y;     // the same in y
    float area; // of the surface the pixel sees, mm²: |x × y| = z²·dx·dy / (f²·cosθ)
};

// Steepest surface, as tangent of the angle between ray and normal's plane: area grows at most this many times.
const float maxStretch = 20.0;

// Change of view z from this pixel to the neighbour in `direction` or, with the sign turned, to the opposite one:
// whichever is nearer, so that a silhouette does not tilt the plane. 0 where neither is valid.
float depthStep(ivec2 pixel, float z, ivec2 direction) {
    float best = 1e30;
    for (int side = -1; side <= 1; side += 2) {
        ivec2 neighbor = pixel + side * direction;
        float difference = isInArea(neighbor) ? float(side) * (viewZ(neighbor) - z) : 1e30;
        if (isFinite(difference) && abs(difference) < abs(best)) {
            best = difference;
        }
    }
    return abs(best) < 1e30 ? best : 0.0;
}

TangentPlane tangentPlane(ivec2 pixel, float z) {
    vec3 ray = vec3(rayAt(pixel), 1.0);
    vec3 flatX = vec3(stepX(z), 0.0);
    vec3 flatY = vec3(stepY(z), 0.0);
    float slopeX;
    float slopeY;
    vec3 value = texelFetch(normalImage, pixel, 0).xyz;
    vec3 normal = hasFlag(flagNormal) ? viewNormal(value) : vec3(0.0);
    float facing = dot(normal, ray);
    if (hasFlag(flagNormal) && isFinite(normal) && facing != 0.0) {
        slopeX = -dot(normal, flatX) / facing;
        slopeY = -dot(normal, flatY) / facing;
    } else {
        slopeX = depthStep(pixel, z, ivec2(1, 0));
        slopeY = depthStep(pixel, z, ivec2(0, 1));
    }
    float size = max(length(flatX), length(flatY));
    float steepness = length(vec2(slopeX, slopeY)) / size;
    float limit = min(1.0, maxStretch / max(steepness, 1e-6));
    TangentPlane plane;
    plane.x = flatX + ray * (slopeX * limit);
    plane.y = flatY + ray * (slopeY * limit);
    plane.area = length(cross(plane.x, plane.y));
    return plane;
}
