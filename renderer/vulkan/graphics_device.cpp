#include "renderer/vulkan/open_device.hpp"

#include "nacre/nacre.h"
#include "renderer/passes/shader_types.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <optional>
#include <span>
#include <utility>

namespace nacre::renderer {
namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

/// Attachments of the G-buffer (renderer/passes/gbuffer.hpp), the most one pass writes.
constexpr std::uint32_t neededColorAttachments = 8;

std::string versionText(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

std::string kindText(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return "discrete";
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return "integrated";
    case vk::PhysicalDeviceType::eVirtualGpu:
        return "virtual";
    case vk::PhysicalDeviceType::eCpu:
        return "software";
    default:
        return "other";
    }
}

/// Position in the order of preference; smaller is faster.
std::size_t kindRank(const std::string& kind) {
    constexpr std::array order{"discrete", "integrated", "virtual", "software", "other"};
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), kind) - order.begin());
}

/// The queue family that does everything, or none.
std::optional<std::uint32_t> findQueueFamily(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        const vk::QueueFlags needed = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
        if ((families[i].queueFlags & needed) == needed) {
            return i;
        }
    }
    return std::nullopt;
}

/// Whether every feature that is on in `needed` is on in `offered`: both are rows of VkBool32.
bool covers(std::span<const VkBool32> offered, std::span<const VkBool32> needed) {
    for (std::size_t i = 0; i < needed.size(); ++i) {
        if (needed[i] && !offered[i]) {
            return false;
        }
    }
    return true;
}

std::span<const VkBool32> flags(const VkPhysicalDeviceFeatures& features) {
    return {&features.robustBufferAccess, &features.inheritedQueries + 1};
}

std::span<const VkBool32> flags(const VkPhysicalDeviceVulkan12Features& features) {
    return {&features.samplerMirrorClampToEdge, &features.subgroupBroadcastDynamicId + 1};
}

NacreRequirements effectRequirements() {
    NacreRequirements requirements{};
    if (nacreGetRequirements(&requirements) != NACRE_SUCCESS) {
        throw RendererError("the effect library does not say what it needs of a Vulkan device");
    }
    return requirements;
}

/// Why this device cannot be used, in one sentence; empty when it can.
std::string findFault(const vk::raii::PhysicalDevice& device) {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return "it offers Vulkan " + versionText(properties.apiVersion) + ", and 1.3 is needed";
    }
    if (!findQueueFamily(device)) {
        return "it has no queue for both graphics and compute";
    }
    if (properties.limits.maxColorAttachments < neededColorAttachments) {
        return "it can write " + std::to_string(properties.limits.maxColorAttachments) +
               " images at a time, and the G-buffer has " + std::to_string(neededColorAttachments);
    }
    constexpr std::uint32_t invocations = shared::groupSize * shared::groupSize;
    if (properties.limits.maxComputeWorkGroupInvocations < invocations) {
        return "its compute workgroups have at most " +
               std::to_string(properties.limits.maxComputeWorkGroupInvocations) + " invocations, and " +
               std::to_string(invocations) + " are needed";
    }
    const NacreRequirements needed = effectRequirements();
    if (properties.limits.maxPerStageDescriptorSampledImages < needed.maxPerStageDescriptorSampledImages ||
        properties.limits.maxPerStageDescriptorStorageImages < needed.maxPerStageDescriptorStorageImages ||
        properties.limits.maxPerStageDescriptorStorageBuffers < needed.maxPerStageDescriptorStorageBuffers) {
        return "a shader of it can read fewer images and buffers than the effect requires (see nacreGetRequirements)";
    }
    const auto offered = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                             vk::PhysicalDeviceVulkan13Features>();
    if (!covers(flags(offered.get<vk::PhysicalDeviceFeatures2>().features), flags(needed.features)) ||
        !covers(flags(offered.get<vk::PhysicalDeviceVulkan12Features>()), flags(needed.features12))) {
        return "it lacks a feature that the effect requires (see nacreGetRequirements)";
    }
    const auto& features13 = offered.get<vk::PhysicalDeviceVulkan13Features>();
    if (!features13.dynamicRendering || !features13.synchronization2) {
        return "it lacks dynamic rendering or synchronization2";
    }
    return {};
}

DeviceDescription describe(const vk::raii::PhysicalDevice& device) {
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan12Properties>();
    const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& properties12 = chain.get<vk::PhysicalDeviceVulkan12Properties>();
    DeviceDescription description;
    description.name = properties.deviceName.data();
    description.kind = kindText(properties.deviceType);
    description.driver = std::string(properties12.driverName.data()) + " " + properties12.driverInfo.data();
    description.apiVersion = versionText(properties.apiVersion);
    description.reason = findFault(device);
    description.usable = description.reason.empty();
    return description;
}

vk::raii::Context openLoader() {
    try {
        return vk::raii::Context();
    } catch (const std::exception&) {
        throw RendererError("there is no Vulkan loader on this machine (Debian: libvulkan1)");
    }
}

bool hasLayer(const vk::raii::Context& context, const std::string& name) {
    const auto layers = context.enumerateInstanceLayerProperties();
    return std::any_of(layers.begin(), layers.end(), [&](const auto& layer) { return name == layer.layerName.data(); });
}

bool hasExtension(const vk::raii::Context& context, const std::string& name) {
    const auto extensions = context.enumerateInstanceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const auto& extension) { return name == extension.extensionName.data(); });
}

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* userData) {
    static_cast<std::vector<std::string>*>(userData)->emplace_back(data->pMessage);
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(std::vector<std::string>& messages) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    return {.messageSeverity = Severity::eWarning | Severity::eError,
            .messageType = Type::eGeneral | Type::eValidation | Type::ePerformance,
            .pfnUserCallback = collectMessage,
            .pUserData = &messages};
}

std::vector<const char*> pointers(const std::vector<std::string>& texts) {
    std::vector<const char*> result;
    std::transform(texts.begin(), texts.end(), std::back_inserter(result),
                   [](const std::string& text) { return text.c_str(); });
    return result;
}

/// With `messages`, the validation layer is on and reports into them.
vk::raii::Instance openInstance(const vk::raii::Context& context, bool labels,
                                const std::vector<std::string>& moreExtensions, std::vector<std::string>* messages) {
    const vk::ApplicationInfo application{.pApplicationName = "nacre", .apiVersion = VK_API_VERSION_1_3};
    const std::vector<const char*> layers(messages ? 1 : 0, validationLayer);
    for (const std::string& extension : moreExtensions) {
        if (!hasExtension(context, extension)) {
            throw RendererError("Vulkan on this machine lacks the extension " + extension);
        }
    }
    std::vector<const char*> extensions = pointers(moreExtensions);
    if (labels) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    const std::array checks{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    vk::ValidationFeaturesEXT validation{.enabledValidationFeatureCount = checks.size(),
                                         .pEnabledValidationFeatures = checks.data()};
    vk::DebugUtilsMessengerCreateInfoEXT messenger;
    if (messages) {
        messenger = messengerInfo(*messages);
        validation.pNext = &messenger;
    }
    try {
        return {context, vk::InstanceCreateInfo{.pNext = messages ? &validation : nullptr,
                                                .pApplicationInfo = &application,
                                                .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
                                                .ppEnabledLayerNames = layers.data(),
                                                .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                                .ppEnabledExtensionNames = extensions.data()}};
    } catch (const vk::IncompatibleDriverError&) {
        throw RendererError(
            "there is no Vulkan driver on this machine (Debian: mesa-vulkan-drivers has a software one)");
    } catch (const vk::SystemError& error) {
        throw RendererError(std::string("Vulkan could not be started: ") + error.what());
    }
}

vk::raii::PhysicalDevices physicalDevices(const vk::raii::Instance& instance) {
    try {
        vk::raii::PhysicalDevices devices(instance);
        if (!devices.empty()) {
            return devices;
        }
    } catch (const vk::SystemError&) {
        // falls through: some loaders report a machine without devices as an error
    }
    throw RendererError("there is no Vulkan device on this machine (Debian: mesa-vulkan-drivers has a software one)");
}

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Index of the device that was asked for.
std::size_t choose(const std::vector<DeviceDescription>& devices, const std::string& name) {
    std::size_t index = 0;
    const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), index);
    if (!name.empty() && fault == std::errc() && end == name.data() + name.size()) {
        if (index >= devices.size()) {
            throw RendererError("there is no Vulkan device " + name + ": the last one is " +
                                std::to_string(devices.size() - 1));
        }
        return index;
    }
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const bool named = lowerCase(devices[i].name).find(lowerCase(name)) != std::string::npos;
        const bool wanted = name.empty() ? devices[i].usable : named;
        if (wanted && (!best || kindRank(devices[i].kind) < kindRank(devices[*best].kind))) {
            best = i;
        }
    }
    if (!best && !name.empty()) {
        throw RendererError("there is no Vulkan device called '" + name + "'");
    }
    return best.value_or(0);
}

/// Throws RendererError naming an extension that the device lacks.
void checkExtensions(const vk::raii::PhysicalDevice& device, const DeviceDescription& description,
                     const std::vector<std::string>& extensions) {
    const auto offered = device.enumerateDeviceExtensionProperties();
    for (const std::string& extension : extensions) {
        if (std::none_of(offered.begin(), offered.end(),
                         [&](const auto& other) { return extension == other.extensionName.data(); })) {
            throw RendererError("the Vulkan device '" + description.name + "' lacks the extension " + extension);
        }
    }
}

vk::raii::Device openDevice(const vk::raii::PhysicalDevice& physicalDevice, std::uint32_t queueFamily, bool anisotropic,
                            bool halfFloats, const std::vector<std::string>& extensionNames) {
    const NacreRequirements needed = effectRequirements();
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue{
        .queueFamilyIndex = queueFamily, .queueCount = 1, .pQueuePriorities = &priority};
    vk::PhysicalDeviceVulkan12Features features12;
    features12 = needed.features12;
    features12.shaderFloat16 = halfFloats;
    vk::PhysicalDeviceVulkan13Features features13{
        .pNext = &features12, .synchronization2 = VK_TRUE, .dynamicRendering = VK_TRUE};
    vk::PhysicalDeviceFeatures2 features{.pNext = &features13};
    features.features = needed.features;
    features.features.samplerAnisotropy = anisotropic;
    const std::vector<const char*> extensions = pointers(extensionNames);
    return {physicalDevice, vk::DeviceCreateInfo{.pNext = &features,
                                                 .queueCreateInfoCount = 1,
                                                 .pQueueCreateInfos = &queue,
                                                 .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                                 .ppEnabledExtensionNames = extensions.data()}};
}

} // namespace

std::string readableBytes(std::uint64_t bytes) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
    return text.data();
}

std::vector<DeviceDescription> listDevices() {
    const vk::raii::Context context = openLoader();
    const vk::raii::Instance instance = openInstance(context, false, {}, nullptr);
    std::vector<DeviceDescription> result;
    for (const vk::raii::PhysicalDevice& device : physicalDevices(instance)) {
        result.push_back(describe(device));
    }
    return result;
}

Device::Implementation::Implementation(const DeviceSettings& settings) : context(openLoader()) {
    if (settings.validation && !hasLayer(context, validationLayer)) {
        throw RendererError(std::string("validation was asked for, but the layer ") + validationLayer +
                            " is not installed (Debian: vulkan-validationlayers)");
    }
    labels = settings.validation || hasExtension(context, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    instance =
        openInstance(context, labels, settings.instanceExtensions, settings.validation ? &validationMessages : nullptr);
    if (settings.validation) {
        messenger = vk::raii::DebugUtilsMessengerEXT(instance, messengerInfo(validationMessages));
    }
    vk::raii::PhysicalDevices devices = physicalDevices(instance);
    std::vector<DeviceDescription> descriptions;
    std::transform(devices.begin(), devices.end(), std::back_inserter(descriptions), describe);
    const std::size_t index = choose(descriptions, settings.name);
    description = descriptions[index];
    if (!description.usable) {
        throw RendererError("the Vulkan device '" + description.name + "' cannot be used: " + description.reason);
    }
    physicalDevice = std::move(devices[index]);
    limits = physicalDevice.getProperties().limits;
    memoryProperties = physicalDevice.getMemoryProperties();
    allocatedBytes.resize(memoryProperties.memoryHeapCount);
    // A software device would spend most of the frame on anisotropic taps.
    const bool software = physicalDevice.getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    anisotropic = physicalDevice.getFeatures().samplerAnisotropy && !software;
    queueFamily = findQueueFamily(physicalDevice).value();
    halfFloats = physicalDevice.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>()
                     .get<vk::PhysicalDeviceVulkan12Features>()
                     .shaderFloat16;
    checkExtensions(physicalDevice, description, settings.deviceExtensions);
    device = openDevice(physicalDevice, queueFamily, anisotropic, halfFloats, settings.deviceExtensions);
    queue = vk::raii::Queue(device, queueFamily, 0);
    commandPool = vk::raii::CommandPool(
        device, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = queueFamily});
    pipelineCache = vk::raii::PipelineCache(device, vk::PipelineCacheCreateInfo());
}

void Device::Implementation::submitAndWait(const std::function<void(const vk::raii::CommandBuffer&)>& recorder) {
    const vk::raii::CommandBuffers buffers(
        device, {.commandPool = *commandPool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
    const vk::raii::CommandBuffer& commandBuffer = buffers.front();
    commandBuffer.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    recorder(commandBuffer);
    commandBuffer.end();
    const vk::raii::Fence fence(device, vk::FenceCreateInfo{});
    const vk::CommandBufferSubmitInfo commands{.commandBuffer = *commandBuffer};
    queue.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &commands}, *fence);
    constexpr std::uint64_t forever = ~std::uint64_t{0};
    if (device.waitForFences(*fence, VK_TRUE, forever) != vk::Result::eSuccess) {
        throw RendererError("the Vulkan device '" + description.name + "' did not finish its work");
    }
}

void Device::Implementation::setName(vk::ObjectType type, std::uint64_t handle, const std::string& text) const {
    device.setDebugUtilsObjectNameEXT({.objectType = type, .objectHandle = handle, .pObjectName = text.c_str()});
}

Device::Device(const DeviceSettings& settings) : implementation_(std::make_unique<Implementation>(settings)) {}
Device::~Device() = default;
Device::Device(Device&&) noexcept = default;

const DeviceDescription& Device::description() const {
    return implementation_->description;
}

const std::vector<std::string>& Device::validationMessages() const {
    return implementation_->validationMessages;
}

} // namespace nacre::renderer
