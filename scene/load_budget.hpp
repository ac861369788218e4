// How much memory a load may take.
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// What a load may keep in memory: 512 MiB, and 256 times the bytes that are read for it. Small files that unfold to
/// more are attacks or accidents.
class LoadBudget {
public:
    explicit LoadBudget(std::string name) : name_(std::move(name)) {}

    void addInput(std::uint64_t bytes) { limit_ += 256 * bytes; }

    /// Throws SceneError, which begins with the name, when everything charged together is too much.
    void charge(std::uint64_t bytes) {
        charged_ += bytes;
        if (charged_ > limit_) {
            throw SceneError(name_ + ": needs more than " + std::to_string(limit_ >> 20) +
                             " MiB of memory, which its size does not explain");
        }
    }
    void charge(const Mesh& mesh) {
        charge(mesh.vertices.size() * sizeof(Vertex) + mesh.indices.size() * sizeof(mesh.indices[0]));
    }
    void charge(const Instance& instance) { charge(sizeof(Instance) + instance.name.size()); }
    void charge(const Texture& texture) { charge(texture.pixels.size()); }

private:
    std::string name_;
    std::uint64_t limit_ = std::uint64_t{512} << 20;
    std::uint64_t charged_ = 0;
};

} // namespace nacre::scene
