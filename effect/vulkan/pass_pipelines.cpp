#include "vulkan/pass_pipelines.hpp"

#include "contract/effect_error.hpp"
#include "vulkan/bindings.hpp"
#include "vulkan/context.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace nacre::effect {
namespace {

void createLayout(Context& context, CallLayout& callLayout, CallKind kind) {
    std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
    for (const NacreBinding& binding : bindingsOf(kind, callLayout.intermediates, context.maxExtent)) {
        layoutBindings.push_back({binding.binding, binding.type, binding.count, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    }
    const Device& device = context.device;
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<std::uint32_t>(layoutBindings.size());
    setInfo.pBindings = layoutBindings.data();
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    check(device.vk.CreateDescriptorSetLayout(device.handle, &setInfo, device.allocator, &setLayout),
          "vkCreateDescriptorSetLayout");
    callLayout.setLayout = {device, setLayout, device.vk.DestroyDescriptorSetLayout};

    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout;
    const VkPushConstantRange materialId{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(std::uint32_t)};
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &materialId;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device.vk.CreatePipelineLayout(device.handle, &layoutInfo, device.allocator, &layout),
          "vkCreatePipelineLayout");
    callLayout.layout = {device, layout, device.vk.DestroyPipelineLayout};
}

} // namespace

Owned<VkPipeline> createPipeline(const Device& device, VkPipelineLayout layout, const Pass& pass, VkPipelineCache cache,
                                 const VkSpecializationInfo* constants) {
    std::vector<std::uint32_t> storage;
    const std::span<const std::uint32_t> spirv = currentSpirv(pass, storage);
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = spirv.size_bytes();
    moduleInfo.pCode = spirv.data();
    VkShaderModule handle = VK_NULL_HANDLE;
    check(device.vk.CreateShaderModule(device.handle, &moduleInfo, device.allocator, &handle), "vkCreateShaderModule");
    const Owned<VkShaderModule> module{device, handle, device.vk.DestroyShaderModule};

    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = handle;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = constants;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device.vk.CreateComputePipelines(device.handle, cache, 1, &info, device.allocator, &pipeline),
          "vkCreateComputePipelines");
    Owned<VkPipeline> owned{device, pipeline, device.vk.DestroyPipeline};
    nameObject(device, VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline), pass.name);
    return owned;
}

namespace {

/// A pass's specialization constants: those of its variant, then those of the context's encodings
/// (encoded_inputs.glsl).
struct PassConstants {
    static constexpr std::uint32_t count = 4;
    static constexpr std::uint32_t ofVariants = 2;
    PassConstants(const Context& context, Variant variant)
        : values{variant & 1u, variant >> 1 & 1u, context.noMaterialIds ? VK_TRUE : VK_FALSE, normalBits(context)} {}
    static std::uint32_t normalBits(const Context& context) {
        return (context.normalEncoding == NACRE_NORMAL_OCTAHEDRAL ? normalOctahedral : 0u) |
               (context.normalSpace == NACRE_NORMAL_VIEW ? normalInViewSpace : 0u);
    }
    std::array<std::uint32_t, count> values;
    std::array<VkSpecializationMapEntry, count> entries{
        {{0, 0, 4}, {1, 4, 4}, {constantNoMaterialIds, 8, 4}, {constantNormalEncoding, 12, 4}}};
};

// A pipeline to be made, and where it goes.
struct PipelineOrder {
    Pass pass;
    VkPipelineLayout layout;
    Variant variant;
    Owned<VkPipeline>* pipeline;
};

void createOrdered(const Context& context, VkPipelineCache cache, const PipelineOrder& order) {
    // An entry for a constant that a pass lacks changes nothing; the thesis's passes have others under the first ids.
    const PassConstants constants(context, order.variant);
    const std::uint32_t first = order.pass.constants != 0 ? 0 : PassConstants::ofVariants;
    const VkSpecializationInfo info{PassConstants::count - first, constants.entries.data() + first,
                                    sizeof(constants.values), constants.values.data()};
    *order.pipeline = createPipeline(context.device, order.layout, order.pass, cache, &info);
}

// Adds the variants of a pass. `pipelines` stays where it is until they are made.
void orderVariants(std::vector<PipelineOrder>& orders, const Pass& pass, VkPipelineLayout layout,
                   PassPipelines& pipelines) {
    for (Variant variant = 0; variant < variantCount; ++variant) {
        if ((variant & ~pass.constants) == 0) {
            orders.push_back({pass, layout, variant, &pipelines[variant]});
        }
    }
}

// Drivers compile on the thread that calls. Callbacks of the caller's are called on its own thread alone.
std::size_t threadCount(const Context& context, std::size_t orderCount) {
    const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1u);
    return context.device.allocator ? 1 : std::min(cores, orderCount);
}

void createAll(const Context& context, VkPipelineCache cache, std::span<const PipelineOrder> orders) {
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr failure;
    const auto work = [&] {
        for (std::size_t i = next++; i < orders.size(); i = next++) {
            try {
                createOrdered(context, cache, orders[i]);
            } catch (...) {
                const std::scoped_lock lock(mutex);
                failure = std::current_exception();
                next = orders.size();
            }
        }
    };
    {
        std::vector<std::jthread> others;
        try {
            for (std::size_t i = 1; i < threadCount(context, orders.size()); ++i) {
                others.emplace_back(work);
            }
        } catch (const std::system_error&) { // the system has no more threads: those that run do it all
        }
        work();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace

void createLayouts(Context& context) {
    createLayout(context, context.scatter, CallKind::Scatter);
    createLayout(context, context.transmit, CallKind::Transmit);
}

TechniquePipelines createPipelines(const Context& context, VkPipelineCache cache) {
    TechniquePipelines pipelines;
    std::vector<PipelineOrder> orders;
    for (std::size_t i = 0; i < techniqueCount; ++i) {
        if (!context.enabled[i]) {
            continue;
        }
        const CallLayout& callLayout = i == transmitIndex ? context.transmit : context.scatter;
        pipelines[i].resize(techniques[i]->passes.size() + techniques[i]->materialPasses.size());
        auto made = pipelines[i].begin();
        for (const std::span<const Pass> part : {techniques[i]->passes, techniques[i]->materialPasses}) {
            for (Pass pass : part) {
                if (context.shaderFloat16 && pass.halfFile) {
                    pass.file = pass.halfFile;
                    pass.spirv = pass.halfSpirv;
                }
                orderVariants(orders, pass, callLayout.layout.get(), *made++);
            }
        }
    }
    createAll(context, cache, orders);
    return pipelines;
}

} // namespace nacre::effect
