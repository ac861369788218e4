// Lit bodies for timing transmit: a G-buffer and the shadow maps of three lights, traced on the CPU.
#pragma once

#include "bench/effect/effect_context.hpp"

namespace nacre::bench {

/// Five by three spheres of material 1 before a wall of none, lit from behind by a directional and a spot light and
/// from among them by a point light.
class TransmitScene {
public:
    /// `coverage`: [0, 0.5] share of the pixels that the spheres cover.
    TransmitScene(renderer::Gpu& gpu, VkExtent2D extent, double coverage, std::uint32_t shadowMapSize);

    /// What the scene gives of a transmit call; its pointers and images are the scene's.
    NacreTransmitInfo info{};

private:
    EffectImages images_;
    std::vector<NacreLight> lights_;
    std::vector<NacreImage> shadowMaps_;
};

} // namespace nacre::bench
