#include "tests/gpu/support/effect.hpp"

#include "core/half.hpp"
#include "image/metrics.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nacre::tests {
namespace {

template <typename To, typename From, typename Convert>
std::vector<To> converted(const std::vector<From>& from, Convert convert) {
    std::vector<To> to;
    to.reserve(from.size());
    for (const From& value : from) {
        to.push_back(static_cast<To>(convert(value)));
    }
    return to;
}

std::vector<std::uint16_t> toHalves(const std::vector<Float4>& values) {
    std::vector<std::uint16_t> halves;
    for (const Float4& value : values) {
        for (const float channel : value) {
            halves.push_back(toHalf(channel));
        }
    }
    return halves;
}

/// An unsigned float of 5 exponent bits and `bits` of mantissa: a half without sign, its mantissa cut.
std::uint32_t toSmallFloat(float value, int bits) {
    return static_cast<std::uint32_t>(toHalf(value)) >> (10 - bits);
}

std::uint32_t toB10G11R11(const Float4& value) {
    return toSmallFloat(value[0], 6) | toSmallFloat(value[1], 6) << 11 | toSmallFloat(value[2], 5) << 22;
}

std::uint32_t toUnorm8(const Float4& value) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) {
        bits |= static_cast<std::uint32_t>(std::lround(255 * value[i])) << 8 * i;
    }
    return bits;
}

Float4 fromB10G11R11(std::uint32_t bits) {
    const auto channel = [](std::uint32_t value, int mantissa) {
        return fromHalf(static_cast<std::uint16_t>(value << (10 - mantissa)));
    };
    return {channel(bits & 0x7ff, 6), channel(bits >> 11 & 0x7ff, 6), channel(bits >> 22, 5), 1};
}

} // namespace

void uploadLight(Gpu& gpu, GpuImage& image, const std::vector<Float4>& light) {
    switch (image.format) {
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return gpu.upload(image, toHalves(light));
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
        return gpu.upload(image, converted<std::uint32_t>(light, toB10G11R11));
    case VK_FORMAT_R8G8B8A8_UNORM:
        return gpu.upload(image, converted<std::uint32_t>(light, toUnorm8));
    default:
        return gpu.upload(image, light);
    }
}

std::vector<Float4> downloadLight(Gpu& gpu, const GpuImage& image) {
    switch (image.format) {
    case VK_FORMAT_R16G16B16A16_SFLOAT: {
        const auto halves = gpu.download<std::array<std::uint16_t, 4>>(image);
        return converted<Float4>(halves, [](const std::array<std::uint16_t, 4>& h) {
            return Float4{fromHalf(h[0]), fromHalf(h[1]), fromHalf(h[2]), fromHalf(h[3])};
        });
    }
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
        return converted<Float4>(gpu.download<std::uint32_t>(image), fromB10G11R11);
    case VK_FORMAT_R32_SFLOAT:
        return converted<Float4>(gpu.download<float>(image), [](float value) { return Float4{value}; });
    case VK_FORMAT_R16_SFLOAT:
        return converted<Float4>(gpu.download<std::uint16_t>(image),
                                 [](std::uint16_t half) { return Float4{fromHalf(half)}; });
    default:
        return gpu.download<Float4>(image);
    }
}

void uploadIds(Gpu& gpu, GpuImage& image, const std::vector<std::uint16_t>& ids) {
    if (image.format == VK_FORMAT_R8_UINT) {
        gpu.upload(image, converted<std::uint8_t>(ids, [](std::uint16_t id) { return id; }));
    } else {
        gpu.upload(image, ids);
    }
}

Projection Projection::perspective(double width, double height, double focalLength, double centerX, double centerY) {
    Projection projection;
    auto& m = projection.clipFromView;
    m[0] = static_cast<float>(2 * focalLength / width);
    m[5] = static_cast<float>(-2 * focalLength / height);
    m[8] = static_cast<float>(1 - 2 * centerX / width);
    m[9] = static_cast<float>(1 - 2 * centerY / height);
    m[11] = -1;
    m[14] = 1;
    return projection;
}

Projection Projection::perspective(double width, double height, double focalLength) {
    return perspective(width, height, focalLength, width / 2, height / 2);
}

Projection Projection::orthographic(double width, double height, double pixelsPerMillimetre) {
    Projection projection;
    auto& m = projection.clipFromView;
    m[0] = static_cast<float>(2 * pixelsPerMillimetre / width);
    m[5] = static_cast<float>(-2 * pixelsPerMillimetre / height);
    m[10] = -1e-4f;
    m[15] = 1;
    return projection;
}

NacreView makeView(const Projection& projection) {
    NacreView view{};
    std::copy(projection.clipFromView.begin(), projection.clipFromView.end(), view.clipFromView);
    for (int i = 0; i < 4; ++i) {
        view.viewFromWorld[5 * i] = 1;
    }
    view.metersPerUnit = 1e-3f;
    return view;
}

ScatterInput ScatterInput::plane(std::uint32_t width, std::uint32_t height, const Projection& projection, float depth) {
    ScatterInput input;
    input.extent = {width, height};
    input.view = makeView(projection);
    const std::size_t count = std::size_t{width} * height;
    input.irradiance.assign(count, {1, 1, 1, 1});
    input.depth.assign(count, depth);
    input.materialId.assign(count, 1);
    return input;
}

ScatterImages::ScatterImages(Gpu& gpu, const ScatterInput& input, const ScatterFormats& formats) {
    info.view = input.view;
    images.reserve(7);
    const auto add = [&](NacreImage& slot, VkFormat format, auto&& upload) {
        const bool isDepth = format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
        images.push_back(gpu.createImage({.format = format,
                                          .extent = input.extent,
                                          .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                          .layout = isDepth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL
                                                            : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}));
        upload(images.back());
        slot = images.back().nacre();
    };
    add(info.irradiance, formats.irradiance, [&](GpuImage& image) { uploadLight(gpu, image, input.irradiance); });
    add(info.depth, formats.depth, [&](GpuImage& image) { gpu.upload(image, input.depth); });
    add(info.materialId, formats.materialId, [&](GpuImage& image) { uploadIds(gpu, image, input.materialId); });
    if (!input.normal.empty()) {
        add(info.normal, VK_FORMAT_R32G32B32A32_SFLOAT, [&](GpuImage& image) { gpu.upload(image, input.normal); });
    }
    if (!input.strength.empty()) {
        add(info.strength, VK_FORMAT_R32_SFLOAT, [&](GpuImage& image) { gpu.upload(image, input.strength); });
    }
    if (!input.scale.empty()) {
        add(info.scale, VK_FORMAT_R32_SFLOAT, [&](GpuImage& image) { gpu.upload(image, input.scale); });
    }
    if (!input.albedo.empty()) {
        add(info.albedo, formats.albedo, [&](GpuImage& image) { uploadLight(gpu, image, input.albedo); });
    }
    scattered = gpu.createImage({.format = formats.scattered,
                                 .extent = input.extent,
                                 .usage = VK_IMAGE_USAGE_STORAGE_BIT,
                                 .layout = VK_IMAGE_LAYOUT_GENERAL});
    info.scattered = scattered.nacre();
}

NacreTransmitInfo ScatterImages::transmitInfo(std::span<const NacreLight> lights,
                                              std::span<const NacreImage> shadowMaps) const {
    NacreTransmitInfo result{};
    result.view = info.view;
    result.depth = info.depth;
    result.materialId = info.materialId;
    result.normal = info.normal;
    result.strength = info.strength;
    result.scale = info.scale;
    result.lights = lights.data();
    result.lightCount = static_cast<std::uint32_t>(lights.size());
    result.shadowMaps = shadowMaps.data();
    result.shadowMapCount = static_cast<std::uint32_t>(shadowMaps.size());
    result.transmitted = info.scattered;
    return result;
}

NacreMaterial toNacre(const Material& material, std::vector<NacreLayer>& storage) {
    NacreMaterial result = nacreDefaultMaterial();
    storage.clear();
    for (const Layer& layer : material.layers) {
        storage.push_back({{static_cast<float>(layer.weight[0]), static_cast<float>(layer.weight[1]),
                            static_cast<float>(layer.weight[2])},
                           static_cast<float>(layer.variance)});
    }
    result.layers = storage.data();
    result.layerCount = static_cast<std::uint32_t>(storage.size());
    for (int channel = 0; material.meanFreePath && channel < 3; ++channel) {
        result.meanFreePath[channel] = static_cast<float>((*material.meanFreePath)[channel]);
    }
    result.albedoUse = material.albedoUse == AlbedoUse::PreAndPost ? NACRE_ALBEDO_PRE_AND_POST : NACRE_ALBEDO_POST;
    result.strength = static_cast<float>(material.strength);
    const double through = material.diffuseTransmission > 0 ? material.diffuseTransmission : 1;
    result.translucency = static_cast<float>(material.translucency * through);
    result.scale = static_cast<float>(material.scale);
    result.secondSurfaces = material.secondSurfaces.value_or(false);
    return result;
}

Effect::Effect(Gpu& owner, NacreContextInfo info) : gpu(owner) {
    info.userData = this;
    info.messageCallback = [](NacreSeverity, const char* message, void* self) {
        static_cast<Effect*>(self)->messages.emplace_back(message);
    };
    if (nacreCreateContext(&info, &context) != NACRE_SUCCESS) {
        throw std::runtime_error(messages.empty() ? "nacreCreateContext" : messages.back());
    }
}

void Effect::setMaterials(std::span<const Material> materials) {
    std::vector<std::vector<NacreLayer>> storage(materials.size());
    std::vector<NacreMaterial> converted;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        converted.push_back(toNacre(materials[i], storage[i]));
    }
    if (nacreSetMaterials(context, 1, static_cast<std::uint32_t>(converted.size()), converted.data()) !=
        NACRE_SUCCESS) {
        throw std::runtime_error(messages.back());
    }
}

std::vector<Float4> Effect::scatter(const ScatterInput& input, NacreTechnique technique,
                                    const ScatterFormats& formats) {
    return scatter(
        input, [technique](NacreScatterInfo& info) { info.technique = technique; }, formats);
}

std::vector<Float4> Effect::scatter(const ScatterInput& input, const std::function<void(NacreScatterInfo&)>& set,
                                    const ScatterFormats& formats) {
    ScatterImages images(gpu, input, formats);
    set(images.info);
    NacreResult result = nacreBeginFrame(context, 0);
    gpu.run([&](VkCommandBuffer commandBuffer) {
        result = result == NACRE_SUCCESS ? nacreCmdScatter(context, commandBuffer, &images.info) : result;
    });
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(messages.empty() ? nacreResultString(result) : messages.back());
    }
    return downloadLight(gpu, images.scattered);
}

Material skin() {
    Material material;
    material.name = "skin";
    material.layers = {{{0.233, 0.455, 0.649}, 0.0064}, {{0.100, 0.336, 0.344}, 0.0484}, {{0.118, 0.198, 0.000}, 0.187},
                       {{0.113, 0.007, 0.007}, 0.567},  {{0.358, 0.004, 0.000}, 1.99},   {{0.078, 0.000, 0.000}, 7.41}};
    return material;
}

Material marble() {
    Material material;
    material.name = "marble";
    material.layers = {{{0.0544578, 0.124549, 0.217725}, 0.0362209},
                       {{0.243663, 0.243532, 0.189042}, 0.114451},
                       {{0.310530, 0.315817, 0.374245}, 0.455584},
                       {{0.391349, 0.316102, 0.218988}, 3.48332}};
    return material;
}

Material burley() {
    Material material;
    material.name = "burley";
    material.meanFreePath = Rgb{0.757, 0.322, 0.2};
    return material;
}

double psnr(std::span<const Float4> image, std::span<const Float4> reference, std::span<const std::uint16_t> ids) {
    ErrorSums sums;
    for (std::size_t i = 0; i < image.size(); ++i) {
        for (int channel = 0; ids[i] != 0 && channel < 3; ++channel) {
            sums.add(image[i][channel], reference[i][channel]);
        }
    }
    return sums.psnr(1);
}

} // namespace nacre::tests
