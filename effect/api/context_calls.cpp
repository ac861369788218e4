// Creation, resizing, materials and costs of a context.
#include "api/guard.hpp"
#include "vulkan/context.hpp"
#include "vulkan/technique_choice.hpp"

#include "contract/validation.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace nacre::effect {
namespace {

constexpr std::uint32_t maxSide = 16384;
constexpr std::uint32_t maxFrames = 8;
constexpr std::uint32_t maxRecords = 64;
constexpr std::uint32_t maxLightCount = 1024;

std::uint32_t countOr(std::uint32_t value, std::uint32_t fallback, std::uint32_t most, const char* field) {
    if (value > most) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreContextInfo::", field, " is ", value, ", must be in [1, ", most, "]");
    }
    return value == 0 ? fallback : value;
}

void checkExtent(const Device& device, VkExtent2D extent) {
    const std::uint32_t most = std::min(maxSide, device.limits.maxImageDimension2D);
    if (extent.width == 0 || extent.height == 0 || extent.width > most || extent.height > most) {
        fail(extent.width > most || extent.height > most ? NACRE_ERROR_LIMIT_EXCEEDED : NACRE_ERROR_INVALID_ARGUMENT,
             "maxExtent is ", extent.width, "x", extent.height, ", each side must be in [1, ", most, "] px");
    }
}

void checkLimit(std::uint32_t has, std::uint32_t needs, const char* limit) {
    if (has < needs) {
        fail(NACRE_ERROR_UNSUPPORTED_DEVICE, "the device's ", limit, " is ", has, ", the effect needs ", needs);
    }
}

void openDevice(Device& device, const NacreContextInfo& info) {
    device.handle = info.device;
    if (info.allocator) {
        device.callbacks = *info.allocator;
        device.allocator = &device.callbacks;
    }
    device.vk = loadDispatchTable(info.getInstanceProcAddr, info.instance, info.device);
    device.vk.GetPhysicalDeviceMemoryProperties(info.physicalDevice, &device.memory);
    VkPhysicalDeviceProperties properties{};
    device.vk.GetPhysicalDeviceProperties(info.physicalDevice, &properties);
    device.limits = properties.limits;

    NacreRequirements requirements{};
    nacreGetRequirements(&requirements);
    if (properties.apiVersion < requirements.apiVersion) {
        fail(NACRE_ERROR_UNSUPPORTED_DEVICE, "the device's Vulkan version is ",
             VK_API_VERSION_MAJOR(properties.apiVersion), ".", VK_API_VERSION_MINOR(properties.apiVersion),
             ", the effect needs 1.2");
    }
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features12, {}};
    device.vk.GetPhysicalDeviceFeatures2(info.physicalDevice, &features);
    if (!features.features.shaderStorageImageWriteWithoutFormat) {
        fail(NACRE_ERROR_UNSUPPORTED_DEVICE, "the device lacks the feature shaderStorageImageWriteWithoutFormat");
    }
    if (info.enabledFeatures && !info.enabledFeatures->shaderStorageImageWriteWithoutFormat) {
        fail(NACRE_ERROR_UNSUPPORTED_DEVICE, "NacreContextInfo::enabledFeatures lacks "
                                             "shaderStorageImageWriteWithoutFormat, which the device has: enable it "
                                             "when the device is created (nacreGetRequirements)");
    }
    if (!device.vk.GetDeviceProcAddr(info.device, "vkCreateRenderPass2")) {
        fail(NACRE_ERROR_UNSUPPORTED_DEVICE,
             "the device does not know vkCreateRenderPass2 of Vulkan 1.2: "
             "VkApplicationInfo::apiVersion of NacreContextInfo::instance must be at least VK_API_VERSION_1_2");
    }
    if (info.shaderFloat16 && !features12.shaderFloat16) {
        fail(NACRE_ERROR_UNSUPPORTED_DEVICE,
             "NacreContextInfo::shaderFloat16 is set, but the device lacks the feature shaderFloat16");
    }
    checkLimit(device.limits.maxPerStageDescriptorSampledImages, requirements.maxPerStageDescriptorSampledImages,
               "maxPerStageDescriptorSampledImages");
    checkLimit(device.limits.maxPerStageDescriptorStorageImages, requirements.maxPerStageDescriptorStorageImages,
               "maxPerStageDescriptorStorageImages");
    checkLimit(device.limits.maxPerStageDescriptorStorageBuffers, requirements.maxPerStageDescriptorStorageBuffers,
               "maxPerStageDescriptorStorageBuffers");
}

std::array<bool, techniqueCount> enabledTechniques(std::uint32_t mask) {
    constexpr std::uint32_t known = ((1u << scatterTechniqueCount) - 1) << 1;
    if ((mask & ~(known | 1u)) != 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::techniques is 0x", std::hex, mask,
             ", knows only the bits 0x", known | 1u);
    }
    if ((mask & 1u << NACRE_TECHNIQUE_DEFAULT) != 0) {
        mask |= 1u << defaultTechnique;
    }
    std::array<bool, techniqueCount> enabled{};
    for (std::size_t i = 0; i < scatterTechniqueCount; ++i) {
        const bool isAsked = (mask >> (i + 1) & 1u) != 0;
        if (isAsked) {
            checkBuilt(i, "NacreContextInfo::techniques");
        }
        enabled[i] = isAsked || (mask == 0 && techniques[i]->isBuilt());
    }
    enabled[transmitIndex] = enabled[composeIndex] = true;
    return enabled;
}

void setEncodings(Context& context, const NacreContextInfo& info) {
    if (info.materialIdMask > NACRE_MAX_MATERIALS) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::materialIdMask is ", info.materialIdMask,
             ", must be in [0, ", NACRE_MAX_MATERIALS, "]");
    }
    if (info.materialIdShift > 15) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::materialIdShift is ", info.materialIdShift,
             ", must be in [0, 15]");
    }
    if (info.normalEncoding != NACRE_NORMAL_XYZ && info.normalEncoding != NACRE_NORMAL_OCTAHEDRAL) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::normalEncoding is ",
             static_cast<int>(info.normalEncoding), ", must be a NacreNormalEncoding");
    }
    if (info.normalSpace != NACRE_NORMAL_WORLD && info.normalSpace != NACRE_NORMAL_VIEW) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::normalSpace is ", static_cast<int>(info.normalSpace),
             ", must be a NacreNormalSpace");
    }
    context.noMaterialIds = info.noMaterialIds;
    context.normalEncoding = info.normalEncoding;
    context.normalSpace = info.normalSpace;
}

/// Makes everything that takes memory, and no memory yet.
void prepare(Context& context, const NacreContextInfo& info, std::uint32_t frames, std::uint32_t records) {
    checkGiven(info.instance, "NacreContextInfo::instance");
    checkGiven(info.physicalDevice, "NacreContextInfo::physicalDevice");
    checkGiven(info.device, "NacreContextInfo::device");
    checkGiven(info.getInstanceProcAddr, "NacreContextInfo::getInstanceProcAddr");
    const std::uint32_t materials = countOr(info.maxMaterials, 64, NACRE_MAX_MATERIALS, "maxMaterials");
    context.maxLights = countOr(info.maxLights, 16, maxLightCount, "maxLights");
    context.messageCallback = info.messageCallback;
    context.userData = info.userData;
    context.enabled = enabledTechniques(info.techniques);
    context.shaderFloat16 = info.shaderFloat16;
    setEncodings(context, info);
    openDevice(context.device, info);
    checkExtent(context.device, info.maxExtent);
    for (std::size_t i = 0; i < techniqueCount; ++i) {
        if (context.enabled[i]) {
            (i == transmitIndex ? context.transmit : context.scatter).intermediates |= techniques[i]->uses();
        }
    }
    const IntermediateSet everywhere = context.noMaterialIds ? bit(intermediateNoIds) : 0;
    context.scatter.intermediates |= everywhere;
    context.transmit.intermediates |= everywhere;
    context.maxExtent = info.maxExtent;
    context.intermediates = createIntermediates(
        context.device, context.scatter.intermediates | context.transmit.intermediates, info.maxExtent);
    context.materials.emplace(
        context.device, materials, frames, context.enabled,
        IdBits{info.materialIdMask == 0 ? NACRE_MAX_MATERIALS : info.materialIdMask, info.materialIdShift});
    context.uniforms = createUniforms(context, frames, records);
}

static_assert(offsetof(NacreContextInfo, headerVersion) == 0 &&
              offsetof(NacreContextInfo, messageCallback) == sizeof(void*) &&
              offsetof(NacreContextInfo, userData) == 2 * sizeof(void*));

void checkVersion(const NacreContextInfo& info) {
    if (info.headerVersion != NACRE_HEADER_VERSION) {
        fail(NACRE_ERROR_VERSION_MISMATCH, "NacreContextInfo::headerVersion is 0x", std::hex, info.headerVersion,
             ", the library's is 0x", NACRE_HEADER_VERSION);
    }
}

MemoryLayout layOutHostMemory(Context& context) {
    MemoryLayout layout(context.device);
    context.materials->addTo(layout);
    layout.add(context.uniforms);
    return layout;
}

std::uint32_t frameCount(const NacreContextInfo& info) {
    return countOr(info.framesInFlight, 2, maxFrames, "framesInFlight");
}

std::uint32_t recordCount(const NacreContextInfo& info) {
    return countOr(info.recordsPerFrame, 1, maxRecords, "recordsPerFrame");
}

void create(Context& context, const NacreContextInfo& info) {
    prepare(context, info, frameCount(info), recordCount(info));
    createLayouts(context);
    context.pipelines = createPipelines(context, info.pipelineCache);
    context.givenMemory = info.deviceMemory;
    context.intermediateMemory = layOut(context.device, context.intermediates)
                                     .place(MemoryUse::Device, info.deviceMemory, "NacreContextInfo::deviceMemory");
    context.hostMemory =
        layOutHostMemory(context).place(MemoryUse::Host, info.hostMemory, "NacreContextInfo::hostMemory");
    context.materials->clear();
    createFrames(context, frameCount(info), recordCount(info));
}

void resize(Context& context, VkExtent2D maxExtent, const NacreMemory* deviceMemory) {
    checkExtent(context.device, maxExtent);
    const NacreMemory& given = deviceMemory ? *deviceMemory : context.givenMemory;
    const char* field = deviceMemory ? "deviceMemory" : "NacreContextInfo::deviceMemory";
    Owned<VkDeviceMemory> memory; // freed after its resources are destroyed
    IntermediateResources resources =
        createIntermediates(context.device, context.scatter.intermediates | context.transmit.intermediates, maxExtent);
    memory = layOut(context.device, resources).place(MemoryUse::Device, given, field);
    std::swap(context.intermediates, resources);
    std::swap(context.intermediateMemory, memory);
    context.maxExtent = maxExtent;
    context.givenMemory = given;
}

void setMaterials(Context& context, std::uint32_t firstId, std::uint32_t count, const NacreMaterial* materials) {
    if (firstId == 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "firstId is 0, which means no subsurface scattering; must be in [1, ",
             NACRE_MAX_MATERIALS, "]");
    }
    if (std::uint64_t{firstId} + count > std::uint64_t{NACRE_MAX_MATERIALS} + 1) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "firstId is ", firstId, " and count ", count, ", the last material id is ",
             NACRE_MAX_MATERIALS);
    }
    if (count > 0) {
        checkGiven(materials, "materials");
    }
    context.materials->set(firstId, std::span(materials, count));
}

void beginFrame(Context& context, std::uint32_t index) {
    if (index >= context.frames.size()) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "frame is ", index, ", the context has ", context.frames.size(),
             " frames in flight");
    }
    context.materials->update(index);
    Frame& frame = context.frames[index];
    context.frame = index;
    frame.scatter.used = 0;
    frame.transmit.used = 0;
    frame.compose.used = 0;
}

/// The names of every technique's passes, for NacreCost::passNames.
std::span<const char* const> passNames(std::size_t technique) {
    static const auto names = [] {
        std::array<std::vector<const char*>, techniqueCount> all;
        for (std::size_t i = 0; i < techniqueCount; ++i) {
            for (const Pass& pass : techniques[i]->passes) {
                all[i].push_back(pass.name);
            }
            if (!techniques[i]->materialPasses.empty()) {
                all[i].push_back(techniques[i]->materialPassesName);
            }
        }
        return all;
    }();
    return names[technique];
}

NacreCost costOf(const Context& context, std::size_t technique) {
    const std::span<const char* const> names = passNames(technique);
    NacreCost cost{};
    cost.dispatchesPerMaterial = static_cast<std::uint32_t>(techniques[technique]->materialPasses.size());
    cost.dispatchCount = cost.dispatchesPerMaterial * context.materials->setCount();
    for (const Pass& pass : techniques[technique]->passes) {
        cost.dispatchCount += repeatsOf(pass, context.maxExtent);
    }
    cost.passCount = static_cast<std::uint32_t>(names.size());
    cost.passNames = names.data();
    for (std::size_t i = 0; i < maxIntermediates; ++i) {
        if (techniques[technique]->uses() >> i & 1u) {
            cost.intermediateBytes += context.intermediates[i].bytes();
        }
    }
    cost.materialBytes = techniques[technique]->tableBytes + sizeof(MaterialParameters);
    return cost;
}

} // namespace
} // namespace nacre::effect

using namespace nacre::effect;

NacreResult nacreGetMemoryRequirements(const NacreContextInfo* info, NacreMemoryRequirements* requirements) {
    if (!info || !requirements) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(info->messageCallback, info->userData, [&] {
        checkVersion(*info);
        Context context;
        prepare(context, *info, frameCount(*info), recordCount(*info));
        requirements->device = layOut(context.device, context.intermediates).requirements();
        requirements->host = layOutHostMemory(context).requirements();
    });
}

NacreResult nacreCreateContext(const NacreContextInfo* info, NacreContext* context) {
    if (!info || !context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    *context = nullptr;
    return guard(info->messageCallback, info->userData, [&] {
        checkVersion(*info);
        auto created = std::make_unique<NacreContext_T>();
        create(*created, *info);
        *context = created.release();
    });
}

void nacreDestroyContext(NacreContext context) {
    delete context;
}

NacreResult nacreResize(NacreContext context, VkExtent2D maxExtent, const NacreMemory* deviceMemory) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] { resize(*context, maxExtent, deviceMemory); });
}

NacreResult nacreSetMaterials(NacreContext context, uint32_t firstId, uint32_t count, const NacreMaterial* materials) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData,
                 [&] { setMaterials(*context, firstId, count, materials); });
}

NacreResult nacreBeginFrame(NacreContext context, uint32_t frame) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] { beginFrame(*context, frame); });
}

NacreResult nacreGetScatterCost(NacreContext context, NacreTechnique technique, NacreCost* cost) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] {
        checkGiven(cost, "cost");
        const std::size_t asked = scatterTechniqueIndex(*context, technique, "technique");
        *cost = costOf(*context, chosenTechniqueIndex(*context, asked, context->materials->summary()));
    });
}

NacreResult nacreGetTransmitCost(NacreContext context, NacreCost* cost) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] {
        checkGiven(cost, "cost");
        *cost = costOf(*context, transmitIndex);
    });
}

NacreResult nacreGetComposeCost(NacreContext context, NacreCost* cost) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] {
        checkGiven(cost, "cost");
        *cost = costOf(*context, composeIndex);
    });
}
