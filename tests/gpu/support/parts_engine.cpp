#include "tests/gpu/support/parts_engine.hpp"

#include <cstdio>
#include <stdexcept>

namespace nacre::tests {
namespace {

void check(VkResult result) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error("PartsEngine: VkResult " + std::to_string(result));
    }
}

void check(NacreResult result) {
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(std::string("PartsEngine: ") + nacreResultString(result));
    }
}

void onMessage(NacreSeverity, const char* message, void*) {
    std::fprintf(stderr, "nacre: %s\n", message);
}
constexpr NacreMessages messages{onMessage, nullptr};

std::uint32_t bitOf(NacreImageSlot slot, const NacreImage& image) {
    return image.view != VK_NULL_HANDLE ? 1u << slot : 0u;
}

} // namespace

PartsEngine::PartsEngine(Gpu& gpu, NacreTechnique technique, VkExtent2D maxExtent, std::uint32_t materialCount,
                         std::uint32_t lightCount)
    : gpu_(gpu), technique_(technique), maxExtent_(maxExtent) {
    createLayouts();
    createPipelines();
    for (const NacreBinding& binding : bindings_) {
        const bool isBuffer =
            binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER || binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        if (isBuffer) {
            // [snippet: parts-sizes]
            const std::uint32_t elements = binding.name == std::string("lights") ? lightCount : materialCount + 1;
            createBuffer(binding, binding.head + binding.stride * elements);
            // [end]
        } else if (binding.intermediate) {
            createIntermediateImage(binding);
        }
    }
    createSet();
}

PartsEngine::~PartsEngine() {
    for (const auto& [name, buffer] : buffers_) {
        vkDestroyBuffer(gpu_.device, buffer.buffer, nullptr);
        vkFreeMemory(gpu_.device, buffer.memory, nullptr);
    }
    for (const std::array<VkPipeline, 4>& pipelines : pipelines_) {
        for (const VkPipeline pipeline : pipelines) {
            vkDestroyPipeline(gpu_.device, pipeline, nullptr);
        }
    }
    vkDestroyDescriptorPool(gpu_.device, pool_, nullptr);
    vkDestroyPipelineLayout(gpu_.device, layout_, nullptr);
    vkDestroyDescriptorSetLayout(gpu_.device, setLayout_, nullptr);
}

void PartsEngine::createLayouts() {
    const VkDevice device = gpu_.device;
    std::vector<NacreBinding>& bindings = bindings_;
    // [snippet: parts-layout]
    std::uint32_t count = 0;
    check(nacreGetBindings(technique_, maxExtent_, &count, nullptr));
    bindings.resize(count);
    check(nacreGetBindings(technique_, maxExtent_, &count, bindings.data()));
    std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
    for (const NacreBinding& binding : bindings) {
        layoutBindings.push_back({binding.binding, binding.type, binding.count, VK_SHADER_STAGE_COMPUTE_BIT});
    }
    // [end]
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = count;
    setInfo.pBindings = layoutBindings.data();
    check(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout_));
    const VkPushConstantRange slot{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(std::uint32_t)};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout_;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &slot;
    check(vkCreatePipelineLayout(device, &layoutInfo, nullptr, &layout_));
}

void PartsEngine::createPipelines() {
    std::uint32_t count = 0;
    check(nacreGetPasses(technique_, maxExtent_, &count, nullptr));
    std::vector<NacrePass> passes(count);
    check(nacreGetPasses(technique_, maxExtent_, &count, passes.data()));
    for (const NacrePass& pass : passes) {
        VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        moduleInfo.codeSize = pass.spirvSize;
        moduleInfo.pCode = pass.spirv;
        VkShaderModule module = VK_NULL_HANDLE;
        check(vkCreateShaderModule(gpu_.device, &moduleInfo, nullptr, &module));
        std::array<VkPipeline, 4>& pipelines = pipelines_.emplace_back();
        for (std::uint32_t variant = 0; variant < pipelines.size(); ++variant) {
            if ((variant & ~pass.constants) == 0) {
                pipelines[variant] = createPipeline(module, pass.constants, variant);
            }
        }
        vkDestroyShaderModule(gpu_.device, module, nullptr);
    }
}

VkPipeline PartsEngine::createPipeline(VkShaderModule module, std::uint32_t has, std::uint32_t variant) {
    // An entry for a constant that a pass lacks changes nothing; a pass without either has others under these ids.
    const VkBool32 values[] = {variant & 1u, variant >> 1};
    const VkSpecializationMapEntry entries[] = {{0, 0, sizeof(VkBool32)}, {1, sizeof(VkBool32), sizeof(VkBool32)}};
    const VkSpecializationInfo constants{2, entries, sizeof(values), values};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = has != 0 ? &constants : nullptr;
    info.layout = layout_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(gpu_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline));
    return pipeline;
}

void PartsEngine::createBuffer(const NacreBinding& binding, VkDeviceSize size) {
    Buffer& buffer = buffers_[binding.name];
    buffer.binding = binding;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                     ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT
                     : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    check(vkCreateBuffer(gpu_.device, &info, nullptr, &buffer.buffer));
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(gpu_.device, buffer.buffer, &requirements);
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocation.allocationSize = requirements.size;
    allocation.memoryTypeIndex = gpu_.memoryType(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                                                  VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkAllocateMemory(gpu_.device, &allocation, nullptr, &buffer.memory));
    check(vkBindBufferMemory(gpu_.device, buffer.buffer, buffer.memory, 0));
    void* mapped = nullptr;
    check(vkMapMemory(gpu_.device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    buffer.mapped = static_cast<std::byte*>(mapped);
    // Intermediates need no contents: these are there to be seen if they were read. Of the caller's, slot 0 and the ids
    // without a slot are 0.
    std::memset(mapped, binding.intermediate ? 0xff : 0, size);
}

void PartsEngine::createIntermediateImage(const NacreBinding& binding) {
    images_[binding.binding] = gpu_.createImage({.format = binding.format,
                                                 .extent = binding.extent,
                                                 .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                                 .layout = VK_IMAGE_LAYOUT_GENERAL,
                                                 .array = binding.array != VK_FALSE});
}

void PartsEngine::createSet() {
    std::vector<VkDescriptorPoolSize> sizes;
    for (const NacreBinding& binding : bindings_) {
        sizes.push_back({binding.type, binding.count});
    }
    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    poolInfo.pPoolSizes = sizes.data();
    check(vkCreateDescriptorPool(gpu_.device, &poolInfo, nullptr, &pool_));
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &setLayout_;
    check(vkAllocateDescriptorSets(gpu_.device, &info, &set_));
}

void PartsEngine::setMaterials(std::span<const NacreMaterial> materials) {
    const Buffer& blocks = buffers_.at("materials");
    const Buffer& tables = buffers_.at("tables");
    auto* slots = reinterpret_cast<std::uint32_t*>(blocks.mapped);
    // [snippet: parts-materials]
    for (std::uint32_t i = 0; i < materials.size(); ++i) {
        const std::uint32_t slot = i + 1;
        slots[slot] = slot; // here the material's id, too
        check(nacreFillMaterial(&materials[i], &messages, blocks.binding.stride, blocks.element(slot)));
        check(nacreFillTable(technique_, &materials[i], &messages, tables.binding.stride, tables.element(slot)));
    }
    // [end]
    materials_.assign(materials.begin(), materials.end());
}

void PartsEngine::bind(const NacreBinding& binding, std::span<const NacreImage> images, const NacreImage& fallback) {
    std::vector<VkDescriptorImageInfo> imageInfos;
    VkDescriptorBufferInfo bufferInfo{VK_NULL_HANDLE, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.dstBinding = binding.binding;
    write.descriptorCount = binding.count;
    write.descriptorType = binding.type;
    if (const auto buffer = buffers_.find(binding.name); buffer != buffers_.end()) {
        bufferInfo.buffer = buffer->second.buffer;
        write.pBufferInfo = &bufferInfo;
    } else {
        for (std::uint32_t i = 0; i < binding.count; ++i) {
            const bool isGiven = i < images.size() && images[i].view != VK_NULL_HANDLE;
            const NacreImage& image = binding.intermediate ? images_.at(binding.binding).nacre()
                                      : isGiven            ? images[i]
                                                           : fallback;
            imageInfos.push_back({VK_NULL_HANDLE, image.view, image.layout});
        }
        write.pImageInfo = imageInfos.data();
    }
    vkUpdateDescriptorSets(gpu_.device, 1, &write, 0, nullptr);
}

void PartsEngine::scatter(VkCommandBuffer commandBuffer, const NacreScatterInfo& info) {
    const std::map<NacreImageSlot, NacreImage> images = {
        {NACRE_IMAGE_IRRADIANCE, info.irradiance},  {NACRE_IMAGE_DEPTH, info.depth},
        {NACRE_IMAGE_MATERIAL_ID, info.materialId}, {NACRE_IMAGE_NORMAL, info.normal},
        {NACRE_IMAGE_STRENGTH, info.strength},      {NACRE_IMAGE_SCALE, info.scale},
        {NACRE_IMAGE_ALBEDO, info.albedo},          {NACRE_IMAGE_SCATTERED, info.scattered}};
    for (const NacreBinding& binding : bindings_) {
        const auto image = images.find(binding.image);
        bind(binding, image != images.end() ? std::span(&image->second, 1) : std::span<const NacreImage>(),
             info.irradiance);
    }
    const Buffer& parameters = buffers_.at("parameters");
    // [snippet: parts-parameters]
    const std::uint32_t optional = bitOf(NACRE_IMAGE_NORMAL, info.normal) | bitOf(NACRE_IMAGE_STRENGTH, info.strength) |
                                   bitOf(NACRE_IMAGE_SCALE, info.scale) | bitOf(NACRE_IMAGE_ALBEDO, info.albedo);
    check(nacreFillScatterParameters(&info, optional, &messages, parameters.binding.head, parameters.mapped));
    const std::uint32_t constants =
        nacreGetScatterConstants(optional, static_cast<std::uint32_t>(materials_.size()), materials_.data());
    // [end]
    const VkExtent2D area = info.view.renderArea.extent;
    recordPasses(commandBuffer, area.width != 0 ? area : info.irradiance.extent, constants);
}

void PartsEngine::transmit(VkCommandBuffer commandBuffer, const NacreTransmitInfo& info) {
    const std::map<NacreImageSlot, NacreImage> images = {{NACRE_IMAGE_DEPTH, info.depth},
                                                         {NACRE_IMAGE_MATERIAL_ID, info.materialId},
                                                         {NACRE_IMAGE_NORMAL, info.normal},
                                                         {NACRE_IMAGE_STRENGTH, info.strength},
                                                         {NACRE_IMAGE_SCALE, info.scale},
                                                         {NACRE_IMAGE_THICKNESS, info.thickness},
                                                         {NACRE_IMAGE_TRANSMITTED, info.transmitted},
                                                         {NACRE_IMAGE_THICKNESS_OUT, info.thicknessOut}};
    for (const NacreBinding& binding : bindings_) {
        if (binding.image == NACRE_IMAGE_SHADOW_MAP) {
            bind(binding, {info.shadowMaps, info.shadowMapCount}, info.shadowMaps[0]);
            continue;
        }
        const auto image = images.find(binding.image);
        bind(binding, image != images.end() ? std::span(&image->second, 1) : std::span<const NacreImage>(),
             binding.image == NACRE_IMAGE_THICKNESS_OUT ? info.transmitted : info.normal);
    }
    const std::uint32_t optional = bitOf(NACRE_IMAGE_STRENGTH, info.strength) | bitOf(NACRE_IMAGE_SCALE, info.scale) |
                                   bitOf(NACRE_IMAGE_THICKNESS, info.thickness) |
                                   bitOf(NACRE_IMAGE_THICKNESS_OUT, info.thicknessOut);
    const Buffer& parameters = buffers_.at("parameters");
    check(nacreFillTransmitParameters(&info, optional, &messages, parameters.binding.head, parameters.mapped));
    const Buffer& lights = buffers_.at("lights");
    check(nacreFillLights(&info, &messages, info.lightCount * lights.binding.stride, lights.mapped));
    const VkExtent2D area = info.view.renderArea.extent;
    recordPasses(commandBuffer, area.width != 0 ? area : info.depth.extent, nacreGetTransmitConstants(optional, &info));
}

void PartsEngine::recordPasses(VkCommandBuffer commandBuffer, VkExtent2D area, std::uint32_t constants) {
    std::uint32_t count = static_cast<std::uint32_t>(pipelines_.size());
    std::vector<NacrePass> passes(count);
    check(nacreGetPasses(technique_, area, &count, passes.data()));
    std::vector<VkPipeline> pipelines;
    for (std::uint32_t i = 0; i < count; ++i) {
        pipelines.push_back(pipelines_[i][constants & passes[i].constants]);
    }
    vkCmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
    const auto barrier = [&] {
        VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
        memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        memory.dstAccessMask =
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
        vkCmdPipelineBarrier(commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
                             VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &memory,
                             0, nullptr, 0, nullptr);
    };
    const auto bufferAt = [&](std::uint32_t number) {
        for (const auto& [name, buffer] : buffers_) {
            if (buffer.binding.binding == number) {
                return buffer.buffer;
            }
        }
        throw std::runtime_error("PartsEngine: no buffer at the indirect binding");
    };
    // [snippet: parts-passes]
    std::uint32_t read = 0;
    std::uint32_t written = ~0u; // by the call before
    const auto push = [&](std::uint32_t value) {
        vkCmdPushConstants(commandBuffer, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(value), &value);
    };
    const auto dispatch = [&](std::size_t i) {
        const NacrePass& pass = passes[i];
        if (((pass.reads | pass.writes) & written) != 0 || (pass.writes & read) != 0) {
            barrier(); // compute shader writes -> compute shader reads, writes, and indirect arguments
            read = written = 0;
        }
        read |= pass.reads;
        written |= pass.writes;
        vkCmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines[i]);
        if (pass.indirectBinding != 0) {
            vkCmdDispatchIndirect(commandBuffer, bufferAt(pass.indirectBinding), pass.indirectOffset);
        } else {
            vkCmdDispatch(commandBuffer, pass.groups.width, pass.groups.height, pass.groups.depth);
        }
    };
    std::size_t first = 0; // of the passes that run for every material
    for (; first < count && !passes[first].perMaterial; ++first) {
        for (std::uint32_t repeat = 0; repeat < passes[first].repeats; ++repeat) {
            push(repeat);
            dispatch(first);
        }
    }
    for (std::uint32_t slot = 1; slot <= materials_.size() && first < count; ++slot) {
        push(slot);
        for (std::size_t i = first; i < count; ++i) {
            dispatch(i);
        }
    }
    // [end]
}

} // namespace nacre::tests
