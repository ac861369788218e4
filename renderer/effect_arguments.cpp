#include "renderer/effect_arguments.hpp"

#include <algorithm>

namespace nacre::renderer {

NacreImage effectImage(const Image& image, const Usage& use) {
    const ImageInfo& info = image.info();
    return {.view = image.view(),
            .format = static_cast<VkFormat>(info.format),
            .layout = static_cast<VkImageLayout>(use.layout),
            .extent = info.extent,
            .usage = static_cast<VkImageUsageFlags>(info.usage)};
}

NacreImage effectImage(const Image& image) {
    return effectImage(image, image.lastUsage());
}

NacreMaterial effectMaterial(const Material& material, std::vector<NacreLayer>& layers) {
    for (const Layer& layer : material.layers) {
        NacreLayer converted{};
        std::transform(layer.weight.begin(), layer.weight.end(), converted.weight,
                       [](double weight) { return static_cast<float>(weight); });
        converted.variance = static_cast<float>(layer.variance);
        layers.push_back(converted);
    }
    NacreMaterial result = nacreDefaultMaterial();
    result.layers = layers.data();
    result.layerCount = static_cast<std::uint32_t>(layers.size());
    if (material.meanFreePath) {
        std::transform(material.meanFreePath->begin(), material.meanFreePath->end(), result.meanFreePath,
                       [](double length) { return static_cast<float>(length); });
    }
    result.albedoUse = material.albedoUse == AlbedoUse::PreAndPost ? NACRE_ALBEDO_PRE_AND_POST : NACRE_ALBEDO_POST;
    result.strength = static_cast<float>(material.strength);
    const double through = material.diffuseTransmission > 0 ? material.diffuseTransmission : 1;
    result.translucency = static_cast<float>(material.translucency * through);
    result.scale = static_cast<float>(material.scale);
    result.secondSurfaces = asksForSecondSurfaces(material);
    return result;
}

NacreContextInfo effectContextInfo(const Gpu& gpu) {
    NacreContextInfo info{};
    info.headerVersion = NACRE_HEADER_VERSION;
    info.instance = *gpu.instance;
    info.physicalDevice = *gpu.physicalDevice;
    info.device = *gpu.device;
    info.getInstanceProcAddr = gpu.context.getDispatcher()->vkGetInstanceProcAddr;
    info.shaderFloat16 = gpu.halfFloats;
    return info;
}

} // namespace nacre::renderer
