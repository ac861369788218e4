// store_frames FOLDER [FRAME...]: the gallery and some synthetic scenes, or these of them, as stored frames, a folder
// each, for the passes in WGSL (docs/webgpu.md).
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
    std::vector<float> thickness;                            ///< mm; empty = none
    std::vector<std::array<NacreShadowCascade, 2>> cascades; ///< of the lights that have some
    bool isEncoded = false;                                  ///< without ids, with octahedral normals in view space
    std::vector<Float4> surfaceColor;                        ///< albedo that the effect does not get, for pictures
    double exposure = 3.14159265;                            ///< of pictures
};

Case namedCase(std::string name) {
    Case result;
    result.name = std::move(name);
    return result;
}

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
    gpu.submitAndWait(
        [&](const vk::raii::CommandBuffer& commandBuffer) { frame.record(commandBuffer, 0, {scene.cameras.front()}); });
    const auto read = [&](renderer::Output output) {
        return readOutput(gpu, output, frame.images(), frame.effectUse(0));
    };
    Case result = namedCase("gallery");
    setMaterials(result, scene.materials);
    result.input.extent = galleryExtent;
    result.input.irradiance = fourChannels(read(renderer::Output::Irradiance));
    result.input.normal = fourChannels(read(renderer::Output::Normal));
    result.input.depth = read(renderer::Output::Depth).values;
    result.surfaceColor = fourChannels(read(renderer::Output::Albedo));
    result.exposure = scene.exposure;
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
    const ScatterScene scene = makeScatterScene(
        {.kind = kind, .footprint = footprint, .width = 240, .height = 135, .seed = 7, .materials = {}});
    Case result = namedCase(sceneKindName(kind));
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
            input.scale.push_back(0.5f + static_cast<float>(x / 2 % 32) / 16);
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

constexpr double slabDepth = 500;     // mm, of its near side from the camera
constexpr double lightDistance = 500; // mm, of the lights behind it
constexpr double slabThickness = 3;   // mm
constexpr std::uint32_t slabMapSize = 48;

/// A layer of a map behind the slab: `value` of how far its far side is from the light at a place in [-1, 1]².
void addLayer(Case& frame, const std::function<double(double x, double y)>& value) {
    for (std::uint32_t i = 0; i < slabMapSize * slabMapSize; ++i) {
        const double x = 2 * (i % slabMapSize + 0.5) / slabMapSize - 1;
        const double y = 2 * (i / slabMapSize + 0.5) / slabMapSize - 1;
        frame.shadowMaps.push_back(static_cast<float>(value(x, y)));
    }
}

/// Along +z from (0, 0, -1000): clip z = s / 1000 or, where it is perspective, 100 / s.
void setMatrix(float (&m)[16], double reach, bool isPerspective) {
    m[0] = m[5] = static_cast<float>(1 / reach);
    m[10] = isPerspective ? 0.0f : 1e-3f;
    m[11] = isPerspective ? 1.0f : 0.0f;
    m[14] = isPerspective ? 100.0f : 1.0f;
    m[15] = isPerspective ? 1000.0f : 1.0f;
}

NacreLight slabLight(NacreLightKind kind, std::uint32_t layer, NacreDepthEncoding encoding) {
    NacreLight light{};
    light.kind = kind;
    light.position[2] = static_cast<float>(-slabDepth - lightDistance);
    light.direction[2] = 1;
    const float irradiance = kind == NACRE_LIGHT_DIRECTIONAL ? 1.0f : 0.2f;
    std::fill(std::begin(light.irradiance), std::end(light.irradiance), irradiance);
    light.shadowLayer = layer;
    light.shadowRange = encoding == NACRE_DEPTH_LINEAR ? 1000.0f : 0.0f;
    light.shadowDepthEncoding = encoding;
    return light;
}

/// How far the slab's far side is from the plane of the lights, mm, where x counts half slabs: it leans, and has a
/// step.
double farSide(double x) {
    return lightDistance - slabThickness - 1.5 * x - (x > 0.5 ? 1.0 : 0.0);
}

/// A slab with a light of every kind behind it, and hardware depth throughout.
Case lightsCase() {
    Case result = namedCase("lights");
    constexpr VkExtent2D extent{120, 80};
    constexpr double reach = 60; // mm, half side of the maps at the slab
    result.input = ScatterInput::plane(extent.width, extent.height,
                                       Projection::perspective(extent.width, extent.height, extent.width * 5), 0);
    result.input.view.depthEncoding = NACRE_DEPTH_HARDWARE;
    for (std::uint32_t i = 0; i < extent.width * extent.height; ++i) {
        const double x = (i % extent.width + 0.5) / extent.width - 0.5;
        result.input.depth[i] = static_cast<float>(1 / (slabDepth + 4 * x)); // near 1
        result.input.normal.push_back({0.08f, 0, 0.9968f, 0});
        result.input.materialId[i] = i / extent.width < 50 ? 1 : i % 7 == 0 ? 0 : 2;
        result.input.irradiance[i] = i % extent.width / 10 % 2 == 0 ? Float4{1, 0.8f, 0.6f, 1} : Float4{0, 0, 0, 1};
        result.thickness.push_back(i % 31 < 6 ? 2.5f : 0.0f);
        result.input.scale.push_back(i % 17 < 8 ? 1.0f : 0.7f);
    }
    const std::vector<Material> materials{skin(), marble()};
    setMaterials(result, materials);
    result.materials[1].thickness = 4;
    result.mapSize = slabMapSize;
    result.lights = {slabLight(NACRE_LIGHT_DIRECTIONAL, 0, NACRE_DEPTH_LINEAR),
                     slabLight(NACRE_LIGHT_SPOT, 1, NACRE_DEPTH_HARDWARE),
                     slabLight(NACRE_LIGHT_DIRECTIONAL, 2, NACRE_DEPTH_HARDWARE),
                     slabLight(NACRE_LIGHT_DIRECTIONAL, 4, NACRE_DEPTH_HARDWARE),
                     slabLight(NACRE_LIGHT_POINT, 5, NACRE_DEPTH_LINEAR)};
    // Linear: nothing, and a body's back, beside the slab.
    setMatrix(result.lights[0].shadowClipFromWorld, reach, false);
    addLayer(result, [](double x, double y) { return y > 0.6 ? 1.0 : (y < -0.7 ? -1e-3 : 1e-3) * farSide(x); });
    setMatrix(result.lights[1].shadowClipFromWorld, reach / lightDistance, true);
    result.lights[1].innerConeAngle = 0.05f;
    result.lights[1].outerConeAngle = 0.1f;
    result.lights[1].attenuation[0] = 0.5f;
    result.lights[1].attenuation[2] = 1;
    addLayer(result, [](double x, double) { return 100 / farSide(x); });
    // Two cascades, of which the second has twice the reach of the first.
    result.cascades.resize(1);
    for (std::uint32_t i = 0; i < 2; ++i) {
        const double cascadeReach = 25.0 * (i + 1);
        NacreShadowCascade& cascade = result.cascades[0][i];
        setMatrix(cascade.clipFromWorld, cascadeReach, false);
        cascade.layer = 2 + i;
        addLayer(result, [=](double x, double) { return 1e-3 * farSide(x * cascadeReach / reach) + 1e-4 * i; });
    }
    result.lights[2].cascadeCount = 2;
    result.lights[2].cascades = result.cascades[0].data();
    result.lights[2].cascadeBlend = 0.3f;
    // Only an atlas's quarter, of what looks away from the light: the receiver itself.
    result.lights[3].shadowRectangle = {{20, 10}, {24, 30}};
    result.lights[3].shadowFrontFacesCulled = VK_TRUE;
    setMatrix(result.lights[3].shadowClipFromWorld, reach, false);
    addLayer(result, [](double, double y) { return 1e-3 * (y > 0.2 ? 480 : 500); });
    for (int face = 0; face < 6; ++face) {
        addLayer(result, [face](double x, double y) {
            return face == 4 ? 1e-3 * (lightDistance - slabThickness) * std::sqrt(1 + x * x + y * y) : 1.0;
        });
    }
    result.lights[4].range = 2000;
    // One from the side without a map, which only authored thickness lets through.
    result.lights.push_back(slabLight(NACRE_LIGHT_DIRECTIONAL, 0, NACRE_DEPTH_LINEAR));
    result.lights[5].direction[0] = 5;
    result.lights[5].irradiance[0] = 20;
    result.lights[5].shadowMap = NACRE_NO_SHADOW_MAP;
    return result;
}

/// A normal as NACRE_NORMAL_OCTAHEDRAL has it.
Float4 octahedral(const Float4& n) {
    const float sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    const float x = n[0] / sum;
    const float y = n[1] / sum;
    return n[2] >= 0 ? Float4{x, y, 0, 0}
                     : Float4{std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), 0, 0};
}

/// The same slab of one material where its strength says so, some of whose normals look away from the camera.
Case encodedCase() {
    Case result = lightsCase();
    result.name = "encoded";
    result.isEncoded = true;
    result.materials.resize(1);
    for (std::size_t i = 0; i < result.input.normal.size(); ++i) {
        result.input.strength.push_back(result.input.materialId[i] == 1   ? 0.6f
                                        : result.input.materialId[i] == 0 ? 0
                                                                          : 1);
        result.input.materialId[i] = result.input.strength[i] > 0 ? 1 : 0; // for who compares
        result.input.normal[i] = octahedral(i % 5 == 0 ? Float4{0.4f, -0.5f, -0.77f, 0} : result.input.normal[i]);
    }
    return result;
}

void check(NacreResult result, const Effect& effect) {
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(effect.messages.empty() ? nacreResultString(result) : effect.messages.back());
    }
}

GpuImage createOutput(Gpu& gpu, VkExtent2D extent, VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT) {
    GpuImage image = gpu.createImage(
        {.format = format, .extent = extent, .usage = VK_IMAGE_USAGE_STORAGE_BIT, .layout = VK_IMAGE_LAYOUT_GENERAL});
    gpu.upload(image, std::vector<std::byte>(texelBytes(format) * extent.width * extent.height));
    return image;
}

constexpr VkFormat halves = VK_FORMAT_R16G16B16A16_SFLOAT;

/// What scatter reads, under its name.
void addImages(Gpu& gpu, StoredFrame& stored, const ScatterImages& images) {
    const std::pair<const char*, const NacreImage*> slots[] = {
        {"irradiance", &images.info.irradiance}, {"depth", &images.info.depth},
        {"materialId", &images.info.materialId}, {"normal", &images.info.normal},
        {"strength", &images.info.strength},     {"scale", &images.info.scale},
        {"albedo", &images.info.albedo}};
    std::size_t next = 0; // those that are given follow one another
    for (const auto& [name, slot] : slots) {
        if (slot->view != VK_NULL_HANDLE) {
            stored.addImage(gpu, name, images.images[next++]);
        }
    }
}

GpuImage createInput(Gpu& gpu, VkExtent2D extent, VkFormat format) {
    return gpu.createImage({.format = format,
                            .extent = extent,
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                            .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

/// What light comes through of a frame's lights.
void storeTransmit(Effect& effect, const Case& frame, const ScatterImages& images, StoredFrame& stored) {
    Gpu& gpu = effect.gpu;
    const VkExtent2D extent = frame.input.extent;
    const GpuImage maps = gpu.createShadowMap(frame.mapSize, frame.shadowMaps);
    const NacreImage map = maps.nacre();
    const GpuImage transmitted = createOutput(gpu, extent);
    const GpuImage thicknessOut = createOutput(gpu, extent, VK_FORMAT_R32_SFLOAT);
    NacreTransmitInfo info = images.transmitInfo(frame.lights, std::span(&map, 1));
    GpuImage thickness;
    if (!frame.thickness.empty()) {
        thickness = createInput(gpu, extent, VK_FORMAT_R32_SFLOAT);
        gpu.upload(thickness, frame.thickness);
        info.thickness = thickness.nacre();
        stored.addImage(gpu, "thickness", thickness);
    }
    info.transmitted = transmitted.nacre();
    info.thicknessOut = thicknessOut.nacre();
    NacreTransmitInfo called = info;
    called.materialId = frame.isEncoded ? NacreImage{} : info.materialId;
    gpu.run([&](VkCommandBuffer commands) { check(nacreCmdTransmit(effect.context, commands, &called), effect); });
    stored.addImage(gpu, "shadowMaps", maps);
    stored.addTransmit(gpu, info, transmitted, thicknessOut);
}

/// Runs the library on a frame, and stores both.
void store(Gpu& gpu, const Case& frame, const std::filesystem::path& folder) {
    const VkExtent2D extent = frame.input.extent;
    NacreContextInfo contextInfo = gpu.contextInfo(extent);
    contextInfo.techniques = 1u << NACRE_TECHNIQUE_BANK;
    contextInfo.maxMaterials = static_cast<std::uint32_t>(frame.materials.size());
    contextInfo.shaderFloat16 = VK_FALSE; // WGSL computes in floats
    contextInfo.noMaterialIds = frame.isEncoded;
    contextInfo.normalEncoding = frame.isEncoded ? NACRE_NORMAL_OCTAHEDRAL : NACRE_NORMAL_XYZ;
    contextInfo.normalSpace = frame.isEncoded ? NACRE_NORMAL_VIEW : NACRE_NORMAL_WORLD;
    Effect effect(gpu, contextInfo);
    check(nacreSetMaterials(effect.context, 1, contextInfo.maxMaterials, frame.materials.data()), effect);
    ScatterImages images(gpu, frame.input, {.irradiance = halves, .albedo = halves});
    const GpuImage scattered = createOutput(gpu, extent);
    images.info.scattered = scattered.nacre();
    images.info.technique = NACRE_TECHNIQUE_BANK;
    check(nacreBeginFrame(effect.context, 0), effect);
    NacreScatterInfo scatter = images.info;
    scatter.materialId = frame.isEncoded ? NacreImage{} : scatter.materialId;
    gpu.run([&](VkCommandBuffer commands) { check(nacreCmdScatter(effect.context, commands, &scatter), effect); });
    StoredFrame stored(folder / frame.name, extent, contextInfo, frame.materials);
    addImages(gpu, stored, images);
    stored.addScatter(gpu, images.info, scattered);
    if (!frame.lights.empty()) {
        storeTransmit(effect, frame, images, stored);
    }
    if (!frame.surfaceColor.empty()) { // after the calls: they do not have it
        GpuImage albedo = createInput(gpu, extent, halves);
        uploadLight(gpu, albedo, frame.surfaceColor);
        stored.addImage(gpu, "albedo", albedo);
    }
    stored.finish(frame.exposure);
    std::cout << (folder / frame.name).string() << '\n';
}

void storeAll(const std::filesystem::path& folder, std::span<char* const> names) {
    const std::pair<std::string, std::function<Case()>> cases[] = {
        {"gallery", galleryCase},
        {"spheres", [] { return syntheticCase(SceneKind::Spheres, 60); }},
        {"thin", [] { return syntheticCase(SceneKind::Thin, 20); }},
        {"everything", everythingCase},
        {"lights", lightsCase},
        {"encoded", encodedCase},
    };
    Gpu& gpu = Gpu::instance();
    for (const auto& [name, make] : cases) {
        if (names.empty() || std::find(names.begin(), names.end(), name) != names.end()) {
            store(gpu, make(), folder);
        }
    }
    for (const std::string& message : gpu.takeMessages()) {
        throw std::runtime_error(message);
    }
}

} // namespace
} // namespace nacre::tests

int main(int count, char** arguments) {
    if (count < 2) {
        std::cerr << "usage: store_frames FOLDER [FRAME...]\n";
        return 2;
    }
    try {
        nacre::tests::storeAll(arguments[1], std::span(arguments, count).subspan(2));
    } catch (const std::exception& error) {
        std::cerr << "store_frames: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
