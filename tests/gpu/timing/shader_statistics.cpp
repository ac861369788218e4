// shader_statistics: what the driver's compiler says of the effect's passes: registers, instructions, shared memory,
// whatever it tells through VK_KHR_pipeline_executable_properties, and how long it takes.
//   shader_statistics [--technique NAME|all] [--csv FILE]
// Nothing is dispatched. Mesa compiles for AMD devices that are not there: RADV_FORCE_FAMILY=navi21 and its RADV alone
// in VK_DRIVER_FILES. What a driver has compiled before it reads from the disk, unless __GL_SHADER_DISK_CACHE=0
// (NVIDIA) or MESA_SHADER_CACHE_DISABLE=1 (Mesa) is set.
#include "nacre/nacre_parts.h"

#include <vulkan/vulkan_raii.hpp>

#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr VkExtent2D extent{1920, 1080};
constexpr const char* extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;

struct Options {
    std::string technique = "all";
    std::string csv;
};

// A specialization constant.
struct Constant {
    std::uint32_t id;
    VkBool32 value;
};

// A pass in one of its forms.
struct Program {
    std::string technique, pass, form;
    std::span<const std::uint32_t> spirv;
    std::optional<Constant> constant = {}; // that is not as by default
};

vk::raii::PhysicalDevice findDevice(const vk::raii::Instance& instance) {
    const vk::raii::PhysicalDevices devices(instance);
    for (const vk::raii::PhysicalDevice& device : devices) {
        for (const vk::ExtensionProperties& offered : device.enumerateDeviceExtensionProperties()) {
            if (std::string(offered.extensionName.data()) == extension) {
                return device;
            }
        }
    }
    throw std::runtime_error(std::string("no Vulkan device offers ") + extension);
}

bool hasHalfFloats(const vk::raii::PhysicalDevice& physicalDevice) {
    const auto offered = physicalDevice.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
    return offered.get<vk::PhysicalDeviceVulkan12Features>().shaderFloat16;
}

// With all that the effect may be given.
vk::raii::Device openDevice(const vk::raii::PhysicalDevice& physicalDevice, bool halfFloats) {
    NacreRequirements requirements;
    nacreGetRequirements(&requirements);
    requirements.features12.shaderFloat16 = halfFloats;
    vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics(VK_TRUE, &requirements.features12);
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, 0, 1, &priority);
    const vk::PhysicalDeviceFeatures features(requirements.features);
    return {physicalDevice, vk::DeviceCreateInfo({}, queue, {}, extension, &features, &statistics)};
}

vk::raii::DescriptorSetLayout makeSetLayout(const vk::raii::Device& device, NacreTechnique technique) {
    std::uint32_t count = 0;
    nacreGetBindings(technique, extent, &count, nullptr);
    std::vector<NacreBinding> bindings(count);
    nacreGetBindings(technique, extent, &count, bindings.data());
    std::vector<vk::DescriptorSetLayoutBinding> layout;
    for (const NacreBinding& binding : bindings) {
        layout.emplace_back(binding.binding, static_cast<vk::DescriptorType>(binding.type), binding.count,
                            vk::ShaderStageFlagBits::eCompute);
    }
    return {device, vk::DescriptorSetLayoutCreateInfo({}, layout)};
}

void addForms(std::vector<Program>& programs, const std::string& technique, const NacrePass& pass,
              std::span<const std::uint32_t> spirv, const std::string& precision) {
    const std::string prefix = precision.empty() ? "" : precision + ", ";
    programs.push_back({technique, pass.name, precision, spirv});
    if (pass.asksMaterials) {
        programs.push_back({technique, pass.name, prefix + "separate materials", spirv, Constant{0, VK_TRUE}});
    }
    if (pass.asksShadowMaps) {
        programs.push_back({technique, pass.name, prefix + "several shadow maps", spirv, Constant{0, VK_TRUE}});
    }
    if (pass.asksAlbedoOrStrength) {
        programs.push_back({technique, pass.name, prefix + "no albedo and strength 1", spirv, Constant{1, VK_FALSE}});
    }
}

std::vector<Program> programsOf(NacreTechnique technique, const std::string& name, bool halfFloats) {
    std::uint32_t count = 0;
    nacreGetPasses(technique, extent, &count, nullptr);
    std::vector<NacrePass> passes(count);
    nacreGetPasses(technique, extent, &count, passes.data());
    std::vector<Program> programs;
    for (const NacrePass& pass : passes) {
        addForms(programs, name, pass, {pass.spirv, pass.spirvSize / sizeof(std::uint32_t)}, "");
        if (pass.halfSpirv != nullptr && halfFloats) {
            addForms(programs, name, pass, {pass.halfSpirv, pass.halfSpirvSize / sizeof(std::uint32_t)}, "half floats");
        }
    }
    return programs;
}

vk::raii::Pipeline makePipeline(const vk::raii::Device& device, const vk::raii::PipelineLayout& layout,
                                const Program& program) {
    const vk::raii::ShaderModule module(device, vk::ShaderModuleCreateInfo({}, program.spirv));
    const Constant constant = program.constant.value_or(Constant{});
    const vk::SpecializationMapEntry entry(constant.id, 0, sizeof(VkBool32));
    const vk::SpecializationInfo constants(1, &entry, sizeof(VkBool32), &constant.value);
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  program.constant ? &constants : nullptr);
    return {device, nullptr,
            vk::ComputePipelineCreateInfo(vk::PipelineCreateFlagBits::eCaptureStatisticsKHR, stage, *layout)};
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

void report(const vk::raii::Device& device, const vk::raii::PipelineLayout& layout, const Program& program,
            std::ofstream& csv) {
    const auto start = std::chrono::steady_clock::now();
    const vk::raii::Pipeline pipeline = makePipeline(device, layout, program);
    const std::chrono::duration<double, std::milli> compiled = std::chrono::steady_clock::now() - start;
    std::printf("%s, %s%s%s\n ", program.technique.c_str(), program.pass.c_str(), program.form.empty() ? "" : ", ",
                program.form.c_str());
    const auto print = [&](const std::string& name, const std::string& value) {
        std::printf(" %s %s;", name.c_str(), value.c_str());
        csv << program.technique << ',' << program.pass << ",\"" << program.form << "\"," << name << ',' << value
            << '\n';
    };
    print("Milliseconds to compile", std::to_string(compiled.count()));
    const vk::PipelineInfoKHR info(*pipeline);
    const auto executables = device.getPipelineExecutablePropertiesKHR(info);
    for (std::uint32_t i = 0; i < executables.size(); ++i) {
        for (const vk::PipelineExecutableStatisticKHR& statistic :
             device.getPipelineExecutableStatisticsKHR({*pipeline, i})) {
            print(statistic.name.data(), valueOf(statistic));
        }
    }
    std::puts("");
}

void run(const Options& options) {
    const vk::raii::Context context;
    const vk::ApplicationInfo application("shader_statistics", 0, nullptr, 0, VK_API_VERSION_1_2);
    const vk::raii::Instance instance(context, vk::InstanceCreateInfo({}, &application));
    const vk::raii::PhysicalDevice physicalDevice = findDevice(instance);
    const bool halfFloats = hasHalfFloats(physicalDevice);
    const vk::raii::Device device = openDevice(physicalDevice, halfFloats);
    std::printf("%s\n", physicalDevice.getProperties().deviceName.data());
    std::ofstream csv(options.csv);
    csv << "technique,pass,form,statistic,value\n";
    bool known = false;
    for (int i = 1; i <= NACRE_TECHNIQUE_TRANSMIT; ++i) {
        const auto technique = static_cast<NacreTechnique>(i);
        const std::string name = technique == NACRE_TECHNIQUE_TRANSMIT ? "transmit" : nacreTechniqueString(technique);
        if (options.technique != "all" && options.technique != name) {
            continue;
        }
        known = true;
        const vk::raii::DescriptorSetLayout setLayout = makeSetLayout(device, technique);
        const vk::PushConstantRange slot(vk::ShaderStageFlagBits::eCompute, 0, sizeof(std::uint32_t));
        const vk::raii::PipelineLayout layout(device, vk::PipelineLayoutCreateInfo({}, *setLayout, slot));
        for (const Program& program : programsOf(technique, name, halfFloats)) {
            report(device, layout, program, csv);
        }
    }
    if (!known) {
        throw std::runtime_error("--technique is '" + options.technique +
                                 "', must be a technique's name, transmit or all");
    }
    if (!options.csv.empty() && !csv.flush()) {
        throw std::runtime_error("cannot write " + options.csv);
    }
}

} // namespace

int main(int count, char** arguments) {
    try {
        Options options;
        for (int i = 1; i < count; ++i) {
            const std::string name = arguments[i];
            if (name != "--technique" && name != "--csv") {
                throw std::runtime_error("unknown argument " + name +
                                         "; known are --technique NAME|all and --csv FILE");
            }
            if (i + 1 == count) {
                throw std::runtime_error(name + " needs a value");
            }
            (name == "--csv" ? options.csv : options.technique) = arguments[++i];
        }
        run(options);
        return 0;
    } catch (const std::exception& exception) {
        std::fprintf(stderr, "shader_statistics: %s\n", exception.what());
        return 1;
    }
}
