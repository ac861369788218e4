// From light to what a display is sent. The curve is Khronos PBR Neutral (Khronos Group 2024, "Khronos PBR Neutral Tone
// Mapper"): base colours up to 0.8 stay what they are, highlights are compressed towards white.
#ifndef NACRE_TONE_CURVE_GLSL
#define NACRE_TONE_CURVE_GLSL

/// The curve's published constants: reflectance at normal incidence of a dielectric, where compression starts, and how
/// fast highlights lose their colour.
const float f90Offset = 0.04;
const float compressionStart = 0.8 - f90Offset;
const float desaturation = 0.15;

vec3 toneCurve(vec3 color) {
    float low = min(color.r, min(color.g, color.b));
    color -= low < 2.0 * f90Offset ? low - low * low / (4.0 * f90Offset) : f90Offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < compressionStart) {
        return color;
    }
    float headroom = 1.0 - compressionStart;
    float compressed = 1.0 - headroom * headroom / (peak + headroom - compressionStart);
    color *= compressed / peak;
    return mix(vec3(compressed), color, 1.0 / (desaturation * (peak - compressed) + 1.0));
}

vec3 encodeSrgb(vec3 color) {
    vec3 high = 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055;
    return mix(high, 12.92 * color, vec3(lessThanEqual(color, vec3(0.0031308))));
}

/// Interleaved gradient noise in [0, 1) (Jimenez 2014, "Next Generation Post Processing in Call of Duty").
float noise(ivec2 pixel) {
    return fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715))));
}

#endif
