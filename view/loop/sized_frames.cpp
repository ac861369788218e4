#include "view/loop/sized_frames.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

/// An extent with that share of the pixels of each axis.
vk::Extent2D shrunk(vk::Extent2D extent, double share) {
    const auto side = [share](std::uint32_t pixels) {
        return std::max(1u, static_cast<std::uint32_t>(std::lround(pixels * share)));
    };
    return {side(extent.width), side(extent.height)};
}

SizedFrame makeFrame(renderer::Device& device, const scene::Scene& scene, const renderer::RenderSettings& settings,
                     const renderer::FrameLimits& limits) {
    return {renderer::Frame(device, scene, settings, limits), {settings.width, settings.height}};
}

} // namespace

SizedFrames::SizedFrames(renderer::Device& device, const scene::Scene& scene, const renderer::RenderSettings& settings,
                         const renderer::FrameLimits& limits)
    : device_(device),
      scene_(scene),
      settings_(settings),
      limits_(limits),
      drawn_(scene),
      full_(makeFrame(device, scene, settings, limits)) {}

void SizedFrames::makeCoarse(double share, const renderer::EffectSettings& effect,
                             renderer::Accumulation& accumulation) {
    const vk::Extent2D extent = shrunk(full_.extent, share);
    renderer::RenderSettings settings = settings_;
    static_cast<renderer::EffectSettings&>(settings) = effect;
    settings.width = extent.width;
    settings.height = extent.height;
    coarse_ = std::make_unique<SizedFrame>(makeFrame(device_, scene_, settings, limits_));
    drawn_.apply(coarse_->frame);
    coarse_->pass = accumulation.attach(coarse_->frame.images());
}

void SizedFrames::resize(vk::Extent2D extent) {
    const double share = coarse_ ? double(coarse_->extent.width) / full_.extent.width : 0;
    const auto setExtent = [](SizedFrame& sized, vk::Extent2D size) {
        sized.frame.resize(size.width, size.height);
        sized.extent = size;
    };
    setExtent(full_, extent);
    if (coarse_) {
        setExtent(*coarse_, shrunk(extent, share));
    }
}

void SizedFrames::attach(renderer::Accumulation& accumulation) {
    full_.pass = accumulation.attach(full_.frame.images());
    if (coarse_) {
        coarse_->pass = accumulation.attach(coarse_->frame.images());
    }
}

template <typename Action> void SizedFrames::forEach(const Action& action) {
    action(full_.frame);
    if (coarse_) {
        action(coarse_->frame);
    }
}

void SizedFrames::setMaterials(const std::vector<Material>& materials) {
    forEach([&](renderer::Frame& frame) { frame.setMaterials(materials); });
    drawn_.materials = materials;
}

void SizedFrames::setSurfaces(std::span<const scene::Surface> surfaces) {
    forEach([&](renderer::Frame& frame) { frame.setSurfaces(surfaces); });
    drawn_.surfaces.assign(surfaces.begin(), surfaces.end());
}

void SizedFrames::setLights(std::span<const scene::Light> lights) {
    forEach([&](renderer::Frame& frame) { frame.setLights(lights); });
    drawn_.lights.assign(lights.begin(), lights.end());
}

void SizedFrames::setEnvironment(float intensity, float rotation) {
    forEach([&](renderer::Frame& frame) { frame.setEnvironment(intensity, rotation); });
    drawn_.environmentIntensity = intensity;
    drawn_.environmentRotation = rotation;
}

void SizedFrames::reloadShaders() {
    full_.frame.reloadShaders();
    forEach([](renderer::Frame& frame) { frame.prepare(frame.settings()); });
}

} // namespace nacre::view
