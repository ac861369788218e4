#include "bench/suites/slab.hpp"

#include "nacre/presets.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::bench {
namespace {

constexpr float slabWidth = 0.32f;
constexpr float slabHeight = 0.18f;
constexpr float slabThickness = 0.0003f; // light shines through the narrowest material that a series has

// A grid of `columns` x `rows` quads on z = `z`, from `left` to `right` as shares of the slab.
struct Patch {
    float left = 0;
    float right = 1;
    float bottom = 0;
    float top = 1;
};

scene::Mesh makeFace(const Patch& patch, float z, std::uint32_t columns, std::uint32_t rows) {
    scene::Mesh mesh;
    const float facing = z > 0 ? 1.0f : -1.0f;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const float u = std::lerp(patch.left, patch.right, float(column) / float(columns));
            const float v = std::lerp(patch.bottom, patch.top, float(row) / float(rows));
            mesh.vertices.push_back({.position = {(u - 0.5f) * slabWidth, (v - 0.5f) * slabHeight, z},
                                     .normal = {0, 0, facing},
                                     .uv = {u, v}});
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * (columns + 1) + column;
            const std::uint32_t b = a + 1;
            const std::uint32_t c = a + columns + 1;
            const std::uint32_t d = c + 1;
            if (facing > 0) {
                mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
            } else {
                mesh.indices.insert(mesh.indices.end(), {a, d, b, a, c, d});
            }
        }
    }
    return mesh;
}

void addMesh(scene::Scene& scene, scene::Mesh mesh, std::uint32_t surface) {
    mesh.surface = surface;
    scene.instances.push_back({.name = mesh.name, .mesh = static_cast<std::uint32_t>(scene.meshes.size())});
    scene.meshes.push_back(std::move(mesh));
}

// Front and back of a patch in at least `triangles` triangles.
void addPatch(scene::Scene& scene, const Patch& patch, std::uint32_t triangles, std::uint32_t surface) {
    const double aspect =
        double(patch.right - patch.left) * slabWidth / (double(patch.top - patch.bottom) * slabHeight);
    const double quads = std::max(1.0, triangles / 4.0);
    const auto rows = std::max(1u, static_cast<std::uint32_t>(std::lround(std::sqrt(quads / aspect))));
    const auto columns = std::max(1u, static_cast<std::uint32_t>(std::ceil(quads / rows)));
    for (const float z : {0.5f * slabThickness, -0.5f * slabThickness}) {
        addMesh(scene, makeFace(patch, z, columns, rows), surface);
    }
}

void addMaterials(scene::Scene& scene, std::uint32_t count) {
    const Material skin = *findPreset("skin");
    for (std::uint32_t i = 0; i < count; ++i) {
        Material material = skin;
        material.name = skin.name + ' ' + std::to_string(i);
        material.scale = 1 + 0.5 * i / count;
        scene::Surface surface;
        surface.material = i;
        scene.materials.push_back(material);
        scene.surfaces.push_back(surface);
    }
}

void addPatches(scene::Scene& scene, const SlabSettings& settings) {
    const auto covered = static_cast<float>(settings.coverage);
    const std::uint32_t count = settings.columns * settings.rows;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t column = i % settings.columns;
        const std::uint32_t row = i / settings.columns;
        const Patch patch{covered * float(column) / float(settings.columns),
                          covered * float(column + 1) / float(settings.columns), float(row) / float(settings.rows),
                          float(row + 1) / float(settings.rows)};
        addPatch(scene, patch, settings.triangles / count, i % settings.materials);
    }
    if (settings.coverage < 1) {
        addPatch(scene, {covered, 1, 0, 1}, 16, static_cast<std::uint32_t>(scene.surfaces.size()));
        scene.surfaces.emplace_back();
    }
}

// On a circle around the line of sight, all aimed at the middle.
scene::Light makeLight(std::uint32_t index, std::uint32_t count) {
    const float angle = 2 * std::numbers::pi_v<float> * (float(index) + 0.25f) / float(count);
    const float side = index % 2 == 0 ? 1.0f : -1.0f;
    scene::Light light;
    light.name = "light " + std::to_string(index);
    light.kind = scene::LightKind::Spot;
    light.intensity = 2.0f / float(count);
    light.position = {0.3f * std::cos(angle), 0.3f * std::sin(angle), side * 0.6f};
    light.direction = -glm::normalize(light.position);
    light.innerConeAngle = 0.5f;
    light.outerConeAngle = 0.6f;
    return light;
}

} // namespace

std::shared_ptr<const View> makeSlab(const SlabSettings& settings) {
    auto scene = std::make_shared<scene::Scene>();
    scene->name = "slab";
    addMaterials(*scene, settings.materials);
    addPatches(*scene, settings);
    for (std::uint32_t i = 0; i < settings.lights; ++i) {
        scene->lights.push_back(makeLight(i, settings.lights));
    }
    scene::Camera camera;
    camera.projection = scene::ProjectionKind::Orthographic;
    camera.orthographicHeight = slabHeight;
    camera.position = {0, 0, 0.5f};
    scene->cameras.push_back(camera);
    return std::make_shared<View>(View{"slab", scene, camera});
}

} // namespace nacre::bench
