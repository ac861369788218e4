#include "scene/gallery/bodies.hpp"
#include "scene/gallery/noise.hpp"
#include "scene/gallery/paint.hpp"
#include "scene/gallery/portable_math.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace nacre::scene::gallery {

namespace {

constexpr glm::vec3 headMiddle{0, 95, 0};
constexpr float headRadius = 100; // mm, only to give the map's angles a length

/// The map in mm along the head from where +Z leaves it.
glm::vec2 onMap(const glm::vec3& p) {
    const glm::vec3 d = p - headMiddle;
    const float across = std::sqrt(d.x * d.x + d.y * d.y);
    return across > 0 ? glm::vec2(d.x, d.y) * (headRadius * arcTangent(across, d.z) / across) : glm::vec2(0);
}

/// Tints the skin within some distance of a point.
struct Patch {
    glm::vec3 place; ///< of the character's left side or the headMiddle; the other side is its mirror image
    glm::vec2 radii;
    glm::vec3 tint;
};

constexpr Patch patches[] = {
    {{40, 84, 78}, {21, 17}, {1.03f, 0.84f, 0.82f}},   // cheeks
    {{0, 78, 112}, {15, 12}, {1.02f, 0.84f, 0.82f}},   // tip of the nose
    {{86, 100, -14}, {34, 40}, {1.05f, 0.80f, 0.76f}}, // ears
    {{32, 114, 86}, {19, 11}, {0.93f, 0.84f, 0.86f}},  // lids
    {{0, 18, 88}, {34, 20}, {0.93f, 0.94f, 0.97f}},    // chin
    {{44, 34, 50}, {34, 22}, {0.94f, 0.95f, 0.98f}},   // jaw
};

/// Tints the skin along a line.
struct Line {
    std::array<glm::vec3, 4> points;
    float begin, end; ///< [mm] half widths
    float softness;   ///< [mm]
    glm::vec3 tint;
    float hair; ///< [0, 1] how much it falls apart into strands
};

constexpr Line lines[] = {
    {{{{19.5f, 113.8f, 80}, {21, 114, 80.5f}, {22, 114, 81}, {23, 114, 82}}},
     1.8f,
     0.8f,
     1.8f,
     {1.05f, 0.70f, 0.68f},
     0},
    {{{{23.5f, 45.8f, 87}, {24.5f, 45.6f, 87}, {25.5f, 45.4f, 86}, {26.5f, 45.3f, 85}}},
     1.2f,
     0.6f,
     1.6f,
     {0.70f, 0.50f, 0.48f},
     0},
    {{{{0, 51, 99}, {6, 52, 99}, {14, 49.5f, 95}, {24, 46, 87}}}, 3.4f, 0.6f, 1.4f, {0.84f, 0.56f, 0.55f}, 0},
    {{{{0, 41.8f, 99}, {8, 42.3f, 98}, {16, 44, 93.5f}, {24, 46, 87}}}, 4.2f, 0.6f, 1.4f, {0.86f, 0.58f, 0.57f}, 0},
    {{{{0, 46.6f, 100}, {7, 47.1f, 99}, {15, 46.6f, 95}, {24.5f, 45.6f, 87}}},
     0.5f,
     0.3f,
     0.8f,
     {0.62f, 0.46f, 0.46f},
     0},
    {{{{16, 113, 80}, {25, 108.6f, 87}, {37, 108.2f, 87}, {48, 111.5f, 78}}},
     0.5f,
     1,
     0.9f,
     {0.30f, 0.24f, 0.22f},
     0.3f},
    {{{{11, 131.5f, 90}, {24, 138, 85}, {38, 140, 77}, {52, 132.5f, 60}}}, 3.6f, 1, 1.8f, {0.34f, 0.26f, 0.22f}, 0.55f},
};
/// The corners of eyes and mouth, and the lips: brows and lashes are models.
constexpr std::span<const Line> openEyedLines = std::span<const Line>(lines).first(5);
/// Lips, lashes and brows.
constexpr std::span<const Line> closedEyedLines = std::span<const Line>(lines).subspan(2);

/// The patches and some lines where they lie on the map.
struct Chart {
    struct MappedLine {
        std::array<glm::vec2, 4> points;
        glm::vec2 low, high; ///< outside of it the line has no effect
    };
    std::vector<glm::vec2> patchPlaces;
    std::span<const Line> painted;
    std::vector<MappedLine> linePlaces; ///< one for each of them
    float finest;                       ///< [mm] finer noise is left out

    Chart(std::span<const Line> paintedLines, float finestNoise) : painted(paintedLines), finest(finestNoise) {
        for (const Patch& patch : patches)
            patchPlaces.push_back(onMap(patch.place));
        for (const Line& line : painted) {
            MappedLine mapped{{}, glm::vec2(1e9f), glm::vec2(-1e9f)};
            const float reach = std::max(line.begin, line.end) + line.softness;
            for (std::size_t i = 0; i < line.points.size(); ++i) {
                mapped.points[i] = onMap(line.points[i]);
                mapped.low = glm::min(mapped.low, mapped.points[i] - reach);
                mapped.high = glm::max(mapped.high, mapped.points[i] + reach);
            }
            linePlaces.push_back(mapped);
        }
    }
};

/// How much of a line covers the point.
float lineCover(const glm::vec2& q, const Line& line, const Chart::MappedLine& mapped) {
    if (glm::any(glm::lessThan(q, mapped.low)) || glm::any(glm::greaterThan(q, mapped.high)))
        return 0;
    float nearest = 1e9f, along = 0;
    for (std::size_t i = 0; i + 1 < mapped.points.size(); ++i) {
        const glm::vec2 a = mapped.points[i], d = mapped.points[i + 1] - a;
        const float t = glm::clamp(glm::dot(q - a, d) / glm::dot(d, d), 0.f, 1.f);
        const float distance = glm::length(q - a - t * d);
        if (distance < nearest)
            nearest = distance, along = (float(i) + t) / float(mapped.points.size() - 1);
    }
    const float halfWidth = glm::mix(line.begin, line.end, along);
    const float strands = 0.5f + 0.5f * noise(glm::vec3(q.x / 0.8f - q.y / 0.9f, q.x / 4.f + q.y / 3.5f, 13));
    return smoothStep(halfWidth + line.softness, halfWidth - 0.5f * line.softness, nearest) * (1 - line.hair * strands);
}

glm::vec3 skinColor(const glm::vec2& q, const Chart& chart) {
    const glm::vec2 folded(std::abs(q.x), q.y);
    glm::vec3 color(0.66f, 0.45f, 0.355f);
    const auto grain = [&](float size, float slice) {
        return size < chart.finest ? 0.f : noise(glm::vec3(q / size, slice));
    };
    color *= 1 + 0.035f * grain(3.1f, 1) + 0.045f * grain(9, 7);
    color.r *= 1 + 0.03f * grain(6, 3);
    for (std::size_t i = 0; i < std::size(patches); ++i) {
        const glm::vec2 d = (folded - chart.patchPlaces[i]) / patches[i].radii;
        const float square = glm::dot(d, d);
        if (square < 9)
            color *= glm::mix(glm::vec3(1), patches[i].tint, exponential(-square));
    }
    // Short hair shows through the scalp; the hairline runs over the forehead and down in front of the ears.
    const float hairline = q.y - 88 + 0.0065f * q.x * q.x + 3 * grain(5, 11);
    const float scalp =
        std::max(smoothStep(-6, 10, hairline), smoothStep(118, 128, glm::length(q)) * smoothStep(-70, -30, q.y));
    const float stubble = 0.85f + 0.15f * grain(0.9f, 5);
    color *= glm::mix(glm::vec3(1), glm::vec3(0.80f, 0.83f, 0.88f) * stubble, 0.8f * scalp);
    for (std::size_t i = 0; i < chart.painted.size(); ++i)
        color *=
            glm::mix(glm::vec3(1), chart.painted[i].tint, lineCover(folded, chart.painted[i], chart.linePlaces[i]));
    return color;
}

} // namespace

glm::vec2 headTextureCoordinates(const glm::vec3& p) {
    const glm::vec2 q = onMap(p) / (2 * pi * headRadius);
    return {0.5f + q.x, 0.5f - q.y};
}

Texture makeSkinTexture() {
    const Chart chart(closedEyedLines, 0);
    return paint("skin", 1024, [&](const glm::vec2& uv) {
        return skinColor(glm::vec2(uv.x - 0.5f, 0.5f - uv.y) * (2 * pi * headRadius), chart);
    });
}

std::vector<glm::vec3> openEyedHeadColors(std::span<const glm::vec3> positions) {
    const Chart chart(openEyedLines, 4); // mm, between vertices
    std::vector<glm::vec3> colors(positions.size());
    std::ranges::transform(positions, colors.begin(), [&](const glm::vec3& p) { return skinColor(onMap(p), chart); });
    return colors;
}

} // namespace nacre::scene::gallery
