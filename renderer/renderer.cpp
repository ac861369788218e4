#include "renderer/renderer.hpp"

#include "renderer/passes/compose.hpp"
#include "renderer/passes/copy_floor.hpp"
#include "renderer/readback.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>

namespace nacre::renderer {
namespace {

constexpr std::uint32_t framesInFlight = 1;
constexpr const char* copyPass = "copy";
constexpr const char* repeatedEffect = "effects"; // what renderEffect repeats; not in the report
constexpr const char* repeatedCopy = "copies";
/// Largest supersampling per axis.
constexpr std::uint32_t maxSamples = 4;
/// How far things occlude ambient light, as a share of the scene's radius.
constexpr float occlusionRadius = 0.08f;

vk::Extent2D checkedExtent(const Gpu& gpu, const RenderSettings& settings) {
    const std::string size = std::to_string(settings.width) + "x" + std::to_string(settings.height);
    if (settings.width == 0 || settings.height == 0) {
        throw RendererError("a picture of " + size + " pixels has nothing in it; both sides must be at least 1");
    }
    if (settings.samples == 0 || settings.samples > maxSamples) {
        throw RendererError("samples is " + std::to_string(settings.samples) + ", and must lie between 1 and " +
                            std::to_string(maxSamples));
    }
    const std::uint32_t largest = gpu.limits.maxImageDimension2D;
    if (settings.width > largest / settings.samples || settings.height > largest / settings.samples) {
        throw RendererError("a picture of " + size + " pixels with " + std::to_string(settings.samples) +
                            " samples per axis is larger than the Vulkan device's limit of " + std::to_string(largest) +
                            "x" + std::to_string(largest));
    }
    return {settings.width * settings.samples, settings.height * settings.samples};
}

vk::raii::Sampler makeNearestSampler(const Gpu& gpu) {
    constexpr auto edge = vk::SamplerAddressMode::eClampToEdge;
    return {gpu.device, {.addressModeU = edge, .addressModeV = edge, .addressModeW = edge}};
}

std::array<vk::ImageUsageFlags, GBuffer::AttachmentCount> gbufferUsage() {
    std::array<vk::ImageUsageFlags, GBuffer::AttachmentCount> result{};
    result[GBuffer::Depth] = effectUsage(NACRE_IMAGE_DEPTH);
    result[GBuffer::VertexNormal] = effectUsage(NACRE_IMAGE_NORMAL);
    result[GBuffer::Albedo] = effectUsage(NACRE_IMAGE_ALBEDO);
    result[GBuffer::MaterialId] = effectUsage(NACRE_IMAGE_MATERIAL_ID);
    result[GBuffer::Thickness] = effectUsage(NACRE_IMAGE_THICKNESS);
    return result;
}

std::vector<shared::LightConstants> lightConstants(const LightSet& lights, float metersPerUnit) {
    std::vector<shared::LightConstants> result;
    std::transform(lights.lights.begin(), lights.lights.end(), std::back_inserter(result),
                   [&](const PlacedLight& light) { return makeConstants(light, metersPerUnit); });
    return result;
}

float checkedMetersPerUnit(const scene::Scene& scene) {
    if (!std::isfinite(scene.metersPerUnit) || scene.metersPerUnit <= 0) {
        throw RendererError("the scene's metersPerUnit is " + std::to_string(scene.metersPerUnit) +
                            ", and must be above 0");
    }
    return static_cast<float>(scene.metersPerUnit);
}

std::uint64_t allocatedBytes(const Gpu& gpu) {
    return std::accumulate(gpu.allocatedBytes.begin(), gpu.allocatedBytes.end(), std::uint64_t{0});
}

/// Notes what is allocated during its life.
class MemoryMeter {
public:
    MemoryMeter(const Gpu& gpu, std::vector<MemoryUse>& memory, const char* name)
        : gpu_(gpu), memory_(memory), name_(name), before_(allocatedBytes(gpu)) {}
    ~MemoryMeter() { memory_.push_back({name_, allocatedBytes(gpu_) - before_}); }
    MemoryMeter(const MemoryMeter&) = delete;
    MemoryMeter& operator=(const MemoryMeter&) = delete;

private:
    const Gpu& gpu_;
    std::vector<MemoryUse>& memory_;
    const char* name_;
    std::uint64_t before_;
};

} // namespace

/// Members are in the order in which they need each other.
struct Renderer::Implementation {
    Implementation(Gpu& device, const scene::Scene& scene, const RenderSettings& renderSettings);

    /// Records one frame; the command buffer's previous use of `frameIndex` must have finished.
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frameIndex, const View& view,
                Timing timing);
    void recordEffect(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frameIndex, const View& view);
    void recordCopy(const vk::raii::CommandBuffer& commandBuffer);
    template <typename Recorder>
    void recordPass(const vk::raii::CommandBuffer& commandBuffer, const char* name, const Recorder& recorder);
    void render(const scene::Camera& camera, Timing timing);
    void renderEffect(std::uint32_t repetitions);
    void sumRepetitions(std::uint32_t repetitions);
    template <typename Recorder> void submit(const Recorder& recorder);
    void fillReport();
    /// Makes a part of the renderer and notes what memory it takes.
    template <typename Make> auto part(const char* name, const Make& make) {
        const MemoryMeter meter(gpu, memory, name);
        return make();
    }

    Gpu& gpu;
    RenderSettings settings;
    vk::Extent2D extent;
    float metersPerUnit;
    float exposure;
    std::size_t materialCount;
    scene::Bounds sceneBounds;
    LightSet lights;
    vk::raii::Sampler nearest;
    std::vector<MemoryUse> memory;
    GpuScene scene;
    ShadowMaps shadowMaps;
    Environment environment;
    GBuffer gbuffer;
    AmbientOcclusion occlusion;
    Lighting lighting;
    Subsurface subsurface;
    Compose compose;
    std::optional<CopyFloor> copyFloor;
    FrameTimer timer;
    FrameReport report;
    std::optional<View> rendered; ///< the last frame's view; empty while there is no whole frame
};

Renderer::Implementation::Implementation(Gpu& device, const scene::Scene& input, const RenderSettings& renderSettings)
    : gpu(device),
      settings(renderSettings),
      extent(checkedExtent(gpu, settings)),
      metersPerUnit(checkedMetersPerUnit(input)),
      exposure(input.exposure),
      materialCount(input.materials.size()),
      sceneBounds(scene::bounds(input)),
      lights(placeLights(input, settings.shadowMapSize)),
      nearest(makeNearestSampler(gpu)),
      scene(part("geometry and textures", [&] { return GpuScene(gpu, input); })),
      shadowMaps(
          part("shadow maps", [&] { return ShadowMaps(gpu, scene, lights.shadowLayers, settings.shadowMapSize); })),
      environment(part("environment", [&] { return Environment(gpu, input.environment); })),
      gbuffer(part("G-buffer", [&] { return GBuffer(gpu, scene, extent, gbufferUsage()); })),
      occlusion(part("ambient occlusion", [&] { return AmbientOcclusion(gpu, gbuffer, nearest); })),
      lighting(part("lighting",
                    [&] {
                        return Lighting(gpu, {gbuffer, occlusion, shadowMaps, environment, nearest},
                                        lightConstants(lights, metersPerUnit), effectUsage(NACRE_IMAGE_IRRADIANCE));
                    })),
      subsurface(part("effect: outputs",
                      [&] {
                          return Subsurface(gpu,
                                            {extent, framesInFlight, 1 + settings.effectRepetitions, metersPerUnit,
                                             settings.thickness, settings.technique},
                                            input.materials, lights.lights);
                      })),
      compose(part("compose and tone map",
                   [&] {
                       return Compose(gpu, {gbuffer, occlusion, lighting, subsurface, environment, nearest},
                                      {settings.width, settings.height});
                   })),
      timer(gpu) {
    subsurface.prepareSettings(gpu, settings);
    if (settings.copyFloor) {
        copyFloor.emplace(
            gpu,
            CopyFloor::Inputs{lighting.irradiance(), gbuffer.image(GBuffer::Depth), gbuffer.image(GBuffer::MaterialId)},
            nearest);
        report.copyBytes = copyFloor->bytes();
    }
    report.triangles = scene::triangleCount(input);
    report.lights = static_cast<std::uint32_t>(lights.lights.size());
    report.materials = static_cast<std::uint32_t>(materialCount);
}

template <typename Recorder>
void Renderer::Implementation::recordPass(const vk::raii::CommandBuffer& commandBuffer, const char* name,
                                          const Recorder& recorder) {
    const Label label(gpu, commandBuffer, name);
    recorder();
    timer.endPass(commandBuffer, name);
}

void Renderer::Implementation::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frameIndex,
                                      const View& view, Timing timing) {
    const auto pass = [&](const char* name, const auto& recorder) { recordPass(commandBuffer, name, recorder); };
    subsurface.beginFrame(frameIndex);
    timer.begin(commandBuffer, timing);
    pass("shadow maps", [&] { shadowMaps.record(commandBuffer, scene); });
    pass("G-buffer", [&] { gbuffer.record(commandBuffer, scene, view); });
    pass("ambient occlusion", [&] { occlusion.record(commandBuffer, occlusionRadius * sceneBounds.radius()); });
    pass("lighting", [&] { lighting.record(commandBuffer); });
    recordEffect(commandBuffer, frameIndex, view);
    const Compose::Settings look{.scatter = settings.scatter,
                                 .scatteredHasAlbedo = subsurface.scatteredHasAlbedo(),
                                 .transmit = settings.transmit,
                                 .exposure = exposure,
                                 .samples = settings.samples,
                                 .dither = settings.dither};
    pass("compose", [&] { compose.recordRadiance(commandBuffer, look); });
    pass("tone map", [&] { compose.recordColor(commandBuffer, look); });
    timer.end(commandBuffer);
    if (timing == Timing::Passes) {
        recordCopy(commandBuffer);
    }
}

void Renderer::Implementation::recordEffect(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frameIndex,
                                            const View& view) {
    const Subsurface::Frame frame{frameIndex, view, gbuffer, timer};
    subsurface.prepareImages(commandBuffer, frame, lighting.irradiance(), shadowMaps.image());
    if (settings.scatter) {
        const Label label(gpu, commandBuffer, "scatter");
        subsurface.scatter(commandBuffer, frame, lighting.irradiance(), settings);
    }
    if (settings.transmit) { // waits for nothing of scatter's
        const Label label(gpu, commandBuffer, "transmit");
        subsurface.transmit(commandBuffer, frame, shadowMaps.image(), settings);
    }
}

void Renderer::Implementation::recordCopy(const vk::raii::CommandBuffer& commandBuffer) {
    if (copyFloor) {
        recordPass(commandBuffer, copyPass, [&] { copyFloor->record(commandBuffer); });
    }
}

template <typename Recorder> void Renderer::Implementation::submit(const Recorder& recorder) {
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        const auto begin = std::chrono::steady_clock::now();
        recorder(commandBuffer);
        const std::chrono::duration<double, std::micro> duration = std::chrono::steady_clock::now() - begin;
        report.recordingMicroseconds = duration.count();
    });
    fillReport();
}

void Renderer::Implementation::render(const scene::Camera& camera, Timing timing) {
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    const View view = makeView(camera, aspect, sceneBounds);
    rendered.reset();
    submit([&](const vk::raii::CommandBuffer& commandBuffer) { record(commandBuffer, 0, view, timing); });
    rendered = view;
}

void Renderer::Implementation::renderEffect(std::uint32_t repetitions) {
    if (!rendered) {
        throw RendererError("the effect cannot be done again before a frame has been rendered");
    }
    if (repetitions > settings.effectRepetitions) {
        throw RendererError("the effect cannot be repeated " + std::to_string(repetitions) +
                            " times, RenderSettings::effectRepetitions is " +
                            std::to_string(settings.effectRepetitions));
    }
    const auto repeat = [&](const vk::raii::CommandBuffer& commandBuffer, const char* name, const auto& recorder) {
        timer.span(commandBuffer, name, [&] {
            for (std::uint32_t i = 0; i < repetitions; ++i) {
                recorder();
            }
        });
    };
    submit([&](const vk::raii::CommandBuffer& commandBuffer) {
        subsurface.beginFrame(0);
        timer.begin(commandBuffer, Timing::Passes);
        recordEffect(commandBuffer, 0, *rendered);
        recordCopy(commandBuffer);
        if (repetitions > 0) {
            repeat(commandBuffer, repeatedEffect, [&] { recordEffect(commandBuffer, 0, *rendered); });
            repeat(commandBuffer, repeatedCopy, [&] { recordCopy(commandBuffer); });
        }
    });
    sumRepetitions(repetitions);
}

void Renderer::Implementation::sumRepetitions(std::uint32_t repetitions) {
    report.effectMicroseconds = report.copyMicroseconds = 0;
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

void Renderer::Implementation::fillReport() {
    timer.read(report);
    const NacreCost scatterCost = subsurface.scatterCost(settings.technique);
    const NacreCost transmitCost = subsurface.transmitCost();
    report.scatterDispatches = settings.scatter ? scatterCost.dispatchCount : 0;
    report.transmitDispatches = settings.transmit ? transmitCost.dispatchCount : 0;
    report.effectBytes = scatterCost.intermediateBytes + transmitCost.intermediateBytes;
    report.memory = memory;
    report.memory.push_back({"scatter: intermediates", scatterCost.intermediateBytes});
    report.memory.push_back({"scatter: materials", scatterCost.materialBytes * materialCount});
    report.memory.push_back({"transmit: intermediates", transmitCost.intermediateBytes});
    report.memory.push_back({"transmit: materials", transmitCost.materialBytes * materialCount});
    report.subsurfaceCoverage = static_cast<double>(lighting.subsurfacePixels()) /
                                (static_cast<double>(extent.width) * static_cast<double>(extent.height));
}

Renderer::Renderer(Device& device, const scene::Scene& scene, const RenderSettings& settings) {
    guard([&] { implementation_ = std::make_unique<Implementation>(device.implementation(), scene, settings); });
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

void Renderer::render(const scene::Camera& camera, Timing timing) {
    guard([&] { implementation_->render(camera, timing); });
}

Pixels Renderer::read(Output output) const {
    Implementation& self = *implementation_;
    if (!self.rendered) {
        throw RendererError("there is no picture to read before one has been rendered");
    }
    if (output == Output::Thickness && !self.settings.thickness) {
        throw RendererError("the thickness cannot be read, RenderSettings::thickness is false");
    }
    Pixels pixels;
    guard([&] {
        pixels = readOutput(self.gpu, output,
                            {self.gbuffer, self.lighting, self.subsurface, self.compose, self.settings.scatter,
                             self.settings.transmit});
    });
    return pixels;
}

void Renderer::renderEffect(std::uint32_t repetitions) {
    guard([&] { implementation_->renderEffect(repetitions); });
}

const FrameReport& Renderer::report() const {
    return implementation_->report;
}

void Renderer::setEffect(const EffectSettings& settings) {
    guard([&] { implementation_->subsurface.prepareSettings(implementation_->gpu, settings); });
    static_cast<EffectSettings&>(implementation_->settings) = settings;
}

void Renderer::setMaterials(const std::vector<Material>& materials) {
    if (materials.size() != implementation_->materialCount) {
        throw RendererError("the scene has " + std::to_string(implementation_->materialCount) +
                            " materials and cannot get " + std::to_string(materials.size()));
    }
    guard([&] {
        implementation_->subsurface.setMaterials(materials);
        implementation_->subsurface.prepareSettings(implementation_->gpu, implementation_->settings);
    });
}

} // namespace nacre::renderer
