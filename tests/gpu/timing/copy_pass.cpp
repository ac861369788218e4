#include "tests/gpu/timing/copy_pass.hpp"

#include "copy_comp.spv.h"

#include <stdexcept>

namespace nacre::tests {
namespace {

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
    }
}

} // namespace

CopyPass::CopyPass(Gpu& gpu, const NacreScatterInfo& info) : gpu_(gpu), extent_(info.scattered.extent) {
    createPipeline();
    createSet(info);
}

CopyPass::~CopyPass() {
    vkDestroyDescriptorPool(gpu_.device, pool_, nullptr);
    vkDestroyPipeline(gpu_.device, pipeline_, nullptr);
    vkDestroyPipelineLayout(gpu_.device, layout_, nullptr);
    vkDestroyDescriptorSetLayout(gpu_.device, setLayout_, nullptr);
}

void CopyPass::createPipeline() {
    constexpr auto sampled = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    constexpr auto storage = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    const VkDescriptorSetLayoutBinding bindings[] = {{0, sampled, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
                                                     {1, sampled, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
                                                     {2, sampled, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
                                                     {3, storage, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = 4;
    setInfo.pBindings = bindings;
    check(vkCreateDescriptorSetLayout(gpu_.device, &setInfo, nullptr, &setLayout_), "vkCreateDescriptorSetLayout");
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout_;
    check(vkCreatePipelineLayout(gpu_.device, &layoutInfo, nullptr, &layout_), "vkCreatePipelineLayout");
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = sizeof(copy_comp_spv);
    moduleInfo.pCode = copy_comp_spv;
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(gpu_.device, &moduleInfo, nullptr, &module), "vkCreateShaderModule");
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.layout = layout_;
    const VkResult result = vkCreateComputePipelines(gpu_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    vkDestroyShaderModule(gpu_.device, module, nullptr);
    check(result, "vkCreateComputePipelines");
}

void CopyPass::createSet(const NacreScatterInfo& info) {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 3}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1}};
    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = 2;
    poolInfo.pPoolSizes = sizes;
    check(vkCreateDescriptorPool(gpu_.device, &poolInfo, nullptr, &pool_), "vkCreateDescriptorPool");
    VkDescriptorSetAllocateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    setInfo.descriptorPool = pool_;
    setInfo.descriptorSetCount = 1;
    setInfo.pSetLayouts = &setLayout_;
    check(vkAllocateDescriptorSets(gpu_.device, &setInfo, &set_), "vkAllocateDescriptorSets");
    const NacreImage images[] = {info.irradiance, info.depth, info.materialId, info.scattered};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const VkDescriptorImageInfo imageInfo{VK_NULL_HANDLE, images[i].view, images[i].layout};
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set_;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = i < 3 ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        write.pImageInfo = &imageInfo;
        vkUpdateDescriptorSets(gpu_.device, 1, &write, 0, nullptr);
    }
}

void CopyPass::record(VkCommandBuffer commandBuffer, VkQueryPool pool, std::uint32_t first) const {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    vkCmdPipelineBarrier(commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0,
                         1, &barrier, 0, nullptr, 0, nullptr);
    const auto timestamp = [&](std::uint32_t query) {
        if (pool != VK_NULL_HANDLE) {
            vkCmdWriteTimestamp(commandBuffer, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, query);
        }
    };
    timestamp(first);
    vkCmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
    vkCmdDispatch(commandBuffer, (extent_.width + 15) / 16, (extent_.height + 15) / 16, 1);
    timestamp(first + 1);
}

} // namespace nacre::tests
