// Directions and equirectangular images: -Z at the centre, +X a quarter to the right, +Y at the top.
const float pi = 3.14159265358979;

vec2 equirectangular(vec3 direction) {
    return vec2(atan(direction.x, -direction.z) / (2.0 * pi) + 0.5, acos(clamp(direction.y, -1.0, 1.0)) / pi);
}

/// From the world into the environment's own frame; `rotation` is the cosine and sine of its turn about +Y.
vec3 environmentDirection(vec3 direction, vec2 rotation) {
    return vec3(rotation.x * direction.x - rotation.y * direction.z, direction.y,
                rotation.y * direction.x + rotation.x * direction.z);
}
