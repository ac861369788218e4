#include "bench/effect/scatter_subject.hpp"

#include <cmath>
#include <cstdio>

namespace nacre::bench {
namespace {

VkExtent2D extentOf(const ScatterScene& scene) {
    return {static_cast<std::uint32_t>(scene.width), static_cast<std::uint32_t>(scene.height)};
}

std::vector<float> depthOf(const ScatterScene& scene) {
    return {scene.depth.begin(), scene.depth.end()};
}

} // namespace

std::string ScatterSubject::label() const {
    char text[128];
    std::snprintf(text, sizeof text, "%s %ux%u cover %.0f%% footprint %.0f px, %d layers, %d materials",
                  sceneKindName(kind), extent.width, extent.height, 100 * coverage, footprint, layers, materials);
    const bool inBlocks = kind == SceneKind::Plane && materials > 1;
    return text + (inBlocks ? " in blocks of " + std::to_string(block) + " px" : std::string());
}

Material layeredSkin(int layers) {
    Material skin = testMaterials().front();
    if (static_cast<std::size_t>(layers) == skin.layers.size()) {
        return skin;
    }
    Material material;
    material.name = "layers";
    for (int i = 0; i < layers; ++i) {
        const double share = layers == 1 ? 1 : i / (layers - 1.0);
        const double variance = layers == 1 ? 1.38 : 0.0064 * std::pow(7.41 / 0.0064, share);
        material.layers.push_back({{1, 1 - 0.5 * share, 1 - 0.9 * share}, variance});
    }
    return material;
}

ScatterScene makeSubjectScene(const ScatterSubject& subject) {
    ScatterScene scene = makeScatterScene({.kind = subject.kind,
                                           .footprint = subject.footprint,
                                           .width = static_cast<int>(subject.extent.width),
                                           .height = static_cast<int>(subject.extent.height)});
    if (subject.kind == SceneKind::Plane) {
        scene.materials.assign(static_cast<std::size_t>(subject.materials), layeredSkin(subject.layers));
    }
    for (Material& material : scene.materials) {
        material.secondSurfaces = false; // none asks for another technique than the one that is timed
    }
    return scene;
}

std::vector<std::uint16_t> scatterIds(const ScatterScene& scene, const ScatterSubject& subject) {
    if (subject.kind != SceneKind::Plane) {
        return {scene.materialId.begin(), scene.materialId.end()};
    }
    const auto [width, height] = subject.extent;
    const double half = 0.5 * std::sqrt(subject.coverage);
    std::vector<std::uint16_t> ids;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const bool covered =
                std::abs((x + 0.5) / width - 0.5) <= half && std::abs((y + 0.5) / height - 0.5) <= half;
            const std::uint32_t block = x / subject.block + y / subject.block * (width / subject.block);
            const std::uint32_t id = 1 + block % static_cast<std::uint32_t>(subject.materials);
            ids.push_back(static_cast<std::uint16_t>(covered ? id : 0));
        }
    }
    return ids;
}

ScatterImages::ScatterImages(renderer::Gpu& gpu, const ScatterScene& scene, std::span<const std::uint16_t> ids,
                             bool wideIds, bool albedo, vk::Format lightFormat)
    : images(gpu, extentOf(scene)),
      irradiance(images.addLight("irradiance", lightFormat, scene.irradiance)),
      depth(images.addDepth(depthOf(scene))),
      materialId(images.addIds(wideIds ? vk::Format::eR16Uint : vk::Format::eR8Uint, ids)) {
    info.view = perspectiveView(extentOf(scene), scene.focalLength);
    info.irradiance = effectImage(irradiance);
    info.depth = effectImage(depth);
    info.materialId = effectImage(materialId);
    if (albedo) {
        const std::vector<Rgb> values(scene.depth.size(), Rgb{0.75, 0.5, 0.25});
        info.albedo = effectImage(images.addLight("albedo", vk::Format::eR8G8B8A8Unorm, values));
    }
    info.scattered = effectImage(images.addOutput("scattered", lightFormat));
}

} // namespace nacre::bench
