#include "scene/gallery/bodies.hpp"
#include "scene/gallery/shapes.hpp"

namespace nacre::scene::gallery {

namespace {

constexpr int rings = 92, corners = 64;

struct Leaf {
    float heading;   ///< [rad] about +Y
    float lean;      ///< [rad] from upright at the root
    float curl;      ///< [rad] further lean up to the tip
    float length;    ///< [mm] petiole and blade
    float halfWidth; ///< [mm]
    float twist;     ///< [rad] about its axis at the tip
};

constexpr Leaf leaves[] = {{0.3f, 0.30f, 1.5f, 190, 34, 0.2f},  {1.5f, 0.45f, 1.3f, 175, 32, -0.3f},
                           {2.7f, 0.35f, 1.2f, 200, 35, 0.3f},  {3.9f, 0.50f, 1.4f, 170, 31, -0.2f},
                           {5.1f, 0.40f, 1.3f, 195, 34, 0.25f}, {0.9f, 0.15f, 1.0f, 225, 33, -0.25f},
                           {3.3f, 0.12f, 0.8f, 240, 34, 0.2f},  {5.7f, 0.65f, 1.5f, 150, 28, 0.1f}};

/// A leaf's cross-section at `along` [0, 1]: `around` [0, 1) runs along its upper side and back along the lower.
glm::vec2 sectionPoint(const Leaf& leaf, float along, float around) {
    constexpr float petiole = 0.28f;
    const float angle = 2 * pi * around;
    const float blade = smoothStep(petiole - 0.03f, petiole + 0.05f, along);
    const float t = glm::clamp((along - petiole) / (1 - petiole), 0.f, 1.f);
    const float outline = std::sqrt(t) * (1 - t) * (1 + 0.9f * t) * 1.9f;
    const float stem = glm::mix(2.2f, 1.5f, along / petiole) * (1 - blade);
    const float halfWidth = stem + leaf.halfWidth * outline * blade + 0.3f;
    const float x = cosine(angle), rib = exponential(-x * x * leaf.halfWidth * leaf.halfWidth / 6);
    // Side veins leave the midrib obliquely; they are raised below and sunken above.
    const float vein = 0.5f + 0.5f * cosine(2 * pi * (t * 11 - std::abs(x) * 2.2f));
    const float veins = 0.22f * vein * vein * vein * vein * smoothStep(1, 0.7f, std::abs(x));
    const float thickness = glm::mix(stem, 0.2f + (1.1f * rib + veins) * (1 - 0.6f * t), blade);
    const float fold = blade * halfWidth * (0.28f * std::abs(x) - 0.12f * x * x) +
                       blade * 2.2f * x * x * sine(21 * t + 3 * leaf.heading + (x > 0 ? 1.5f : 0.f));
    // A flattened section keeps its full thickness almost to the margin.
    const float s = sine(angle), side = s < 0 ? -1.f : 1.f;
    const float profile = glm::mix(std::abs(s), std::sqrt(std::sqrt(std::abs(s))), blade);
    return {x * halfWidth, side * profile * thickness + fold};
}

Solid makeLeaf(const Leaf& leaf) {
    Solid solid;
    glm::vec3 position(6 * sine(leaf.heading), 0, 6 * cosine(leaf.heading));
    const glm::vec3 outward(sine(leaf.heading), 0, cosine(leaf.heading)), level(outward.z, 0, -outward.x);
    for (int ring = 0; ring < rings; ++ring) {
        const float along = float(ring) / float(rings - 1);
        const float lean = leaf.lean + leaf.curl * along * along;
        const glm::vec3 axis = cosine(lean) * glm::vec3(0, 1, 0) + sine(lean) * outward;
        const glm::vec3 above = cosine(lean) * -outward + sine(lean) * glm::vec3(0, 1, 0);
        const float twist = leaf.twist * along;
        const glm::vec3 x = cosine(twist) * level + sine(twist) * above,
                        y = cosine(twist) * above - sine(twist) * level;
        if (ring > 0)
            position += leaf.length / float(rings - 1) * axis;
        for (int corner = 0; corner < corners; ++corner) {
            const glm::vec2 q = sectionPoint(leaf, along, float(corner) / float(corners));
            solid.positions.push_back(position + q.x * x + q.y * y);
        }
    }
    const auto at = [](int ring, int corner) { return std::uint32_t(ring * corners + corner % corners); };
    for (int ring = 0; ring + 1 < rings; ++ring)
        for (int c = 0; c < corners; ++c)
            solid.indices.insert(solid.indices.end(), {at(ring, c), at(ring, c + 1), at(ring + 1, c + 1), at(ring, c),
                                                       at(ring + 1, c + 1), at(ring + 1, c)});
    for (const int ring : {0, rings - 1}) {
        const auto pole = std::uint32_t(solid.positions.size());
        glm::vec3 sum(0);
        for (int c = 0; c < corners; ++c)
            sum += solid.positions[at(ring, c)];
        solid.positions.push_back(sum / float(corners));
        for (int c = 0; c < corners; ++c)
            if (ring == 0)
                solid.indices.insert(solid.indices.end(), {pole, at(ring, c + 1), at(ring, c)});
            else
                solid.indices.insert(solid.indices.end(), {pole, at(ring, c), at(ring, c + 1)});
    }
    return solid;
}

} // namespace

Body makePlant(std::size_t triangles) {
    Body plant;
    for (const Leaf& leaf : leaves)
        append(plant.solid, makeLeaf(leaf));
    fitTriangleCount(plant.solid, triangles, [](const glm::vec3& p) { return p; });
    plant.normals = smoothNormals(plant.solid);
    return plant;
}

} // namespace nacre::scene::gallery
