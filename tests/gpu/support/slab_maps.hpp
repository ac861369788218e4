// Shadow maps of a slab, and the thickness that transmission finds by them. Lengths in mm.
#pragma once

#include "tests/gpu/support/effect.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::tests {

inline constexpr std::uint32_t imageSize = 40;
inline constexpr double pixel = 1; // mm
inline constexpr double receiverDepth = 500;
inline constexpr double lightDepth = 1000;
inline constexpr double thickness = 3;
inline constexpr float nearPlane = 100, farPlane = 2000;

/// How clip z and w follow from the distance s along the light's axis: (z·s + z1) / (w·s + w1).
struct Depth {
    const char* name;
    double z, z1, w, w1;
    double at(double s) const { return (z * s + z1) / (w * s + w1); }
};
inline constexpr double n = nearPlane, f = farPlane;
inline constexpr Depth orthographic{"orthographic", 1 / (f - n), -n / (f - n), 0, 1};
inline constexpr Depth orthographicReversed{"orthographic, reversed", -1 / (f - n), f / (f - n), 0, 1};
inline constexpr Depth perspective{"perspective", f / (f - n), -n* f / (f - n), 1, 0};
inline constexpr Depth perspectiveReversed{"perspective, reversed", -n / (f - n), n* f / (f - n), 1, 0};
inline constexpr Depth perspectiveInfinite{"perspective, reversed and infinite", 0, n, 1, 0};

/// The matrix of a light at (0, 0, -lightDepth) that looks along +z. reach: half side of the map, mm, at distance 1
/// where it is perspective.
inline void setMatrix(float (&m)[16], const Depth& depth, double reach, double x = 0, double y = 0) {
    std::fill(std::begin(m), std::end(m), 0.0f);
    m[0] = static_cast<float>(1 / reach);
    m[5] = static_cast<float>(1 / reach);
    m[12] = static_cast<float>(-x / reach);
    m[13] = static_cast<float>(-y / reach);
    m[10] = static_cast<float>(depth.z);
    m[11] = static_cast<float>(depth.w);
    m[14] = static_cast<float>(depth.z * lightDepth + depth.z1);
    m[15] = static_cast<float>(depth.w * lightDepth + depth.w1);
}

/// A point of the receiver and its normal, world space in mm; of the camera at the origin only the depth counts.
struct Surface {
    double z = -receiverDepth;
    Float4 normal{0, 0, 1, 0};
};

class ShadowMapsTest : public GpuTest {
protected:
    ShadowMapsTest() {
        NacreContextInfo info = gpu.contextInfo({imageSize, imageSize});
        info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        effect_ = std::make_unique<Effect>(gpu, info);
        setMaterial(0);
    }
    void setMaterial(float authored) {
        std::vector<NacreLayer> layers;
        NacreMaterial material = toNacre(marble(), layers);
        material.thickness = authored;
        ASSERT_EQ(nacreSetMaterials(effect_->context, 1, 1, &material), NACRE_SUCCESS);
    }
    static NacreLight light(NacreLightKind kind) {
        NacreLight result{};
        result.kind = kind;
        result.position[2] = static_cast<float>(-lightDepth);
        result.direction[2] = 1;
        result.irradiance[0] = result.irradiance[1] = result.irradiance[2] = 1;
        result.innerConeAngle = 0.5f;
        result.outerConeAngle = 0.6f;
        result.shadowDepthEncoding = NACRE_DEPTH_HARDWARE;
        return result;
    }
    static double x(std::uint32_t column) { return (column + 0.5 - imageSize / 2.0) * pixel; }

    struct Result {
        std::vector<Float4> light;
        std::vector<float> thickness;
    };
    NacreResult call(const ScatterInput& input, std::span<const NacreLight> lights, std::span<const NacreImage> maps,
                     Result& result) {
        ScatterImages images(gpu, input);
        const GpuImage out = gpu.createImage(
            {.format = VK_FORMAT_R32_SFLOAT, .extent = input.extent, .usage = VK_IMAGE_USAGE_STORAGE_BIT});
        NacreTransmitInfo info = images.transmitInfo(lights, maps);
        info.thicknessOut = out.nacre();
        EXPECT_EQ(nacreBeginFrame(effect_->context, 0), NACRE_SUCCESS);
        NacreResult code = NACRE_SUCCESS;
        gpu.run(
            [&](VkCommandBuffer commandBuffer) { code = nacreCmdTransmit(effect_->context, commandBuffer, &info); });
        result = {gpu.download<Float4>(images.scattered), gpu.download<float>(out)};
        return code;
    }
    /// The surface as an orthographic camera at the origin sees it, lit by a light.
    Result transmit(const std::function<Surface(double x, double y)>& surface, const NacreLight& light,
                    std::span<const NacreImage> maps) {
        return transmit(surface, std::span(&light, 1), maps);
    }
    Result transmit(const std::function<Surface(double x, double y)>& surface, std::span<const NacreLight> lights,
                    std::span<const NacreImage> maps) {
        ScatterInput input =
            ScatterInput::plane(imageSize, imageSize, Projection::orthographic(imageSize, imageSize, 1 / pixel), 1);
        for (std::uint32_t i = 0; i < imageSize * imageSize; ++i) {
            const Surface at = surface(x(i % imageSize), -x(i / imageSize));
            input.depth[i] = static_cast<float>(-at.z);
            input.normal.push_back(at.normal);
        }
        Result result;
        EXPECT_EQ(call(input, lights, maps, result), NACRE_SUCCESS)
            << (effect_->messages.empty() ? "" : effect_->messages.back());
        return result;
    }
    static Surface plane(double, double) { return {}; }

    /// A map in a format, its depth aspect filled.
    GpuImage createMap(VkFormat format, VkExtent2D size, const std::vector<float>& values) {
        const std::size_t layers = values.size() / (std::size_t{size.width} * size.height);
        GpuImage image = gpu.createImage({.format = format,
                                          .extent = size,
                                          .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                          .layers = static_cast<std::uint32_t>(layers),
                                          .array = true});
        const auto as = [&]<typename Texel>(Texel, double one) {
            std::vector<Texel> texels;
            std::transform(values.begin(), values.end(), std::back_inserter(texels),
                           [one](float value) { return static_cast<Texel>(std::lround(value * one)); });
            gpu.upload(image, texels);
        };
        switch (format) {
        case VK_FORMAT_D16_UNORM:
        case VK_FORMAT_R16_UNORM:
            as(std::uint16_t{}, 65535);
            break;
        case VK_FORMAT_X8_D24_UNORM_PACK32:
        case VK_FORMAT_D24_UNORM_S8_UINT:
            as(std::uint32_t{}, 16777215);
            break;
        default:
            gpu.upload(image, values);
        }
        return image;
    }
    /// What a light's map of this reach has of a slab of `thickness` whose far side leans by `slope` along x.
    static std::vector<float> slabMap(std::uint32_t size, const Depth& depth, double reach, double slope,
                                      double middleX = 0) {
        std::vector<float> values;
        for (std::uint32_t i = 0; i < size * size; ++i) {
            const double u = (2 * (i % size + 0.5) / size - 1) * reach + middleX;
            const double base = lightDepth - receiverDepth - thickness;
            const double s = depth.w != 0 ? base / (1 - slope * u) : base + slope * u;
            values.push_back(static_cast<float>(depth.at(s)));
        }
        return values;
    }
    /// The way of the light through that slab to a receiver at x, y.
    static double slabThickness(bool isDirectional, double slope, double x, double y) {
        const double base = lightDepth - receiverDepth - thickness;
        const double s = lightDepth - receiverDepth;
        if (isDirectional) {
            return s - base - slope * x;
        }
        return (1 - base / (s - slope * x)) * std::sqrt(s * s + x * x + y * y);
    }
    void expectSlab(const Result& result, bool isDirectional, double slope, double tolerance = 0.02) {
        for (std::uint32_t i = 0; i < imageSize * imageSize; ++i) {
            const double expected = slabThickness(isDirectional, slope, x(i % imageSize), -x(i / imageSize));
            ASSERT_NEAR(result.thickness[i], expected, tolerance * expected) << i % imageSize << ", " << i / imageSize;
            const double light = makeProfile(marble())->slabTransmittance(0, expected);
            const double distance = 1e-3 * std::hypot(x(i % imageSize), x(i / imageSize), lightDepth - receiverDepth);
            const double arrives = isDirectional ? 1 : (lightDepth - receiverDepth) * 1e-3 / std::pow(distance, 3);
            ASSERT_NEAR(result.light[i][0], light * arrives, 2 * tolerance * light * arrives);
        }
    }
    void expectRefused(const NacreLight& light, std::span<const NacreImage> maps, const std::string& sentence) {
        ScatterInput input = ScatterInput::plane(8, 8, Projection::orthographic(8, 8, 1), 500);
        input.normal.assign(64, {0, 0, 1, 0});
        Result result;
        EXPECT_NE(call(input, {&light, 1}, maps, result), NACRE_SUCCESS) << sentence;
        ASSERT_FALSE(effect_->messages.empty());
        EXPECT_NE(effect_->messages.back().find(sentence), std::string::npos) << effect_->messages.back();
    }

    std::unique_ptr<Effect> effect_;
};

} // namespace nacre::tests
