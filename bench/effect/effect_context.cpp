#include "bench/effect/effect_context.hpp"

#include "renderer/vulkan/transfer.hpp"

#include "core/half.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>

namespace nacre::bench {
namespace {

template <typename To, typename From, typename Convert>
std::vector<To> convertEach(std::span<const From> values, const Convert& convert) {
    std::vector<To> converted;
    converted.reserve(values.size());
    for (const From& value : values) {
        converted.push_back(convert(value));
    }
    return converted;
}

template <typename Texel> std::span<const std::byte> bytesOf(const std::vector<Texel>& texels) {
    return std::as_bytes(std::span(texels));
}

std::array<std::uint16_t, 4> toHalves(const Rgb& light) {
    return {toHalf(static_cast<float>(light[0])), toHalf(static_cast<float>(light[1])),
            toHalf(static_cast<float>(light[2])), toHalf(1.0f)};
}

std::array<std::uint8_t, 4> toBytes(const Rgb& light) {
    const auto channel = [&](int i) { return static_cast<std::uint8_t>(std::lround(255 * light[i])); };
    return {channel(0), channel(1), channel(2), 255};
}

} // namespace

EffectContext::EffectContext(const NacreContextInfo& info, std::span<const Material> materials) {
    NacreContextInfo withMessages = info;
    withMessages.userData = message_.get();
    withMessages.messageCallback = [](NacreSeverity severity, const char* message, void* userData) {
        if (severity == NACRE_SEVERITY_ERROR) {
            *static_cast<std::string*>(userData) = message;
        }
    };
    NacreContext context = nullptr;
    check(nacreCreateContext(&withMessages, &context));
    context_.reset(context);
    std::vector<std::vector<NacreLayer>> layers(materials.size());
    std::vector<NacreMaterial> converted;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        converted.push_back(renderer::effectMaterial(materials[i], layers[i]));
    }
    if (!converted.empty()) {
        check(nacreSetMaterials(context, 1, static_cast<std::uint32_t>(converted.size()), converted.data()));
    }
}

void EffectContext::check(NacreResult result) const {
    if (result != NACRE_SUCCESS) {
        throw renderer::RendererError("the effect refused: " +
                                      (message_->empty() ? std::string(nacreResultString(result)) : *message_));
    }
}

NacreView perspectiveView(VkExtent2D extent, double focalLength) {
    NacreView view{};
    view.clipFromView[0] = static_cast<float>(2 * focalLength / extent.width);
    view.clipFromView[5] = static_cast<float>(-2 * focalLength / extent.height);
    view.clipFromView[11] = -1;
    view.clipFromView[14] = 1;
    for (int i = 0; i < 4; ++i) {
        view.viewFromWorld[5 * i] = 1;
    }
    view.metersPerUnit = 1e-3f;
    return view;
}

renderer::Image& EffectImages::addInput(renderer::ImageInfo info, std::span<const std::byte> texels) {
    using Kind = vk::ImageUsageFlagBits;
    info.usage = Kind::eSampled | Kind::eTransferSrc | Kind::eTransferDst;
    renderer::Image& image = images_.emplace_back(gpu_, info);
    renderer::uploadImage(gpu_, image, texels, renderer::usage::computeRead);
    return image;
}

renderer::Image& EffectImages::addLight(const std::string& name, vk::Format format, std::span<const Rgb> light) {
    const renderer::ImageInfo info{.name = name, .format = format, .extent = extent_};
    if (format == vk::Format::eR8G8B8A8Unorm) {
        return addInput(info, bytesOf(convertEach<std::array<std::uint8_t, 4>>(light, toBytes)));
    }
    if (format == vk::Format::eB10G11R11UfloatPack32) {
        const auto pack = [](const Rgb& value) { return glm::packF2x11_1x10(glm::vec3(value[0], value[1], value[2])); };
        return addInput(info, bytesOf(convertEach<std::uint32_t>(light, pack)));
    }
    return addInput(info, bytesOf(convertEach<std::array<std::uint16_t, 4>>(light, toHalves)));
}

renderer::Image& EffectImages::addDepth(std::span<const float> depth) {
    return addInput({.name = "depth", .format = vk::Format::eR32Sfloat, .extent = extent_}, std::as_bytes(depth));
}

renderer::Image& EffectImages::addIds(vk::Format format, std::span<const std::uint16_t> ids) {
    const renderer::ImageInfo info{.name = "material ids", .format = format, .extent = extent_};
    if (format == vk::Format::eR8Uint) {
        const auto narrow = [](std::uint16_t id) { return static_cast<std::uint8_t>(id); };
        return addInput(info, bytesOf(convertEach<std::uint8_t>(ids, narrow)));
    }
    return addInput(info, std::as_bytes(ids));
}

renderer::Image& EffectImages::addShadowMap(std::uint32_t size, std::span<const float> texels) {
    return addInput({.name = "shadow map",
                     .format = vk::Format::eR32Sfloat,
                     .extent = {size, size},
                     .layers = static_cast<std::uint32_t>(texels.size() / (std::size_t{size} * size)),
                     .viewType = vk::ImageViewType::e2DArray},
                    std::as_bytes(texels));
}

renderer::Image& EffectImages::addOutput(const std::string& name, vk::Format format) {
    renderer::Image& image = images_.emplace_back(
        gpu_, renderer::ImageInfo{
                  .name = name, .format = format, .extent = extent_, .usage = vk::ImageUsageFlagBits::eStorage});
    gpu_.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        renderer::prepare(commandBuffer, {{image, renderer::usage::computeWrite}});
    });
    return image;
}

} // namespace nacre::bench
