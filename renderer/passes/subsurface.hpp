// The effect, called through include/nacre/nacre.h alone. Internal to the renderer.
#pragma once

#include "nacre/nacre.h"
#include "renderer/frame_settings.hpp"
#include "renderer/passes/gbuffer.hpp"
#include "renderer/vulkan/frame_timer.hpp"

#include <memory>
#include <optional>

namespace nacre::renderer {

/// What the effect wants of an image beyond what the renderer does with it.
vk::ImageUsageFlags effectUsage(NacreImageSlot slot);

/// What the effect writes.
struct SubsurfaceImages {
    SubsurfaceImages(Gpu& gpu, vk::Extent2D extent, bool withThickness);

    Image scattered;                ///< RGBA16F. Pixels without a material are not written
    Image transmitted;              ///< irradiance, without albedo. RGBA16F
    std::optional<Image> thickness; ///< the one that transmission used, mm, 0 where there was none. R16F

    template <typename Action> void forEachImage(const Action& action) {
        action(scattered);
        action(transmitted);
        if (thickness) {
            action(*thickness);
        }
    }
};

/// The effect's context, and the materials in it.
class Subsurface {
public:
    struct Info {
        vk::Extent2D extent;
        std::uint32_t framesInFlight = 1;
        std::uint32_t recordsPerFrame = 1; ///< of the effect
        std::uint32_t maxLights = 1;
        float metersPerUnit = 1;
        NacreTechnique technique = NACRE_TECHNIQUE_DEFAULT; ///< the first; `prepare` adds others
        bool secondSurfaces = false;                        ///< `bank-surfaces` as well
    };

    Subsurface(Gpu& gpu, const Info& info, const std::vector<Material>& materials);

    /// Whether scattered light has the albedo in it, as it must where materials apply it before, too; else it is left
    /// to compose, which reads it anyway.
    bool scatteredHasAlbedo() const;
    /// By material id, for compose.
    std::span<const shared::TransmissionConstants> transmissions() const { return transmissions_; }
    /// By material id, as transmissions.
    std::span<const shared::LobeConstants> lobes() const { return lobes_; }

    struct Inputs {
        const View& view;
        std::span<const NacreLight> lights;
        GBuffer& gbuffer;
        Image& irradiance;
        Image& shadowMaps;
        SubsurfaceImages& outputs;
        FrameTimer& timer;
        bool hasScale = false;    ///< whether surfaces multiply the lengths of their materials
        bool hasStrength = false; ///< whether textures multiply the strength of materials
        bool hasShares = false;   ///< whether textures multiply the share of the light that comes through
    };

    /// Before anything of frame `frame` is recorded; its previous use must have finished.
    void beginFrame(std::uint32_t frame);
    /// The barriers of both at once, then scatter, then transmit, which waits for nothing of scatter's.
    void record(const vk::raii::CommandBuffer& commandBuffer, const Inputs& inputs, const EffectSettings& settings);
    /// Whether `record` can do what the settings ask with the materials as they are.
    bool isPrepared(const EffectSettings& settings) const;
    /// Compiles what is missing; the device must have finished with all frames.
    void prepare(const EffectSettings& settings);
    /// Replaces the materials that are not what they were (as many as before), for frames that begin later.
    void setMaterials(const std::vector<Material>& materials);
    /// The device must have finished with all frames.
    void resize(vk::Extent2D extent);
    /// Compiles all shaders that have changed, and makes the effect's pipelines anew; the device must have finished
    /// with all frames. Only in a developer build.
    void reloadShaders();
    NacreCost scatterCost(NacreTechnique technique) const;
    NacreCost transmitCost() const;

private:
    struct Destroy {
        void operator()(NacreContext context) const { nacreDestroyContext(context); }
    };

    void check(NacreResult result) const;
    void setMaterial(std::size_t index, const Material& material);
    /// Replaces the context, if there is one, by one for these techniques, with the materials in it.
    void createContext(std::uint32_t techniques);
    void scatter(const vk::raii::CommandBuffer& commandBuffer, const Inputs& inputs, const EffectSettings& settings);
    void transmit(const vk::raii::CommandBuffer& commandBuffer, const Inputs& inputs, const EffectSettings& settings);
    NacreView makeView(const View& view) const;
    bool bakes(const EffectSettings& settings) const;

    Gpu& gpu_;
    Info info_;
    std::vector<Material> materials_;
    std::vector<shared::TransmissionConstants> transmissions_;
    std::vector<shared::LobeConstants> lobes_;
    std::uint32_t techniques_ = 0;             ///< NacreContextInfo::techniques
    std::optional<std::uint32_t> bakedRadius_; ///< of the first material as it is
    std::unique_ptr<std::string> message_;     ///< the effect's last error; its address is known to the context
    std::unique_ptr<NacreContext_T, Destroy> context_;
};

} // namespace nacre::renderer
