#include "renderer/passes/subsurface.hpp"

#include "renderer/effect_arguments.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstring>

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

void copy(float (&target)[3], const glm::vec3& value) {
    std::copy_n(glm::value_ptr(value), 3, target);
}

NacreLight convert(const PlacedLight& light) {
    NacreLight result{};
    result.kind = static_cast<NacreLightKind>(light.kind);
    copy(result.position, light.position);
    copy(result.direction, light.direction);
    copy(result.irradiance, light.irradiance);
    result.range = light.range;
    result.innerConeAngle = light.innerConeAngle;
    result.outerConeAngle = light.outerConeAngle;
    const bool shadowed = light.shadowLayer != shared::noShadow;
    result.shadowMap = shadowed ? 0 : NACRE_NO_SHADOW_MAP;
    result.shadowLayer = shadowed ? light.shadowLayer : 0;
    std::copy_n(glm::value_ptr(light.shadowClipFromWorld), 16, result.shadowClipFromWorld);
    result.shadowRange = light.shadowRange;
    return result;
}

shared::TransmissionConstants makeTransmission(const Material& material) {
    shared::TransmissionConstants result{};
    if (const auto& color = material.diffuseTransmissionColor) {
        result.color = glm::vec4((*color)[0], (*color)[1], (*color)[2], 1);
    }
    result.share.x = static_cast<float>(material.diffuseTransmission);
    return result;
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

Subsurface::Subsurface(Gpu& gpu, const Info& info, const std::vector<Material>& materials,
                       const std::vector<PlacedLight>& lights)
    : info_(info),
      pipelines_(gpu.device, vk::PipelineCacheCreateInfo()),
      materials_(checked(materials)),
      message_(std::make_unique<std::string>()) {
    std::transform(lights.begin(), lights.end(), std::back_inserter(lights_),
                   [](const PlacedLight& light) { return convert(light); });
    constexpr vk::Format color = vk::Format::eR16G16B16A16Sfloat;
    scattered_ = makeOutput(gpu, "scattered", color, info.extent, NACRE_IMAGE_SCATTERED);
    transmitted_ = makeOutput(gpu, "transmitted", color, info.extent, NACRE_IMAGE_TRANSMITTED);
    if (info.thickness) {
        thickness_ = makeOutput(gpu, "thickness", vk::Format::eR16Sfloat, info.extent, NACRE_IMAGE_THICKNESS_OUT);
    }
    transmissions_ = Buffer(gpu, "transmissions", (materials.size() + 1) * sizeof(shared::TransmissionConstants),
                            vk::BufferUsageFlagBits::eStorageBuffer, Buffer::Place::Host);
    createContext(gpu, techniquesFor(info.technique, materials));
    setMaterials(materials);
}

void Subsurface::createContext(Gpu& gpu, std::uint32_t techniques) {
    NacreContextInfo contextInfo = effectContextInfo(gpu);
    contextInfo.pipelineCache = *pipelines_;
    contextInfo.maxExtent = info_.extent;
    contextInfo.techniques = techniques;
    contextInfo.framesInFlight = info_.framesInFlight;
    contextInfo.recordsPerFrame = info_.recordsPerFrame;
    contextInfo.maxMaterials = std::max(1u, static_cast<std::uint32_t>(materials_.size()));
    contextInfo.maxLights = std::max(1u, static_cast<std::uint32_t>(lights_.size()));
    contextInfo.messageCallback = keepMessage;
    contextInfo.userData = message_.get();
    NacreContext context = nullptr;
    check(nacreCreateContext(&contextInfo, &context));
    context_.reset(context);
    techniques_ = techniques;
}

void Subsurface::check(NacreResult result) const {
    if (result != NACRE_SUCCESS) {
        throw RendererError("the effect refused: " +
                            (message_->empty() ? std::string(nacreResultString(result)) : *message_));
    }
}

void Subsurface::setMaterials(const std::vector<Material>& materials) {
    checked(materials);
    std::vector<std::vector<NacreLayer>> layers(materials.size());
    std::vector<NacreMaterial> converted;
    std::vector<shared::TransmissionConstants> transmissions(1);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        converted.push_back(effectMaterial(materials[i], layers[i]));
        transmissions.push_back(makeTransmission(materials[i]));
    }
    if (!converted.empty()) {
        check(nacreSetMaterials(context_.get(), 1, static_cast<std::uint32_t>(converted.size()), converted.data()));
    }
    materials_ = materials;
    bakedRadius_.reset();
    std::memcpy(transmissions_.mapped(), transmissions.data(), transmissions.size() * sizeof(transmissions[0]));
}

NacreView Subsurface::makeView(const View& view) const {
    NacreView result{};
    std::copy_n(glm::value_ptr(view.clipFromView), 16, result.clipFromView);
    std::copy_n(glm::value_ptr(view.viewFromWorld), 16, result.viewFromWorld);
    result.depthEncoding = NACRE_DEPTH_LINEAR;
    result.metersPerUnit = info_.metersPerUnit;
    return result;
}

void Subsurface::beginFrame(std::uint32_t index) {
    message_->clear();
    check(nacreBeginFrame(context_.get(), index));
}

void Subsurface::prepareImages(const vk::raii::CommandBuffer& commandBuffer, const Frame& frame, Image& irradiance,
                               Image& shadowMaps) {
    GBuffer& gbuffer = frame.gbuffer;
    const ImageUse uses[] = {{irradiance, usage::computeRead},
                             {gbuffer.image(GBuffer::Depth), usage::computeRead},
                             {gbuffer.image(GBuffer::MaterialId), usage::computeRead},
                             {gbuffer.image(GBuffer::VertexNormal), usage::computeRead},
                             {gbuffer.image(GBuffer::Albedo), usage::computeRead},
                             {gbuffer.image(GBuffer::Thickness), usage::computeRead},
                             {shadowMaps, usage::computeRead},
                             {scattered_, usage::computeWrite},
                             {transmitted_, usage::computeWrite},
                             {thickness_, usage::computeWrite}}; // last: only where there is one
    prepare(commandBuffer, std::span(uses).first(std::size(uses) - (info_.thickness ? 0 : 1)));
}

void Subsurface::transmit(const vk::raii::CommandBuffer& commandBuffer, const Frame& frame, Image& shadowMaps,
                          const EffectSettings& settings) {
    GBuffer& gbuffer = frame.gbuffer;
    Image& depth = gbuffer.image(GBuffer::Depth);
    Image& materialId = gbuffer.image(GBuffer::MaterialId);
    Image& normal = gbuffer.image(GBuffer::VertexNormal);
    Image& authored = gbuffer.image(GBuffer::Thickness);
    const NacreImage maps = effectImage(shadowMaps);
    const NacreCost cost = transmitCost();
    NacreTransmitInfo info{};
    info.view = makeView(frame.view);
    info.frame = frame.index;
    info.depth = effectImage(depth);
    info.materialId = effectImage(materialId);
    info.normal = effectImage(normal);
    info.thickness = effectImage(authored);
    info.lightCount = static_cast<std::uint32_t>(lights_.size());
    info.lights = lights_.data();
    info.shadowMapCount = 1;
    info.shadowMaps = &maps;
    info.baselines = &settings.baselines;
    info.transmitted = effectImage(transmitted_);
    if (info_.thickness) {
        info.thicknessOut = effectImage(thickness_);
    }
    info.timestamps = frame.timer.reserve({cost.passNames, cost.passCount}, "transmit: ");
    check(nacreCmdTransmit(context_.get(), *commandBuffer, &info));
}

void Subsurface::prepareSettings(Gpu& gpu, const EffectSettings& settings) {
    const std::uint32_t needed = techniques_ | techniquesFor(settings.technique, materials_);
    if (needed != techniques_) {
        createContext(gpu, needed);
        setMaterials(materials_);
    }
    const bool bakes =
        settings.technique == NACRE_TECHNIQUE_THESIS && settings.baselines.thesisBakedKernel && !materials_.empty();
    if (bakes && bakedRadius_ != settings.baselines.thesisRadius) {
        check(nacreBakeThesisKernel(context_.get(), 1, settings.baselines.thesisRadius));
        bakedRadius_ = settings.baselines.thesisRadius;
    }
}

void Subsurface::scatter(const vk::raii::CommandBuffer& commandBuffer, const Frame& frame, Image& irradiance,
                         const EffectSettings& settings) {
    GBuffer& gbuffer = frame.gbuffer;
    Image& depth = gbuffer.image(GBuffer::Depth);
    Image& materialId = gbuffer.image(GBuffer::MaterialId);
    Image& normal = gbuffer.image(GBuffer::VertexNormal);
    const NacreCost cost = scatterCost(settings.technique);
    NacreScatterInfo info{};
    info.view = makeView(frame.view);
    info.frame = frame.index;
    info.technique = settings.technique;
    info.burleySampleBudget = settings.burleySampleBudget;
    NacreBaselineSettings baselines = settings.baselines;
    baselines.thesisBakedKernel = baselines.thesisBakedKernel && !materials_.empty();
    info.baselines = &baselines;
    info.irradiance = effectImage(irradiance);
    info.depth = effectImage(depth);
    info.materialId = effectImage(materialId);
    info.normal = effectImage(normal);
    scatteredHasAlbedo_ = std::ranges::any_of(
        materials_, [](const Material& material) { return material.albedoUse == AlbedoUse::PreAndPost; });
    if (scatteredHasAlbedo_) {
        info.albedo = effectImage(gbuffer.image(GBuffer::Albedo));
    }
    info.scattered = effectImage(scattered_);
    info.skipUnscattered = VK_TRUE; // compose asks the id
    info.timestamps = frame.timer.reserve({cost.passNames, cost.passCount}, "scatter: ");
    check(nacreCmdScatter(context_.get(), *commandBuffer, &info));
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
