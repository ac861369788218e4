// The effect, called through include/nacre/nacre.h alone. Internal to the renderer.
#pragma once

#include "nacre/nacre.h"
#include "renderer/vulkan/frame_timer.hpp"
#include "renderer/passes/gbuffer.hpp"
#include "renderer/light_placement.hpp"
#include "renderer/renderer.hpp"

#include <optional>

namespace nacre::renderer {

/// What the effect wants of an image beyond what the renderer does with it.
vk::ImageUsageFlags effectUsage(NacreImageSlot slot);

/// The effect's context, its outputs, and the materials in it.
class Subsurface {
public:
    struct Info {
        vk::Extent2D extent;
        std::uint32_t framesInFlight = 1;
        std::uint32_t recordsPerFrame = 1; ///< of the effect
        float metersPerUnit = 1;
        bool thickness = false;                             ///< RenderSettings::thickness
        NacreTechnique technique = NACRE_TECHNIQUE_DEFAULT; ///< the first; prepareSettings adds others
    };

    Subsurface(Gpu& gpu, const Info& info, const std::vector<Material>& materials,
               const std::vector<PlacedLight>& lights);

    /// Scattered light (RGBA16F). Pixels without a material are not written.
    Image& scattered() { return scattered_; }
    /// Whether the last `scatter` has put the albedo in it, as it must where materials apply it before, too; else it is
    /// left to compose, which reads it anyway.
    bool scatteredHasAlbedo() const { return scatteredHasAlbedo_; }
    /// Transmitted irradiance, without albedo. RGBA16F.
    Image& transmitted() { return transmitted_; }
    /// The thickness transmission used, mm, 0 where there was none (R16F); only where Info::thickness asks for it.
    Image& thickness() { return thickness_; }
    /// TransmissionConstants by material id, for compose.
    const Buffer& transmissions() const { return transmissions_; }

    struct Frame {
        std::uint32_t index = 0;
        View view;
        GBuffer& gbuffer;
        FrameTimer& timer;
    };

    /// Before anything of frame `index` is recorded; its previous use must have finished.
    void beginFrame(std::uint32_t index);
    /// The barriers before `scatter` and `transmit`, all at once, so that there is none between the two.
    void prepareImages(const vk::raii::CommandBuffer& commandBuffer, const Frame& frame, Image& irradiance,
                       Image& shadowMaps);
    void scatter(const vk::raii::CommandBuffer& commandBuffer, const Frame& frame, Image& irradiance,
                 const EffectSettings& settings);
    void transmit(const vk::raii::CommandBuffer& commandBuffer, const Frame& frame, Image& shadowMaps,
                  const EffectSettings& settings);
    /// Compiles what the settings need beyond the context's own pipelines; the device must be idle. Before `scatter`
    /// with new settings or materials.
    void prepareSettings(Gpu& gpu, const EffectSettings& settings);
    /// Replaces all materials; the device must be idle.
    void setMaterials(const std::vector<Material>& materials);
    NacreCost scatterCost(NacreTechnique technique) const;
    NacreCost transmitCost() const;

private:
    struct Destroy {
        void operator()(NacreContext context) const { nacreDestroyContext(context); }
    };

    void check(NacreResult result) const;
    /// Replaces the context, if there is one, by one for these techniques.
    void createContext(Gpu& gpu, std::uint32_t techniques);
    NacreView makeView(const View& view) const;

    Info info_;
    std::vector<NacreLight> lights_;
    vk::raii::PipelineCache pipelines_{nullptr}; ///< from one context to the next
    Image scattered_;
    Image transmitted_;
    Image thickness_;
    Buffer transmissions_;
    std::vector<Material> materials_;
    bool scatteredHasAlbedo_ = false;
    std::uint32_t techniques_ = 0;             ///< NacreContextInfo::techniques
    std::optional<std::uint32_t> bakedRadius_; ///< of the first material as it is
    std::unique_ptr<std::string> message_;     ///< the effect's last error; its address is known to the context
    std::unique_ptr<NacreContext_T, Destroy> context_;
};

} // namespace nacre::renderer
