#include "renderer/frame.hpp"

#include "renderer/light_placement.hpp"
#include "renderer/picture_passes.hpp"
#include "renderer/vulkan/debug_label.hpp"
#include "renderer/vulkan/memory_meter.hpp"
#include "renderer/vulkan/reloadable_pipeline.hpp"
#include "renderer/vulkan/translate_errors.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace nacre::renderer {
namespace {

constexpr std::uint32_t maxFramesInFlight = 8; // as NacreContextInfo::framesInFlight
constexpr const char* copyPass = "copy";
constexpr const char* repeatedEffect = "effects"; // what recordEffect repeats; not in the report
constexpr const char* repeatedCopy = "copies";
/// How far things occlude ambient light, as a share of the scene's radius.
constexpr float occlusionRadius = 0.08f;

vk::raii::Sampler makeNearestSampler(const Gpu& gpu) {
    constexpr auto edge = vk::SamplerAddressMode::eClampToEdge;
    return {gpu.device, {.addressModeU = edge, .addressModeV = edge, .addressModeW = edge}};
}

float checkedMetersPerUnit(const scene::Scene& scene) {
    if (!std::isfinite(scene.metersPerUnit) || scene.metersPerUnit <= 0) {
        throw RendererError("the scene's metersPerUnit is " + std::to_string(scene.metersPerUnit) +
                            ", and must be above 0");
    }
    return static_cast<float>(scene.metersPerUnit);
}

RenderSettings checked(const Gpu& gpu, const RenderSettings& settings) {
    checkedExtent(gpu, settings);
    return settings;
}

/// The limits, with room for the scene's own lights, which then hold for the placement, too.
FrameLimits checked(FrameLimits limits, LightPlacement& placement) {
    if (limits.framesInFlight == 0 || limits.framesInFlight > maxFramesInFlight) {
        throw RendererError("framesInFlight is " + std::to_string(limits.framesInFlight) +
                            ", and must lie between 1 and " + std::to_string(maxFramesInFlight));
    }
    const LightSet& lights = placement.placed();
    limits.lights = std::max(limits.lights, static_cast<std::uint32_t>(lights.lights.size()));
    limits.shadowLayers = std::max(limits.shadowLayers, static_cast<std::uint32_t>(lights.shadowLayers.size()));
    placement.limit(limits.lights, limits.shadowLayers);
    return limits;
}

/// Turns "copies" and "effects" into the report's times of one.
void sumRepetitions(FrameReport& report, std::uint32_t repetitions) {
    std::erase_if(report.passes, [&](const PassTime& pass) {
        const bool isRepeated = pass.name == repeatedEffect || pass.name == repeatedCopy;
        const bool isCopy = pass.name == repeatedCopy || pass.name == copyPass;
        if (isRepeated || repetitions == 0) {
            (isCopy ? report.copyMicroseconds : report.effectMicroseconds) +=
                pass.microseconds / std::max(repetitions, 1u);
        }
        return isRepeated;
    });
}

} // namespace

/// Members are in the order in which they need each other.
struct Frame::Implementation {
    /// What a frame number was used for last.
    struct Recorded {
        View view;
        EffectUse use;
        std::optional<std::uint32_t> repetitions; ///< of recordEffect
        FrameReport counts;                       ///< what is known without the device
    };

    Implementation(Gpu& device, const scene::Scene& scene, const RenderSettings& renderSettings,
                   const FrameLimits& frameLimits);

    std::unique_ptr<PicturePasses> makePicture(const RenderSettings& of);
    View viewOf(const FrameView& view) const;
    void beginFrame(std::uint32_t frame);
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const FrameView& frameView,
                Timing timing);
    void recordEffect(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, std::uint32_t repetitions);
    void recordEffectOnce(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const View& view);
    void recordCopy(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame);
    template <typename Recorder>
    void recordPass(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const char* name,
                    const Recorder& recorder);
    /// Runs `recorder` and takes back what it says of images if it fails; returns the processor time in microseconds.
    template <typename Recorder> double timed(const Recorder& recorder);
    void discard();
    Recorded recordedNow(const View& view, double microseconds) const;
    Compose::Settings look() const;
    FrameReport count() const;
    FrameReport report(std::uint32_t frame) const;

    Gpu& gpu;
    RenderSettings settings;
    float metersPerUnit;
    float exposure;
    std::size_t materialCount;
    std::uint64_t triangles;
    scene::Bounds sceneBounds;
    LightPlacement placement;
    FrameLimits limits;
    vk::raii::Sampler nearest;
    std::vector<MemoryUse> memory;
    GpuScene scene;
    ShadowMaps shadowMaps;
    Environment environment;
    std::unique_ptr<PicturePasses> picture;
    Subsurface subsurface;
    std::vector<FrameTimer> timers;                ///< one a frame number
    std::vector<std::optional<Recorded>> recorded; ///< likewise
    std::uint32_t lastBegun = 0;
};

Frame::Implementation::Implementation(Gpu& device, const scene::Scene& input, const RenderSettings& renderSettings,
                                      const FrameLimits& frameLimits)
    : gpu(device),
      settings(checked(gpu, renderSettings)),
      metersPerUnit(checkedMetersPerUnit(input)),
      exposure(input.exposure),
      materialCount(input.materials.size()),
      triangles(scene::triangleCount(input)),
      sceneBounds(scene::bounds(input)),
      placement(input, settings.shadowMapSize),
      limits(checked(frameLimits, placement)),
      nearest(makeNearestSampler(gpu)),
      scene(metered(gpu, memory, "geometry and textures", [&] { return GpuScene(gpu, input, limits.framesInFlight); })),
      shadowMaps(metered(
          gpu, memory, "shadow maps",
          [&] { return ShadowMaps(gpu, scene, limits.shadowLayers, settings.shadowMapSize, limits.framesInFlight); })),
      environment(metered(gpu, memory, "environment",
                          [&] { return Environment(gpu, input.environment, limits.framesInFlight); })),
      picture(makePicture(settings)),
      subsurface(gpu,
                 {picture->extent, limits.framesInFlight, 1 + settings.effectRepetitions, limits.lights, metersPerUnit,
                  settings.technique, limits.secondSurfaces},
                 input.materials),
      recorded(limits.framesInFlight) {
    subsurface.prepare(settings);
    for (std::uint32_t frame = 0; frame < limits.framesInFlight; ++frame) {
        timers.emplace_back(gpu);
    }
}

std::unique_ptr<PicturePasses> Frame::Implementation::makePicture(const RenderSettings& of) {
    return std::make_unique<PicturePasses>(gpu, PicturePasses::Inputs{scene, shadowMaps, environment, nearest}, of,
                                           PicturePasses::Limits{materialCount, limits.lights, limits.framesInFlight});
}

View Frame::Implementation::viewOf(const FrameView& view) const {
    const auto width = static_cast<float>(picture->extent.width);
    const auto height = static_cast<float>(picture->extent.height);
    scene::Camera camera = view.camera;
    // The picture moves the other way; offCenter counts half pictures, right and up.
    camera.offCenter += glm::vec2(-2 * view.jitter.x / width, 2 * view.jitter.y / height);
    return makeView(camera, static_cast<float>(settings.width) / static_cast<float>(settings.height), sceneBounds);
}

template <typename Recorder>
void Frame::Implementation::recordPass(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                                       const char* name, const Recorder& recorder) {
    const Label label(gpu, commandBuffer, name);
    recorder();
    timers[frame].endPass(commandBuffer, name);
}

template <typename Recorder> double Frame::Implementation::timed(const Recorder& recorder) {
    const auto begin = std::chrono::steady_clock::now();
    try {
        recorder();
    } catch (...) {
        discard();
        throw;
    }
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

void Frame::Implementation::discard() {
    const auto forget = [](Image& image) { image.forget(); };
    shadowMaps.forEachImage(forget);
    shadowMaps.invalidate();
    picture->forEachImage(forget);
    recorded[lastBegun].reset();
}

void Frame::Implementation::beginFrame(std::uint32_t frame) {
    if (frame >= limits.framesInFlight) {
        throw RendererError("there is no frame " + std::to_string(frame) + ", framesInFlight is " +
                            std::to_string(limits.framesInFlight));
    }
    if (!subsurface.isPrepared(settings)) {
        throw RendererError("the frame is not prepared for its effect settings and materials");
    }
    recorded[frame].reset();
    lastBegun = frame;
    subsurface.beginFrame(frame);
}

Frame::Implementation::Recorded Frame::Implementation::recordedNow(const View& view, double microseconds) const {
    Recorded result{.view = view,
                    .use = {settings.scatter, settings.transmit, subsurface.scatteredHasAlbedo()},
                    .repetitions = {},
                    .counts = count()};
    result.counts.recordingMicroseconds = microseconds;
    return result;
}

Compose::Settings Frame::Implementation::look() const {
    return {.transmissions = subsurface.transmissions(),
            .scatter = settings.scatter,
            .scatteredHasAlbedo = subsurface.scatteredHasAlbedo(),
            .transmit = settings.transmit,
            .hasThickness = scene.hasThickness(),
            .hasScale = scene.hasScale(),
            .hasTransmissionColors = scene.hasTextures(&scene::Surface::transmissionColorTexture),
            .hasBlended = scene.hasBlended(),
            .exposure = exposure,
            .samples = settings.samples,
            .dither = settings.dither};
}

void Frame::Implementation::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                                   const FrameView& frameView, Timing timing) {
    const View view = viewOf(frameView);
    beginFrame(frame);
    FrameTimer& timer = timers[frame];
    std::uint32_t shadowLayers = 0;
    const auto pass = [&](const char* name, const auto& recorder) { recordPass(commandBuffer, frame, name, recorder); };
    const LightSet& lights = placement.placed();
    const double microseconds = timed([&] {
        scene.beginFrame(frame);
        environment.beginFrame(frame);
        if (settings.shadowMapsEveryFrame) {
            shadowMaps.invalidate();
        }
        timer.begin(commandBuffer, timing);
        pass("shadow maps",
             [&] { shadowLayers = shadowMaps.record(commandBuffer, frame, scene, lights.shadowLayers); });
        pass("G-buffer", [&] { picture->gbuffer.record(commandBuffer, frame, scene, view); });
        pass("ambient occlusion",
             [&] { picture->occlusion.record(commandBuffer, frame, occlusionRadius * sceneBounds.radius()); });
        pass("lighting", [&] { picture->lighting.record(commandBuffer, frame, lights.constants, subsurface.lobes()); });
        recordEffectOnce(commandBuffer, frame, view);
        if (scene.hasBlended()) {
            pass("blended surfaces", [&] {
                picture->blended.record(commandBuffer, frame, scene, static_cast<std::uint32_t>(lights.lights.size()));
            });
        }
        pass("compose", [&] { picture->compose.recordRadiance(commandBuffer, frame, look()); });
        pass("tone map", [&] { picture->compose.recordColor(commandBuffer, frame, look()); });
        timer.end(commandBuffer);
        if (timing == Timing::Passes) {
            recordCopy(commandBuffer, frame);
        }
    });
    recorded[frame] = recordedNow(view, microseconds);
    recorded[frame]->counts.shadowLayersDrawn = shadowLayers;
}

void Frame::Implementation::recordEffectOnce(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                                             const View& view) {
    subsurface.record(commandBuffer,
                      {view, placement.placed().lights, picture->gbuffer, picture->lighting.irradiance(),
                       shadowMaps.image(), picture->subsurface, timers[frame], scene.hasScale(), scene.hasStrength(),
                       scene.hasTextures(&scene::Surface::transmissionTexture)},
                      settings);
}

void Frame::Implementation::recordCopy(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame) {
    if (picture->copyFloor) {
        recordPass(commandBuffer, frame, copyPass, [&] { picture->copyFloor->record(commandBuffer); });
    }
}

void Frame::Implementation::recordEffect(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame,
                                         std::uint32_t repetitions) {
    if (frame >= recorded.size() || !recorded[frame]) {
        throw RendererError("the effect cannot be done again before a frame has been rendered");
    }
    if (repetitions > settings.effectRepetitions) {
        throw RendererError("the effect cannot be repeated " + std::to_string(repetitions) +
                            " times, RenderSettings::effectRepetitions is " +
                            std::to_string(settings.effectRepetitions));
    }
    const View view = recorded[frame]->view;
    beginFrame(frame);
    FrameTimer& timer = timers[frame];
    const auto repeat = [&](const char* name, const auto& recorder) {
        timer.span(commandBuffer, name, [&] {
            for (std::uint32_t i = 0; i < repetitions; ++i) {
                recorder();
            }
        });
    };
    const double microseconds = timed([&] {
        timer.begin(commandBuffer, Timing::Passes);
        recordEffectOnce(commandBuffer, frame, view);
        recordCopy(commandBuffer, frame);
        if (repetitions > 0) {
            repeat(repeatedEffect, [&] { recordEffectOnce(commandBuffer, frame, view); });
            repeat(repeatedCopy, [&] { recordCopy(commandBuffer, frame); });
        }
    });
    recorded[frame] = recordedNow(view, microseconds);
    recorded[frame]->repetitions = repetitions;
}

FrameReport Frame::Implementation::count() const {
    FrameReport result;
    const NacreCost scatterCost = subsurface.scatterCost(settings.technique);
    const NacreCost transmitCost = subsurface.transmitCost();
    result.scatterDispatches = settings.scatter ? scatterCost.dispatchCount : 0;
    result.transmitDispatches = settings.transmit ? transmitCost.dispatchCount : 0;
    result.effectBytes = scatterCost.intermediateBytes + transmitCost.intermediateBytes;
    result.memory = memory;
    result.memory.insert(result.memory.end(), picture->memory.begin(), picture->memory.end());
    result.memory.push_back({"scatter: intermediates", scatterCost.intermediateBytes});
    result.memory.push_back({"scatter: materials", scatterCost.materialBytes * materialCount});
    result.memory.push_back({"transmit: intermediates", transmitCost.intermediateBytes});
    result.memory.push_back({"transmit: materials", transmitCost.materialBytes * materialCount});
    result.copyBytes = picture->copyFloor ? picture->copyFloor->bytes() : 0;
    result.triangles = triangles;
    result.lights = static_cast<std::uint32_t>(placement.placed().lights.size());
    result.materials = static_cast<std::uint32_t>(materialCount);
    return result;
}

FrameReport Frame::Implementation::report(std::uint32_t frame) const {
    if (frame >= recorded.size() || !recorded[frame]) {
        return {};
    }
    FrameReport result = recorded[frame]->counts;
    timers[frame].read(result);
    if (recorded[frame]->repetitions) {
        sumRepetitions(result, *recorded[frame]->repetitions);
    }
    result.subsurfaceCoverage =
        static_cast<double>(picture->lighting.subsurfacePixels(frame)) /
        (static_cast<double>(picture->extent.width) * static_cast<double>(picture->extent.height));
    return result;
}

Frame::Frame(Device& device, const scene::Scene& scene, const RenderSettings& settings, const FrameLimits& limits) {
    translateErrors(
        [&] { implementation_ = std::make_unique<Implementation>(device.implementation(), scene, settings, limits); });
}

Frame::~Frame() = default;
Frame::Frame(Frame&&) noexcept = default;

void Frame::setEffect(const EffectSettings& settings) {
    if (!isPrepared(settings)) {
        throw RendererError("the frame is not prepared for these effect settings");
    }
    static_cast<EffectSettings&>(implementation_->settings) = settings;
}

void Frame::setMaterials(const std::vector<Material>& materials) {
    if (materials.size() != implementation_->materialCount) {
        throw RendererError("the scene has " + std::to_string(implementation_->materialCount) +
                            " materials and cannot get " + std::to_string(materials.size()));
    }
    implementation_->subsurface.setMaterials(materials);
}

void Frame::setSurfaces(std::span<const scene::Surface> surfaces) {
    implementation_->scene.setSurfaces(surfaces);
}

void Frame::setLights(std::span<const scene::Light> lights) {
    implementation_->placement.place(lights);
}

void Frame::setExposure(float exposure) {
    implementation_->exposure = exposure;
}

void Frame::setEnvironment(float intensity, float rotation) {
    implementation_->environment.setLook(intensity, rotation);
}

bool Frame::isPrepared(const EffectSettings& settings) const {
    return implementation_->subsurface.isPrepared(settings);
}

void Frame::prepare(const EffectSettings& settings) {
    translateErrors([&] { implementation_->subsurface.prepare(settings); });
}

void Frame::reloadShaders() {
    translateErrors([&] {
        if (!shadersMayChange()) {
            throw RendererError("shaders are part of this program; build with the preset developer to reload them");
        }
        implementation_->subsurface.reloadShaders();
        reloadPipelines(implementation_->gpu);
    });
}

void Frame::resize(std::uint32_t width, std::uint32_t height) {
    Implementation& self = *implementation_;
    RenderSettings settings = self.settings;
    settings.width = width;
    settings.height = height;
    translateErrors([&] {
        std::unique_ptr<PicturePasses> picture = self.makePicture(settings);
        self.subsurface.resize(picture->extent);
        self.picture = std::move(picture);
        self.settings = settings;
        self.recorded.assign(self.recorded.size(), std::nullopt);
    });
}

void Frame::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, const FrameView& view,
                   Timing timing) {
    translateErrors([&] { implementation_->record(commandBuffer, frame, view, timing); });
}

void Frame::recordEffect(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, std::uint32_t repetitions) {
    translateErrors([&] { implementation_->recordEffect(commandBuffer, frame, repetitions); });
}

void Frame::discard() {
    implementation_->discard();
}

const RenderSettings& Frame::settings() const {
    return implementation_->settings;
}

FrameImages Frame::images() {
    PicturePasses& picture = *implementation_->picture;
    GBuffer& gbuffer = picture.gbuffer;
    std::optional<Image>& thickness = picture.subsurface.thickness;
    return {.color = picture.compose.color(),
            .radiance = picture.compose.radiance(),
            .irradiance = picture.lighting.irradiance(),
            .specular = picture.lighting.specular(),
            .scattered = picture.subsurface.scattered,
            .transmitted = picture.subsurface.transmitted,
            .thickness = thickness ? &*thickness : nullptr,
            .depth = gbuffer.image(GBuffer::Depth),
            .shadingNormal = gbuffer.image(GBuffer::ShadingNormal),
            .albedo = gbuffer.image(GBuffer::Albedo),
            .materialId = gbuffer.image(GBuffer::MaterialId),
            .shadowMaps = implementation_->shadowMaps.image()};
}

const EffectUse& Frame::effectUse(std::uint32_t frame) const {
    const auto& recorded = implementation_->recorded;
    if (frame >= recorded.size() || !recorded[frame]) {
        throw RendererError("there is no picture to read before one has been rendered");
    }
    return recorded[frame]->use;
}

FrameReport Frame::report(std::uint32_t frame) const {
    return translateErrors([&] { return implementation_->report(frame); });
}

} // namespace nacre::renderer
