#include "bench/effect/shader_statistics.hpp"

#include "nacre/nacre_passes.h"
#include "renderer/vulkan/vulkan.hpp"

#include <chrono>
#include <optional>
#include <ostream>
#include <span>
#include <stdexcept>

namespace nacre::bench {
namespace {

constexpr VkExtent2D largestPicture{1920, 1080};
constexpr const char* statisticsExtension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
constexpr const char* everyTechnique = "all";

// A specialization constant.
struct Constant {
    std::uint32_t id;
    VkBool32 value;
};

// A pass in one of its forms.
struct PassForm {
    std::string technique, pass, form;
    std::span<const std::uint32_t> spirv;
    std::optional<Constant> constant = {}; // that is not as by default
};

bool offersStatistics(const vk::raii::PhysicalDevice& device) {
    for (const vk::ExtensionProperties& offered : device.enumerateDeviceExtensionProperties()) {
        if (std::string(offered.extensionName.data()) == statisticsExtension) {
            return true;
        }
    }
    return false;
}

std::string deviceName(const vk::raii::PhysicalDevice& device) {
    return device.getProperties().deviceName.data();
}

vk::raii::PhysicalDevice findTellingDevice(const vk::raii::Instance& instance, const std::string& name) {
    const vk::raii::PhysicalDevices devices(instance);
    for (const vk::raii::PhysicalDevice& device : devices) {
        if (deviceName(device).find(name) != std::string::npos && offersStatistics(device)) {
            return device;
        }
    }
    throw std::runtime_error("no Vulkan device" + (name.empty() ? "" : " called '" + name + "'") + " offers " +
                             statisticsExtension);
}

bool hasHalfFloats(const vk::raii::PhysicalDevice& device) {
    const auto offered = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
    return offered.get<vk::PhysicalDeviceVulkan12Features>().shaderFloat16;
}

// With all that the effect may be given.
vk::raii::Device openTellingDevice(const vk::raii::PhysicalDevice& physicalDevice, bool halfFloats) {
    NacreRequirements requirements;
    nacreGetRequirements(&requirements);
    requirements.features12.shaderFloat16 = halfFloats;
    const vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics{.pNext = &requirements.features12,
                                                                               .pipelineExecutableInfo = VK_TRUE};
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue{.queueCount = 1, .pQueuePriorities = &priority};
    vk::PhysicalDeviceFeatures features;
    features = requirements.features;
    return {physicalDevice, vk::DeviceCreateInfo{.pNext = &statistics,
                                                 .queueCreateInfoCount = 1,
                                                 .pQueueCreateInfos = &queue,
                                                 .enabledExtensionCount = 1,
                                                 .ppEnabledExtensionNames = &statisticsExtension,
                                                 .pEnabledFeatures = &features}};
}

vk::raii::DescriptorSetLayout makeEffectSetLayout(const vk::raii::Device& device, NacreTechnique technique) {
    std::uint32_t count = 0;
    nacreGetBindings(technique, largestPicture, &count, nullptr);
    std::vector<NacreBinding> bindings(count);
    nacreGetBindings(technique, largestPicture, &count, bindings.data());
    std::vector<vk::DescriptorSetLayoutBinding> layout;
    for (const NacreBinding& binding : bindings) {
        layout.push_back({.binding = binding.binding,
                          .descriptorType = static_cast<vk::DescriptorType>(binding.type),
                          .descriptorCount = binding.count,
                          .stageFlags = vk::ShaderStageFlagBits::eCompute});
    }
    return {device, vk::DescriptorSetLayoutCreateInfo{.bindingCount = static_cast<std::uint32_t>(layout.size()),
                                                      .pBindings = layout.data()}};
}

void addForms(std::vector<PassForm>& forms, const std::string& technique, const NacrePass& pass,
              std::span<const std::uint32_t> spirv, const std::string& precision) {
    const std::string prefix = precision.empty() ? "" : precision + ", ";
    forms.push_back({technique, pass.name, precision, spirv});
    const bool isTransmit = technique == "transmit";
    if ((pass.constants & 1u << 0) != 0) {
        forms.push_back({technique, pass.name, prefix + (isTransmit ? "several shadow maps" : "separate materials"),
                         spirv, Constant{0, VK_TRUE}});
    }
    if ((pass.constants & 1u << 1) != 0) { // by default false in transmit, else true
        forms.push_back({technique, pass.name, prefix + (isTransmit ? "general lights" : "no albedo and strength 1"),
                         spirv, Constant{1, isTransmit ? VK_TRUE : VK_FALSE}});
    }
}

std::vector<PassForm> formsOf(NacreTechnique technique, const std::string& name, bool halfFloats) {
    std::uint32_t count = 0;
    nacreGetPasses(technique, largestPicture, &count, nullptr);
    std::vector<NacrePass> passes(count);
    nacreGetPasses(technique, largestPicture, &count, passes.data());
    std::vector<PassForm> forms;
    for (const NacrePass& pass : passes) {
        addForms(forms, name, pass, {pass.spirv, pass.spirvSize / sizeof(std::uint32_t)}, "");
        if (pass.halfSpirv != nullptr && halfFloats) {
            addForms(forms, name, pass, {pass.halfSpirv, pass.halfSpirvSize / sizeof(std::uint32_t)}, "half floats");
        }
    }
    return forms;
}

vk::raii::Pipeline compile(const vk::raii::Device& device, const vk::raii::PipelineLayout& layout,
                           const PassForm& form) {
    const vk::raii::ShaderModule module(
        device, vk::ShaderModuleCreateInfo{.codeSize = form.spirv.size_bytes(), .pCode = form.spirv.data()});
    const Constant constant = form.constant.value_or(Constant{});
    const vk::SpecializationMapEntry entry{.constantID = constant.id, .size = sizeof(VkBool32)};
    const vk::SpecializationInfo constants{
        .mapEntryCount = 1, .pMapEntries = &entry, .dataSize = sizeof(VkBool32), .pData = &constant.value};
    const vk::PipelineShaderStageCreateInfo stage{.stage = vk::ShaderStageFlagBits::eCompute,
                                                  .module = *module,
                                                  .pName = "main",
                                                  .pSpecializationInfo = form.constant ? &constants : nullptr};
    return {device, nullptr,
            vk::ComputePipelineCreateInfo{
                .flags = vk::PipelineCreateFlagBits::eCaptureStatisticsKHR, .stage = stage, .layout = *layout}};
}

std::string valueOf(const vk::PipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
    case vk::PipelineExecutableStatisticFormatKHR::eBool32:
        return statistic.value.b32 ? "yes" : "no";
    case vk::PipelineExecutableStatisticFormatKHR::eInt64:
        return std::to_string(statistic.value.i64);
    case vk::PipelineExecutableStatisticFormatKHR::eUint64:
        return std::to_string(statistic.value.u64);
    default:
        return std::to_string(statistic.value.f64);
    }
}

CompiledPass compilePass(const vk::raii::Device& device, const vk::raii::PipelineLayout& layout, const PassForm& form) {
    const auto start = std::chrono::steady_clock::now();
    const vk::raii::Pipeline pipeline = compile(device, layout, form);
    const std::chrono::duration<double, std::milli> compiled = std::chrono::steady_clock::now() - start;
    CompiledPass result{form.technique, form.pass, form.form, {}};
    result.statistics.push_back({"Milliseconds to compile", std::to_string(compiled.count())});
    const auto executables = device.getPipelineExecutablePropertiesKHR({.pipeline = *pipeline});
    for (std::uint32_t i = 0; i < executables.size(); ++i) {
        for (const vk::PipelineExecutableStatisticKHR& statistic :
             device.getPipelineExecutableStatisticsKHR({.pipeline = *pipeline, .executableIndex = i})) {
            result.statistics.push_back({statistic.name.data(), valueOf(statistic)});
        }
    }
    return result;
}

void print(std::ostream& out, const CompiledPass& pass) {
    out << pass.technique << ", " << pass.pass << (pass.form.empty() ? "" : ", ") << pass.form << "\n ";
    for (const ShaderStatistic& statistic : pass.statistics) {
        out << ' ' << statistic.name << ' ' << statistic.value << ';';
    }
    out << std::endl;
}

struct NamedTechnique {
    NacreTechnique technique;
    std::string name;
};

std::vector<NamedTechnique> techniquesCalled(const std::string& name) {
    std::vector<NamedTechnique> found;
    std::string known = std::string(everyTechnique);
    std::uint32_t count = 0;
    nacreGetTechniques(&count, nullptr);
    std::vector<NacreTechnique> techniques(count);
    nacreGetTechniques(&count, techniques.data());
    techniques.push_back(NACRE_TECHNIQUE_TRANSMIT);
    for (const NacreTechnique technique : techniques) {
        const std::string own = technique == NACRE_TECHNIQUE_TRANSMIT ? "transmit" : nacreTechniqueString(technique);
        known += ", " + own;
        if (name == everyTechnique || name == own) {
            found.push_back({technique, own});
        }
    }
    if (found.empty()) {
        throw std::invalid_argument("--technique is '" + name + "', must be one of " + known);
    }
    return found;
}

} // namespace

std::vector<CompiledPass> compilePasses(const std::string& technique, const std::string& device, std::ostream& out) {
    const std::vector<NamedTechnique> techniques = techniquesCalled(technique);
    const vk::raii::Context context;
    const vk::ApplicationInfo application{.pApplicationName = "nacre", .apiVersion = VK_API_VERSION_1_2};
    const vk::raii::Instance instance(context, vk::InstanceCreateInfo{.pApplicationInfo = &application});
    const vk::raii::PhysicalDevice physicalDevice = findTellingDevice(instance, device);
    const bool halfFloats = hasHalfFloats(physicalDevice);
    const vk::raii::Device opened = openTellingDevice(physicalDevice, halfFloats);
    out << deviceName(physicalDevice) << '\n';
    std::vector<CompiledPass> passes;
    for (const auto& [which, name] : techniques) {
        const vk::raii::DescriptorSetLayout setLayout = makeEffectSetLayout(opened, which);
        const vk::PushConstantRange slot{.stageFlags = vk::ShaderStageFlagBits::eCompute,
                                         .size = sizeof(std::uint32_t)};
        const vk::DescriptorSetLayout handle = *setLayout;
        const vk::raii::PipelineLayout layout(opened, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1,
                                                                                   .pSetLayouts = &handle,
                                                                                   .pushConstantRangeCount = 1,
                                                                                   .pPushConstantRanges = &slot});
        for (const PassForm& form : formsOf(which, name, halfFloats)) {
            passes.push_back(compilePass(opened, layout, form));
            print(out, passes.back());
        }
    }
    return passes;
}

std::string formatShaderCsv(const std::vector<CompiledPass>& passes) {
    std::string csv = "technique,pass,form,statistic,value\n";
    for (const CompiledPass& pass : passes) {
        for (const ShaderStatistic& statistic : pass.statistics) {
            csv += pass.technique + ',' + pass.pass + ",\"" + pass.form + "\"," + statistic.name + ',' +
                   statistic.value + '\n';
        }
    }
    return csv;
}

} // namespace nacre::bench
