#include "view/loop/swatch.hpp"

#include "nacre/presets.hpp"
#include "scene/primitive_meshes.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

constexpr float spacing = 45;      // mm, from body to body
constexpr float halfSide = 12.5f;  // of a square
constexpr float plateDepth = 10;   // mm
constexpr float ballRadius = 10;   // mm
constexpr float thinnest = 0.2f;   // mm, of the wedge
constexpr float thickest = 12;     // mm
constexpr float blockerDepth = 20; // mm before the plate
constexpr std::uint32_t samples = 4;
constexpr std::uint32_t mapSize = 1024;
constexpr std::size_t bodies = 3;

constexpr glm::vec3 slanted{0.6f, 0, -0.8f}; // shadows fall 3/4 of the depth to the right

/// Adds a quad with a face of its own, anticlockwise as it is seen.
void addQuad(scene::Mesh& mesh, const std::array<glm::vec3, 4>& corners) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const glm::vec3 tangent = glm::normalize(corners[1] - corners[0]);
    for (const glm::vec3& corner : corners) {
        mesh.vertices.push_back({.position = corner, .normal = normal, .tangent = glm::vec4(tangent, 1)});
    }
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) {
        mesh.indices.push_back(first + index);
    }
}

/// A body with a flat front at z = 0, a square; its back is `left` and `right` mm behind at its sides.
scene::Mesh makeBlock(const char* name, float left, float right) {
    scene::Mesh mesh{.name = name};
    const std::array<glm::vec3, 4> front{glm::vec3(-halfSide, -halfSide, 0), glm::vec3(halfSide, -halfSide, 0),
                                         glm::vec3(halfSide, halfSide, 0), glm::vec3(-halfSide, halfSide, 0)};
    std::array<glm::vec3, 4> back = front;
    for (glm::vec3& corner : back) {
        corner.z = corner.x < 0 ? -left : -right;
    }
    addQuad(mesh, front);
    addQuad(mesh, {back[1], back[0], back[3], back[2]});
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        addQuad(mesh, {front[next], front[i], back[i], back[next]});
    }
    return mesh;
}

/// Shades the left half of the plate from the slanted light, out of the picture's sight.
scene::Mesh makeBlocker() {
    scene::Mesh mesh{.name = "blocker"};
    constexpr float edge = -0.75f * blockerDepth;
    constexpr float width = 20;
    constexpr float height = 2 * halfSide;
    addQuad(mesh, {glm::vec3(edge - width, -height, blockerDepth), glm::vec3(edge, -height, blockerDepth),
                   glm::vec3(edge, height, blockerDepth), glm::vec3(edge - width, height, blockerDepth)});
    return mesh;
}

scene::Light sun(const glm::vec3& direction, float intensity) {
    return {.name = "sun", .intensity = intensity, .direction = glm::normalize(direction)};
}

/// What each body is lit by.
std::vector<scene::Light> lightsOf(std::size_t body) {
    switch (body) {
    case 0:
        return {sun(slanted, 4)};
    case 1:
        return {sun({0, 0, 1}, 12)};
    default:
        return {sun({0.6f, -0.5f, -0.6f}, 3), sun({-0.5f, -0.1f, 1}, 6)};
    }
}

float centerOf(std::size_t body) {
    return spacing * (static_cast<float>(body) - 1);
}

scene::Scene makeScene() {
    scene::Scene result{.name = "swatch"};
    result.metersPerUnit = 0.001;
    result.environment.intensity = 0.05f;
    result.materials = {presets().front()};
    scene::Surface scattering{.name = "material"};
    scattering.material = 0;
    scene::Surface black{.name = "blocker", .baseColor = glm::vec4(0, 0, 0, 1)};
    black.doubleSided = true;
    result.surfaces = {scattering, black};
    result.meshes = {makeBlock("plate", plateDepth, plateDepth), makeBlock("wedge", thinnest, thickest),
                     scene::ball(ballRadius, 32), makeBlocker()};
    result.meshes.back().surface = 1;
    for (std::uint32_t mesh = 0; mesh < result.meshes.size(); ++mesh) {
        glm::mat4 transform(1);
        transform[3].x = centerOf(mesh % bodies); // the blocker is the plate's
        result.instances.push_back({result.meshes[mesh].name, mesh, transform});
    }
    result.lights = lightsOf(2);
    scene::Camera camera;
    camera.projection = scene::ProjectionKind::Orthographic;
    camera.orthographicHeight = static_cast<float>(Swatch::swatchMillimeters);
    camera.position = {0, 0, 100};
    result.cameras = {camera};
    return result;
}

} // namespace

Swatch::Swatch(renderer::Device& device, double pixelsPerMillimeter) : scene_(makeScene()) {
    LoopSettings settings;
    settings.width = settings.height =
        std::max(16u, static_cast<std::uint32_t>(std::lround(swatchMillimeters * pixelsPerMillimeter)));
    settings.shadowMapSize = mapSize;
    settings.stillSamples = samples;
    settings.thickness = false;
    loop_ = std::make_unique<PictureLoop>(device, scene_, settings);
    picture_ = makeImage(static_cast<std::uint32_t>(bodies) * settings.width, settings.height, {"R", "G", "B"},
                         Encoding::Srgb);
    body_ = bodies;
}

Swatch::~Swatch() = default;

void Swatch::setMaterial(const Material& material) {
    scene::Surface surface = scene_.surfaces[0];
    surface.baseColor = glm::vec4(material.albedo[0], material.albedo[1], material.albedo[2], 1);
    surface.roughness = static_cast<float>(material.roughness);
    surface.specular = static_cast<float>(material.specular);
    loop_->setMaterials({material});
    loop_->setSurfaces(std::array{surface, scene_.surfaces[1]});
    body_ = 0;
    aim();
}

void Swatch::aim() {
    scene::Camera camera = scene_.cameras[0];
    camera.position.x = camera.target.x = centerOf(body_);
    loop_->setCamera(camera);
    loop_->setLights(lightsOf(body_));
}

bool Swatch::step() {
    if (body_ == bodies) {
        return true;
    }
    if (loop_->step() != Step::Converged) {
        return false;
    }
    const Image shown = toEncoding(loop_->read(0).shown, Encoding::Srgb);
    const std::size_t row = std::size_t{3} * shown.width;
    for (std::uint32_t y = 0; y < shown.height; ++y) {
        std::copy_n(shown.values.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                    picture_.values.begin() + static_cast<std::ptrdiff_t>((y * bodies + body_) * row));
    }
    if (++body_ < bodies) {
        aim();
        return false;
    }
    return true;
}

} // namespace nacre::view
