// What an artist changes of a scene, as values: a copy is a step of the history.
#pragma once

#include "scene/scene.hpp"

#include <filesystem>
#include <memory>
#include <set>
#include <vector>

namespace nacre::view {

/// A material while it is edited.
struct EditedMaterial {
    Material material;
    std::set<std::size_t> hidden; ///< layers that are kept but not drawn

    /// The material without its hidden layers. With all of them hidden it is drawn as if none were. Light of a channel
    /// that no layer has leaves where it enters.
    Material drawn() const;
    bool operator==(const EditedMaterial&) const = default;
};

struct EditedScene {
    std::vector<EditedMaterial> materials;
    std::vector<scene::Surface> surfaces;
    std::vector<scene::Light> lights;
    float environmentIntensity = 1;
    float environmentRotation = 0;                 ///< [rad]
    std::string environmentFile;                   ///< that `environmentImage` was read from
    std::shared_ptr<const Image> environmentImage; ///< null: the built-in sky
    float exposureStops = 0;                       ///< the picture is multiplied by 2^stops
};

/// What can be changed of this scene. One without a material gets one, skin, that no surface has yet.
EditedScene editedOf(scene::Scene& scene);

std::vector<Material> drawnMaterials(const EditedScene& edited);

/// The scene with what was edited in it.
scene::Scene sceneOf(const scene::Scene& scene, const EditedScene& edited);

/// Light from all around by an equirectangular .hdr or .exr file; with an empty name by the built-in sky. Throws
/// FileError.
void setEnvironment(EditedScene& edited, const std::filesystem::path& file);

/// Puts another material in place of `index`. Surfaces that have it take over its albedo, roughness and specular, where
/// they have no texture for them; if no surface of the scene has a material, all get it.
void replaceMaterial(EditedScene& edited, std::size_t index, const Material& material);

/// Gives every surface of that material what the material says of surfaces.
void applyToSurfaces(EditedScene& edited, std::size_t index);

// ---- Layers of materials[index], which turns into layers if it is told by a mean free path or by slabs.

/// The layers as they can be edited.
std::vector<Layer>& layersOf(EditedMaterial& edited);
/// Adds a copy of layer `index`, behind it. False where there is no room (maxLayers).
bool duplicateLayer(EditedMaterial& edited, std::size_t index);
/// Adds a layer twice as wide as the widest. False where there is no room.
bool addLayer(EditedMaterial& edited);
/// False for the last one: a material has a layer.
bool removeLayer(EditedMaterial& edited, std::size_t index);
void moveLayer(EditedMaterial& edited, std::size_t from, std::size_t to);

} // namespace nacre::view
