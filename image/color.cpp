#include "image/color.hpp"

#include <cmath>

namespace nacre {
namespace {

using Matrix = std::array<Tristimulus, 3>;

// Exact for the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and the white (0.3127, 0.3290) of IEC 61966-2-1.
constexpr Matrix xyzOfRgb{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                           {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                           {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};

constexpr Tristimulus multiply(const Matrix& matrix, const Tristimulus& vector) {
    Tristimulus result{};
    for (std::size_t row = 0; row < 3; ++row) {
        result[row] = matrix[row][0] * vector[0] + matrix[row][1] * vector[1] + matrix[row][2] * vector[2];
    }
    return result;
}

// By Cramer's rule, so that a colour that goes both ways comes back.
constexpr Matrix inverse(const Matrix& m) {
    const auto cofactor = [&](std::size_t row, std::size_t column) {
        const std::size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    Matrix result{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            result[row][column] = cofactor(column, row) / determinant;
        }
    }
    return result;
}

constexpr Matrix rgbOfXyz = inverse(xyzOfRgb);
constexpr Tristimulus white = multiply(xyzOfRgb, {1, 1, 1});

// CIE 15:2004, section 8.2.1: the cube root, and its tangent near black.
constexpr double labCorner = 6.0 / 29;

double compressed(double t) {
    return t > labCorner * labCorner * labCorner ? std::cbrt(t) : t / (3 * labCorner * labCorner) + 4.0 / 29;
}

double expanded(double t) {
    return t > labCorner ? t * t * t : 3 * labCorner * labCorner * (t - 4.0 / 29);
}

} // namespace

float encodeSrgb(float linear) {
    if (!(linear > 0)) {
        return 0;
    }
    if (linear >= 1) {
        return 1;
    }
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float decodeSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Tristimulus toXyz(const Tristimulus& rgb) {
    return multiply(xyzOfRgb, rgb);
}

Tristimulus fromXyz(const Tristimulus& xyz) {
    return multiply(rgbOfXyz, xyz);
}

double luminance(const Tristimulus& rgb) {
    return toXyz(rgb)[1];
}

Tristimulus toLab(const Tristimulus& rgb) {
    const Tristimulus xyz = toXyz(rgb);
    const double x = compressed(xyz[0] / white[0]);
    const double y = compressed(xyz[1] / white[1]);
    const double z = compressed(xyz[2] / white[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Tristimulus fromLab(const Tristimulus& lab) {
    const double y = (lab[0] + 16) / 116;
    return fromXyz(
        {white[0] * expanded(y + lab[1] / 500), white[1] * expanded(y), white[2] * expanded(y - lab[2] / 200)});
}

Tristimulus toYCxCz(const Tristimulus& rgb) {
    const Tristimulus xyz = toXyz(rgb);
    const double x = xyz[0] / white[0];
    const double y = xyz[1] / white[1];
    const double z = xyz[2] / white[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Tristimulus fromYCxCz(const Tristimulus& yCxCz) {
    const double y = (yCxCz[0] + 16) / 116;
    return fromXyz({white[0] * (y + yCxCz[1] / 500), white[1] * y, white[2] * (y - yCxCz[2] / 200)});
}

Tristimulus huntAdjusted(const Tristimulus& lab) {
    return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
}

double hyab(const Tristimulus& lab, const Tristimulus& other) {
    return std::abs(lab[0] - other[0]) + std::hypot(lab[1] - other[1], lab[2] - other[2]);
}

} // namespace nacre
