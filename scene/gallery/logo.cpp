#include "scene/gallery/bodies.hpp"
#include "scene/gallery/shapes.hpp"

namespace nacre::scene::gallery {

namespace {

constexpr float capHeight = 62, strokeWidth = 13, halfDepth = 7, bevel = 3, letterSpacing = 9;

/// A bar from a to b with square ends.
float barDistance(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b, float width) {
    const glm::vec2 axis = b - a, d = p - 0.5f * (a + b);
    const float length = glm::length(axis);
    const glm::vec2 along = axis / length;
    const glm::vec2 q(std::abs(glm::dot(d, along)) - 0.5f * length,
                      std::abs(d.x * -along.y + d.y * along.x) - 0.5f * width);
    return glm::length(glm::max(q, 0.f)) + std::min(std::max(q.x, q.y), 0.f);
}

float clipped(float shape, float low, float high, float y) {
    return std::max({shape, low - y, y - high});
}

using Outline = float (*)(const glm::vec2&);

float letterN(const glm::vec2& p) {
    constexpr float w = strokeWidth, right = 50 - 0.5f * w;
    const float slant = barDistance(p, {0.5f * w - 4.2f, capHeight + 6}, {right + 4.2f, -6}, w);
    return std::min({barDistance(p, {0.5f * w, 0}, {0.5f * w, capHeight}, w),
                     barDistance(p, {right, 0}, {right, capHeight}, w),
                     std::max(clipped(slant, 0, capHeight, p.y), std::max(-p.x, p.x - 50))});
}

float letterA(const glm::vec2& p) {
    const float left = barDistance(p, {4.8f, -4}, {29.9f, capHeight + 4}, strokeWidth);
    const float right = barDistance(p, {53.2f, -4}, {28.1f, capHeight + 4}, strokeWidth);
    const float legs = clipped(std::min(left, right), 0, capHeight, p.y);
    return std::min(legs, barDistance(p, {13, 17}, {45, 17}, 11));
}

float letterC(const glm::vec2& p) {
    const glm::vec2 q = p - glm::vec2(31, 31);
    const float ring = std::abs(glm::length(q) - (31 - 0.5f * strokeWidth)) - 0.5f * strokeWidth;
    // The opening looks to the right, 50 degrees to both sides.
    return std::max(ring, 0.766f * q.x - 0.643f * std::abs(q.y));
}

float letterR(const glm::vec2& p) {
    constexpr float w = strokeWidth, bowl = 19, straight = 27;
    const glm::vec2 q = p - glm::vec2(straight, capHeight - bowl);
    // A bowl is a straight part that ends in a half circle; the counter is a smaller one.
    const auto bowlDistance = [&](float left, float radius) {
        return q.x > 0 ? glm::length(q) - radius : std::max(std::abs(q.y) - radius, left - p.x);
    };
    const float ring = std::max(bowlDistance(0, bowl), -bowlDistance(w, bowl - w));
    const float leg = clipped(barDistance(p, {19.5f, 36}, {44.5f, -5}, w), 0, 33, p.y);
    return std::min({barDistance(p, {0.5f * w, 0}, {0.5f * w, capHeight}, w), ring, leg});
}

float letterE(const glm::vec2& p) {
    constexpr float w = strokeWidth;
    return std::min({barDistance(p, {0.5f * w, 0}, {0.5f * w, capHeight}, w),
                     barDistance(p, {1, 0.5f * w}, {42, 0.5f * w}, w),
                     barDistance(p, {1, 0.5f * capHeight}, {38, 0.5f * capHeight}, w - 1),
                     barDistance(p, {1, capHeight - 0.5f * w}, {42, capHeight - 0.5f * w}, w)});
}

/// Extrudes an outline along z with a chamfer of `bevel` mm whose edges are a little rounded.
float extrude(float outline, float z) {
    const float side = std::abs(z) - halfDepth;
    const float chamfer = 0.70710678f * (outline + side + bevel);
    return smoothMaximum(smoothMaximum(outline, side, 0.8f), chamfer, 1.2f);
}

} // namespace

Body makeLogo(std::size_t triangles) {
    struct Letter {
        Outline outline;
        float width;
    };
    constexpr Letter letters[] = {{letterN, 50}, {letterA, 58}, {letterC, 56}, {letterR, 50}, {letterE, 42}};
    float total = -letterSpacing;
    for (const Letter& letter : letters)
        total += letter.width + letterSpacing;
    ImplicitSurface logo;
    float x = -0.5f * total;
    for (const Letter& letter : letters) {
        logo.add({{x, 0, -halfDepth}, {x + letter.width + 4, capHeight, halfDepth}}, 0,
                 [outline = letter.outline, x](const glm::vec3& p) {
                     return extrude(outline({p.x - x, p.y}), p.z);
                 });
        x += letter.width + letterSpacing;
    }
    return makeBody(logo, 0.9f, triangles);
}

} // namespace nacre::scene::gallery
