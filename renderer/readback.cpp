#include "renderer/readback.hpp"

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
Pixels readScattered(Gpu& gpu, const FrameImages& images) {
    Pixels pixels = read(gpu, images.lighting.irradiance(), rgb);
    if (!images.scatter) {
        return pixels;
    }
    const Pixels scattered = read(gpu, images.subsurface.scattered(), rgb);
    const bool hasAlbedo = images.subsurface.scatteredHasAlbedo();
    const Pixels albedo = hasAlbedo ? read(gpu, images.gbuffer.image(GBuffer::Albedo), rgb) : Pixels{};
    const Pixels material = read(gpu, images.gbuffer.image(GBuffer::MaterialId), {"ID"});
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
        if (material.values[i / rgb.size()] != 0) {
            const float share = hasAlbedo ? albedo.values[i] : 1.0f;
            pixels.values[i] = share > 0 ? scattered.values[i] / share : 0.0f;
        }
    }
    return pixels;
}

/// What transmission leaves behind; nothing where it is off.
Pixels readTransmission(Gpu& gpu, Image& image, const Names& channels, bool transmit) {
    Pixels pixels = read(gpu, image, channels);
    if (!transmit) {
        std::fill(pixels.values.begin(), pixels.values.end(), 0.0f);
    }
    return pixels;
}

/// Linear depth, infinite where there is nothing.
Pixels readDepth(Gpu& gpu, GBuffer& gbuffer) {
    Pixels pixels = read(gpu, gbuffer.image(GBuffer::Depth), {"Z"});
    const Pixels normal = read(gpu, gbuffer.image(GBuffer::ShadingNormal), {"X", "Y", "Z", "W"});
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
        if (normal.values[4 * i + 3] == 0) {
            pixels.values[i] = std::numeric_limits<float>::infinity();
        }
    }
    return pixels;
}

} // namespace

Pixels readOutput(Gpu& gpu, Output output, const FrameImages& images) {
    GBuffer& gbuffer = images.gbuffer;
    switch (output) {
    case Output::Color:
        return read(gpu, images.compose.color(), rgb);
    case Output::Radiance:
        return read(gpu, images.compose.radiance(), rgb);
    case Output::Irradiance:
        return read(gpu, images.lighting.irradiance(), rgb);
    case Output::Scattered:
        return readScattered(gpu, images);
    case Output::Transmitted:
        return readTransmission(gpu, images.subsurface.transmitted(), rgb, images.transmit);
    case Output::Depth:
        return readDepth(gpu, gbuffer);
    case Output::Normal:
        return read(gpu, gbuffer.image(GBuffer::ShadingNormal), {"X", "Y", "Z"});
    case Output::Material:
        return read(gpu, gbuffer.image(GBuffer::MaterialId), {"ID"});
    case Output::Thickness:
        return readTransmission(gpu, images.subsurface.thickness(), {"MM"}, images.transmit);
    case Output::Albedo:
        return read(gpu, gbuffer.image(GBuffer::Albedo), rgb);
    case Output::Specular:
        return read(gpu, images.lighting.specular(), rgb);
    }
    throw RendererError("there is no such output");
}

} // namespace nacre::renderer
