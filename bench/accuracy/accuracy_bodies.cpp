#include "bench/accuracy/accuracy_bodies.hpp"

#include "nacre/presets.hpp"
#include "scene/primitive_meshes.hpp"
#include "scene/surface_material.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace nacre::bench {
namespace {

using scene::Mesh;
using scene::Scene;

constexpr float lightIntensity = 3;
constexpr float fieldOfView = 0.3f; // [rad] narrow, so that near and far parts are about as large
constexpr int sheetColumns = 48;

scene::Light light(scene::LightKind kind, const char* name) {
    scene::Light result;
    result.kind = kind;
    result.name = name;
    result.intensity = lightIntensity;
    return result;
}

/// Two triangles, corners counter-clockwise as seen from outside, each with its own normal.
void addQuad(Mesh& mesh, const std::array<glm::vec3, 4>& corners, const std::array<glm::vec3, 4>& normals) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        mesh.vertices.push_back({corners[i], normals[i], {1, 0, 0, 1}, {0, 0}});
    }
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) {
        mesh.indices.push_back(first + index);
    }
}

void addFlatQuad(Mesh& mesh, const std::array<glm::vec3, 4>& corners) {
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    addQuad(mesh, corners, {normal, normal, normal, normal});
}

/// Intensity at one metre that is `lightIntensity` at this distance.
float intensityAt(float millimetres) {
    const float metres = millimetres / 1000;
    return lightIntensity * metres * metres;
}

scene::Camera cameraTowards(const glm::vec3& target, const glm::vec3& direction, float distance) {
    scene::Camera camera;
    camera.target = target;
    camera.position = target + distance * glm::normalize(direction);
    if (std::abs(glm::normalize(direction).y) > 0.99f) {
        camera.up = {0, 0, -1};
    }
    return camera;
}

} // namespace

Scene darkMillimetres() {
    Scene scene;
    scene.metersPerUnit = 0.001;
    scene.environment.zenith = scene.environment.horizon = scene.environment.ground = glm::vec3(0);
    return scene;
}

std::uint32_t addGreySurface(Scene& scene) {
    scene::Surface surface;
    surface.baseColor = glm::vec4(0.3f, 0.3f, 0.3f, 1);
    surface.specular = 0;
    scene.surfaces.push_back(surface);
    return static_cast<std::uint32_t>(scene.surfaces.size() - 1);
}

std::uint32_t addPresetSurface(Scene& scene, const char* preset) {
    const std::uint32_t index = addGreySurface(scene);
    const std::uint32_t material = scene::addMaterial(scene, *findPreset(preset), preset);
    scene::setSurfaceMaterial(scene, scene.surfaces[index], material);
    scene.surfaces[index].specular = 0;
    return index;
}

void addBody(Scene& scene, Mesh mesh, std::uint32_t surface, const glm::mat4& transform) {
    mesh.surface = surface;
    scene.instances.push_back({mesh.name, static_cast<std::uint32_t>(scene.meshes.size()), transform});
    scene.meshes.push_back(std::move(mesh));
}

Mesh wedge(float width, float height, float thin, float thick) {
    const float x = width / 2;
    const float y = height / 2;
    const auto corner = [&](float sideX, float sideY, float sideZ) {
        return glm::vec3(sideX * x, sideY * y, sideZ * (sideX < 0 ? thin : thick) / 2);
    };
    Mesh mesh;
    mesh.name = "wedge";
    addFlatQuad(mesh, {corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1)});
    addFlatQuad(mesh, {corner(1, -1, -1), corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1)});
    addFlatQuad(mesh, {corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, -1)});
    addFlatQuad(mesh, {corner(1, -1, 1), corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1)});
    addFlatQuad(mesh, {corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, -1), corner(-1, 1, -1)});
    addFlatQuad(mesh, {corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1)});
    return mesh;
}

Mesh bentSheet(float width, float height, float thickness, float radius) {
    const float y = height / 2;
    const auto out = [&](int column) {
        const float angle = (static_cast<float>(column) / sheetColumns - 0.5f) * width / radius;
        return glm::vec3(std::sin(angle), 0, std::cos(angle));
    };
    const auto at = [&](int column, float side, float level) {
        return (radius + side * thickness / 2) * out(column) + glm::vec3(0, level * y, -radius);
    };
    Mesh mesh;
    mesh.name = "leaf";
    for (int i = 0; i < sheetColumns; ++i) {
        const int j = i + 1;
        addQuad(mesh, {at(i, 1, -1), at(j, 1, -1), at(j, 1, 1), at(i, 1, 1)}, {out(i), out(j), out(j), out(i)});
        addQuad(mesh, {at(j, -1, -1), at(i, -1, -1), at(i, -1, 1), at(j, -1, 1)}, {-out(j), -out(i), -out(i), -out(j)});
        addFlatQuad(mesh, {at(i, 1, 1), at(j, 1, 1), at(j, -1, 1), at(i, -1, 1)});
        addFlatQuad(mesh, {at(i, -1, -1), at(j, -1, -1), at(j, 1, -1), at(i, 1, -1)});
    }
    addFlatQuad(mesh, {at(0, -1, -1), at(0, 1, -1), at(0, 1, 1), at(0, -1, 1)});
    const int last = sheetColumns;
    addFlatQuad(mesh, {at(last, 1, -1), at(last, -1, -1), at(last, -1, 1), at(last, 1, 1)});
    return mesh;
}

scene::Light sun(const glm::vec3& direction) {
    scene::Light result = light(scene::LightKind::Directional, "sun");
    result.direction = glm::normalize(direction);
    return result;
}

scene::Light lamp(const glm::vec3& position) {
    scene::Light result = light(scene::LightKind::Point, "lamp");
    result.position = position;
    result.intensity = intensityAt(glm::length(position));
    return result;
}

scene::Light spotLamp(const glm::vec3& position, float innerConeAngle, float outerConeAngle) {
    scene::Light result = lamp(position);
    result.kind = scene::LightKind::Spot;
    result.name = "spot";
    result.direction = -glm::normalize(position);
    result.innerConeAngle = glm::radians(innerConeAngle);
    result.outerConeAngle = glm::radians(outerConeAngle);
    return result;
}

scene::Camera cameraAt(const glm::vec3& target, const glm::vec3& direction, float height) {
    scene::Camera camera = cameraTowards(target, direction, height / 2 / std::tan(fieldOfView / 2));
    camera.verticalFieldOfView = fieldOfView;
    return camera;
}

scene::Camera flatCameraAt(const glm::vec3& target, const glm::vec3& direction, float height) {
    scene::Camera camera = cameraTowards(target, direction, 100);
    camera.projection = scene::ProjectionKind::Orthographic;
    camera.orthographicHeight = height;
    return camera;
}

} // namespace nacre::bench
