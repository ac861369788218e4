#include "scene/surface_material.hpp"

#include "core/files/quoted_text.hpp"

#include <algorithm>

namespace nacre::scene {

std::uint32_t addMaterial(Scene& scene, Material material, const std::string& where) {
    if (const std::string fault = findFault(material); !fault.empty()) {
        throw SceneError(where + ": " + fault);
    }
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void setSurfaceMaterial(Scene& scene, Surface& surface, std::uint32_t material) {
    surface.material = material;
    if (material == none) {
        return;
    }
    if (surface.alphaMode == AlphaMode::Blend) {
        surface.alphaMode = AlphaMode::Mask;
        surface.alphaCutoff = 0.5f;
    }
    const Material& source = scene.materials[material];
    if (surface.baseColorTexture == none) {
        surface.baseColor = glm::vec4(source.albedo[0], source.albedo[1], source.albedo[2], surface.baseColor.w);
    }
    if (surface.metallicRoughnessTexture == none) {
        surface.roughness = static_cast<float>(source.roughness);
        surface.metallic = 0;
    }
    surface.specular = static_cast<float>(source.specular);
}

void setBodyMaterial(Scene& scene, std::uint32_t material, const std::string& where) {
    const auto isBody = [](const Surface& surface) { return surface.alphaMode != AlphaMode::Blend; };
    const bool all = material == none || std::ranges::none_of(scene.surfaces, isBody);
    for (Surface& surface : scene.surfaces) {
        if (all || isBody(surface)) {
            setSurfaceMaterial(scene, surface, material);
        } else {
            scene.notes.push_back(where + " is not given to the surface " + inQuotes(surface.name) +
                                  ", which is blended");
        }
    }
}

void assignMaterial(Scene& scene, const Material& material) {
    const auto scatters = [](const Surface& surface) { return surface.material != none; };
    const bool all = std::ranges::none_of(scene.surfaces, scatters);
    scene.materials.clear();
    const std::string where = "material '" + withoutMiddle(material.name, 100) + "'";
    addMaterial(scene, material, where);
    if (all) {
        setBodyMaterial(scene, 0, where);
        return;
    }
    for (Surface& surface : scene.surfaces) {
        if (scatters(surface)) {
            setSurfaceMaterial(scene, surface, 0);
        }
    }
}

} // namespace nacre::scene
