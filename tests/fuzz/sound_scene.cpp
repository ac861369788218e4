#include "tests/fuzz/sound_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace nacre::fuzz {
namespace {

using scene::none;

void require(bool holds, const char* what) {
    if (!holds) {
        std::fprintf(stderr, "the scene is not sound: %s\n", what);
        std::abort();
    }
}

template <typename T> bool isIndex(std::uint32_t index, const std::vector<T>& items, bool mayBeNone = false) {
    return (mayBeNone && index == none) || index < items.size();
}

template <typename Vector> bool isFinite(const Vector& vector) {
    for (int i = 0; i < Vector::length(); ++i) {
        if (!std::isfinite(vector[i])) {
            return false;
        }
    }
    return true;
}

bool isFinite(const glm::mat4& matrix) {
    return isFinite(matrix[0]) && isFinite(matrix[1]) && isFinite(matrix[2]) && isFinite(matrix[3]);
}

void requireSound(const scene::Scene& scene, const scene::Mesh& mesh) {
    require(isIndex(mesh.surface, scene.surfaces), "mesh.surface");
    require(mesh.indices.size() % 3 == 0, "mesh.indices are triangles");
    require(std::ranges::all_of(mesh.indices, [&](std::uint32_t i) { return i < mesh.vertices.size(); }),
            "mesh.indices");
    for (const scene::Vertex& vertex : mesh.vertices) {
        require(isFinite(vertex.position), "vertex.position");
        require(isFinite(vertex.normal), "vertex.normal");
        require(isFinite(vertex.tangent), "vertex.tangent");
        require(isFinite(vertex.uv) && isFinite(vertex.secondUv), "vertex.uv");
    }
}

void requireSound(const scene::Scene& scene, const scene::Surface& surface) {
    for (const scene::TextureSlot& slot : scene::textureSlots) {
        require(isIndex(surface.*slot.texture, scene.textures, true), "surface's textures");
        const glm::mat3& uv = (surface.*slot.coordinates).transform;
        require(isFinite(uv[0]) && isFinite(uv[1]) && isFinite(uv[2]), "surface's texture coordinates");
    }
    require(isIndex(surface.material, scene.materials, true), "surface.material");
    require(isFinite(surface.baseColor) && isFinite(surface.emission), "surface's colours");
    require(std::isfinite(surface.metallic) && std::isfinite(surface.roughness) && std::isfinite(surface.specular) &&
                std::isfinite(surface.normalScale) && std::isfinite(surface.thickness) && std::isfinite(surface.scale),
            "surface's numbers");
}

} // namespace

void requireSound(const scene::Scene& scene) {
    for (const scene::Mesh& mesh : scene.meshes) {
        requireSound(scene, mesh);
    }
    for (const scene::Surface& surface : scene.surfaces) {
        requireSound(scene, surface);
    }
    for (const scene::Texture& texture : scene.textures) {
        require(texture.pixels.size() == std::size_t{texture.width} * texture.height * 4, "texture.pixels");
    }
    for (const scene::Instance& instance : scene.instances) {
        require(isIndex(instance.mesh, scene.meshes), "instance.mesh");
        require(isFinite(instance.transform), "instance.transform");
    }
    for (const Material& material : scene.materials) {
        require(findFault(material).empty(), "materials");
    }
    for (const scene::Light& light : scene.lights) {
        require(isFinite(light.color) && isFinite(light.position) && isFinite(light.direction), "light's vectors");
        require(std::isfinite(light.intensity) && std::isfinite(light.range), "light's numbers");
    }
    for (const scene::Camera& camera : scene.cameras) {
        require(isFinite(camera.position) && isFinite(camera.target) && isFinite(camera.up), "camera's vectors");
    }
    for (const std::string& note : scene.notes) {
        require(!note.empty() && note.size() <= mostOfSentence, "notes");
    }
    require(scene.metersPerUnit > 0 && std::isfinite(scene.metersPerUnit), "metersPerUnit");
}

} // namespace nacre::fuzz
