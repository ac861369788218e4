// What of a scene a window changes while frames of it are drawn.
#pragma once

#include "renderer/frame.hpp"

#include <vector>

namespace nacre::view {

struct DrawnScene {
    std::vector<Material> materials;
    std::vector<scene::Surface> surfaces;
    std::vector<scene::Light> lights;
    float environmentIntensity = 1;
    float environmentRotation = 0;

    explicit DrawnScene(const scene::Scene& scene);

    /// Sets all of it.
    void apply(renderer::Frame& frame) const;
};

} // namespace nacre::view
