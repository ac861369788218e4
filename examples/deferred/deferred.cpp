// A deferred renderer as engines have them, with subsurface scattering: rasterised bodies on a table, lit from behind
// by a sun with four shadow cascades of hardware depth; a G-buffer with material ids in the stencil and octahedral
// normals in view space; a reversed depth buffer; one or four samples a pixel; several frames in flight; a size that
// changes. What is Nacre's stands in snippets.
//
// Usage: deferred [picture.png [frames in flight [samples a pixel [times as wide and high]]]]
#include "frame_block.hpp"
#include "images.hpp"
#include "pipelines.hpp"

// [snippet: raster-headers]
#include <nacre/nacre.hpp>
// [end]

#include <glm/gtc/type_ptr.hpp>
#include <stb/stb_image_write.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace {

constexpr VkExtent2D sizes[] = {{360, 200}, {480, 270}}; // it changes in the middle
constexpr int frameCount = 8;

// [snippet: raster-context]
void check(NacreResult result) {
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(nacreResultString(result)); // the callback has said which field, and why
    }
}

nacre::Context createContext(const Device& device, VkExtent2D extent, const VkPhysicalDeviceFeatures& features) {
    NacreContextInfo info{};
    info.headerVersion = NACRE_HEADER_VERSION;
    info.messageCallback = [](NacreSeverity, const char* message, void*) {
        std::fprintf(stderr, "nacre: %s\n", message);
    };
    info.instance = device.instance;
    info.physicalDevice = device.physicalDevice;
    info.device = device.device;
    info.getInstanceProcAddr = vkGetInstanceProcAddr;
    info.enabledFeatures = &features;
    info.maxExtent = extent;
    info.techniques = 1u << NACRE_TECHNIQUE_DEFAULT;
    info.framesInFlight = static_cast<std::uint32_t>(device.frames.size());
    info.materialIdMask = 0xf0; // the upper half of the stencil; the engine's own bits are the lower
    info.materialIdShift = 4;
    info.normalEncoding = NACRE_NORMAL_OCTAHEDRAL;
    info.normalSpace = NACRE_NORMAL_VIEW;
    nacre::Context context;
    check(nacre::Context::create(info, context));
    const char* presets[] = {"marble", "skin", "wax"};
    for (std::uint32_t i = 0; i < 3; ++i) {
        check(context.setPreset(1 + i, presets[i]));
    }
    return context;
}
// [end]

// [snippet: raster-images]
void createEffectImages(Device& device, VkExtent2D extent, Images& images) {
    for (Image* image : {&images.scattered, &images.transmitted, &images.composed}) {
        *image = device.createImage(VK_FORMAT_R16G16B16A16_SFLOAT, extent,
                                    VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    }
}

NacreImage effectImage(const Image& image) {
    return {image.view, image.format, image.last.layout, image.extent, image.usage};
}
// [end]

/// One frame's drawing. Everything is on one queue, and images are the same in all frames: `use` orders a frame after
/// what the one before did with them.
class Renderer {
public:
    Renderer(std::uint32_t framesInFlight, VkSampleCountFlagBits samples, VkExtent2D extent)
        // [snippet: raster-device]
        : requirements_(requirements()),
          device_(requirements_.features, requirements_.features12)
    // [end]
    {
        device_.createFrames(framesInFlight, sizeof(FrameBlock));
        samples_ = samples;
        pipelines_ = createPipelines(device_, samples);
        context_ = createContext(device_, extent, requirements_.features);
        makeImages(extent);
    }
    ~Renderer() {
        vkDeviceWaitIdle(device_.device);
        context_ = {};
        images_.forEach([&](Image& image) { device_.destroy(image); });
    }
    Renderer(const Renderer&) = delete;

    void resize(VkExtent2D extent) {
        vkDeviceWaitIdle(device_.device);
        images_.forEach([&](Image& image) { device_.destroy(image); });
        // [snippet: raster-resize]
        check(context_.resize(extent)); // the device is idle
        // [end]
        makeImages(extent);
    }

    void draw(int number) {
        const auto index = static_cast<std::uint32_t>(number) % static_cast<std::uint32_t>(device_.frames.size());
        const Device::Frame& frame = device_.frames[index];
        ::check(vkWaitForFences(device_.device, 1, &frame.finished, VK_TRUE, UINT64_MAX), "vkWaitForFences");
        ::check(vkResetFences(device_.device, 1, &frame.finished), "vkResetFences");
        block_ = makeFrame(extent_, number);
        std::memcpy(frame.uniforms.mapped, &block_, sizeof(block_));
        commands_ = frame.commands;
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        ::check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
        vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, device_.layout, 0, 1, &frame.set, 0,
                                nullptr);
        drawShadows();
        drawSurfaces();
        drawLighting();
        drawSubsurface(index);
        addSubsurface();
        copyPicture();
        ::check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands_;
        ::check(vkQueueSubmit(device_.queue, 1, &submit, frame.finished), "vkQueueSubmit");
    }

    /// The last picture.
    void save(const char* path) {
        vkDeviceWaitIdle(device_.device);
        const auto width = static_cast<int>(extent_.width);
        if (stbi_write_png(path, width, static_cast<int>(extent_.height), 4, pixels_.mapped, 4 * width) == 0) {
            throw std::runtime_error(std::string("cannot write ") + path);
        }
        std::printf("wrote %s\n", path);
    }

private:
    // [snippet: raster-requirements]
    static NacreRequirements requirements() {
        NacreRequirements result{};
        check(nacreGetRequirements(&result));
        return result;
    }
    // [end]

    bool isMultisampled() const { return samples_ != VK_SAMPLE_COUNT_1_BIT; }
    /// What has one sample a pixel.
    const GBuffer& surfaces() const { return isMultisampled() ? images_.resolved : images_.drawn; }

    /// The images, and what follows from them: the buffer that the picture is copied to, and the sets.
    void makeImages(VkExtent2D extent) {
        extent_ = extent;
        images_ = createImages(device_, extent, samples_);
        createEffectImages(device_, extent, images_);
        pixels_ =
            device_.createBuffer(VkDeviceSize{4} * extent_.width * extent_.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        const VkDescriptorImageInfo bound[] = {
            {device_.sampler, images_.drawn.depth.view, depthRead.layout},
            {device_.sampler, images_.drawn.depth.stencilView, depthRead.layout},
            {device_.sampler, images_.drawn.normal.view, colorRead.layout},
            {device_.sampler, images_.drawn.albedo.view, colorRead.layout},
            {device_.sampler, images_.shadowMap.view, depthRead.layout},
            {device_.sampler, images_.composed.view, generalRead.layout},
        };
        for (std::uint32_t i = 0; i < device_.frames.size(); ++i) {
            device_.bind(i, bound);
        }
    }

    static VkRenderingAttachmentInfo target(VkImageView view, const Use& as, VkAttachmentLoadOp load, float depth = 0) {
        VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        info.imageView = view;
        info.imageLayout = as.layout;
        info.loadOp = load;
        info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        info.clearValue.depthStencil.depth = depth;
        return info;
    }

    void beginRendering(VkExtent2D extent, std::span<const VkRenderingAttachmentInfo> colors,
                        const VkRenderingAttachmentInfo* depth, bool hasStencil) {
        VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
        info.renderArea.extent = extent;
        info.layerCount = 1;
        info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
        info.pColorAttachments = colors.data();
        info.pDepthAttachment = depth;
        info.pStencilAttachment = hasStencil ? depth : nullptr;
        vkCmdBeginRendering(commands_, &info);
        const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
        vkCmdSetViewport(commands_, 0, 1, &viewport);
        vkCmdSetScissor(commands_, 0, 1, &info.renderArea);
    }

    void drawBody(int cascade, std::uint32_t body) {
        const std::int32_t draw[] = {cascade, static_cast<std::int32_t>(body)};
        vkCmdPushConstants(commands_, device_.layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                           sizeof(draw), draw);
        vkCmdDraw(commands_, verticesOfBody, 1, 0, 0);
    }

    void drawShadows() {
        use(commands_, images_.shadowMap, depthTarget, true);
        for (std::uint32_t cascade = 0; cascade < cascadeCount; ++cascade) {
            const VkRenderingAttachmentInfo depth =
                target(images_.shadowMap.layers[cascade], depthTarget, VK_ATTACHMENT_LOAD_OP_CLEAR, 1);
            beginRendering(images_.shadowMap.extent, {}, &depth, false);
            vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.shadow);
            for (std::uint32_t body = 0; body < bodyCount; ++body) {
                drawBody(static_cast<int>(cascade), body);
            }
            vkCmdEndRendering(commands_);
        }
        use(commands_, images_.shadowMap, depthRead);
    }

    void drawSurfaces() {
        GBuffer& drawn = images_.drawn;
        use(commands_, drawn.albedo, colorTarget, true);
        use(commands_, drawn.normal, colorTarget, true);
        use(commands_, drawn.depth, depthTarget, true);
        const VkRenderingAttachmentInfo colors[] = {
            target(drawn.albedo.view, colorTarget, VK_ATTACHMENT_LOAD_OP_CLEAR),
            target(drawn.normal.view, colorTarget, VK_ATTACHMENT_LOAD_OP_CLEAR)};
        const VkRenderingAttachmentInfo depth = target(drawn.depth.view, depthTarget, VK_ATTACHMENT_LOAD_OP_CLEAR);
        beginRendering(extent_, colors, &depth, true);
        vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.surface);
        for (std::uint32_t body = 0; body < bodyCount; ++body) {
            const auto material = static_cast<std::uint32_t>(block_.bodies[body].center.w);
            vkCmdSetStencilReference(commands_, VK_STENCIL_FACE_FRONT_AND_BACK, material << 4 | 0x5);
            drawBody(-1, body);
        }
        vkCmdEndRendering(commands_);
        use(commands_, drawn.albedo, colorRead);
        use(commands_, drawn.normal, colorRead);
        use(commands_, drawn.depth, depthRead);
    }

    /// Lights all samples; of several it makes one.
    void drawLighting() {
        std::vector<Image*> images{&images_.irradiance, &images_.picture};
        if (isMultisampled()) {
            GBuffer& resolved = images_.resolved;
            images.insert(images.end(), {&resolved.albedo, &resolved.normal, &resolved.depth, &images_.ids});
        }
        std::vector<VkRenderingAttachmentInfo> colors;
        for (Image* image : images) {
            use(commands_, *image, colorTarget, true);
            colors.push_back(target(image->view, colorTarget, VK_ATTACHMENT_LOAD_OP_DONT_CARE));
        }
        drawScreen(pipelines_.lighting, colors);
        for (Image* image : images) {
            if (image != &images_.picture) {
                use(commands_, *image, colorRead);
            }
        }
    }

    void drawScreen(VkPipeline pipeline, std::span<const VkRenderingAttachmentInfo> colors) {
        beginRendering(extent_, colors, nullptr, false);
        vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        vkCmdDraw(commands_, 3, 1, 0, 0);
        vkCmdEndRendering(commands_);
    }

    // [snippet: raster-light]
    /// The sun with its cascades, whose maps are depth buffers as they are.
    NacreLight sun(NacreShadowCascade (&cascades)[cascadeCount]) const {
        NacreLight light{};
        light.kind = NACRE_LIGHT_DIRECTIONAL;
        std::memcpy(light.direction, glm::value_ptr(block_.lightDirection), sizeof(light.direction));
        light.irradiance[0] = light.irradiance[1] = light.irradiance[2] = block_.lightDirection.w;
        light.shadowDepthEncoding = NACRE_DEPTH_HARDWARE;
        light.cascadeCount = cascadeCount;
        light.cascades = cascades;
        light.cascadeChoice = NACRE_CASCADE_BY_VIEW_DEPTH;
        for (std::uint32_t i = 0; i < cascadeCount; ++i) {
            std::memcpy(cascades[i].clipFromWorld, glm::value_ptr(block_.shadowClipFromWorld[i]), sizeof(glm::mat4));
            cascades[i].layer = i;
            cascades[i].farDepth = block_.cascadeEnds[static_cast<int>(i)];
        }
        return light;
    }
    // [end]

    // [snippet: raster-frame]
    void drawSubsurface(std::uint32_t index) {
        // Writing waits for what the frame before read; the contents are not needed any more.
        use(commands_, images_.scattered, computeWrite, true);
        use(commands_, images_.transmitted, computeWrite, true);
        use(commands_, images_.composed, computeWrite, true);
        check(context_.beginFrame(index)); // its fence has been waited for

        NacreScatterInfo scatter{};
        std::memcpy(scatter.view.clipFromView, glm::value_ptr(block_.clipFromView), sizeof(glm::mat4));
        std::memcpy(scatter.view.viewFromWorld, glm::value_ptr(block_.viewFromWorld), sizeof(glm::mat4));
        scatter.view.depthEncoding = NACRE_DEPTH_HARDWARE;
        scatter.irradiance = effectImage(images_.irradiance);
        scatter.depth = effectImage(surfaces().depth);
        scatter.materialId = effectImage(isMultisampled() ? images_.ids : images_.drawn.depth);
        if (!isMultisampled()) {
            scatter.materialId.view = images_.drawn.depth.stencilView;
        }
        scatter.scattered = effectImage(images_.scattered);
        check(context_.cmdScatter(commands_, scatter));

        NacreShadowCascade cascades[cascadeCount]{};
        const NacreLight light = sun(cascades);
        const NacreImage shadowMap = effectImage(images_.shadowMap);
        NacreTransmitInfo transmit{};
        transmit.view = scatter.view;
        transmit.depth = scatter.depth;
        transmit.materialId = scatter.materialId;
        transmit.normal = effectImage(surfaces().normal);
        transmit.lightCount = 1;
        transmit.lights = &light;
        transmit.shadowMapCount = 1;
        transmit.shadowMaps = &shadowMap;
        transmit.transmitted = effectImage(images_.transmitted);
        check(context_.cmdTransmit(commands_, transmit));

        use(commands_, images_.scattered, generalRead);
        use(commands_, images_.transmitted, generalRead);
        NacreComposeInfo compose{};
        compose.materialId = scatter.materialId;
        compose.scattered = effectImage(images_.scattered);
        compose.transmitted = effectImage(images_.transmitted);
        compose.albedo = effectImage(surfaces().albedo);
        compose.composed = effectImage(images_.composed);
        check(context_.cmdCompose(commands_, compose));
        use(commands_, images_.composed, generalRead);
    }
    // [end]

    void addSubsurface() {
        use(commands_, images_.picture, colorTarget);
        const VkRenderingAttachmentInfo colors[] = {
            target(images_.picture.view, colorTarget, VK_ATTACHMENT_LOAD_OP_LOAD)};
        drawScreen(pipelines_.add, colors);
    }

    void copyPicture() {
        use(commands_, images_.picture, copySource);
        VkMemoryBarrier2 reused{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2}; // the frame before wrote the same buffer
        reused.srcStageMask = reused.dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        reused.srcAccessMask = reused.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &reused;
        vkCmdPipelineBarrier2(commands_, &dependency);
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {extent_.width, extent_.height, 1};
        vkCmdCopyImageToBuffer(commands_, images_.picture.image, copySource.layout, pixels_.buffer, 1, &region);
    }

    NacreRequirements requirements_;
    Device device_;
    nacre::Context context_;
    Pipelines pipelines_{};
    Images images_;
    VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
    Buffer pixels_;
    VkExtent2D extent_{};
    FrameBlock block_{};
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

} // namespace

int main(int argc, char** argv) {
    try {
        const auto number = [&](int index, std::uint32_t otherwise) {
            return argc > index ? static_cast<std::uint32_t>(std::atoi(argv[index])) : otherwise;
        };
        const std::uint32_t framesInFlight = number(2, 2), samples = number(3, 1), times = number(4, 1);
        if (framesInFlight < 1 || framesInFlight > 8 || (samples != 1 && samples != 4) || times < 1 || times > 4) {
            throw std::runtime_error("frames in flight must be in [1, 8], samples 1 or 4, times in [1, 4]");
        }
        const auto extent = [times](VkExtent2D size) { return VkExtent2D{size.width * times, size.height * times}; };
        Renderer renderer(framesInFlight, static_cast<VkSampleCountFlagBits>(samples), extent(sizes[0]));
        for (int frame = 0; frame < frameCount; ++frame) {
            if (frame == frameCount / 2) {
                renderer.resize(extent(sizes[1]));
            }
            renderer.draw(frame);
        }
        renderer.save(argc > 1 ? argv[1] : "deferred.png");
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "deferred: %s\n", error.what());
        return 1;
    }
}
