#include "renderer/passes/environment.hpp"

#include "renderer/vulkan/transfer.hpp"

#include "environment_reflectance_comp.spv.h"
#include "environment_specular_comp.spv.h"
#include "scene/sky.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace nacre::renderer {
namespace {

constexpr std::uint32_t specularSize = 128;   ///< px, side of the sharpest cube level
constexpr std::uint32_t reflectanceSize = 64; ///< px
constexpr float largestHalf = 65504;

constexpr double pi = std::numbers::pi;

using Harmonics = std::array<double, 9>;

/// Real spherical harmonics up to degree 2 (Ramamoorthi and Hanrahan 2001, eq. 3).
Harmonics harmonics(const glm::dvec3& n) {
    return {0.282095,
            0.488603 * n.y,
            0.488603 * n.z,
            0.488603 * n.x,
            1.092548 * n.x * n.y,
            1.092548 * n.y * n.z,
            0.315392 * (3 * n.z * n.z - 1),
            1.092548 * n.x * n.z,
            0.546274 * (n.x * n.x - n.y * n.y)};
}

vk::raii::Sampler makeSkySampler(const Gpu& gpu, vk::SamplerAddressMode longitude) {
    return {gpu.device,
            {.magFilter = vk::Filter::eLinear,
             .minFilter = vk::Filter::eLinear,
             .mipmapMode = vk::SamplerMipmapMode::eLinear,
             .addressModeU = longitude,
             .addressModeV = vk::SamplerAddressMode::eClampToEdge,
             .addressModeW = vk::SamplerAddressMode::eClampToEdge,
             .maxLod = VK_LOD_CLAMP_NONE}};
}

} // namespace

std::array<glm::vec3, 9> irradianceHarmonics(const nacre::Image& image) {
    std::array<glm::dvec3, 9> sum{};
    double weight = 0;
    for (std::uint32_t row = 0; row < image.height; ++row) {
        const double theta = pi * (row + 0.5) / image.height;
        const double solidAngle = std::sin(theta);
        for (std::uint32_t column = 0; column < image.width; ++column) {
            const double phi = 2 * pi * ((column + 0.5) / image.width - 0.5);
            const Harmonics basis =
                harmonics({std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
            const float* pixel = &image.values[(std::size_t{row} * image.width + column) * 4];
            for (std::size_t i = 0; i < basis.size(); ++i) {
                sum[i] += glm::dvec3(pixel[0], pixel[1], pixel[2]) * (basis[i] * solidAngle);
            }
            weight += solidAngle;
        }
    }
    std::array<glm::vec3, 9> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double lobe = i == 0 ? pi : i < 4 ? 2 * pi / 3 : pi / 4;
        result[i] = glm::vec3(sum[i] * (4 * pi / weight * lobe));
    }
    return result;
}

Environment::Environment(Gpu& gpu, const scene::Environment& environment, std::uint32_t framesInFlight)
    : sampler_(makeSkySampler(gpu, vk::SamplerAddressMode::eRepeat)),
      clampSampler_(makeSkySampler(gpu, vk::SamplerAddressMode::eClampToEdge)) {
    const nacre::Image image = environment.image ? *environment.image : scene::makeSky(environment);
    if (image.width == 0 || image.values.size() != std::size_t{image.width} * image.height * 4) {
        throw RendererError("the environment image has " + std::to_string(image.values.size()) + " values for its " +
                            std::to_string(image.width) + "x" + std::to_string(image.height) + " pixels");
    }
    uploadRadiance(gpu, image);
    prefilter(gpu);
    const std::array<glm::vec3, 9> irradiance = irradianceHarmonics(image);
    std::transform(irradiance.begin(), irradiance.end(), constants_.irradiance,
                   [](const glm::vec3& value) { return glm::vec4(value, 0); });
    setLook(environment.intensity, environment.rotation);
    constantsBuffer_ = FrameBuffer(gpu, "environment constants", sizeof constants_,
                                   vk::BufferUsageFlagBits::eUniformBuffer, framesInFlight);
}

void Environment::setLook(float intensity, float rotation) {
    constants_.rotation = {std::cos(rotation), std::sin(rotation), intensity, 0};
}

void Environment::uploadRadiance(Gpu& gpu, const nacre::Image& image) {
    std::vector<std::uint16_t> halves(image.values.size());
    std::transform(image.values.begin(), image.values.end(), halves.begin(),
                   [](float value) { return glm::packHalf1x16(std::clamp(value, 0.0f, largestHalf)); });
    using Kind = vk::ImageUsageFlagBits;
    radiance_ =
        Image(gpu, {.name = "environment",
                    .format = vk::Format::eR16G16B16A16Sfloat,
                    .extent = {image.width, image.height},
                    .usage = Kind::eSampled | Kind::eTransferSrc | Kind::eTransferDst,
                    .mipLevels = static_cast<std::uint32_t>(std::bit_width(std::max(image.width, image.height)))});
    uploadImage(gpu, radiance_, std::as_bytes(std::span(halves)), usage::computeRead);
}

void Environment::prefilter(Gpu& gpu) {
    using Kind = vk::ImageUsageFlagBits;
    specular_ = Image(gpu, {.name = "prefiltered environment",
                            .format = vk::Format::eR16G16B16A16Sfloat,
                            .extent = {specularSize, specularSize},
                            .usage = Kind::eSampled | Kind::eStorage,
                            .layers = 6,
                            .mipLevels = shared::specularLevels,
                            .viewType = vk::ImageViewType::eCube});
    reflectance_ = Image(gpu, {.name = "specular reflectance",
                               .format = vk::Format::eR16G16B16A16Sfloat,
                               .extent = {reflectanceSize, reflectanceSize},
                               .usage = Kind::eSampled | Kind::eStorage});
    const ComputePass reflectancePass(gpu, "specular reflectance", environment_reflectance_comp_spv,
                                      {written(reflectance_)});
    std::vector<vk::raii::ImageView> views;
    std::vector<ComputePass> levels;
    for (std::uint32_t level = 0; level < shared::specularLevels; ++level) {
        views.push_back(specular_.makeView(gpu, vk::ImageViewType::e2DArray, level, 0, 6));
        levels.emplace_back(gpu, "environment prefilter", environment_specular_comp_spv,
                            std::vector{sampled(radiance_, sampler_), written(specular_, *views.back())},
                            static_cast<std::uint32_t>(sizeof(float)));
    }
    gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        reflectancePass.record(commandBuffer, 0, reflectance_.info().extent);
        for (std::uint32_t level = 0; level < shared::specularLevels; ++level) {
            const float roughness = static_cast<float>(level) / (shared::specularLevels - 1);
            const std::uint32_t side = specularSize >> level;
            levels[level].record(commandBuffer, 0, {side, side}, bytesOf(roughness), 6);
        }
        prepare(commandBuffer, {{specular_, usage::computeRead}, {reflectance_, usage::computeRead}});
    });
}

} // namespace nacre::renderer
