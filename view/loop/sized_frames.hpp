// The frames that the viewer's picture is drawn with: one of all its pixels, and one of fewer for slow devices.
#pragma once

#include "renderer/accumulation.hpp"
#include "view/loop/drawn_scene.hpp"

#include <memory>
#include <span>

namespace nacre::view {

/// A frame at one size, and its pass of the accumulation.
struct SizedFrame {
    renderer::Frame frame;
    vk::Extent2D extent;
    std::size_t pass = 0;
};

/// The full frame, and the coarse one once it has been made. Both draw the same scene.
class SizedFrames {
public:
    /// `device` and `scene` must outlive it.
    SizedFrames(renderer::Device& device, const scene::Scene& scene, const renderer::RenderSettings& settings,
                const renderer::FrameLimits& limits);

    SizedFrame& full() { return full_; }
    SizedFrame* coarse() { return coarse_.get(); }
    const SizedFrame* coarse() const { return coarse_.get(); }
    /// Makes the coarse frame, with that share of the pixels of each axis.
    void makeCoarse(double share, const renderer::EffectSettings& effect, renderer::Accumulation& accumulation);
    /// The full frame's size. The coarse one keeps its share.
    void resize(vk::Extent2D extent);
    void attach(renderer::Accumulation& accumulation);

    const DrawnScene& drawn() const { return drawn_; }
    void setMaterials(const std::vector<Material>& materials);
    void setSurfaces(std::span<const scene::Surface> surfaces);
    void setLights(std::span<const scene::Light> lights);
    void setEnvironment(float intensity, float rotation);
    void reloadShaders();

private:
    template <typename Action> void forEach(const Action& action);

    renderer::Device& device_;
    const scene::Scene& scene_;
    renderer::RenderSettings settings_;
    renderer::FrameLimits limits_;
    DrawnScene drawn_;
    SizedFrame full_;
    std::unique_ptr<SizedFrame> coarse_;
};

} // namespace nacre::view
