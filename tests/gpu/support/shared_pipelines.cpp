#include "tests/gpu/support/shared_pipelines.hpp"

#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vulkan/vulkan.h>

namespace nacre::tests {
namespace {

/// What objects are made of, as bytes; equal bytes make equal pipelines.
struct Store {
    std::mutex mutex;
    std::map<VkShaderModule, std::string> modules;
    std::map<VkDescriptorSetLayout, std::string> setLayouts;
    std::map<VkPipelineLayout, std::string> layouts;
    std::map<std::pair<VkDevice, std::string>, VkPipeline> pipelines;
};

Store& store() {
    static Store& store = *new Store; // outlives the devices, which are static, too
    return store;
}

template <typename T> void append(std::string& bytes, std::span<const T> values) {
    bytes += std::to_string(values.size_bytes()) + ' ';
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

VKAPI_ATTR VkResult VKAPI_CALL createModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkShaderModule* module) {
    const VkResult result = vkCreateShaderModule(device, info, allocator, module);
    const std::scoped_lock lock(store().mutex);
    if (result == VK_SUCCESS) {
        store().modules[*module] = std::string(reinterpret_cast<const char*>(info->pCode), info->codeSize);
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL destroyModule(VkDevice device, VkShaderModule module,
                                         const VkAllocationCallbacks* allocator) {
    vkDestroyShaderModule(device, module, allocator);
    const std::scoped_lock lock(store().mutex);
    store().modules.erase(module);
}

VKAPI_ATTR VkResult VKAPI_CALL createSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkDescriptorSetLayout* layout) {
    const VkResult result = vkCreateDescriptorSetLayout(device, info, allocator, layout);
    std::string bytes = std::to_string(info->flags) + ' ';
    for (const VkDescriptorSetLayoutBinding& binding : std::span(info->pBindings, info->bindingCount)) {
        const std::uint32_t numbers[] = {binding.binding, static_cast<std::uint32_t>(binding.descriptorType),
                                         binding.descriptorCount, binding.stageFlags};
        append(bytes, std::span<const std::uint32_t>(numbers));
    }
    const std::scoped_lock lock(store().mutex);
    if (result == VK_SUCCESS) {
        store().setLayouts[*layout] = bytes;
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkPipelineLayout* layout) {
    const VkResult result = vkCreatePipelineLayout(device, info, allocator, layout);
    const std::scoped_lock lock(store().mutex);
    std::string bytes;
    for (const VkDescriptorSetLayout setLayout : std::span(info->pSetLayouts, info->setLayoutCount)) {
        const std::string& set = store().setLayouts.at(setLayout);
        append(bytes, std::span(set.data(), set.size()));
    }
    append(bytes, std::span(info->pPushConstantRanges, info->pushConstantRangeCount));
    if (result == VK_SUCCESS) {
        store().layouts[*layout] = bytes;
    }
    return result;
}

/// All that a pipeline is made from.
std::string keyOf(const VkComputePipelineCreateInfo& info) {
    std::string key = std::string(info.stage.pName) + ' ' + std::to_string(info.flags) + ' ';
    key += store().layouts.at(info.layout);
    if (const VkSpecializationInfo* constants = info.stage.pSpecializationInfo) {
        append(key, std::span(constants->pMapEntries, constants->mapEntryCount));
        append(key, std::span(static_cast<const char*>(constants->pData), constants->dataSize));
    }
    return key + store().modules.at(info.stage.module);
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                               const VkComputePipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
    if (cache != VK_NULL_HANDLE || allocator != nullptr) {
        return vkCreateComputePipelines(device, cache, count, infos, allocator, pipelines);
    }
    const std::scoped_lock lock(store().mutex);
    for (std::uint32_t i = 0; i < count; ++i) {
        VkPipeline& shared = store().pipelines[{device, keyOf(infos[i])}];
        if (shared == VK_NULL_HANDLE) {
            const VkResult result = vkCreateComputePipelines(device, cache, 1, &infos[i], nullptr, &shared);
            if (result != VK_SUCCESS) {
                return result;
            }
        }
        pipelines[i] = shared;
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyPipeline(VkDevice device, VkPipeline pipeline,
                                           const VkAllocationCallbacks* allocator) {
    const std::scoped_lock lock(store().mutex);
    for (const auto& [key, shared] : store().pipelines) {
        if (shared == pipeline) {
            return;
        }
    }
    vkDestroyPipeline(device, pipeline, allocator);
}

template <typename Function> PFN_vkVoidFunction untyped(Function* function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL sharingGetDeviceProcAddr(VkDevice device, const char* name) {
    const std::pair<std::string_view, PFN_vkVoidFunction> functions[] = {
        {"vkCreateShaderModule", untyped(&createModule)},           {"vkDestroyShaderModule", untyped(&destroyModule)},
        {"vkCreateDescriptorSetLayout", untyped(&createSetLayout)}, {"vkCreatePipelineLayout", untyped(&createLayout)},
        {"vkCreateComputePipelines", untyped(&createPipelines)},    {"vkDestroyPipeline", untyped(&destroyPipeline)},
    };
    for (const auto& [own, function] : functions) {
        if (own == name) {
            return function;
        }
    }
    return vkGetDeviceProcAddr(device, name);
}

} // namespace

PFN_vkVoidFunction sharingGetInstanceProcAddr(VkInstance instance, const char* name) {
    return std::string_view(name) == "vkGetDeviceProcAddr" ? untyped(&sharingGetDeviceProcAddr)
                                                           : vkGetInstanceProcAddr(instance, name);
}

void destroySharedPipelines(VkDevice device) {
    const std::scoped_lock lock(store().mutex);
    std::erase_if(store().pipelines, [device](const auto& entry) {
        const bool isOwn = entry.first.first == device;
        if (isOwn) {
            vkDestroyPipeline(device, entry.second, nullptr);
        }
        return isOwn;
    });
}

} // namespace nacre::tests
