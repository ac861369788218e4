#include "bake/atlas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nacre::bake {
namespace {

constexpr double maxTurns = 16;
constexpr double touch = 0.70710678118654752; ///< texels from a texel's middle to its corner
constexpr double strictlyInside = 1e-3;       ///< least barycentric coordinate that tells an overlap from an edge

constexpr double offEdge = 1.0 / 1024; ///< of the way to the triangle's middle, so that a place has one side

using Corners = std::array<glm::dvec2, 3>; ///< in texels
using Weights = std::array<double, 3>;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

Weights weightsOf(const Corners& corners, const glm::dvec2& point) {
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double u = cross(point - corners[0], corners[2] - corners[0]) / area;
    const double v = cross(corners[1] - corners[0], point - corners[0]) / area;
    return {1 - u - v, u, v};
}

struct Nearest {
    Weights weights{};
    double distance = std::numeric_limits<double>::infinity(); ///< texels; 0 inside
};

/// The triangle's point that is nearest to `point`.
Nearest nearestOf(const Corners& corners, const glm::dvec2& point) {
    const Weights weights = weightsOf(corners, point);
    if (std::ranges::all_of(weights, [](double weight) { return weight >= 0; })) {
        return {weights, 0};
    }
    Nearest best;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        const glm::dvec2 edge = corners[next] - corners[i];
        const double along = std::clamp(glm::dot(point - corners[i], edge) / glm::dot(edge, edge), 0.0, 1.0);
        const double distance = glm::length(corners[i] + along * edge - point);
        if (distance < best.distance) {
            best.distance = distance;
            best.weights = {};
            best.weights[i] = 1 - along;
            best.weights[next] = along;
        }
    }
    return best;
}

/// Keeps the nearest triangle of every texel.
class Painter {
public:
    Painter(std::uint32_t width, std::uint32_t height)
        : width_(width), height_(height), nearest_(std::size_t{width} * height) {}

    void paint(const Corners& corners, std::uint32_t instance, std::uint32_t triangle);
    Atlas atlas() const;

private:
    struct Texel {
        trace::Hit place;
        float distance = std::numeric_limits<float>::infinity();
        bool shared = false;
    };

    void offer(Texel& texel, const Nearest& nearest, std::uint32_t instance, std::uint32_t triangle) const;

    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<Texel> nearest_;
};

std::uint32_t wrapped(std::int64_t index, std::uint32_t size) {
    const std::int64_t count = size;
    return static_cast<std::uint32_t>((index % count + count) % count);
}

void Painter::offer(Texel& texel, const Nearest& nearest, std::uint32_t instance, std::uint32_t triangle) const {
    if (nearest.distance == 0 && texel.distance == 0) {
        texel.shared = texel.shared || *std::ranges::min_element(nearest.weights) > strictlyInside;
    }
    if (nearest.distance <= touch && nearest.distance < texel.distance) {
        const double inwards = nearest.distance > 0 ? offEdge : 0;
        const auto moved = [&](std::size_t i) {
            return static_cast<float>(std::lerp(nearest.weights[i], 1.0 / 3, inwards));
        };
        texel.place = {0, instance, triangle, moved(1), moved(2)};
        texel.distance = static_cast<float>(nearest.distance);
    }
}

void Painter::paint(const Corners& corners, std::uint32_t instance, std::uint32_t triangle) {
    const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]) - touch;
    const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]) + touch;
    const auto firstColumn = static_cast<std::int64_t>(std::floor(low.x));
    const auto lastColumn = static_cast<std::int64_t>(std::floor(high.x));
    for (auto row = static_cast<std::int64_t>(std::floor(low.y)); static_cast<double>(row) <= high.y; ++row) {
        const std::size_t firstOfRow = std::size_t{wrapped(row, height_)} * width_;
        for (std::int64_t column = firstColumn; column <= lastColumn; ++column) {
            const glm::dvec2 middle(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
            offer(nearest_[firstOfRow + wrapped(column, width_)], nearestOf(corners, middle), instance, triangle);
        }
    }
}

Atlas Painter::atlas() const {
    Atlas atlas;
    atlas.width = width_;
    atlas.height = height_;
    for (std::uint32_t i = 0; i < nearest_.size(); ++i) {
        if (std::isfinite(nearest_[i].distance)) {
            atlas.texels.push_back(i);
            atlas.places.push_back(nearest_[i].place);
            atlas.shared += nearest_[i].shared ? 1 : 0;
        }
    }
    return atlas;
}

Corners cornersOf(const scene::Mesh& mesh, std::size_t triangle, const scene::TextureCoordinates& coordinates,
                  const glm::dvec2& size) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2& uv = coordinates.of(mesh.vertices[mesh.indices[3 * triangle + i]]);
        corners[i] = glm::dvec2(glm::dmat3(coordinates.transform) * glm::dvec3(uv, 1)) * size;
    }
    return corners;
}

void requireFewTurns(const Corners& corners, const glm::dvec2& size, const scene::Mesh& mesh,
                     const std::string& where) {
    const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]) / size;
    const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]) / size;
    const double turns = std::max(high.x - low.x, high.y - low.y);
    constexpr double maxPlace = 1e6;
    const bool near = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)}) <= maxPlace;
    if (!(turns <= maxTurns) || !near) {
        throw scene::SceneError(where + ": the mesh '" + mesh.name + "' has texture coordinates that run over " +
                                std::to_string(turns) + " pictures in one triangle or lie far outside of [0, 1]; " +
                                "at most 16 can be baked");
    }
}

} // namespace

Atlas makeAtlas(const scene::Scene& scene, std::uint32_t surface, std::uint32_t width, std::uint32_t height,
                const std::string& where) {
    Painter painter(width, height);
    const glm::dvec2 size(width, height);
    std::vector<bool> done(scene.meshes.size());
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        const std::uint32_t index = scene.instances[instance].mesh;
        const scene::Mesh& mesh = scene.meshes[index];
        if (mesh.surface != surface || done[index]) {
            continue;
        }
        done[index] = true;
        for (std::uint32_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
            const Corners corners = cornersOf(mesh, triangle, scene.surfaces[surface].thicknessUv, size);
            if (cross(corners[1] - corners[0], corners[2] - corners[0]) != 0) {
                requireFewTurns(corners, size, mesh, where);
                painter.paint(corners, instance, triangle);
            }
        }
    }
    return painter.atlas();
}

VertexPlaces makeVertexPlaces(const scene::Scene& scene, std::uint32_t surface) {
    constexpr float third = 1.0f / 3;
    constexpr float inwards = 1.0f / 64;
    VertexPlaces result;
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        const scene::Mesh& mesh = scene.meshes[scene.instances[instance].mesh];
        if (surface != scene::none && mesh.surface != surface) {
            continue;
        }
        std::vector<std::uint32_t> indices(mesh.vertices.size(), scene::none);
        for (std::uint32_t i = 0; i < mesh.indices.size(); ++i) {
            std::uint32_t& index = indices[mesh.indices[i]];
            if (index == scene::none) {
                index = static_cast<std::uint32_t>(result.places.size());
                const float u = i % 3 == 1 ? 1.0f : 0.0f;
                const float v = i % 3 == 2 ? 1.0f : 0.0f;
                result.places.push_back({0, instance, i / 3, u + inwards * (third - u), v + inwards * (third - v)});
            }
        }
        result.instances.push_back(instance);
        result.indices.push_back(std::move(indices));
    }
    return result;
}

std::vector<float> padded(const Atlas& atlas, std::span<const float> values) {
    std::vector<float> picture(std::size_t{atlas.width} * atlas.height, 0);
    std::vector<bool> reached(picture.size());
    std::vector<std::uint32_t> front = atlas.texels;
    for (std::size_t i = 0; i < front.size(); ++i) {
        picture[front[i]] = values[i];
        reached[front[i]] = true;
    }
    while (!front.empty()) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t texel : front) {
            const std::uint32_t x = texel % atlas.width;
            const std::uint32_t y = texel / atlas.width;
            const std::array<std::uint32_t, 4> neighbours{
                y * atlas.width + (x + 1) % atlas.width, y * atlas.width + (x + atlas.width - 1) % atlas.width,
                (y + 1) % atlas.height * atlas.width + x, (y + atlas.height - 1) % atlas.height * atlas.width + x};
            for (const std::uint32_t neighbour : neighbours) {
                if (!reached[neighbour]) {
                    reached[neighbour] = true;
                    picture[neighbour] = picture[texel];
                    next.push_back(neighbour);
                }
            }
        }
        front = std::move(next);
    }
    return picture;
}

} // namespace nacre::bake
