#include "scene/gallery/bodies.hpp"
#include "scene/gallery/shapes.hpp"

#include <array>

namespace nacre::scene::gallery {

namespace {

/// From the tail's tip to the back of the head.
std::vector<TubePoint> spine() {
    return smoothTube(std::array<TubePoint, 14>{{{{84, 26, 66}, 1.5f},
                                                 {{104, 12, 34}, 4},
                                                 {{104, 9, -12}, 7},
                                                 {{76, 11, -56}, 10},
                                                 {{34, 15, -76}, 14},
                                                 {{4, 27, -66}, 20},
                                                 {{0, 52, -42}, 30},
                                                 {{0, 88, -22}, 31},
                                                 {{0, 124, -2}, 33},
                                                 {{0, 156, 6}, 22},
                                                 {{0, 184, -6}, 16.5f},
                                                 {{0, 212, -4}, 13.5f},
                                                 {{0, 234, 16}, 12.5f},
                                                 {{0, 243, 40}, 13}}},
                      5);
}

void addClaws(ImplicitSurface& dragon, const glm::vec3& paw, float side, float spread) {
    for (int i = -1; i <= 1; ++i) {
        const float x = side * (spread * float(i) + 2);
        const glm::vec3 knuckle = paw + glm::vec3(0.5f * x, 0.5f, 9), tip = paw + glm::vec3(x, -3.5f, 20);
        addTube(dragon, std::array<TubePoint, 3>{{{paw, 6}, {knuckle, 5}, {tip, 3.6f}}}, 3);
        addCapsule(dragon, {tip, 2.6f}, {tip + glm::vec3(0.15f * x, -2, 9), 0.7f}, 1.5f);
    }
}

void addLimbs(ImplicitSurface& dragon, float side) {
    addTube(dragon,
            smoothTube(std::array<TubePoint, 5>{{{{side * 24, 128, 4}, 15},
                                                 {{side * 37, 96, -2}, 12.5f},
                                                 {{side * 37, 62, 18}, 9},
                                                 {{side * 33, 28, 34}, 7.5f},
                                                 {{side * 33, 8, 36}, 8}}},
                       4),
            9);
    addClaws(dragon, {side * 33, 7, 38}, side, 7);
    addEllipsoid(dragon, {side * 33, 52, -30}, {19, 34, 30}, 12);
    addTube(dragon,
            smoothTube(std::array<TubePoint, 4>{{{{side * 42, 56, -10}, 16},
                                                 {{side * 50, 34, -26}, 11},
                                                 {{side * 50, 12, -22}, 8},
                                                 {{side * 50, 8, -8}, 8}}},
                       4),
            7);
    addClaws(dragon, {side * 50, 7, -6}, side, 7);
}

void addHead(ImplicitSurface& dragon) {
    addEllipsoid(dragon, {0, 246, 46}, {15, 13, 19}, 8);
    addTube(dragon, std::array<TubePoint, 3>{{{{0, 245, 56}, 11}, {{0, 239, 76}, 8}, {{0, 236, 92}, 6.5f}}}, 7);
    addTube(dragon, std::array<TubePoint, 3>{{{{0, 233, 46}, 8}, {{0, 224, 68}, 5.5f}, {{0, 221, 85}, 4}}}, 5);
    bothSides([&](float side) {
        addSphere(dragon, {side * 4.2f, 241, 93}, 3.2f, 3);
        carveEllipsoid(dragon, {side * 4.6f, 240.5f, 97}, {1.5f, 1.5f, 2.2f}, 1);
        addTube(dragon,
                smoothTube(
                    std::array<TubePoint, 3>{
                        {{{side * 6, 250, 76}, 2}, {{side * 11, 255, 62}, 3.8f}, {{side * 13, 257, 48}, 3}}},
                    4),
                3);
        carveEllipsoid(dragon, {side * 13.5f, 248.5f, 63}, {5, 4, 6}, 2);
        addSphere(dragon, {side * 11, 248.5f, 62}, 4.2f, 0.6f);
        addTube(dragon,
                smoothTube(std::array<TubePoint, 4>{{{{side * 9, 256, 40}, 5.5f},
                                                     {{side * 18, 270, 22}, 4.4f},
                                                     {{side * 25, 281, -4}, 3},
                                                     {{side * 22, 297, -24}, 0.8f}}},
                           6),
                4);
        addTube(dragon,
                smoothTube(
                    std::array<TubePoint, 3>{
                        {{{side * 13, 240, 40}, 3.6f}, {{side * 23, 238, 24}, 2.6f}, {{side * 27, 243, 6}, 0.7f}}},
                    4),
                3);
        addTube(dragon,
                smoothTube(
                    std::array<TubePoint, 3>{
                        {{{side * 11, 231, 42}, 3}, {{side * 18, 224, 30}, 2.2f}, {{side * 21, 224, 16}, 0.7f}}},
                    4),
                3);
        addPlate(dragon, {side * 12, 243, 40}, {side * 26, 242, 8}, {side * 14, 232, 36}, 0.9f, 1.5f);
        addPlate(dragon, {side * 12, 233, 40}, {side * 25, 240, 9}, {side * 20, 225, 18}, 0.9f, 1.5f);
        for (int i = 0; i < 5; ++i) {
            const float z = 90 - 7 * float(i), x = side * (4.3f + 0.7f * float(i));
            const float upper = 233.2f + 0.9f * float(i), lower = 225 + 1.2f * float(i);
            addCapsule(dragon, {{x, upper, z}, 1.5f}, {{x, upper - 5, z + 0.5f}, 0.5f}, 0.6f);
            addCapsule(dragon, {{0.8f * x, lower, z - 5}, 1.4f}, {{0.85f * x, lower + 4.5f, z - 4.5f}, 0.5f}, 0.6f);
        }
    });
}

/// The skin between two fingers of a wing, all three given from the wrist: a billowing sheet with a scalloped hem.
void addMembrane(ImplicitSurface& dragon, const glm::vec3& wrist, const glm::vec3& a, const glm::vec3& b,
                 float billow) {
    const glm::vec3 u = a - wrist, v = b - wrist, normal = glm::normalize(glm::cross(u, v));
    const float uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), determinant = uu * vv - uv * uv;
    const float height = std::sqrt(determinant) / glm::length(u - v); // from the wrist to the hem
    dragon.add(boundsOf({wrist, a, b}, std::abs(billow) + 4), 2.5f, [=](const glm::vec3& p) {
        const glm::vec3 q = p - wrist;
        const float qu = glm::dot(q, u), qv = glm::dot(q, v);
        const float s = (vv * qu - uv * qv) / determinant, t = (uu * qv - uv * qu) / determinant;
        const float along = s + t, across = along > 1e-4f ? glm::clamp(t / along, 0.f, 1.f) : 0.5f;
        const float arch = 4 * across * (1 - across);
        const float sheet = std::abs(glm::dot(q, normal) - billow * arch * along * (1.5f - 0.5f * along));
        const float hem = (along - 1 + 0.16f * arch) * height;
        const float edge = -std::min(s * std::sqrt(determinant / vv), t * std::sqrt(determinant / uu));
        const float thickness = 1.05f + 0.25f * (1 - along);
        return 0.8f * smoothMaximum(smoothMaximum(hem, edge - 1, 2), sheet - thickness, 1.6f);
    });
}

void addWing(ImplicitSurface& dragon, float side) {
    const auto at = [side](float x, float y, float z) { return glm::vec3(side * x, y, z); };
    const glm::vec3 shoulder = at(22, 146, -14), elbow = at(58, 188, -46), wrist = at(72, 252, -34);
    const std::array<glm::vec3, 5> tips{at(146, 300, -22), at(176, 238, -34), at(166, 170, -44), at(122, 112, -48),
                                        at(24, 92, -42)};
    addTube(dragon, smoothTube(std::array<TubePoint, 3>{{{shoulder, 11}, {elbow, 6.5f}, {wrist, 5}}}, 6), 6);
    addCapsule(dragon, {wrist, 3}, {wrist + at(-4, 17, 8), 0.8f}, 3);
    for (std::size_t i = 0; i + 1 < tips.size(); ++i) {
        const glm::vec3 middle = 0.5f * (wrist + tips[i]) + glm::vec3(0, 5, -7);
        addTube(dragon, smoothTube(std::array<TubePoint, 3>{{{wrist, 4}, {middle, 2.8f}, {tips[i], 1.3f}}}, 6), 2.5f);
        addMembrane(dragon, wrist, tips[i], tips[i + 1], (i + 2 == tips.size() ? -10.f : -9.f) * side);
    }
    addPlate(dragon, shoulder, elbow, wrist, 1.4f, 4);
}

/// Thin plates that stand on the back from the neck to the tail.
void addCrest(ImplicitSurface& dragon, const std::vector<TubePoint>& spine) {
    for (std::size_t i = 6; i + 3 < spine.size(); i += 2) {
        const glm::vec3 along = glm::normalize(spine[i + 1].center - spine[i - 1].center);
        // Backward and up: away from the belly, which looks along +z on the body and down on the tail.
        const glm::vec3 rough = i < 26 ? glm::vec3(0, 1, 0) : glm::vec3(0, 0.3f, -1);
        const glm::vec3 back = glm::normalize(rough - glm::dot(rough, along) * along);
        const float size = 7 + 9 * smoothStep(6, 40, float(i)) * smoothStep(66, 50, float(i));
        const glm::vec3 root = spine[i].center + (spine[i].radius - 2) * back;
        addPlate(dragon, root - 0.55f * size * along, root + 0.55f * size * along,
                 root + size * back - 0.6f * size * along, 1, 2);
    }
    const glm::vec3 tip = spine.front().center;
    addPlate(dragon, tip + glm::vec3(4, -8, -12), tip + glm::vec3(-2, 4, -4), tip + glm::vec3(-16, 22, 10), 1, 2);
    addPlate(dragon, tip + glm::vec3(4, -8, -12), tip + glm::vec3(-2, 4, -4), tip + glm::vec3(14, 14, 12), 1, 2);
}

/// Where a point lies along and around the spine.
struct SpinePlace {
    float excess = 1e9f; ///< mm outside of the tube
    float position = 0;  ///< mm from the tail's tip
    float radius = 1;
    glm::vec3 offset{0}, axis{0, 1, 0};
};

/// Overlapping scales around the spine, broad plates on the belly.
class Scales {
public:
    explicit Scales(std::vector<TubePoint> spine) : spine_(std::move(spine)), arc_(spine_.size(), 0) {
        for (std::size_t i = 1; i < spine_.size(); ++i)
            arc_[i] = arc_[i - 1] + glm::length(spine_[i].center - spine_[i - 1].center);
        for (std::size_t i = 0; i + 1 < spine_.size(); ++i) {
            while (float(counts_.size()) * rowHeight < arc_[i + 1])
                counts_.push_back(std::floor(2 * pi * spine_[i].radius / 8 + 0.5f));
            const float far = arc_[i + 1] - arc_[i] + std::max(spine_[i].radius, spine_[i + 1].radius) + reach;
            farSquared_.push_back(far * far);
        }
    }

    float height(const glm::vec3& p) const {
        const SpinePlace place = find(p);
        const float fade = smoothStep(reach, 2, std::abs(place.excess)) *
                           smoothStep(arc_.back(), arc_.back() - 10, place.position) * smoothStep(6, 9, place.radius);
        if (fade == 0)
            return 0;
        // The belly looks down on the tail and forward on the body.
        const glm::vec3 axis = glm::normalize(place.axis);
        const glm::vec3 belly =
            glm::mix(glm::vec3(0, -1, 0), glm::vec3(0, -0.35f, 1), smoothStep(arc_[22], arc_[30], place.position));
        const glm::vec3 front = glm::normalize(belly - axis * glm::dot(axis, belly));
        const float angle = arcTangent(glm::dot(place.offset, glm::cross(axis, front)), glm::dot(place.offset, front));
        const float row = place.position / rowHeight, whole = std::floor(row), within = row - whole;
        const float count = counts_[std::min(std::size_t(whole), counts_.size() - 1)];
        const float column = angle / (2 * pi) * count + 0.5f * (whole - 2 * std::floor(whole / 2));
        const float u = 2 * (column - std::floor(column)) - 1;
        const float scale = (1 - u * u * u * u) * smoothStep(0, 0.33f, within) * (1 - 0.75f * within);
        const float plate = smoothStep(0, 0.33f, within) * (1 - 0.8f * within);
        return fade * (1.0f * glm::mix(scale, plate, smoothStep(0.95f, 0.8f, std::abs(angle))) - 0.3f);
    }

private:
    static constexpr float rowHeight = 7, reach = 7;

    SpinePlace find(const glm::vec3& p) const {
        SpinePlace best;
        for (std::size_t i = 0; i + 1 < spine_.size(); ++i) {
            const glm::vec3 a = spine_[i].center;
            if (glm::dot(p - a, p - a) > farSquared_[i])
                continue;
            const glm::vec3 d = spine_[i + 1].center - a;
            const float t = glm::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.f, 1.f);
            const glm::vec3 away = p - a - t * d;
            const float radius = glm::mix(spine_[i].radius, spine_[i + 1].radius, t);
            const float excess = glm::length(away) - radius;
            if (excess < best.excess)
                best = {excess, glm::mix(arc_[i], arc_[i + 1], t), radius, away, d};
        }
        return best;
    }

    std::vector<TubePoint> spine_;
    std::vector<float> arc_;        ///< mm from the tail's tip
    std::vector<float> counts_;     ///< scales in every row
    std::vector<float> farSquared_; ///< mm²: what is further from where a piece of the spine begins, it does not reach
};

} // namespace

Body makeDragon(std::size_t triangles) {
    ImplicitSurface dragon;
    const std::vector<TubePoint> back = spine();
    for (std::size_t i = 0; i + 1 < back.size(); i += 8) // in pieces, each with its own bounds
        addTube(dragon, std::span(back).subspan(i, std::min<std::size_t>(9, back.size() - i)), 0);
    bothSides([&](float side) { addLimbs(dragon, side); });
    dragon.emboss(boundsOf({40, 130, -10}, {120, 130, 110}),
                  [scales = Scales(back)](const glm::vec3& p) { return scales.height(p); });
    addHead(dragon);
    addCrest(dragon, back);
    bothSides([&](float side) { addWing(dragon, side); });
    return makeBody(dragon, 1.2f, triangles);
}

} // namespace nacre::scene::gallery
