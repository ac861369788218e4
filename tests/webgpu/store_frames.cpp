// store_frames FOLDER: the gallery and some synthetic scenes as stored frames, a folder each, for the passes in WGSL
// (docs/webgpu.md).
#include "nacre/nacre_material.hpp"
#include "renderer/camera.hpp"
#include "renderer/frame.hpp"
#include "renderer/light_placement.hpp"
#include "renderer/readback.hpp"
#include "renderer/vulkan/open_device.hpp"
#include "scene/gallery/gallery.hpp"
#include "tests/gpu/support/scene_input.hpp"
#include "tests/webgpu/stored_frame.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <iostream>

namespace nacre::tests {
namespace {

constexpr VkExtent2D galleryExtent{480, 270};
constexpr std::uint32_t galleryMapSize = 512;

/// A frame's inputs, and materials 1, 2, …
struct Case {
    std::string name;
    ScatterInput input;
    std::vector<NacreMaterial> materials;
    std::vector<std::vector<NacreLayer>> layers;
    std::vector<NacreLight> lights;
    std::vector<float> shadowMaps; ///< layer after layer, `mapSize`² texels each
    std::uint32_t mapSize = 0;
};

void setMaterials(Case& frame, std::span<const Material> materials) {
    frame.layers.resize(materials.size());
    for (std::size_t i = 0; i < materials.size(); ++i) {
        frame.materials.push_back(callMaterial(materials[i], frame.layers[i]));
        frame.materials.back().secondSurfaces = VK_FALSE; // WGSL has none
    }
}

std::vector<Float4> fourChannels(const nacre::Image& image) {
    std::vector<Float4> result(std::size_t{image.width} * image.height, {0, 0, 0, 1});
    for (std::size_t i = 0; i < result.size(); ++i) {
        std::copy_n(&image.values[i * image.channels.size()], std::min<std::size_t>(3, image.channels.size()),
                    result[i].begin());
    }
    return result;
}

std::vector<float> downloadLayers(renderer::Gpu& gpu, renderer::Image& image) {
    const renderer::ImageInfo& info = image.info();
    const std::size_t count = std::size_t{info.extent.width} * info.extent.height * info.layers;
    const renderer::Buffer staging(gpu, "shadow maps, read back", sizeof(float) * count,
                                   vk::BufferUsageFlagBits::eTransferDst, renderer::Buffer::Place::ReadBack);
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        renderer::prepare(commandBuffer, {{image, renderer::usage::transferRead}});
        const vk::BufferImageCopy copy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, info.layers},
                                       .imageExtent = {info.extent.width, info.extent.height, 1}};
        commandBuffer.copyImageToBuffer(image.handle(), vk::ImageLayout::eTransferSrcOptimal, staging.handle(), copy);
        const vk::MemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eTransfer,
                                         .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                         .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                         .dstAccessMask = vk::AccessFlagBits2::eHostRead};
        commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
    });
    std::vector<float> texels(count);
    std::memcpy(texels.data(), staging.mapped(), sizeof(float) * count);
    return texels;
}

/// What the renderer hands to the effect for the gallery, with shading normals in place of its vertices'.
Case galleryCase() {
    const scene::Scene scene = scene::makeGallery();
    renderer::RenderSettings settings;
    settings.width = galleryExtent.width;
    settings.height = galleryExtent.height;
    settings.shadowMapSize = galleryMapSize;
    renderer::Device device{renderer::DeviceSettings{}};
    renderer::Gpu& gpu = device.implementation();
    renderer::Frame frame(device, scene, settings);
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        frame.record(commandBuffer, 0, {scene.cameras.front()});
    });
    const auto read = [&](renderer::Output output) {
        return readOutput(gpu, output, frame.images(), frame.effectUse(0));
    };
    Case result{.name = "gallery", .input = {}, .materials = {}, .layers = {}, .lights = {}, .shadowMaps = {}};
    setMaterials(result, scene.materials);
    result.input.extent = galleryExtent;
    result.input.irradiance = fourChannels(read(renderer::Output::Irradiance));
    result.input.normal = fourChannels(read(renderer::Output::Normal));
    result.input.depth = read(renderer::Output::Depth).values;
    for (const float id : read(renderer::Output::Material).values) {
        result.input.materialId.push_back(static_cast<std::uint16_t>(id));
    }
    const float aspect = static_cast<float>(galleryExtent.width) / static_cast<float>(galleryExtent.height);
    const renderer::View view = renderer::makeView(scene.cameras.front(), aspect, scene::bounds(scene));
    std::copy_n(glm::value_ptr(view.clipFromView), 16, result.input.view.clipFromView);
    std::copy_n(glm::value_ptr(view.viewFromWorld), 16, result.input.view.viewFromWorld);
    result.input.view.depthEncoding = NACRE_DEPTH_LINEAR;
    result.input.view.metersPerUnit = static_cast<float>(scene.metersPerUnit);
    renderer::LightPlacement placement(scene, galleryMapSize);
    result.lights = placement.placed().lights;
    result.mapSize = galleryMapSize;
    result.shadowMaps = downloadLayers(gpu, frame.images().shadowMaps);
    return result;
}

Case syntheticCase(SceneKind kind, double footprint) {
    const ScatterScene scene =
        makeScatterScene({.kind = kind, .footprint = footprint, .width = 240, .height = 135, .seed = 7, .materials = {}});
    Case result{.name = scene.name, .input = {}, .materials = {}, .layers = {}, .lights = {}, .shadowMaps = {}};
    result.input = toInput(scene);
    setMaterials(result, scene.materials);
    return result;
}

/// Materials that do not exchange light, an albedo before and after, strengths, light beyond half floats and light that
/// is none, and a render area that is a part of the images.
Case everythingCase() {
    Case result = syntheticCase(SceneKind::Foliage, 20);
    result.name = "everything";
    ScatterInput& input = result.input;
    for (std::uint32_t y = 0; y < input.extent.height; ++y) {
        for (std::uint32_t x = 0; x < input.extent.width; ++x) {
            input.strength.push_back(0.25f + 0.5f * static_cast<float>(x % 64) / 64);
            input.albedo.push_back({0.5f, 0.25f + 0.5f * static_cast<float>(y % 32) / 32, 0.75f, 1});
        }
    }
    for (std::uint32_t x = 20; x < 40; ++x) {
        input.irradiance[input.index(x, 60)] = {40000, 60000, 50000, 1};
    }
    input.irradiance[input.index(100, 60)][1] = std::numeric_limits<float>::infinity();
    input.view.renderArea = {{5, 3}, {222, 117}};
    for (std::size_t i = 0; i < result.materials.size(); ++i) {
        result.materials[i].exchangeGroups = 1u << i % 2;
        result.materials[i].strength = i == 0 ? 0.5f : 1.0f;
        result.materials[i].albedoUse = i == 1 ? NACRE_ALBEDO_PRE_AND_POST : NACRE_ALBEDO_POST;
    }
    return result;
}

void check(NacreResult result, const Effect& effect) {
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(effect.messages.empty() ? nacreResultString(result) : effect.messages.back());
    }
}

GpuImage createOutput(Gpu& gpu, VkExtent2D extent) {
    GpuImage image = gpu.createImage({.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                      .extent = extent,
                                      .usage = VK_IMAGE_USAGE_STORAGE_BIT,
                                      .layout = VK_IMAGE_LAYOUT_GENERAL});
    gpu.upload(image, std::vector<std::uint16_t>(std::size_t{4} * extent.width * extent.height));
    return image;
}

/// Runs the library on a frame, and stores both.
void store(Gpu& gpu, const Case& frame, const std::filesystem::path& folder) {
    const VkExtent2D extent = frame.input.extent;
    NacreContextInfo contextInfo = gpu.contextInfo(extent);
    contextInfo.techniques = 1u << NACRE_TECHNIQUE_BANK;
    contextInfo.maxMaterials = static_cast<std::uint32_t>(frame.materials.size());
    contextInfo.shaderFloat16 = VK_FALSE; // WGSL computes in floats
    Effect effect(gpu, contextInfo);
    check(nacreSetMaterials(effect.context, 1, contextInfo.maxMaterials, frame.materials.data()), effect);
    ScatterImages images(gpu, frame.input,
                         {.irradiance = VK_FORMAT_R16G16B16A16_SFLOAT, .albedo = VK_FORMAT_R16G16B16A16_SFLOAT});
    const GpuImage scattered = createOutput(gpu, extent);
    images.info.scattered = scattered.nacre();
    images.info.technique = NACRE_TECHNIQUE_BANK;
    check(nacreBeginFrame(effect.context, 0), effect);
    gpu.run([&](VkCommandBuffer commands) { check(nacreCmdScatter(effect.context, commands, &images.info), effect); });
    StoredFrame stored(folder / frame.name, extent, frame.materials);
    const char* const names[] = {"irradiance", "depth", "materialId", "normal", "strength", "albedo"};
    std::size_t next = 0;
    const NacreImage* const slots[] = {&images.info.irradiance, &images.info.depth,    &images.info.materialId,
                                       &images.info.normal,     &images.info.strength, &images.info.albedo};
    for (std::size_t i = 0; i < std::size(names); ++i) {
        if (slots[i]->view != VK_NULL_HANDLE) {
            stored.addImage(gpu, names[i], images.images[next++]);
        }
    }
    stored.addScatter(gpu, images.info, scattered);
    if (!frame.lights.empty()) {
        const GpuImage maps = gpu.createShadowMap(frame.mapSize, frame.shadowMaps);
        const GpuImage transmitted = createOutput(gpu, extent);
        const NacreImage map = maps.nacre();
        NacreTransmitInfo info = images.transmitInfo(frame.lights, std::span(&map, 1));
        info.transmitted = transmitted.nacre();
        gpu.run([&](VkCommandBuffer commands) { check(nacreCmdTransmit(effect.context, commands, &info), effect); });
        stored.addImage(gpu, "shadowMaps", maps);
        stored.addTransmit(gpu, info, transmitted);
    }
    stored.finish();
    std::cout << (folder / frame.name).string() << '\n';
}

void storeAll(const std::filesystem::path& folder) {
    Gpu& gpu = Gpu::instance();
    store(gpu, galleryCase(), folder);
    store(gpu, syntheticCase(SceneKind::Spheres, 60), folder);
    store(gpu, syntheticCase(SceneKind::Thin, 20), folder);
    store(gpu, everythingCase(), folder);
    for (const std::string& message : gpu.takeMessages()) {
        throw std::runtime_error(message);
    }
}

} // namespace
} // namespace nacre::tests

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: store_frames FOLDER\n";
        return 2;
    }
    try {
        nacre::tests::storeAll(arguments[1]);
    } catch (const std::exception& error) {
        std::cerr << "store_frames: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
