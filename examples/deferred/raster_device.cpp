#include "raster_device.hpp"

#include <stdexcept>
#include <string>

namespace {

constexpr std::uint32_t imageBindings = 6; // 1 … 6, after the uniform block

VkImageAspectFlags aspectsOf(VkFormat format) {
    switch (format) {
    case VK_FORMAT_D32_SFLOAT:
        return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
        return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
        return VK_IMAGE_ASPECT_COLOR_BIT;
    }
}

} // namespace

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
    }
}

Device::Device(const VkPhysicalDeviceFeatures& features, VkPhysicalDeviceVulkan12Features features12) {
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instanceInfo.pApplicationInfo = &application;
    check(vkCreateInstance(&instanceInfo, nullptr, &instance), "vkCreateInstance");
    std::uint32_t count = 1;
    const VkResult found = vkEnumeratePhysicalDevices(instance, &count, &physicalDevice);
    if ((found != VK_SUCCESS && found != VK_INCOMPLETE) || count == 0) {
        throw std::runtime_error("there is no Vulkan device");
    }
    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    features13.dynamicRendering = VK_TRUE;
    features13.synchronization2 = VK_TRUE;
    features12.pNext = &features13;
    const float priority = 1;
    VkDeviceQueueCreateInfo queueInfo{
        VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO}; // family 0 draws and computes on all desktops
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features12};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.pEnabledFeatures = &features;
    check(vkCreateDevice(physicalDevice, &info, nullptr, &device), "vkCreateDevice");
    vkGetDeviceQueue(device, 0, 0, &queue);
    VkSamplerCreateInfo samplerInfo{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    check(vkCreateSampler(device, &samplerInfo, nullptr, &sampler), "vkCreateSampler");

    std::vector<VkDescriptorSetLayoutBinding> bindings{
        {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}};
    for (std::uint32_t i = 1; i <= imageBindings; ++i) {
        bindings.push_back({i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
    setInfo.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout), "vkCreateDescriptorSetLayout");
    const VkPushConstantRange draw{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, 8};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &draw;
    check(vkCreatePipelineLayout(device, &layoutInfo, nullptr, &layout), "vkCreatePipelineLayout");
}

Device::~Device() {
    for (const Frame& frame : frames) {
        vkDestroyFence(device, frame.finished, nullptr);
    }
    for (const Buffer& buffer : buffers_) {
        vkDestroyBuffer(device, buffer.buffer, nullptr);
        vkFreeMemory(device, buffer.memory, nullptr);
    }
    for (const VkPipeline pipeline : pipelines_) {
        vkDestroyPipeline(device, pipeline, nullptr);
    }
    vkDestroyDescriptorPool(device, descriptorPool_, nullptr);
    vkDestroyCommandPool(device, commandPool_, nullptr);
    vkDestroyPipelineLayout(device, layout, nullptr);
    vkDestroyDescriptorSetLayout(device, setLayout, nullptr);
    vkDestroySampler(device, sampler, nullptr);
    vkDestroyDevice(device, nullptr);
    vkDestroyInstance(instance, nullptr);
}

VkDeviceMemory Device::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(physicalDevice, &properties);
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = requirements.size;
    while ((requirements.memoryTypeBits >> info.memoryTypeIndex & 1u) == 0 ||
           (properties.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted) {
        if (++info.memoryTypeIndex == properties.memoryTypeCount) {
            throw std::runtime_error("the device lacks a type of memory");
        }
    }
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &info, nullptr, &memory), "vkAllocateMemory");
    return memory;
}

Image Device::createImage(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage, std::uint32_t layers,
                          VkSampleCountFlagBits samples) {
    Image result;
    result.format = format;
    result.extent = extent;
    result.usage = usage;
    result.aspects = aspectsOf(format);
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = layers == 0 ? 1 : layers;
    info.samples = samples;
    info.usage = usage;
    check(vkCreateImage(device, &info, nullptr, &result.image), "vkCreateImage");
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device, result.image, &requirements);
    result.memory = allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(device, result.image, result.memory, 0), "vkBindImageMemory");
    const auto createView = [&](VkImageAspectFlags aspect, VkImageViewType type, std::uint32_t first,
                                std::uint32_t count) {
        VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        viewInfo.image = result.image;
        viewInfo.viewType = type;
        viewInfo.format = format;
        viewInfo.subresourceRange = {aspect, 0, 1, first, count};
        VkImageView view = VK_NULL_HANDLE;
        check(vkCreateImageView(device, &viewInfo, nullptr, &view), "vkCreateImageView");
        return view;
    };
    const bool hasStencil = (result.aspects & VK_IMAGE_ASPECT_STENCIL_BIT) != 0;
    const VkImageAspectFlags first = hasStencil ? VkImageAspectFlags{VK_IMAGE_ASPECT_DEPTH_BIT} : result.aspects;
    result.view =
        createView(first, layers == 0 ? VK_IMAGE_VIEW_TYPE_2D : VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0, info.arrayLayers);
    if (hasStencil) {
        result.stencilView = createView(VK_IMAGE_ASPECT_STENCIL_BIT, VK_IMAGE_VIEW_TYPE_2D, 0, 1);
    }
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        result.layers.push_back(createView(first, VK_IMAGE_VIEW_TYPE_2D, layer, 1));
    }
    return result;
}

void Device::destroy(Image& image) {
    vkDestroyImageView(device, image.view, nullptr);
    vkDestroyImageView(device, image.stencilView, nullptr);
    for (const VkImageView layer : image.layers) {
        vkDestroyImageView(device, layer, nullptr);
    }
    vkDestroyImage(device, image.image, nullptr);
    vkFreeMemory(device, image.memory, nullptr);
    image = {};
}

Buffer Device::createBuffer(VkDeviceSize size, VkBufferUsageFlags usage) {
    Buffer result;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage;
    check(vkCreateBuffer(device, &info, nullptr, &result.buffer), "vkCreateBuffer");
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device, result.buffer, &requirements);
    result.memory = allocate(requirements, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(device, result.buffer, result.memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(device, result.memory, 0, VK_WHOLE_SIZE, 0, &result.mapped), "vkMapMemory");
    buffers_.push_back(result);
    return result;
}

VkShaderModule Device::createModule(std::span<const std::uint32_t> spirv) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
    return module;
}

VkPipeline Device::createPipeline(const PipelineInfo& from) {
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    const auto addStage = [&](VkShaderStageFlagBits stage, std::span<const std::uint32_t> spirv) {
        VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
        info.stage = stage;
        info.module = createModule(spirv);
        info.pName = "main";
        stages.push_back(info);
    };
    addStage(VK_SHADER_STAGE_VERTEX_BIT, from.vertex);
    if (!from.fragment.empty()) {
        addStage(VK_SHADER_STAGE_FRAGMENT_BIT, from.fragment);
    }
    const VkPipelineVertexInputStateCreateInfo vertexInput{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.cullMode = VK_CULL_MODE_NONE; // the shadow maps keep the faces that see the light
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = from.samples;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = depth.depthWriteEnable = from.depth != VK_FORMAT_UNDEFINED;
    depth.depthCompareOp = from.compare;
    depth.stencilTestEnable = from.writesStencil;
    depth.front = {VK_STENCIL_OP_KEEP, VK_STENCIL_OP_REPLACE, VK_STENCIL_OP_KEEP, VK_COMPARE_OP_ALWAYS, 0xff, 0xff, 0};
    depth.back = depth.front;
    VkPipelineColorBlendAttachmentState blend{};
    blend.blendEnable = from.adds;
    blend.srcColorBlendFactor = blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.srcAlphaBlendFactor = blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.colorWriteMask = 0xf;
    const std::vector<VkPipelineColorBlendAttachmentState> blends(from.colors.size(), blend);
    VkPipelineColorBlendStateCreateInfo blending{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount = static_cast<std::uint32_t>(blends.size());
    blending.pAttachments = blends.data();
    const VkDynamicState dynamics[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                       VK_DYNAMIC_STATE_STENCIL_REFERENCE};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = from.writesStencil ? 3 : 2;
    dynamic.pDynamicStates = dynamics;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(from.colors.size());
    rendering.pColorAttachmentFormats = from.colors.data();
    rendering.depthAttachmentFormat = from.depth;
    rendering.stencilAttachmentFormat = from.writesStencil ? from.depth : VK_FORMAT_UNDEFINED;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertexInput;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blending;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result = vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
    for (const VkPipelineShaderStageCreateInfo& stage : stages) {
        vkDestroyShaderModule(device, stage.module, nullptr);
    }
    check(result, "vkCreateGraphicsPipelines");
    pipelines_.push_back(pipeline);
    return pipeline;
}

void Device::createFrames(std::uint32_t count, VkDeviceSize uniformBytes) {
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    check(vkCreateCommandPool(device, &poolInfo, nullptr, &commandPool_), "vkCreateCommandPool");
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count * imageBindings}};
    VkDescriptorPoolCreateInfo setPool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    setPool.maxSets = count;
    setPool.poolSizeCount = 2;
    setPool.pPoolSizes = sizes;
    check(vkCreateDescriptorPool(device, &setPool, nullptr, &descriptorPool_), "vkCreateDescriptorPool");
    for (std::uint32_t i = 0; i < count; ++i) {
        Frame& frame = frames.emplace_back();
        VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        commands.commandPool = commandPool_;
        commands.commandBufferCount = 1;
        check(vkAllocateCommandBuffers(device, &commands, &frame.commands), "vkAllocateCommandBuffers");
        VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        check(vkCreateFence(device, &fence, nullptr, &frame.finished), "vkCreateFence");
        VkDescriptorSetAllocateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
        set.descriptorPool = descriptorPool_;
        set.descriptorSetCount = 1;
        set.pSetLayouts = &setLayout;
        check(vkAllocateDescriptorSets(device, &set, &frame.set), "vkAllocateDescriptorSets");
        frame.uniforms = createBuffer(uniformBytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        const VkDescriptorBufferInfo buffer{frame.uniforms.buffer, 0, uniformBytes};
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = frame.set;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        write.pBufferInfo = &buffer;
        vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
    }
}

void Device::bind(std::uint32_t frame, std::span<const VkDescriptorImageInfo> images) {
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = frames[frame].set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    for (const VkDescriptorImageInfo& image : images) {
        ++write.dstBinding;
        write.pImageInfo = &image;
        vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
    }
}

void use(VkCommandBuffer commands, Image& image, const Use& next, bool discard) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = image.last.stages;
    barrier.srcAccessMask = image.last.access;
    barrier.dstStageMask = next.stages;
    barrier.dstAccessMask = next.access;
    barrier.oldLayout = discard ? VK_IMAGE_LAYOUT_UNDEFINED : image.last.layout;
    barrier.newLayout = next.layout;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.image;
    barrier.subresourceRange = {image.aspects, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
    image.last = next;
}
