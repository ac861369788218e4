// GGX microfacets. `alpha` is roughness² (Burley 2012, "Physically-Based Shading at Disney").

/// Half vector around +Z for a point of the unit square (Karis 2013, "Real Shading in Unreal Engine 4").
vec3 sampleGgx(vec2 u, float alpha) {
    float cosTheta = sqrt((1.0 - u.y) / (1.0 + (alpha * alpha - 1.0) * u.y));
    float sinTheta = sqrt(max(0.0, 1.0 - cosTheta * cosTheta));
    float phi = 2.0 * 3.14159265358979 * u.x;
    return vec3(sinTheta * cos(phi), sinTheta * sin(phi), cosTheta);
}

float ggxDistribution(float nDotH, float alpha) {
    float a2 = alpha * alpha;
    float t = nDotH * nDotH * (a2 - 1.0) + 1.0;
    return a2 / (3.14159265358979 * t * t);
}

/// Height-correlated Smith masking and shadowing over 4 n·l n·v (Heitz 2014, eq. 99).
float ggxVisibility(float nDotL, float nDotV, float alpha) {
    float a2 = alpha * alpha;
    float toView = nDotL * sqrt(nDotV * nDotV * (1.0 - a2) + a2);
    float toLight = nDotV * sqrt(nDotL * nDotL * (1.0 - a2) + a2);
    return 0.5 / max(toView + toLight, 1e-7);
}

/// Schlick 1994.
vec3 fresnel(vec3 f0, float vDotH) {
    return f0 + (1.0 - f0) * pow(1.0 - vDotH, 5.0);
}

/// Point i of n of the Hammersley set.
vec2 hammersley(uint i, uint n) {
    return vec2((float(i) + 0.5) / float(n), float(bitfieldReverse(i)) * 2.3283064365386963e-10);
}
