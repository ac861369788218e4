#include "tests/gpu/support/tracked_device.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace nacre::tests {
namespace {

constexpr VkDeviceSize blockBytes = 16 << 20;

void succeed(VkResult result) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error("TrackedDevice: VkResult " + std::to_string(result));
    }
}

/// What a barrier has to know of states.
struct Scope {
    VkPipelineStageFlags stages = 0;
    VkAccessFlags access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

Scope scopeOf(States states) {
    constexpr VkPipelineStageFlags compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    constexpr struct {
        State state;
        Scope scope;
    } table[] = {
        {StateUniform, {compute, VK_ACCESS_UNIFORM_READ_BIT}},
        {StateSampled, {compute, VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}},
        {StateStorageRead, {compute, VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_GENERAL}},
        {StateStorageWrite, {compute, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL}},
        {StateIndirect, {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT}},
    };
    Scope scope;
    for (const auto& [state, part] : table) {
        if ((states & state) != 0) {
            scope.stages |= part.stages;
            scope.access |= part.access;
            scope.layout = part.layout;
        }
    }
    return scope;
}

/// The bindings that SPIR-V names: those of its instructions OpDecorate with the decoration Binding.
std::set<std::uint32_t> bindingsIn(std::span<const std::uint32_t> spirv) {
    constexpr std::uint32_t header = 5, opDecorate = 71, decorationBinding = 33;
    std::set<std::uint32_t> bindings;
    for (std::size_t i = header; i < spirv.size(); i += spirv[i] >> 16) {
        if ((spirv[i] & 0xffff) == opDecorate && spirv[i + 2] == decorationBinding) {
            bindings.insert(spirv[i + 3]);
        }
    }
    return bindings;
}

} // namespace

TrackedDevice::TrackedDevice(Gpu& gpu) : gpu_(gpu) {
    constexpr VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 64},
                                              {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 512},
                                              {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1024},
                                              {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 512}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = 64;
    info.poolSizeCount = static_cast<std::uint32_t>(std::size(sizes));
    info.pPoolSizes = sizes;
    succeed(vkCreateDescriptorPool(gpu_.device, &info, nullptr, &pool_));
}

TrackedDevice::~TrackedDevice() {
    for (const Resource& resource : resources_) {
        if (!resource.isImported) {
            vkDestroyImageView(gpu_.device, resource.view, nullptr);
            vkDestroyImage(gpu_.device, resource.image, nullptr);
            vkDestroyBuffer(gpu_.device, resource.buffer, nullptr);
        }
    }
    for (const auto& [type, blocks] : blocks_) {
        for (const Block& block : blocks) {
            vkFreeMemory(gpu_.device, block.memory, nullptr);
        }
    }
    for (const Program& program : programs_) {
        vkDestroyPipeline(gpu_.device, program.pipeline, nullptr);
        vkDestroyPipelineLayout(gpu_.device, program.layout, nullptr);
        vkDestroyDescriptorSetLayout(gpu_.device, program.setLayout, nullptr);
    }
    vkDestroyDescriptorPool(gpu_.device, pool_, nullptr);
}

/// The next free piece of a block, host-visible where the type is.
TrackedDevice::Place TrackedDevice::place(const VkMemoryRequirements& requirements) {
    const std::uint32_t type = gpu_.memoryType(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                                                VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    const VkDeviceSize alignment = std::max(requirements.alignment, gpu_.properties.limits.bufferImageGranularity);
    std::vector<Block>& blocks = blocks_[type];
    const auto start = [&] { return (blocks.back().used + alignment - 1) / alignment * alignment; };
    if (blocks.empty() || start() + requirements.size > blockBytes) {
        Block block;
        VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        allocation.allocationSize = std::max(blockBytes, requirements.size);
        allocation.memoryTypeIndex = type;
        succeed(vkAllocateMemory(gpu_.device, &allocation, nullptr, &block.memory));
        void* mapped = nullptr;
        succeed(vkMapMemory(gpu_.device, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
        block.mapped = static_cast<std::byte*>(mapped);
        blocks.push_back(block);
    }
    const VkDeviceSize offset = start();
    blocks.back().used = offset + requirements.size;
    return {blocks.back().memory, offset, blocks.back().mapped + offset};
}

TrackedDevice::Handle TrackedDevice::createBuffer(VkDeviceSize size, VkBufferUsageFlags usage) {
    Resource& resource = resources_.emplace_back();
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage;
    succeed(vkCreateBuffer(gpu_.device, &info, nullptr, &resource.buffer));
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(gpu_.device, resource.buffer, &requirements);
    const Place at = place(requirements);
    resource.mapped = {at.mapped, size};
    std::memset(at.mapped, 0xff, size); // to be seen if it were read before it is written
    succeed(vkBindBufferMemory(gpu_.device, resource.buffer, at.memory, at.offset));
    return resources_.size() - 1;
}

TrackedDevice::Handle TrackedDevice::createImage(VkFormat format, VkExtent2D extent, bool array) {
    Resource& resource = resources_.emplace_back();
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    succeed(vkCreateImage(gpu_.device, &info, nullptr, &resource.image));
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(gpu_.device, resource.image, &requirements);
    const Place at = place(requirements);
    succeed(vkBindImageMemory(gpu_.device, resource.image, at.memory, at.offset));
    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = resource.image;
    viewInfo.viewType = array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = format;
    viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    succeed(vkCreateImageView(gpu_.device, &viewInfo, nullptr, &resource.view));
    return resources_.size() - 1;
}

TrackedDevice::Handle TrackedDevice::import(const GpuImage& image) {
    Resource& resource = resources_.emplace_back();
    resource.image = image.image;
    resource.view = image.view;
    resource.layers = image.layers;
    resource.isImported = true;
    resource.states = image.layout == VK_IMAGE_LAYOUT_GENERAL ? StateStorageRead : StateSampled;
    return resources_.size() - 1;
}

TrackedDevice::Program TrackedDevice::createProgram(std::span<const std::uint32_t> spirv, std::span<const Slot> slots,
                                                    const std::map<std::uint32_t, VkBool32>& constants) {
    Program& program = programs_.emplace_back();
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    const std::set<std::uint32_t> used = bindingsIn(spirv);
    for (const Slot& slot : slots) {
        if (used.contains(slot.binding)) {
            program.slots.push_back(slot);
            bindings.push_back({slot.binding, slot.type, slot.count, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
        }
    }
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
    setInfo.pBindings = bindings.data();
    succeed(vkCreateDescriptorSetLayout(gpu_.device, &setInfo, nullptr, &program.setLayout));
    const VkPushConstantRange pushed{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(std::uint32_t)};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pSetLayouts = &program.setLayout;
    layoutInfo.pPushConstantRanges = &pushed;
    succeed(vkCreatePipelineLayout(gpu_.device, &layoutInfo, nullptr, &program.layout));

    std::vector<VkSpecializationMapEntry> entries;
    std::vector<VkBool32> values;
    for (const auto& [id, value] : constants) {
        entries.push_back({id, static_cast<std::uint32_t>(values.size() * sizeof(VkBool32)), sizeof(VkBool32)});
        values.push_back(value);
    }
    const VkSpecializationInfo special{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                       values.size() * sizeof(VkBool32), values.data()};
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = spirv.size_bytes();
    moduleInfo.pCode = spirv.data();
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &special;
    info.layout = program.layout;
    succeed(vkCreateShaderModule(gpu_.device, &moduleInfo, nullptr, &info.stage.module));
    const VkResult made = vkCreateComputePipelines(gpu_.device, VK_NULL_HANDLE, 1, &info, nullptr, &program.pipeline);
    vkDestroyShaderModule(gpu_.device, info.stage.module, nullptr);
    succeed(made);
    return program;
}

/// What was recorded before has run.
void TrackedDevice::begin(VkCommandBuffer commands) {
    commands_ = commands;
    succeed(vkResetDescriptorPool(gpu_.device, pool_, 0));
}

/// Brings resources into the states wanted, with one barrier for those that are not in them.
void TrackedDevice::require(std::span<const std::pair<Handle, States>> wanted) {
    std::map<Handle, States> all;
    for (const auto& [handle, states] : wanted) {
        all[handle] |= states;
    }
    VkPipelineStageFlags from = 0, to = 0;
    std::vector<VkBufferMemoryBarrier> buffers;
    std::vector<VkImageMemoryBarrier> images;
    for (const auto& [handle, states] : all) {
        Resource& resource = resources_[handle];
        if (resource.states == states && (states & StateStorageWrite) == 0) {
            continue;
        }
        const Scope before = scopeOf(resource.states);
        const Scope after = scopeOf(states);
        if (resource.image != VK_NULL_HANDLE) {
            images.push_back({VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                              nullptr,
                              before.access,
                              after.access,
                              before.layout,
                              after.layout,
                              VK_QUEUE_FAMILY_IGNORED,
                              VK_QUEUE_FAMILY_IGNORED,
                              resource.image,
                              {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, resource.layers}});
        } else {
            buffers.push_back({VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER, nullptr, before.access, after.access,
                               VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, resource.buffer, 0, VK_WHOLE_SIZE});
        }
        from |= before.stages;
        to |= after.stages;
        resource.states = states;
    }
    if (!buffers.empty() || !images.empty()) {
        ++barrierCount;
        vkCmdPipelineBarrier(commands_, from != 0 ? from : VkPipelineStageFlags{VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT}, to,
                             0, 0, nullptr, static_cast<std::uint32_t>(buffers.size()), buffers.data(),
                             static_cast<std::uint32_t>(images.size()), images.data());
    }
}

VkDescriptorSet TrackedDevice::createSet(const Dispatch& dispatch) {
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &dispatch.program->setLayout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    succeed(vkAllocateDescriptorSets(gpu_.device, &info, &set));
    for (const Slot& slot : dispatch.program->slots) {
        const Bound& bound = dispatch.bound.at(slot.binding);
        for (std::uint32_t i = 0; i < slot.count; ++i) {
            const Resource& resource = resources_[bound.resources[i % bound.resources.size()]];
            const VkDescriptorImageInfo image{VK_NULL_HANDLE, resource.view, scopeOf(bound.states).layout};
            const VkDescriptorBufferInfo buffer{resource.buffer, 0, VK_WHOLE_SIZE};
            const VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                             nullptr,
                                             set,
                                             slot.binding,
                                             i,
                                             1,
                                             slot.type,
                                             &image,
                                             &buffer,
                                             nullptr};
            vkUpdateDescriptorSets(gpu_.device, 1, &write, 0, nullptr);
        }
    }
    return set;
}

void TrackedDevice::dispatch(const Dispatch& dispatch) {
    std::vector<std::pair<Handle, States>> wanted;
    for (const Slot& slot : dispatch.program->slots) {
        const Bound& bound = dispatch.bound.at(slot.binding);
        for (const Handle resource : bound.resources) {
            wanted.emplace_back(resource, bound.states);
        }
    }
    if (dispatch.indirect) {
        wanted.emplace_back(*dispatch.indirect, StateIndirect);
    }
    require(wanted);
    const VkDescriptorSet set = createSet(dispatch);
    const Program& program = *dispatch.program;
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline);
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout, 0, 1, &set, 0, nullptr);
    vkCmdPushConstants(commands_, program.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(dispatch.pushed),
                       &dispatch.pushed);
    if (dispatch.indirect) {
        vkCmdDispatchIndirect(commands_, resources_[*dispatch.indirect].buffer, dispatch.indirectOffset);
    } else {
        vkCmdDispatch(commands_, dispatch.groups.width, dispatch.groups.height, dispatch.groups.depth);
    }
}

} // namespace nacre::tests
