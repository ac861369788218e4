// Elementary functions from IEEE additions, multiplications and square roots only, so that the gallery comes out the
// same with every C library; std::sin and its like may differ in the last bit from one machine to the next.
#pragma once

#include <cmath>
#include <numbers>

namespace nacre::scene::gallery {

inline constexpr float pi = std::numbers::pi_v<float>;

/// sin(x), |x| up to a few thousand, error below 1e-7.
inline float sine(float x) {
    const double turns = double(x) / (2 * std::numbers::pi);
    const double quarter = 4 * (turns - std::floor(turns + 0.5)); // [-2, 2) quarter turns
    const double folded = quarter > 1 ? 2 - quarter : quarter < -1 ? -2 - quarter : quarter;
    const double a = folded * (std::numbers::pi / 2);
    const double s = a * a; // Taylor series about 0 up to a¹³, |a| ≤ π/2
    return float(a * (1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110 * (1 - s / 156)))))));
}

inline float cosine(float x) {
    return sine(x + pi / 2);
}

/// eˣ for |x| below 80, relative error below 1e-7.
inline float exponential(float x) {
    const double scaled = double(x) / std::numbers::ln2;
    const double whole = std::floor(scaled + 0.5);
    const double r = (scaled - whole) * std::numbers::ln2;
    const double series = 1 + r * (1 + r / 2 * (1 + r / 3 * (1 + r / 4 * (1 + r / 5 * (1 + r / 6 * (1 + r / 7))))));
    return float(std::ldexp(series, int(whole)));
}

/// ln x, x > 0, relative error below 1e-7.
inline float logarithm(float x) {
    int exponent = 0;
    const double m = std::frexp(double(x), &exponent); // [0.5, 1)
    const double shifted = m * std::numbers::sqrt2;
    const double z = (shifted - 1) / (shifted + 1); // |z| ≤ 0.172; ln y = 2 artanh z
    const double s = z * z;
    const double series = 2 * z * (1 + s * (1.0 / 3 + s * (1.0 / 5 + s * (1.0 / 7 + s * (1.0 / 9 + s / 11)))));
    return float(series + (exponent - 0.5) * std::numbers::ln2);
}

/// Angle of (x, y) in (-π, π], error below 1e-6.
inline float arcTangent(float y, float x) {
    const double ax = std::fabs(double(x)), ay = std::fabs(double(y));
    const double high = ax > ay ? ax : ay, low = ax > ay ? ay : ax;
    if (high == 0)
        return 0;
    // Twice halved with atan t = 2 atan(t / (1 + √(1 + t²))), then the series about 0.
    double t = low / high;
    t = t / (1 + std::sqrt(1 + t * t));
    t = t / (1 + std::sqrt(1 + t * t));
    const double s = t * t;
    double angle = 4 * t * (1 - s * (1.0 / 3 - s * (1.0 / 5 - s * (1.0 / 7 - s * (1.0 / 9 - s / 11)))));
    angle = ay > ax ? std::numbers::pi / 2 - angle : angle;
    angle = x < 0 ? std::numbers::pi - angle : angle;
    return float(y < 0 ? -angle : angle);
}

/// 0 below `low`, 1 above `high`, Hermite in between.
inline float smoothStep(float low, float high, float x) {
    const float t = std::fmin(std::fmax((x - low) / (high - low), 0.f), 1.f);
    return t * t * (3 - 2 * t);
}

} // namespace nacre::scene::gallery
