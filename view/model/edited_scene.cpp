#include "view/model/edited_scene.hpp"

#include "image/image_file.hpp"
#include "nacre/presets.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

/// Layer numbers after `change` has given each its new place; those without one are gone.
template <typename Change> std::set<std::size_t> renumbered(const std::set<std::size_t>& layers, const Change& change) {
    std::set<std::size_t> result;
    for (const std::size_t layer : layers) {
        if (const std::optional<std::size_t> place = change(layer)) {
            result.insert(*place);
        }
    }
    return result;
}

} // namespace

Material EditedMaterial::drawn() const {
    Material result = material;
    if (!hidden.empty() && hidden.size() < material.layers.size()) {
        result.slabs.clear(); // which are all of the layers
        result.layers.clear();
        for (std::size_t i = 0; i < material.layers.size(); ++i) {
            if (!hidden.contains(i)) {
                result.layers.push_back(material.layers[i]);
            }
        }
    }
    if (result.layers.empty() || result.layers.size() == maxLayers) {
        return result;
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
        if (std::ranges::all_of(result.layers, [&](const Layer& layer) { return layer.weight[channel] <= 0; })) {
            Layer direct;
            direct.weight[channel] = 1;
            result.layers.push_back(direct);
            result.slabs.clear();
        }
    }
    return result;
}

EditedScene editedOf(scene::Scene& scene) {
    if (scene.materials.empty()) {
        scene.materials.push_back(presets().front());
    }
    EditedScene edited;
    for (const Material& material : scene.materials) {
        edited.materials.push_back({material, {}});
    }
    edited.surfaces = scene.surfaces;
    edited.lights = scene.lights;
    edited.environmentIntensity = scene.environment.intensity;
    edited.environmentRotation = scene.environment.rotation;
    edited.environmentFile = scene.environment.file;
    if (scene.environment.image) {
        edited.environmentImage = std::make_shared<const Image>(*scene.environment.image);
    }
    return edited;
}

scene::Scene sceneOf(const scene::Scene& scene, const EditedScene& edited) {
    scene::Scene result = scene;
    result.materials = drawnMaterials(edited);
    result.surfaces = edited.surfaces;
    result.lights = edited.lights;
    result.environment.intensity = edited.environmentIntensity;
    result.environment.rotation = edited.environmentRotation;
    result.environment.file = edited.environmentFile;
    result.environment.image = edited.environmentImage ? std::optional(*edited.environmentImage) : std::nullopt;
    result.exposure = scene.exposure * std::exp2(edited.exposureStops);
    return result;
}

void setEnvironment(EditedScene& edited, const std::filesystem::path& file) {
    edited.environmentImage.reset();
    edited.environmentFile.clear();
    if (file.empty()) {
        return;
    }
    Image image = readRadiance(file);
    if (!std::ranges::all_of(image.values, [](float value) { return value >= 0 && std::isfinite(value); })) {
        throw FileError(file.string() + ": has negative, infinite or NaN pixels, and cannot light a scene");
    }
    edited.environmentImage = std::make_shared<const Image>(std::move(image));
    edited.environmentFile = file.string();
}

std::vector<Material> drawnMaterials(const EditedScene& edited) {
    std::vector<Material> result;
    for (const EditedMaterial& material : edited.materials) {
        result.push_back(material.drawn());
    }
    return result;
}

void replaceMaterial(EditedScene& edited, std::size_t index, const Material& material) {
    edited.materials[index] = {material, {}};
    const bool noneScatters = std::ranges::all_of(
        edited.surfaces, [](const scene::Surface& surface) { return surface.material == scene::none; });
    if (noneScatters) {
        for (scene::Surface& surface : edited.surfaces) {
            surface.material = static_cast<std::uint32_t>(index);
        }
    }
    applyToSurfaces(edited, index);
}

void applyToSurfaces(EditedScene& edited, std::size_t index) {
    const Material& material = edited.materials[index].material;
    for (scene::Surface& surface : edited.surfaces) {
        if (surface.material != index) {
            continue;
        }
        if (surface.baseColorTexture == scene::none) {
            surface.baseColor =
                glm::vec4(material.albedo[0], material.albedo[1], material.albedo[2], surface.baseColor.w);
        }
        if (surface.metallicRoughnessTexture == scene::none) {
            surface.roughness = static_cast<float>(material.roughness);
            surface.metallic = 0;
        }
        surface.specular = static_cast<float>(material.specular);
    }
}

std::vector<Layer>& layersOf(EditedMaterial& edited) {
    Material& material = edited.material;
    if (material.layers.empty()) {
        material.layers = makeLayers(material);
        // makeLayers has the scale in it, which stays a factor of its own.
        for (Layer& layer : material.layers) {
            layer.variance /= material.scale * material.scale;
        }
        material.meanFreePath.reset();
    }
    material.slabs.clear();
    return material.layers;
}

bool duplicateLayer(EditedMaterial& edited, std::size_t index) {
    std::vector<Layer>& layers = layersOf(edited);
    if (layers.size() >= maxLayers || index >= layers.size()) {
        return false;
    }
    const Layer copy = layers[index];
    layers.insert(layers.begin() + static_cast<std::ptrdiff_t>(index) + 1, copy);
    edited.hidden = renumbered(edited.hidden, [index](std::size_t layer) -> std::optional<std::size_t> {
        return layer > index ? layer + 1 : layer;
    });
    return true;
}

bool addLayer(EditedMaterial& edited) {
    std::vector<Layer>& layers = layersOf(edited);
    if (layers.size() >= maxLayers) {
        return false;
    }
    constexpr double leastVariance = 0.01;
    double widest = leastVariance;
    for (const Layer& layer : layers) {
        widest = std::max(widest, layer.variance);
    }
    constexpr double share = 0.2;
    constexpr double twiceAsWide = 4; // of a variance
    layers.push_back({{share, share, share}, std::min(widest * twiceAsWide, 1e6)});
    return true;
}

bool removeLayer(EditedMaterial& edited, std::size_t index) {
    std::vector<Layer>& layers = layersOf(edited);
    if (layers.size() <= 1 || index >= layers.size()) {
        return false;
    }
    layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(index));
    edited.hidden = renumbered(edited.hidden, [index](std::size_t layer) -> std::optional<std::size_t> {
        if (layer == index) {
            return std::nullopt;
        }
        return layer > index ? layer - 1 : layer;
    });
    return true;
}

void moveLayer(EditedMaterial& edited, std::size_t from, std::size_t to) {
    std::vector<Layer>& layers = layersOf(edited);
    if (from == to || from >= layers.size() || to >= layers.size()) {
        return;
    }
    const Layer moved = layers[from];
    layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(from));
    layers.insert(layers.begin() + static_cast<std::ptrdiff_t>(to), moved);
    edited.hidden = renumbered(edited.hidden, [from, to](std::size_t layer) -> std::optional<std::size_t> {
        if (layer == from) {
            return to;
        }
        const std::size_t without = layer > from ? layer - 1 : layer;
        return without >= to ? without + 1 : without;
    });
}

} // namespace nacre::view
