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

#ifdef NACRE_RENDERER_SHADER_TYPES_H
/// Irradiance on a surface with this normal in world space: E(n) = Σ cᵢ Yᵢ(n), see irradianceHarmonics in environment.hpp.
vec3 environmentIrradiance(EnvironmentConstants environment, vec3 normal) {
    vec3 n = environmentDirection(normal, environment.rotation.xy);
    vec3 sum = environment.irradiance[0].rgb * 0.282095;
    sum += 0.488603 * (environment.irradiance[1].rgb * n.y + environment.irradiance[2].rgb * n.z +
                       environment.irradiance[3].rgb * n.x);
    sum += 1.092548 * (environment.irradiance[4].rgb * (n.x * n.y) + environment.irradiance[5].rgb * (n.y * n.z) +
                       environment.irradiance[7].rgb * (n.x * n.z));
    sum += environment.irradiance[6].rgb * (0.315392 * (3.0 * n.z * n.z - 1.0));
    sum += environment.irradiance[8].rgb * (0.546274 * (n.x * n.x - n.y * n.y));
    return max(sum, 0.0) * environment.rotation.z;
}
#endif
