#include "transmit/shadow_decoding.hpp"

#include <cmath>
#include <utility>

namespace nacre::effect {
namespace {

/// Row-major 4x4.
using Matrix4 = std::array<std::array<double, 4>, 4>;

Matrix4 fromColumnMajor(const float (&m)[16]) {
    Matrix4 result;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            result[row][column] = m[4 * column + row];
        }
    }
    return result;
}

Matrix4 multiplied(const Matrix4& a, const Matrix4& b) {
    Matrix4 result{};
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            for (std::size_t i = 0; i < 4; ++i) {
                result[row][column] += a[row][i] * b[i][column];
            }
        }
    }
    return result;
}

/// Gauss and Jordan's, with the largest pivot of a column.
bool invert(Matrix4 m, Matrix4& inverse) {
    inverse = {};
    for (std::size_t i = 0; i < 4; ++i) {
        inverse[i][i] = 1;
    }
    for (std::size_t column = 0; column < 4; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < 4; ++row) {
            pivot = std::abs(m[row][column]) > std::abs(m[pivot][column]) ? row : pivot;
        }
        std::swap(m[pivot], m[column]);
        std::swap(inverse[pivot], inverse[column]);
        const double divisor = m[column][column];
        if (divisor == 0 || !std::isfinite(divisor)) {
            return false;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            m[column][i] /= divisor;
            inverse[column][i] /= divisor;
        }
        for (std::size_t row = 0; row < 4; ++row) {
            const double factor = row == column ? 0 : m[row][column];
            for (std::size_t i = 0; i < 4; ++i) {
                m[row][i] -= factor * m[column][i];
                inverse[row][i] -= factor * inverse[column][i];
            }
        }
    }
    return true;
}

/// Clip space's x and y from texels.
Matrix4 clipFromTexel(VkExtent2D size) {
    return {{{2.0 / size.width, 0, 0, -1}, {0, 2.0 / size.height, 0, -1}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

mat4 toShader(const Matrix4& m) {
    mat4 result{};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto value = [&](std::size_t row) { return static_cast<float>(m[row][i]); };
        result.columns[i] = {value(0), value(1), value(2), value(3)};
    }
    return result;
}

} // namespace

ShadowDecoding decodingOf(const float (&clipFromWorld)[16], const std::array<double, 3>& origin, VkExtent2D size) {
    Matrix4 clipFromOffset = fromColumnMajor(clipFromWorld);
    for (auto& row : clipFromOffset) {
        row[3] += row[0] * origin[0] + row[1] * origin[1] + row[2] * origin[2];
    }
    Matrix4 offsetFromClip;
    if (!invert(clipFromOffset, offsetFromClip)) {
        return {};
    }
    return {toShader(multiplied(offsetFromClip, clipFromTexel(size))), true};
}

ShadowDecoding cubeDecodingOf(const float (&projection)[16], VkExtent2D size) {
    const double z = projection[10], w = projection[11], bias = projection[14];
    if (bias == 0 || w == 0 || projection[15] != 0) {
        return {};
    }
    // Of a distance s along the face's axis the depth is (±z·s + bias) / (|w|·s), so that s = bias / (|w|·depth - ±z).
    const double sign = bias > 0 ? 1 : -1;
    const double towards = w > 0 ? 1 : -1;
    const double s = std::abs(bias);
    const Matrix4 offsetFromFace{
        {{s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, 0, s}, {0, 0, sign * std::abs(w), -sign * towards * z}}};
    return {toShader(multiplied(offsetFromFace, clipFromTexel(size))), true};
}

std::array<double, 3> middleOfMap(const float (&clipFromWorld)[16]) {
    Matrix4 worldFromClip{};
    if (!invert(fromColumnMajor(clipFromWorld), worldFromClip)) {
        return {NAN, NAN, NAN};
    }
    // Reversed or not: depths along a direction may be counted from anywhere near.
    const double w = worldFromClip[3][3];
    return {worldFromClip[0][3] / w, worldFromClip[1][3] / w, worldFromClip[2][3] / w};
}

} // namespace nacre::effect
