// The models of a scene file.
#pragma once

#include "scene/files/scene_file_object.hpp"
#include "scene/load_budget.hpp"

#include <map>
#include <set>

namespace nacre::scene {

/// Loads each model once and places it as often as the file says. Entries that differ in place and name alone share
/// meshes, surfaces and textures.
class SceneFileModels {
public:
    /// The models are added to `scene`, whose metersPerUnit is known; `time` as for loadModel.
    SceneFileModels(const std::string& file, Scene& scene, std::optional<double> time)
        : scene_(scene), time_(time), budget_(file) {}

    void add(std::vector<SceneFileObject>& models);

private:
    /// A model in the scene: its instances, with the meshes they have there, lights and cameras before they were moved.
    struct Placed {
        std::vector<Instance> instances;
        std::vector<Light> lights;
        std::vector<Camera> cameras;
        float unitScale = 1;
        glm::dvec3 origin{0}; ///< the model's Scene::origin
    };

    void addModel(SceneFileObject& object, std::uint32_t entry);
    void placeAgain(SceneFileObject& object, const Placed& placed);
    void charge(const Scene& model, const std::string& key);
    Scene take(const SceneFileObject& object, const std::string& source, const std::string& key);
    void append(Scene model, const glm::dmat4& transform, const std::string& name);
    void takeOver(Scene model);

    Scene& scene_;
    std::optional<double> time_;
    LoadBudget budget_;
    std::map<std::string, int> placements_; ///< with looks of their own, that are left, of each model by its key
    std::map<std::string, Scene> models_;   ///< by key
    std::map<std::string, Placed> placed_;  ///< by looks
    std::set<std::string> seen_;            ///< keys of the models that have been placed
};

} // namespace nacre::scene
