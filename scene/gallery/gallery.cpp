#include "scene/gallery/gallery.hpp"

#include "nacre/presets.hpp"
#include "scene/gallery/plinth.hpp"
#include "scene/gallery/stored_bodies.hpp"
#include "scene/surface_material.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <array>

namespace nacre::scene {

namespace {

using gallery::Body;

constexpr float millimetre = 0.001f;
constexpr float plinthHeight = 0.06f, potHeight = 0.066f;

/// An albedo texture and how it lies on a body.
struct Painting {
    glm::vec2 (*coordinates)(const glm::vec3& p) = nullptr;
    Texture (*make)() = nullptr;
};

/// A stored body, what it is made of and where it stands.
struct Exhibit {
    const char* name;
    const char* preset;
    glm::vec3 place; ///< [m] where its lowest point stands
    float heading;   ///< [deg] about +Y
    float roll;      ///< [deg] about +Z, before
    glm::vec3 color;
    float roughness;
    Painting painting;
};

constexpr Painting skin{gallery::headTextureCoordinates, gallery::makeSkinTexture};
constexpr Painting flames{gallery::shellTextureCoordinates, gallery::makeShellTexture};
constexpr glm::vec3 white{1}, jade{0.34f, 0.62f, 0.40f}, marble{0.86f, 0.84f, 0.80f}, green{0.22f, 0.46f, 0.10f};

constexpr std::array<Exhibit, 5> exhibits{{
    {"head", "skin", {-0.165f, 0, -0.02f}, 11, 0, white, 0.42f, skin},
    {"dragon", "jade", {0.27f, 0, -0.05f}, -14, 0, jade, 0.22f, {}},
    {"logo", "marble", {0.055f, 0, 0.185f}, 0, 0, marble, 0.25f, {}},
    {"shell", "nacre", {-0.365f, 0, 0.08f}, -28, -62, white, 0.2f, flames},
    {"plant", "leaf", {0.05f, 0.86f * potHeight, -0.12f}, 0, 0, green, 0.38f, {}},
}};

std::uint32_t addSurface(Scene& scene, const std::string& name, const glm::vec3& color, float roughness) {
    Surface surface;
    surface.name = name;
    surface.baseColor = glm::vec4(color, 1);
    surface.roughness = roughness;
    scene.surfaces.push_back(surface);
    return std::uint32_t(scene.surfaces.size() - 1);
}

void addInstance(Scene& scene, Mesh mesh, std::uint32_t surface, const glm::mat4& transform) {
    mesh.surface = surface;
    scene.instances.push_back({mesh.name, std::uint32_t(scene.meshes.size()), transform});
    scene.meshes.push_back(std::move(mesh));
}

void addStage(Scene& scene) {
    const std::uint32_t stone = addSurface(scene, "plinth", {0.038f, 0.038f, 0.042f}, 0.9f);
    const std::uint32_t floor = addSurface(scene, "ground", {0.04f, 0.04f, 0.044f}, 0.9f);
    const std::uint32_t clay = addSurface(scene, "pot", {0.30f, 0.13f, 0.08f}, 0.7f);
    scene.surfaces[stone].specular = scene.surfaces[floor].specular = 0.15f; // dull: the back light must not dazzle
    const glm::mat4 identity(1);
    addInstance(scene, gallery::makeChamferedBox({0.56f, 0.5f * plinthHeight, 0.26f}, 0.006f), stone,
                glm::translate(identity, {0, -0.5f * plinthHeight, 0}));
    addInstance(scene, gallery::makeGround(1.6f), floor, glm::translate(identity, {0, -plinthHeight, 0}));
    glm::vec3 pot = exhibits.back().place;
    pot.y = 0;
    addInstance(scene, gallery::makePot(potHeight), clay, glm::translate(identity, pot));
}

Mesh toMesh(const Exhibit& exhibit, Body&& body) {
    Mesh mesh;
    mesh.name = exhibit.name;
    mesh.vertices.reserve(body.solid.positions.size());
    for (std::size_t i = 0; i < body.solid.positions.size(); ++i) {
        const glm::vec3 position = body.solid.positions[i], normal = body.normals[i];
        const glm::vec2 uv = exhibit.painting.coordinates ? exhibit.painting.coordinates(position) : glm::vec2(0);
        mesh.vertices.push_back({millimetre * position, normal, gallery::anyTangent(normal), uv});
    }
    mesh.indices = std::move(body.solid.indices);
    return mesh;
}

/// Turned, and moved so that the lowest point comes to stand at the exhibit's place.
glm::mat4 standing(const Exhibit& exhibit, const Mesh& mesh) {
    glm::mat4 turn = glm::rotate(glm::mat4(1), glm::radians(exhibit.heading), {0, 1, 0});
    turn = glm::rotate(turn, glm::radians(exhibit.roll), {0, 0, 1});
    float lowest = std::numeric_limits<float>::max();
    for (const Vertex& vertex : mesh.vertices)
        lowest = std::min(lowest, (turn * glm::vec4(vertex.position, 1)).y);
    return glm::translate(glm::mat4(1), exhibit.place - glm::vec3(0, lowest, 0)) * turn;
}

std::uint32_t addSurfaceOf(Scene& scene, const Exhibit& exhibit) {
    const Material* preset = findPreset(exhibit.preset);
    if (!preset)
        throw SceneError(std::string("the gallery's ") + exhibit.name + " needs the preset '" + exhibit.preset + "'");
    const std::uint32_t surface = addSurface(scene, exhibit.name, exhibit.color, exhibit.roughness);
    scene.surfaces[surface].material = addMaterial(scene, *preset, std::string("the gallery's ") + exhibit.name);
    // Seen from where the gallery's cameras stand its jade has 47 dB without them, and the whole gallery would take 16
    // us more (1920x1080, NVIDIA H200).
    scene.materials.back().secondSurfaces = false;
    if (exhibit.painting.make) {
        scene.surfaces[surface].baseColorTexture = std::uint32_t(scene.textures.size());
        scene.textures.push_back(exhibit.painting.make());
    }
    return surface;
}

void addExhibits(Scene& scene) {
    for (const Exhibit& exhibit : exhibits) {
        const std::uint32_t surface = addSurfaceOf(scene, exhibit);
        Mesh mesh = toMesh(exhibit, gallery::storedBody(exhibit.name));
        const glm::mat4 transform = standing(exhibit, mesh);
        addInstance(scene, std::move(mesh), surface, transform);
    }
}

} // namespace

std::vector<Light> galleryLights(GalleryLight which) {
    std::vector<Light> lights;
    if (which != GalleryLight::Back) {
        Light key;
        key.name = "front key";
        key.kind = LightKind::Directional;
        key.color = {1, 0.95f, 0.88f};
        key.intensity = 5.2f;
        key.position = {-0.9f, 1.1f, 1.4f};
        key.direction = glm::normalize(glm::vec3(0.62f, -0.62f, -0.75f));
        Light fill;
        fill.name = "front fill";
        fill.kind = LightKind::Point;
        fill.color = {0.80f, 0.88f, 1};
        fill.intensity = 1.6f;
        fill.position = {0.75f, 0.45f, 0.95f};
        lights.insert(lights.end(), {key, fill});
    }
    if (which != GalleryLight::Front) {
        Light back;
        back.name = "back";
        back.kind = LightKind::Spot;
        back.color = {1, 0.93f, 0.82f};
        back.intensity = 62;
        back.position = {-0.14f, 0.78f, -1.25f};
        back.direction = glm::normalize(glm::vec3(0, 0.14f, 0) - back.position);
        back.innerConeAngle = glm::radians(20.f);
        back.outerConeAngle = glm::radians(27.f);
        lights.push_back(back);
    }
    return lights;
}

Scene makeGallery(GalleryLight light) {
    Scene scene;
    scene.name = "gallery";
    addStage(scene);
    addExhibits(scene);
    scene.lights = galleryLights(light);
    Camera camera;
    camera.name = "gallery";
    camera.position = {0, 0.30f, 1.75f};
    camera.target = {0, 0.135f, 0};
    camera.verticalFieldOfView = 0.30f;
    scene.cameras.push_back(camera);
    scene.environment.zenith = {0.16f, 0.18f, 0.22f};
    scene.environment.horizon = {0.10f, 0.10f, 0.11f};
    scene.environment.ground = {0.03f, 0.03f, 0.03f};
    return scene;
}

} // namespace nacre::scene
