// Transmit against closed forms: a slab lit from behind by directional, spot and point lights.
#include "nacre/nacre_baselines.h"
#include "tests/gpu/support/counted_calls.hpp"
#include "tests/gpu/support/effect.hpp"
#include "tests/support/synthetic_scenes.hpp"

#include <cmath>
#include <limits>

using namespace nacre;
using namespace nacre::tests;

namespace {

using Vector = Vector3<double>;

/// Three axes of a camera and a light that face each other: the light is 1 m from the camera along -z.
struct Frame {
    Vector x, y, z;
    Vector at(double a, double b, double c) const { return a * x + b * y + c * z; }
};
constexpr Frame worldFrame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

constexpr std::uint32_t imageSize = 48;
constexpr std::uint32_t mapSize = 512;
constexpr double receiverDepth = 500; // mm before the camera
constexpr double lightDepth = 1000;
constexpr double extent = 120; // mm, half side of the shadow map
constexpr double shadowRange = 2000;

/// A slab between the receiver plane and an entry plane `thickness` mm behind it, tilted by `slope` along x and y.
struct Slab {
    double thickness = 1;
    double slope = 0;
    Frame frame = worldFrame;

    Vector entryNormal() const { return normalized(frame.at(slope, -0.5 * slope, 1)); }
    double entryOffset() const { return dot(entryNormal(), frame.at(0, 0, -receiverDepth - thickness)); }
    /// Distance from `origin` along `direction` to the entry plane; the range where it is not met.
    double distance(const Vector& origin, const Vector& direction) const {
        const double t = (entryOffset() - dot(entryNormal(), origin)) / dot(entryNormal(), direction);
        return t > 0 && std::isfinite(t) ? t : shadowRange;
    }
};

/// What Vulkan's cube map face selection inverts to: the direction of a point s, t in [-1, 1] of a face.
Vector cubeDirection(int face, double s, double t) {
    const Vector directions[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    return normalized(directions[face]);
}

struct Ray {
    Vector origin, direction;
};

class TransmitTest : public GpuTest {
protected:
    /// A light behind the slab that shines at the camera, with its shadow map.
    NacreLight light(NacreLightKind kind, const Frame& frame = worldFrame) const {
        NacreLight result{};
        result.kind = kind;
        const Vector position = frame.at(0, 0, -lightDepth);
        for (int i = 0; i < 3; ++i) {
            result.position[i] = static_cast<float>(position[i]);
            result.direction[i] = static_cast<float>(3 * frame.z[i]);
            result.irradiance[i] = 1.0f + 0.5f * static_cast<float>(i);
        }
        result.outerConeAngle = 0.6f;
        result.innerConeAngle = 0.5f;
        result.shadowRange = static_cast<float>(shadowRange);
        // Columns of a map that looks along frame.z: clip x and y over ±extent at the receiver.
        const double reach = kind == NACRE_LIGHT_SPOT ? extent / (lightDepth - receiverDepth) : extent;
        for (int column = 0; column < 3; ++column) {
            result.shadowClipFromWorld[4 * column] = static_cast<float>(frame.x[column] / reach);
            result.shadowClipFromWorld[4 * column + 1] = static_cast<float>(frame.y[column] / reach);
            result.shadowClipFromWorld[4 * column + 3] =
                kind == NACRE_LIGHT_SPOT ? static_cast<float>(frame.z[column]) : 0.0f;
        }
        result.shadowClipFromWorld[15] = kind == NACRE_LIGHT_SPOT ? static_cast<float>(lightDepth) : 1.0f;
        return result;
    }

    Ray shadowRay(const NacreLight& light, const Frame& frame, int face, double s, double t) const {
        const Vector position = frame.at(0, 0, -lightDepth);
        switch (light.kind) {
        case NACRE_LIGHT_DIRECTIONAL:
            return {position + frame.at(s * extent, t * extent, 0), frame.z};
        case NACRE_LIGHT_SPOT:
            return {position, normalized(frame.at(s * extent, t * extent, lightDepth - receiverDepth))};
        default:
            return {position, cubeDirection(face, s, t)};
        }
    }

    GpuImage shadowMap(const NacreLight& light, const Slab& slab) {
        const std::uint32_t layers = light.kind == NACRE_LIGHT_POINT ? 6 : 1;
        std::vector<float> texels;
        for (std::uint32_t layer = 0; layer < layers; ++layer) {
            for (std::uint32_t y = 0; y < mapSize; ++y) {
                for (std::uint32_t x = 0; x < mapSize; ++x) {
                    const Ray ray = shadowRay(light, slab.frame, static_cast<int>(layer), 2 * (x + 0.5) / mapSize - 1,
                                              2 * (y + 0.5) / mapSize - 1);
                    const double depth = slab.distance(ray.origin, ray.direction);
                    texels.push_back(static_cast<float>(std::min(depth, shadowRange) / shadowRange));
                }
            }
        }
        return gpu.createShadowMap(mapSize, texels);
    }

    struct Result {
        std::vector<Float4> light;
        std::vector<float> thickness;
    };

    /// The receiver plane seen by the camera, one material, these lights.
    Result transmit(const NacreMaterial& material, std::span<const NacreLight> lights, std::span<const NacreImage> maps,
                    const Frame& frame = worldFrame, const std::function<void(NacreTransmitInfo&)>& change = {}) {
        ScatterInput input = ScatterInput::plane(imageSize, imageSize,
                                                 Projection::perspective(imageSize, imageSize, 600), receiverDepth);
        for (int column = 0; column < 3; ++column) {
            input.view.viewFromWorld[4 * column] = static_cast<float>(frame.x[column]);
            input.view.viewFromWorld[4 * column + 1] = static_cast<float>(frame.y[column]);
            input.view.viewFromWorld[4 * column + 2] = static_cast<float>(frame.z[column]);
        }
        const Float4 normal{static_cast<float>(frame.z[0]), static_cast<float>(frame.z[1]),
                            static_cast<float>(frame.z[2]), 0};
        input.normal.assign(input.depth.size(), normal);
        ScatterImages images(gpu, input);
        GpuImage thickness = gpu.createImage(
            {.format = VK_FORMAT_R32_SFLOAT, .extent = input.extent, .usage = VK_IMAGE_USAGE_STORAGE_BIT});
        NacreContextInfo context = gpu.contextInfo(input.extent);
        context.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        context.maxLights = static_cast<std::uint32_t>(lights.size());
        Effect effect(gpu, context);
        EXPECT_EQ(nacreSetMaterials(effect.context, 1, 1, &material), NACRE_SUCCESS);
        EXPECT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
        NacreTransmitInfo info = images.transmitInfo(lights, maps);
        info.thicknessOut = thickness.nacre();
        if (change) {
            change(info);
        }
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_EQ(nacreCmdTransmit(effect.context, commandBuffer, &info), NACRE_SUCCESS)
                << (effect.messages.empty() ? "" : effect.messages.back());
        });
        return {gpu.download<Float4>(images.scattered), gpu.download<float>(thickness)};
    }

    /// Compares every pixel with T(thickness along the light)·E·cosine of one light.
    void expectSlab(const Material& material, const NacreLight& light, const Slab& slab, const Result& result,
                    double tolerance, double translucency = 1) {
        const auto profile = makeProfile(material);
        for (std::uint32_t y = 0; y < imageSize; ++y) {
            for (std::uint32_t x = 0; x < imageSize; ++x) {
                const double scale = receiverDepth / 600;
                const Vector point = slab.frame.at((x + 0.5 - imageSize / 2.0) * scale,
                                                   (imageSize / 2.0 - y - 0.5) * scale, -receiverDepth);
                const Vector position = slab.frame.at(0, 0, -lightDepth);
                const bool directional = light.kind == NACRE_LIGHT_DIRECTIONAL;
                const Vector travel = directional ? slab.frame.z : normalized(point - position);
                const double meters = 1e-3 * std::sqrt(dot(point - position, point - position));
                // From the receiver back to where the light came in.
                const double thickness = slab.distance(point, -1 * travel);
                for (int channel = 0; channel < 3; ++channel) {
                    const double irradiance =
                        light.irradiance[channel] * dot(travel, slab.frame.z) / (directional ? 1 : meters * meters);
                    const double expected = translucency * profile->slabTransmittance(channel, thickness) * irradiance;
                    ASSERT_NEAR(result.light[y * imageSize + x][channel], expected,
                                tolerance * expected + 1e-3 * irradiance)
                        << x << ", " << y << " channel " << channel << ", thickness " << thickness << " mm";
                }
                ASSERT_NEAR(result.thickness[y * imageSize + x], thickness, tolerance * thickness + 0.01);
            }
        }
    }

    NacreMaterial opaqueTo(const Material& material) {
        NacreMaterial result = toNacre(material, layers_);
        result.translucency = 1;
        return result;
    }

private:
    std::vector<NacreLayer> layers_;
};

constexpr NacreLightKind kinds[] = {NACRE_LIGHT_DIRECTIONAL, NACRE_LIGHT_SPOT, NACRE_LIGHT_POINT};

TEST_F(TransmitTest, SlabFollowsItsTransmittance) {
    for (const Material& material : {skin(), marble(), burley()}) {
        for (const NacreLightKind kind : kinds) {
            for (const double thickness : {0.5, 2.0, 4.0}) {
                const Slab slab{.thickness = thickness};
                const NacreLight source = light(kind);
                const GpuImage map = shadowMap(source, slab);
                const NacreImage maps[] = {map.nacre()};
                SCOPED_TRACE(material.name + ", light kind " + std::to_string(kind));
                expectSlab(material, source, slab, transmit(opaqueTo(material), {&source, 1}, maps), 0.02);
            }
        }
    }
}

TEST_F(TransmitTest, EveryCubeFaceIsTheRightWayRound) {
    const double half = std::sqrt(0.5);
    const Frame frames[] = {
        {{half, 0, -half}, {0, 1, 0}, {half, 0, half}}, // two faces meet in the middle
        {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
        {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
    };
    for (const Frame& frame : frames) {
        const Slab slab{.thickness = 3, .slope = 0.06, .frame = frame};
        const NacreLight source = light(NACRE_LIGHT_POINT, frame);
        const GpuImage map = shadowMap(source, slab);
        const NacreImage maps[] = {map.nacre()};
        expectSlab(marble(), source, slab, transmit(opaqueTo(marble()), {&source, 1}, maps, frame), 0.05);
    }
}

TEST_F(TransmitTest, TiltedSlab) {
    for (const NacreLightKind kind : kinds) {
        const Slab slab{.thickness = 4, .slope = 0.08};
        const NacreLight source = light(kind);
        const GpuImage map = shadowMap(source, slab);
        const NacreImage maps[] = {map.nacre()};
        expectSlab(marble(), source, slab, transmit(opaqueTo(marble()), {&source, 1}, maps), 0.05);
    }
}

TEST_F(TransmitTest, LightsAddUp) {
    const Slab slab{.thickness = 1};
    std::vector<NacreLight> lights;
    std::vector<GpuImage> images;
    std::vector<NacreImage> maps;
    std::vector<Float4> sum(imageSize * imageSize, Float4{});
    for (const NacreLightKind kind : kinds) {
        lights.push_back(light(kind));
        images.push_back(shadowMap(lights.back(), slab));
        maps.push_back(images.back().nacre());
        lights.back().shadowMap = static_cast<std::uint32_t>(maps.size() - 1);
    }
    for (const NacreLight& one : lights) {
        const Result result = transmit(opaqueTo(skin()), {&one, 1}, maps);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            for (int channel = 0; channel < 3; ++channel) {
                sum[i][channel] += result.light[i][channel];
            }
        }
    }
    const Result all = transmit(opaqueTo(skin()), lights, maps);
    for (std::size_t i = 0; i < sum.size(); ++i) {
        ASSERT_NEAR(all.light[i][0], sum[i][0], 1e-4f * sum[i][0]);
    }
}

// Many lights with several shadow maps: the loops of a software device end after 65,535 turns. The thesis's own form
// takes a turn for every two layers of every light, and holds there up to half as many lights as a context may have.
TEST_F(TransmitTest, ManyLightsAddUp) {
    const Slab slab{.thickness = 1.5};
    const NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    const GpuImage map = shadowMap(source, slab);
    const NacreImage maps[] = {map.nacre(), map.nacre()};
    const auto shared = [&](std::uint32_t count) {
        std::vector<NacreLight> lights(count, source);
        for (std::uint32_t i = 0; i < count; ++i) {
            lights[i].shadowMap = i % 2;
            for (float& irradiance : lights[i].irradiance) {
                irradiance /= static_cast<float>(count);
            }
        }
        return lights;
    };
    Material material = skin();
    constexpr double share = 1.0 / NACRE_MAX_LAYERS;
    material.layers.assign(NACRE_MAX_LAYERS, {{share, share, share}, 4});
    for (const VkBool32 thesis : {VK_FALSE, VK_TRUE}) {
        const NacreBaselineSettings settings{.thesisTransmittance = thesis};
        const auto change = [&](NacreTransmitInfo& info) { info.baselines = &settings; };
        const Result one = transmit(opaqueTo(material), {&source, 1}, maps, worldFrame, change);
        const Result all = transmit(opaqueTo(material), shared(thesis ? 512 : 1024), maps, worldFrame, change);
        const std::size_t middle = imageSize * imageSize / 2;
        EXPECT_GT(one.light[middle][0], 0.01f);
        EXPECT_NEAR(all.light[middle][0], one.light[middle][0], 1e-3f * one.light[middle][0]) << thesis;
    }
}

TEST_F(TransmitTest, EveryLightHasTheShadowMapThatItNames) {
    NacreLight source = light(NACRE_LIGHT_SPOT);
    std::vector<Slab> slabs;
    std::vector<GpuImage> images;
    std::vector<NacreImage> maps;
    for (std::uint32_t i = 0; i < NACRE_MAX_SHADOW_MAPS; ++i) {
        slabs.push_back({.thickness = 0.5 + 0.25 * i});
        images.push_back(shadowMap(source, slabs.back()));
        maps.push_back(images.back().nacre());
    }
    for (const std::size_t count : {std::size_t{2}, maps.size()}) {
        for (source.shadowMap = 0; source.shadowMap < count; ++source.shadowMap) {
            SCOPED_TRACE("shadow map " + std::to_string(source.shadowMap) + " of " + std::to_string(count));
            expectSlab(marble(), source, slabs[source.shadowMap],
                       transmit(opaqueTo(marble()), {&source, 1}, std::span(maps).first(count)), 0.02);
        }
    }
}

TEST_F(TransmitTest, AuthoredThicknessBoundsOrStandsIn) {
    const Slab slab{.thickness = 3};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    const GpuImage map = shadowMap(source, slab);
    const NacreImage maps[] = {map.nacre()};
    NacreMaterial material = opaqueTo(marble());
    const std::size_t middle = imageSize * imageSize / 2 + imageSize / 2;

    material.thickness = 1;
    EXPECT_NEAR(transmit(material, {&source, 1}, maps).thickness[middle], 1, 1e-3) << "bounds";
    material.thickness = 10;
    EXPECT_NEAR(transmit(material, {&source, 1}, maps).thickness[middle], 3, 0.02) << "does not bound";

    source.shadowMap = NACRE_NO_SHADOW_MAP;
    material.thickness = 2;
    Result result = transmit(material, {&source, 1}, {});
    const double expected = makeProfile(marble())->slabTransmittance(0, 2) * source.irradiance[0];
    EXPECT_NEAR(result.thickness[middle], 2, 1e-3) << "stands in";
    EXPECT_NEAR(result.light[middle][0], expected, 0.02 * expected);

    material.thickness = 0;
    result = transmit(material, {&source, 1}, {});
    EXPECT_EQ(result.light[middle][0], 0) << "neither shadow map nor thickness: no glow";
    EXPECT_EQ(result.thickness[middle], 0);
}

TEST_F(TransmitTest, FrontLightsGiveNothing) {
    const Slab slab{.thickness = 1};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    const GpuImage map = shadowMap(source, slab);
    const NacreImage maps[] = {map.nacre()};
    source.direction[2] = -1;
    NacreMaterial material = opaqueTo(skin());
    material.thickness = 1;
    for (const Float4& pixel : transmit(material, {&source, 1}, maps).light) {
        ASSERT_EQ(pixel[0], 0);
    }
}

TEST_F(TransmitTest, SurfaceInFrontOfTheMapIsAsDarkAsItIsFar) {
    // The stored depth is behind the receiver: the map has nothing between it and the light. A sheet's own depth is
    // there but for its exactness.
    for (const double behind : {20.0, 0.001}) {
        const Slab slab{.thickness = -behind};
        const NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
        const GpuImage map = shadowMap(source, slab);
        const NacreImage maps[] = {map.nacre()};
        const Result result = transmit(opaqueTo(skin()), {&source, 1}, maps);
        const double share = makeProfile(skin())->slabTransmittance(0, behind);
        for (std::size_t i = 0; i < result.light.size(); ++i) {
            ASSERT_NEAR(result.light[i][0], share * source.irradiance[0], 5e-3) << behind;
            ASSERT_EQ(result.thickness[i], 0);
        }
    }
}

TEST_F(TransmitTest, ThesisTransmittance) {
    const Slab slab{.thickness = 1.5};
    const NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    const GpuImage map = shadowMap(source, slab);
    const NacreImage maps[] = {map.nacre()};
    const NacreBaselineSettings settings{.thesisTransmittance = VK_TRUE};
    const Result result = transmit(opaqueTo(skin()), {&source, 1}, maps, worldFrame,
                                   [&](NacreTransmitInfo& info) { info.baselines = &settings; });
    double expected = 0;
    for (const Layer& layer : skin().layers) {
        expected += layer.weight[0] * std::exp(-1.5 * 1.5 / layer.variance);
    }
    EXPECT_NEAR(result.light[imageSize * imageSize / 2][0], expected, 0.02 * expected);
}

TEST_F(TransmitTest, WithoutTranslucencyThicknessIsLeft) {
    const Slab slab{.thickness = 1};
    const NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    const GpuImage map = shadowMap(source, slab);
    const NacreImage maps[] = {map.nacre()};
    NacreMaterial material = opaqueTo(skin());
    material.translucency = 0;
    const Result result = transmit(material, {&source, 1}, maps);
    for (std::size_t i = 0; i < result.light.size(); ++i) {
        ASSERT_EQ(result.light[i][0], 0);
        ASSERT_NEAR(result.thickness[i], 1, 1e-2f);
    }
}

TEST_F(TransmitTest, TranslucencyScales) {
    const Slab slab{.thickness = 1};
    const NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    const GpuImage map = shadowMap(source, slab);
    const NacreImage maps[] = {map.nacre()};
    NacreMaterial material = opaqueTo(skin());
    material.translucency = 0.25f;
    expectSlab(skin(), source, slab, transmit(material, {&source, 1}, maps), 0.02, 0.25);
}

} // namespace
