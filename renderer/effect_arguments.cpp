#include "renderer/effect_arguments.hpp"

#include "nacre/nacre_material.hpp"

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
    return callMaterial(material, layers);
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
