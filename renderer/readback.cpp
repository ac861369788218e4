#include "renderer/readback.hpp"

#include "renderer/vulkan/transfer.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

namespace nacre::renderer {
namespace {

using Names = std::vector<std::string>;

const Names rgb{"R", "G", "B"};

/// The first `channels` of every pixel of an image, whose pixels have `stride` values.
template <typename Value, typename Convert>
std::vector<float> convert(const std::vector<std::byte>& bytes, std::size_t stride, std::size_t channels,
                           const Convert& toFloat) {
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    std::vector<float> result(values.size() / stride * channels);
    for (std::size_t from = 0, to = 0; to < result.size(); from += stride, to += channels) {
        for (std::size_t channel = 0; channel < channels; ++channel) {
            result[to + channel] = toFloat(values[from + channel]);
        }
    }
    return result;
}

/// The values of all halves: large pictures are read far faster with them.
const std::vector<float>& halves() {
    static const std::vector<float> values = [] {
        std::vector<float> result(65536);
        for (std::uint32_t bits = 0; bits < result.size(); ++bits) {
            result[bits] = glm::unpackHalf1x16(static_cast<std::uint16_t>(bits));
        }
        return result;
    }();
    return values;
}

std::vector<float> toFloats(vk::Format format, const std::vector<std::byte>& bytes, std::size_t channels) {
    switch (format) {
    case vk::Format::eR16G16B16A16Sfloat:
    case vk::Format::eR16Sfloat: {
        const std::size_t stride = format == vk::Format::eR16Sfloat ? 1 : 4;
        return convert<std::uint16_t>(bytes, stride, channels,
                                      [&values = halves()](std::uint16_t half) { return values[half]; });
    }
    case vk::Format::eR16Uint:
        return convert<std::uint16_t>(bytes, 1, channels, [](std::uint16_t value) { return float(value); });
    case vk::Format::eR8G8B8A8Unorm:
        return convert<std::uint8_t>(bytes, 4, channels, [](std::uint8_t value) { return float(value) / 255.0f; });
    default:
        return convert<float>(bytes, 1, channels, [](float value) { return value; });
    }
}

/// The first channels of the image's pixels.
Pixels read(Gpu& gpu, Image& image, const Names& channels) {
    const vk::Extent2D extent = image.info().extent;
    return {extent.width, extent.height, channels,
            toFloats(image.info().format, downloadImage(gpu, image), channels.size())};
}

/// The irradiance after scattering: where there is a material, the effect's output, over the albedo if it has that in
/// it.
Pixels readScattered(Gpu& gpu, const FrameImages& images, const EffectUse& use) {
    Pixels pixels = read(gpu, images.irradiance, rgb);
    if (!use.scatter) {
        return pixels;
    }
    const Pixels scattered = read(gpu, images.scattered, rgb);
    const Pixels albedo = use.scatteredHasAlbedo ? read(gpu, images.albedo, rgb) : Pixels{};
    const Pixels material = read(gpu, images.materialId, {"ID"});
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
        if (material.values[i / rgb.size()] != 0) {
            const float share = use.scatteredHasAlbedo ? albedo.values[i] : 1.0f;
            pixels.values[i] = share > 0 ? scattered.values[i] / share : 0.0f;
        }
    }
    return pixels;
}

/// What transmission leaves behind; nothing where it is off.
Pixels readTransmission(Gpu& gpu, Image& image, const Names& channels, const EffectUse& use) {
    Pixels pixels = read(gpu, image, channels);
    if (!use.transmit) {
        std::fill(pixels.values.begin(), pixels.values.end(), 0.0f);
    }
    return pixels;
}

/// Linear depth, infinite where there is nothing.
Pixels readDepth(Gpu& gpu, const FrameImages& images) {
    Pixels pixels = read(gpu, images.depth, {"Z"});
    const Pixels normal = read(gpu, images.shadingNormal, {"X", "Y", "Z", "W"});
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
        if (normal.values[4 * i + 3] == 0) {
            pixels.values[i] = std::numeric_limits<float>::infinity();
        }
    }
    return pixels;
}

Pixels readThickness(Gpu& gpu, const FrameImages& images, const EffectUse& use) {
    if (images.thickness == nullptr) {
        throw RendererError("the thickness cannot be read, RenderSettings::thickness is false");
    }
    return readTransmission(gpu, *images.thickness, {"MM"}, use);
}

} // namespace

Pixels readOutput(Gpu& gpu, Output output, const FrameImages& images, const EffectUse& use) {
    switch (output) {
    case Output::Color: {
        Pixels pixels = read(gpu, images.color, rgb);
        pixels.encoding = Encoding::Srgb;
        return pixels;
    }
    case Output::Radiance:
        return read(gpu, images.radiance, rgb);
    case Output::Irradiance:
        return read(gpu, images.irradiance, rgb);
    case Output::Scattered:
        return readScattered(gpu, images, use);
    case Output::Transmitted:
        return readTransmission(gpu, images.transmitted, rgb, use);
    case Output::Depth:
        return readDepth(gpu, images);
    case Output::Normal:
        return read(gpu, images.shadingNormal, {"X", "Y", "Z"});
    case Output::Material:
        return read(gpu, images.materialId, {"ID"});
    case Output::Thickness:
        return readThickness(gpu, images, use);
    case Output::Albedo:
        return read(gpu, images.albedo, rgb);
    case Output::Specular:
        return read(gpu, images.specular, rgb);
    }
    throw RendererError("there is no such output");
}

} // namespace nacre::renderer
