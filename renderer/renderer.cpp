#include "renderer/renderer.hpp"

#include "renderer/compose.hpp"
#include "renderer/readback.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::renderer {
namespace {

constexpr std::uint32_t framesInFlight = 1;
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

} // namespace

/// Members are in the order in which they need each other.
struct Renderer::Implementation {
    Implementation(Gpu& device, const scene::Scene& scene, const RenderSettings& renderSettings);

    /// Records one frame; the command buffer's previous use of `frameIndex` must have finished.
    void record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frameIndex, const View& view);
    void render(const scene::Camera& camera);
    void fillReport();

    Gpu& gpu;
    RenderSettings settings;
    vk::Extent2D extent;
    float metersPerUnit;
    float exposure;
    std::size_t materialCount;
    scene::Bounds sceneBounds;
    LightSet lights;
    vk::raii::Sampler nearest;
    GpuScene scene;
    ShadowMaps shadowMaps;
    Environment environment;
    GBuffer gbuffer;
    AmbientOcclusion occlusion;
    Lighting lighting;
    Subsurface subsurface;
    Compose compose;
    FrameTimer timer;
    FrameReport report;
    bool rendered = false;
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
      scene(gpu, input),
      shadowMaps(gpu, scene, lights.shadowLayers, settings.shadowMapSize),
      environment(gpu, input.environment),
      gbuffer(gpu, scene, extent, gbufferUsage()),
      occlusion(gpu, gbuffer, nearest),
      lighting(gpu, {gbuffer, occlusion, shadowMaps, environment, nearest}, lightConstants(lights, metersPerUnit),
               effectUsage(NACRE_IMAGE_IRRADIANCE)),
      subsurface(gpu, {extent, framesInFlight, metersPerUnit}, input.materials, lights.lights),
      compose(gpu, {gbuffer, lighting, subsurface, environment, nearest}, {settings.width, settings.height}),
      timer(gpu) {
    report.triangles = scene::triangleCount(input);
    report.lights = static_cast<std::uint32_t>(lights.lights.size());
    report.materials = static_cast<std::uint32_t>(materialCount);
}

void Renderer::Implementation::record(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frameIndex,
                                      const View& view) {
    const auto pass = [&](const char* name, const auto& recorder) {
        const Label label(gpu, commandBuffer, name);
        recorder();
        timer.endPass(commandBuffer, name);
    };
    const Compose::Settings look{settings.scatter, settings.transmit, exposure, settings.samples, settings.dither};
    const Subsurface::Frame frame{frameIndex, view, gbuffer, timer};
    subsurface.beginFrame(frameIndex);
    timer.begin(commandBuffer);
    pass("shadow maps", [&] { shadowMaps.record(commandBuffer, scene); });
    pass("G-buffer", [&] { gbuffer.record(commandBuffer, scene, view); });
    pass("ambient occlusion", [&] { occlusion.record(commandBuffer, occlusionRadius * sceneBounds.radius()); });
    pass("lighting", [&] { lighting.record(commandBuffer); });
    if (settings.transmit) {
        const Label label(gpu, commandBuffer, "transmit");
        subsurface.transmit(commandBuffer, frame, shadowMaps.image());
    }
    if (settings.scatter) {
        const Label label(gpu, commandBuffer, "scatter");
        subsurface.scatter(commandBuffer, frame, lighting.irradiance(), settings.technique);
    }
    pass("compose", [&] { compose.recordRadiance(commandBuffer, look); });
    pass("tone map", [&] { compose.recordColor(commandBuffer, look); });
}

void Renderer::Implementation::render(const scene::Camera& camera) {
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    const View view = makeView(camera, aspect, sceneBounds);
    rendered = false;
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) { record(commandBuffer, 0, view); });
    rendered = true;
    fillReport();
}

void Renderer::Implementation::fillReport() {
    timer.read(report);
    const NacreCost scatterCost = subsurface.scatterCost(settings.technique);
    const NacreCost transmitCost = subsurface.transmitCost();
    report.scatterDispatches = settings.scatter ? scatterCost.dispatchCount : 0;
    report.transmitDispatches = settings.transmit ? transmitCost.dispatchCount : 0;
    report.effectBytes = scatterCost.intermediateBytes + transmitCost.intermediateBytes;
    report.subsurfaceCoverage = static_cast<double>(lighting.subsurfacePixels()) /
                                (static_cast<double>(extent.width) * static_cast<double>(extent.height));
}

Renderer::Renderer(Device& device, const scene::Scene& scene, const RenderSettings& settings) {
    guard([&] { implementation_ = std::make_unique<Implementation>(device.implementation(), scene, settings); });
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

void Renderer::render(const scene::Camera& camera) {
    guard([&] { implementation_->render(camera); });
}

Pixels Renderer::read(Output output) const {
    Implementation& self = *implementation_;
    if (!self.rendered) {
        throw RendererError("there is no picture to read before one has been rendered");
    }
    Pixels pixels;
    guard([&] {
        pixels = readOutput(self.gpu, output,
                            {self.gbuffer, self.lighting, self.subsurface, self.compose, self.settings.scatter,
                             self.settings.transmit});
    });
    return pixels;
}

const FrameReport& Renderer::report() const {
    return implementation_->report;
}

void Renderer::setEffect(Technique technique, bool scatter, bool transmit) {
    RenderSettings& settings = implementation_->settings;
    settings.technique = technique;
    settings.scatter = scatter;
    settings.transmit = transmit;
}

void Renderer::setMaterials(const std::vector<Material>& materials) {
    if (materials.size() != implementation_->materialCount) {
        throw RendererError("the scene has " + std::to_string(implementation_->materialCount) +
                            " materials and cannot get " + std::to_string(materials.size()));
    }
    guard([&] { implementation_->subsurface.setMaterials(materials); });
}

} // namespace nacre::renderer
