// A frame: records everything from the shadow maps to the picture into a command buffer of its driver's. Drivers are
// renderer/offscreen.hpp, which waits for every frame, and whoever shows frames in a window.
#pragma once

#include "renderer/frame_report.hpp"
#include "renderer/frame_settings.hpp"
#include "renderer/graphics_device.hpp"
#include "renderer/vulkan/resources.hpp"
#include "scene/scene.hpp"

#include <memory>
#include <span>

namespace nacre::renderer {

/// What a frame is made for: it allocates nothing for more later on.
struct FrameLimits {
    std::uint32_t framesInFlight = 1; ///< [1 … 8]
    std::uint32_t lights = 0;         ///< [0 … 1024] most lights; never less than the scene's
    std::uint32_t shadowLayers = 0;   ///< most layers of shadow maps: one a directional light or spot that casts a
                                      ///< shadow, six a point light; never less than the scene's
    bool secondSurfaces = false;      ///< materials may come to ask for second surfaces (asksForSecondSurfaces)
};

/// From where a frame is seen.
struct FrameView {
    scene::Camera camera;
    /// [-0.5, 0.5] px, right and down: where in its pixel every sample lies. Pictures of many such views add up to a
    /// smooth one.
    glm::vec2 jitter{0};
};

/// The images that a frame leaves behind, until the next one is recorded. Blended surfaces are in `color` and
/// `radiance` alone: the others show what is behind them. All can be copied from and sampled but for `color`, which can
/// be copied and blitted; the driver records its barriers with `prepare` (renderer/vulkan/resources.hpp). All but
/// `color` are RenderSettings::samples times as wide and as high as the picture.
struct FrameImages {
    Image& color;         ///< the picture, sRGB encoded. RGBA8
    Image& radiance;      ///< linear light before exposure and tone curve. RGBA16F
    Image& irradiance;    ///< diffuse light without albedo and specular. RGBA16F
    Image& specular;      ///< radiance of specular reflections. RGBA16F
    Image& scattered;     ///< the effect's output, where there is a material. RGBA16F
    Image& transmitted;   ///< irradiance, without albedo. RGBA16F
    Image* thickness;     ///< mm; null without RenderSettings::thickness. R16F
    Image& depth;         ///< linear, scene units; the far plane where there is nothing. R32F
    Image& shadingNormal; ///< world space; w is 0 where there is nothing. RGBA16F
    Image& albedo;        ///< diffuse albedo. RGBA16F
    Image& materialId;    ///< index into Scene::materials + 1; 0 = none. R16_UINT
    Image& shadowMaps;    ///< a layer for each map: distance, 1 where nothing stands. R32F
};

/// How the effect went into the images.
struct EffectUse {
    bool scatter = false;
    bool transmit = false;
    bool scatteredHasAlbedo = false; ///< `scattered` was multiplied by the albedo
};

/// Records frames of one scene. What is recorded must be submitted to one queue in the order of recording. Recording
/// never submits, waits or allocates on the device. Throws RendererError with one sentence.
///
/// Frames have numbers below FrameLimits::framesInFlight. A number may be recorded again once the device has finished
/// what was recorded with it before; the driver's fences say when. Each number has its own copy of everything that is
/// set here, so `set…` may be called while frames are in flight, and holds from the next recording on.
class Frame {
public:
    Frame(Device& device, const scene::Scene& scene, const RenderSettings& settings, const FrameLimits& limits = {});
    ~Frame();
    Frame(Frame&&) noexcept;

    /// Refuses settings that the frame is not prepared for.
    void setEffect(const EffectSettings& settings);
    /// Replaces the scene's subsurface materials (same count). Afterwards the frame may have to be prepared: where they
    /// ask for second surfaces, or change what thesisBakedKernel compiles in.
    void setMaterials(const std::vector<Material>& materials);
    /// Replaces the scene's surfaces (same count), which keep their textures, alphaMode and doubleSided.
    void setSurfaces(std::span<const scene::Surface> surfaces);
    /// Replaces the scene's lights, within FrameLimits.
    void setLights(std::span<const scene::Light> lights);
    /// Scene::exposure.
    void setExposure(float exposure);
    /// Environment::intensity and Environment::rotation.
    void setEnvironment(float intensity, float rotation);

    /// Whether frames can be recorded with these settings and the materials as they are.
    bool isPrepared(const EffectSettings& settings) const;
    /// Compiles and allocates what is missing for that. The device must have finished with all frames.
    void prepare(const EffectSettings& settings);
    /// Makes everything anew that depends on the picture's size. The device must have finished with all frames. On
    /// failure the old size stays.
    void resize(std::uint32_t width, std::uint32_t height);

    /// In a developer build (CMake option NACRE_DEVELOPER): compiles the shaders that have changed and makes all
    /// pipelines anew, but for the environment's, which were used once. The device must have finished with all frames,
    /// which have to be prepared again where thesisBakedKernel is set. Throws RendererError with the compiler's message
    /// and keeps the pipelines; in other builds it always throws.
    void reloadShaders();

    /// Records frame `frame`. On failure the command buffer must be thrown away.
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const FrameView& view,
                Timing timing = Timing::Passes);
    /// Records the effect (and copy) again on the images of frame `frame`, which was recorded last, see
    /// Offscreen::renderEffect.
    void recordEffect(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, std::uint32_t repetitions = 0);
    /// Says that the last recording will not be submitted.
    void discard();

    const RenderSettings& settings() const;
    FrameImages images();
    /// How the effect went into the images of frame `frame`, when it was recorded last.
    const EffectUse& effectUse(std::uint32_t frame) const;
    /// What frame `frame` did when it was recorded last; nothing here waits. Times and coverage are right once the
    /// device has finished it; before, `passes` is empty.
    FrameReport report(std::uint32_t frame) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace nacre::renderer
