// The passes and images whose size is the picture's. Internal to the renderer.
#pragma once

#include "renderer/frame_report.hpp"
#include "renderer/frame_settings.hpp"
#include "renderer/passes/ambient_occlusion.hpp"
#include "renderer/passes/blended_surfaces.hpp"
#include "renderer/passes/compose_picture.hpp"
#include "renderer/passes/copy_floor.hpp"
#include "renderer/passes/lighting.hpp"
#include "renderer/passes/subsurface.hpp"

#include <optional>
#include <vector>

namespace nacre::renderer {

/// Pixels of the images that are tone mapped into the picture. Throws RendererError for settings that make no picture.
vk::Extent2D checkedExtent(const Gpu& gpu, const RenderSettings& settings);

/// From the G-buffer to the picture. It stays where it is made: passes know where others' images are.
struct PicturePasses {
    struct Inputs {
        const GpuScene& scene;
        ShadowMaps& shadowMaps;
        Environment& environment;
        const vk::raii::Sampler& nearest;
    };
    struct Limits {
        std::size_t materials = 0;
        std::size_t lights = 0;
        std::uint32_t framesInFlight = 1;
    };

    PicturePasses(Gpu& gpu, const Inputs& inputs, const RenderSettings& settings, const Limits& limits);
    PicturePasses(const PicturePasses&) = delete;
    PicturePasses& operator=(const PicturePasses&) = delete;

    template <typename Action> void forEachImage(const Action& action) {
        gbuffer.forEachImage(action);
        occlusion.forEachImage(action);
        lighting.forEachImage(action);
        subsurface.forEachImage(action);
        blended.forEachImage(action);
        compose.forEachImage(action);
        if (copyFloor) {
            copyFloor->forEachImage(action);
        }
    }

    std::vector<MemoryUse> memory;
    vk::Extent2D extent;
    GBuffer gbuffer;
    AmbientOcclusion occlusion;
    Lighting lighting;
    SubsurfaceImages subsurface;
    BlendedSurfaces blended;
    Compose compose;
    std::optional<CopyFloor> copyFloor;
};

} // namespace nacre::renderer
