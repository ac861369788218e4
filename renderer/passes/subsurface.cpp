#include "renderer/passes/subsurface.hpp"

#include "renderer/effect_arguments.hpp"
#include "renderer/vulkan/debug_label.hpp"
#include "renderer/vulkan/reloadable_pipeline.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace nacre::renderer {
namespace {

/// The materials, once each is known to be valid.
const std::vector<Material>& checked(const std::vector<Material>& materials) {
    for (const Material& material : materials) {
        if (const std::string fault = findFault(material); !fault.empty()) {
            throw RendererError("the material '" + material.name + "' is not valid: " + fault);
        }
    }
    return materials;
}

/// NacreContextInfo::techniques for this technique, and for the one that materials, which are valid, ask for in its
/// place.
std::uint32_t techniquesFor(NacreTechnique technique, const std::vector<Material>& materials) {
    const bool asks = (technique == NACRE_TECHNIQUE_DEFAULT || technique == NACRE_TECHNIQUE_BANK) &&
                      std::ranges::any_of(materials, asksForSecondSurfaces);
    return 1u << technique | (asks ? 1u << NACRE_TECHNIQUE_BANK_SURFACES : 0);
}

NacreImage asInput(const Image& image) {
    return effectImage(image, usage::computeRead);
}

/// One channel of it, which `view` shows as red.
NacreImage asFactor(const Image& image, vk::ImageView view) {
    NacreImage result = asInput(image);
    result.view = view;
    return result;
}

NacreImage asOutput(const Image& image) {
    return effectImage(image, usage::computeWrite);
}

/// What comes through slabs, over nearness: 1 at no thickness, ½ where half of the widest channel's light does, 0 far
/// away.
void setThrough(shared::TransmissionConstants& result, const Material& material) {
    const auto profile = makeProfile(material);
    const double middle = std::max(profile->quantileRadius(0.5), 1e-6);
    result.share.y = static_cast<float>(middle);
    for (unsigned step = 1; step <= shared::throughSteps; ++step) {
        const double thickness = middle * (static_cast<double>(shared::throughSteps) / step - 1);
        const auto share = [&](int channel) {
            return static_cast<float>(material.translucency * profile->slabTransmittance(channel, thickness));
        };
        result.through[step] = {share(0), share(1), share(2), 0};
    }
}

shared::TransmissionConstants makeTransmission(const Material& material) {
    shared::TransmissionConstants result{};
    if (const auto& color = material.diffuseTransmissionColor) {
        result.color = glm::vec4((*color)[0], (*color)[1], (*color)[2], 1);
    }
    result.share.x = static_cast<float>(material.diffuseTransmission);
    setThrough(result, material);
    return result;
}

shared::LobeConstants makeLobe(const Material& material) {
    return {glm::vec4(material.secondLobe, material.secondLobeRoughness, 0, 0)};
}

Image makeOutput(Gpu& gpu, const char* name, vk::Format format, vk::Extent2D extent, NacreImageSlot slot) {
    using Kind = vk::ImageUsageFlagBits;
    return {gpu, ImageInfo{.name = name,
                           .format = format,
                           .extent = extent,
                           .usage = Kind::eStorage | Kind::eSampled | Kind::eTransferSrc | effectUsage(slot)}};
}

void keepMessage(NacreSeverity severity, const char* message, void* userData) {
    if (severity == NACRE_SEVERITY_ERROR) {
        *static_cast<std::string*>(userData) = message;
    }
}

} // namespace

vk::ImageUsageFlags effectUsage(NacreImageSlot slot) {
    NacreImageRequirements requirements{};
    if (nacreGetImageRequirements(slot, &requirements) != NACRE_SUCCESS) {
        throw RendererError("the effect library does not say what it needs of its images");
    }
    return static_cast<vk::ImageUsageFlags>(requirements.usage);
}

SubsurfaceImages::SubsurfaceImages(Gpu& gpu, vk::Extent2D extent, bool withThickness) {
    constexpr vk::Format color = vk::Format::eR16G16B16A16Sfloat;
    scattered = makeOutput(gpu, "scattered", color, extent, NACRE_IMAGE_SCATTERED);
    transmitted = makeOutput(gpu, "transmitted", color, extent, NACRE_IMAGE_TRANSMITTED);
    if (withThickness) {
        thickness = makeOutput(gpu, "thickness", vk::Format::eR16Sfloat, extent, NACRE_IMAGE_THICKNESS_OUT);
    }
}

Subsurface::Subsurface(Gpu& gpu, const Info& info, const std::vector<Material>& materials)
    : gpu_(gpu), info_(info), materials_(checked(materials)), message_(std::make_unique<std::string>()) {
    createContext(techniquesFor(info.technique, materials) |
                  (info.secondSurfaces ? 1u << NACRE_TECHNIQUE_BANK_SURFACES : 0));
}

void Subsurface::createContext(std::uint32_t techniques) {
    NacreContextInfo contextInfo = effectContextInfo(gpu_);
    contextInfo.pipelineCache = *gpu_.pipelineCache;
    contextInfo.maxExtent = info_.extent;
    contextInfo.techniques = techniques;
    contextInfo.framesInFlight = info_.framesInFlight;
    contextInfo.recordsPerFrame = info_.recordsPerFrame;
    contextInfo.maxMaterials = std::max(1u, static_cast<std::uint32_t>(materials_.size()));
    contextInfo.maxLights = std::max(1u, info_.maxLights);
    contextInfo.messageCallback = keepMessage;
    contextInfo.userData = message_.get();
    NacreContext context = nullptr;
    if (materials_.size() > NACRE_MAX_MATERIALS) {
        throw RendererError("the scene has " + std::to_string(materials_.size()) +
                            " subsurface materials, of which at most " + std::to_string(NACRE_MAX_MATERIALS) +
                            " can be drawn at a time");
    }
    check(nacreCreateContext(&contextInfo, &context));
    context_.reset(context);
    techniques_ = techniques;
    transmissions_.resize(materials_.size() + 1);
    lobes_.resize(materials_.size() + 1);
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        setMaterial(i, materials_[i]);
    }
}

void Subsurface::check(NacreResult result) const {
    if (result != NACRE_SUCCESS) {
        throw RendererError("the effect refused: " +
                            (message_->empty() ? std::string(nacreResultString(result)) : *message_));
    }
}

void Subsurface::setMaterials(const std::vector<Material>& materials) {
    checked(materials);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (!(materials[i] == materials_[i])) {
            setMaterial(i, materials[i]);
        }
    }
    materials_ = materials;
    bakedRadius_.reset();
}

void Subsurface::setMaterial(std::size_t index, const Material& material) {
    std::vector<NacreLayer> layers;
    const NacreMaterial converted = effectMaterial(material, layers);
    check(nacreSetMaterials(context_.get(), static_cast<std::uint32_t>(index) + 1, 1, &converted));
    transmissions_[index + 1] = makeTransmission(material);
    lobes_[index + 1] = makeLobe(material);
}

NacreView Subsurface::makeView(const View& view) const {
    NacreView result{};
    std::copy_n(glm::value_ptr(view.clipFromView), 16, result.clipFromView);
    std::copy_n(glm::value_ptr(view.viewFromWorld), 16, result.viewFromWorld);
    result.depthEncoding = NACRE_DEPTH_LINEAR;
    result.metersPerUnit = info_.metersPerUnit;
    return result;
}

bool Subsurface::scatteredHasAlbedo() const {
    return std::ranges::any_of(materials_,
                               [](const Material& material) { return material.albedoUse == AlbedoUse::PreAndPost; });
}

void Subsurface::beginFrame(std::uint32_t frame) {
    message_->clear();
    check(nacreBeginFrame(context_.get(), frame));
}

void Subsurface::record(const vk::raii::CommandBuffer& commandBuffer, const Inputs& inputs,
                        const EffectSettings& settings) {
    GBuffer& gbuffer = inputs.gbuffer;
    std::vector<ImageUse> uses{{inputs.irradiance, usage::computeRead},
                               {gbuffer.image(GBuffer::Depth), usage::computeRead},
                               {gbuffer.image(GBuffer::MaterialId), usage::computeRead},
                               {gbuffer.image(GBuffer::VertexNormal), usage::computeRead},
                               {gbuffer.image(GBuffer::Albedo), usage::computeRead},
                               {gbuffer.image(GBuffer::Emission), usage::computeRead},
                               {gbuffer.image(GBuffer::Transmission), usage::computeRead},
                               {inputs.shadowMaps, usage::computeRead}};
    inputs.outputs.forEachImage([&](Image& image) { uses.push_back({image, usage::computeWrite}); });
    nacre::renderer::prepare(commandBuffer, uses);
    if (settings.scatter) {
        const Label label(gpu_, commandBuffer, "scatter");
        scatter(commandBuffer, inputs, settings);
    }
    if (settings.transmit) {
        const Label label(gpu_, commandBuffer, "transmit");
        transmit(commandBuffer, inputs, settings);
    }
}

void Subsurface::scatter(const vk::raii::CommandBuffer& commandBuffer, const Inputs& inputs,
                         const EffectSettings& settings) {
    GBuffer& gbuffer = inputs.gbuffer;
    const NacreCost cost = scatterCost(settings.technique);
    NacreScatterInfo info{};
    info.view = makeView(inputs.view);
    info.technique = settings.technique;
    info.burleySampleBudget = settings.burleySampleBudget;
    NacreBaselineSettings baselines = settings.baselines;
    baselines.thesisBakedKernel = baselines.thesisBakedKernel && !materials_.empty();
    info.baselines = &baselines;
    info.irradiance = asInput(inputs.irradiance);
    info.depth = asInput(gbuffer.image(GBuffer::Depth));
    info.materialId = asInput(gbuffer.image(GBuffer::MaterialId));
    info.normal = asInput(gbuffer.image(GBuffer::VertexNormal));
    if (inputs.hasScale) {
        info.scale = asFactor(gbuffer.image(GBuffer::VertexNormal), gbuffer.scaleView());
    }
    if (inputs.hasStrength) {
        info.strength = asFactor(gbuffer.image(GBuffer::Emission), gbuffer.strengthView());
    }
    if (scatteredHasAlbedo()) {
        info.albedo = asInput(gbuffer.image(GBuffer::Albedo));
    }
    info.scattered = asOutput(inputs.outputs.scattered);
    info.skipUnscattered = VK_TRUE; // compose asks the id
    info.timestamps = inputs.timer.reserve({cost.passNames, cost.passCount}, "scatter: ");
    check(nacreCmdScatter(context_.get(), *commandBuffer, &info));
}

void Subsurface::transmit(const vk::raii::CommandBuffer& commandBuffer, const Inputs& inputs,
                          const EffectSettings& settings) {
    GBuffer& gbuffer = inputs.gbuffer;
    const NacreImage maps = asInput(inputs.shadowMaps);
    const NacreCost cost = transmitCost();
    NacreTransmitInfo info{};
    info.view = makeView(inputs.view);
    info.depth = asInput(gbuffer.image(GBuffer::Depth));
    info.materialId = asInput(gbuffer.image(GBuffer::MaterialId));
    info.normal = asInput(gbuffer.image(GBuffer::VertexNormal));
    info.thickness = asInput(gbuffer.image(GBuffer::Transmission));
    if (inputs.hasScale) {
        info.scale = asFactor(gbuffer.image(GBuffer::VertexNormal), gbuffer.scaleView());
    }
    if (inputs.hasShares) {
        info.strength = asFactor(gbuffer.image(GBuffer::Albedo), gbuffer.shareView());
    }
    info.lightCount = static_cast<std::uint32_t>(inputs.lights.size());
    info.lights = inputs.lights.data();
    info.shadowMapCount = 1;
    info.shadowMaps = &maps;
    info.baselines = &settings.baselines;
    info.transmitted = asOutput(inputs.outputs.transmitted);
    if (inputs.outputs.thickness) {
        info.thicknessOut = asOutput(*inputs.outputs.thickness);
    }
    info.timestamps = inputs.timer.reserve({cost.passNames, cost.passCount}, "transmit: ");
    check(nacreCmdTransmit(context_.get(), *commandBuffer, &info));
}

bool Subsurface::bakes(const EffectSettings& settings) const {
    return settings.technique == NACRE_TECHNIQUE_THESIS && settings.baselines.thesisBakedKernel && !materials_.empty();
}

bool Subsurface::isPrepared(const EffectSettings& settings) const {
    const std::uint32_t needed = techniquesFor(settings.technique, materials_);
    return (needed & ~techniques_) == 0 && (!bakes(settings) || bakedRadius_ == settings.baselines.thesisRadius);
}

void Subsurface::prepare(const EffectSettings& settings) {
    const std::uint32_t needed = techniques_ | techniquesFor(settings.technique, materials_);
    if (needed != techniques_) {
        createContext(needed);
    }
    if (bakes(settings) && bakedRadius_ != settings.baselines.thesisRadius) {
        check(nacreBakeThesisKernel(context_.get(), 1, settings.baselines.thesisRadius));
        bakedRadius_ = settings.baselines.thesisRadius;
    }
}

void Subsurface::resize(vk::Extent2D extent) {
    message_->clear();
    check(nacreResize(context_.get(), extent, nullptr));
    info_.extent = extent;
}

void Subsurface::reloadShaders() {
    check(reloadEffectShaders(context_.get()));
    bakedRadius_.reset();
}

NacreCost Subsurface::scatterCost(NacreTechnique technique) const {
    NacreCost cost{};
    check(nacreGetScatterCost(context_.get(), technique, &cost));
    return cost;
}

NacreCost Subsurface::transmitCost() const {
    NacreCost cost{};
    check(nacreGetTransmitCost(context_.get(), &cost));
    return cost;
}

} // namespace nacre::renderer
