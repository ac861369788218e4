// Transmit against the same sum over the points of the lit surface in double precision: a plane lit from behind through
// bodies of uneven thickness.
#include "nacre/profile.hpp"
#include "tests/gpu/support/effect.hpp"
#include "tests/support/synthetic_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr int imageSize = 48;
constexpr double focalLength = 600;   // px
constexpr double receiverDepth = 500; // mm before the camera
constexpr double lightDepth = 1000;
constexpr double lightDistance = lightDepth - receiverDepth;
constexpr double shadowRange = 2000;

/// Thickness in mm under a texel of the shadow map; below 0, light enters before the plane.
using Body = std::function<double(int x, int y)>;

/// [0, 1), without pattern.
double noise(int x, int y) {
    std::uint32_t value = static_cast<std::uint32_t>(x) * 0x9e3779b9u + static_cast<std::uint32_t>(y) * 0x85ebca6bu;
    value = (value ^ value >> 15) * 0x2c1b3c6du;
    value = (value ^ value >> 12) * 0x297a2d39u;
    return (value >> 8) * 0x1p-24;
}

/// The light, its map and its filter. The camera sees the plane from 500 mm, the light is 500 mm behind the plane.
struct Lighting {
    NacreLightKind kind = NACRE_LIGHT_DIRECTIONAL;
    double aside = 0; // mm, how far right of the picture's middle the light is, and above it
    int mapSize = 512;
    double extent = 120;    // mm, half side of the map's part of the plane
    float filterRadius = 0; // texels
    float normalOffset = 0; // texels
};

/// A corner of the map is in the picture, 12 px from its middle; a point light's map is a face of its cube. The
/// receiver stays where it is, so that a slab is as thick for light from any direction.
Lighting bordered(NacreLightKind kind, double side, float filterRadius) {
    return {.kind = kind,
            .aside = side * (lightDistance - 10),
            .mapSize = 128,
            .extent = lightDistance,
            .filterRadius = filterRadius,
            .normalOffset = 1e-6f};
}

/// The taps of an axis at a coordinate in texels: a tent. What is outside of the map has no weight. Those that are
/// farther apart than a texel and a half move with the coordinate.
struct Taps {
    static bool areMoving(double spacing) { return spacing >= 1.5; }
    Taps(double coordinate, double spacing, int mapSize) {
        const double middle = coordinate / spacing - 0.5;
        double sum = 0;
        double tent[4];
        for (int i = 0; i < 4; ++i) {
            const double tap = std::floor(middle) - 1 + i;
            const double place = areMoving(spacing) ? coordinate + (i - 1.5) * spacing : (tap + 0.5) * spacing;
            texels[i] = static_cast<int>(std::floor(place));
            tent[i] = areMoving(spacing) ? 0.5 - 0.25 * std::abs(i - 1.5) : 0.5 - 0.25 * std::abs(tap - middle);
            const bool inside = texels[i] >= 0 && texels[i] < mapSize;
            weights[i] = inside ? tent[i] : 0;
            sum += weights[i];
        }
        for (int i = 0; i < 4; ++i) {
            weights[i] = sum > 0 ? weights[i] / sum : tent[i];
        }
    }
    int texels[4];
    double weights[4];
};

/// 4x4 texels, a column's and a row's number, in the map. Rows of moving taps are sheared, and columns.
struct SquareTaps {
    SquareTaps(double column, double row, double spacing, int mapSize)
        : columns(column, spacing, mapSize), rows(row, spacing, mapSize), last(mapSize - 1) {
        for (int i = 0; i < 4 && Taps::areMoving(spacing); ++i) {
            shear[i] = static_cast<int>(std::floor(0.25 * spacing * (i - 1.5) + 0.5));
        }
    }
    int x(int i) const { return std::clamp(columns.texels[i % 4] + shear[i / 4], 0, last); }
    int y(int i) const { return std::clamp(rows.texels[i / 4] - shear[i % 4], 0, last); }
    double weight(int i) const { return columns.weights[i % 4] * rows.weights[i / 4]; }
    Taps columns, rows;
    int shear[4] = {};
    int last;
};

/// z = height + slopeX·x + slopeY·y, by least squares.
struct Plane {
    double height = 0, slopeX = 0, slopeY = 0;

    Plane(std::span<const Vector3<double>> points, std::span<const double> weights) {
        double sum = 0;
        Vector3<double> mean{};
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum += weights[i];
            mean = mean + weights[i] * points[i];
        }
        mean = 1 / std::max(sum, 1e-12) * mean;
        double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vector3<double> d = points[i] - mean;
            const double weight = weights[i] / std::max(sum, 1e-12);
            xx += weight * d[0] * d[0];
            xy += weight * d[0] * d[1];
            yy += weight * d[1] * d[1];
            xz += weight * d[0] * d[2];
            yz += weight * d[1] * d[2];
        }
        const double farAway = mean[0] * mean[0] + mean[1] * mean[1];
        const double least = 1e-3 * (xx + yy) + 1e-5 * (xx + yy + farAway) + 1e-12;
        const double determinant = (xx + least) * (yy + least) - xy * xy;
        slopeX = (xz * (yy + least) - yz * xy) / determinant;
        slopeY = (yz * (xx + least) - xz * xy) / determinant;
        height = mean[2] - slopeX * mean[0] - slopeY * mean[1];
    }
    double cosine() const { return 1 / std::hypot(1, slopeX, slopeY); }
    Vector3<double> under(const Vector3<double>& point) const {
        return {point[0], point[1], height + slopeX * point[0] + slopeY * point[1]};
    }
};

double lengthOf(const Vector3<double>& v) {
    return std::sqrt(dot(v, v));
}

class TransmitFilterTest : public GpuTest {
protected:
    struct Error {
        double rms = 0;
        double largest = 0;
    };

    /// Shares of the light's irradiance that the picture is off the sum over the taps, where the map is.
    Error error(const Material& material, const Body& body, const Lighting& lighting = {}) {
        const auto profile = makeProfile(material);
        const std::vector<Float4> image = transmit(material, body, lighting);
        Error result;
        int count = 0;
        for (int i = 0; i < imageSize * imageSize; ++i) {
            const Point point(lighting, i % imageSize, i / imageSize);
            if (!point.inside) {
                continue;
            }
            for (int channel = 0; channel < 3; ++channel) {
                const double expected = entrySum(*profile, channel, body, lighting, point);
                const double difference =
                    std::abs(image[static_cast<std::size_t>(i)][channel] / point.irradiance - expected);
                // Not less than, so that NaN counts.
                result.largest = difference <= result.largest ? result.largest : difference;
                result.rms += difference * difference;
                ++count;
            }
        }
        EXPECT_GT(count, 0);
        result.rms = std::sqrt(result.rms / count);
        return result;
    }

private:
    /// The plane as the camera sees it; the light is behind it and shines at the camera with an irradiance of 1, at a
    /// metre if not directional.
    std::vector<Float4> transmit(const Material& material, const Body& body, const Lighting& lighting) {
        const GpuImage map = shadowMap(body, lighting);
        const NacreImage maps[] = {map.nacre()};
        const NacreLight source = light(lighting);
        ScatterInput input = ScatterInput::plane(
            imageSize, imageSize, Projection::perspective(imageSize, imageSize, focalLength), receiverDepth);
        input.normal.assign(input.depth.size(), {0, 0, 1, 0});
        const ScatterImages images(gpu, input);
        NacreContextInfo contextInfo = gpu.contextInfo(input.extent);
        contextInfo.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        Effect effect(gpu, contextInfo);
        std::vector<NacreLayer> layers;
        NacreMaterial translucent = toNacre(material, layers);
        translucent.translucency = 1;
        EXPECT_EQ(nacreSetMaterials(effect.context, 1, 1, &translucent), NACRE_SUCCESS);
        EXPECT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
        NacreTransmitInfo info = images.transmitInfo({&source, 1}, maps);
        info.filterRadius = lighting.filterRadius;
        info.normalOffset = lighting.normalOffset;
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_EQ(nacreCmdTransmit(effect.context, commandBuffer, &info), NACRE_SUCCESS);
        });
        return gpu.download<Float4>(images.scattered);
    }

    /// A pixel's point of the plane, as the light sees it.
    struct Point {
        Point(const Lighting& lighting, int x, int y) {
            constexpr double pixel = receiverDepth / focalLength; // mm
            const double right = (x + 0.5 - imageSize / 2.0) * pixel - lighting.aside;
            const double up = (imageSize / 2.0 - y - 0.5) * pixel - lighting.aside;
            const double down = lighting.kind == NACRE_LIGHT_POINT ? -up : up; // a cube's faces have y downwards
            column = 0.5 * lighting.mapSize * (1 + right / lighting.extent);
            row = 0.5 * lighting.mapSize * (1 + down / lighting.extent);
            inside = std::max(std::abs(right), std::abs(up)) < lighting.extent;
            place = {right, down, lightDistance};
            if (lighting.kind != NACRE_LIGHT_DIRECTIONAL) {
                irradiance = 1e6 / dot(place, place);
            }
        }
        /// Of the surface under a texel, from the plane's point: two axes across the light, the third towards it.
        Vector3<double> inLightFrame(const Lighting& lighting, int x, int y, double thickness) const {
            const double texel = 2 * lighting.extent / lighting.mapSize;
            const Vector3<double> onPlane{texel * (x + 0.5) - lighting.extent, texel * (y + 0.5) - lighting.extent,
                                          lightDistance};
            const bool isDirectional = lighting.kind == NACRE_LIGHT_DIRECTIONAL;
            const Vector3<double> ray = isDirectional ? Vector3<double>{0, 0, 1} : normalized(onPlane);
            return turned(lighting, onPlane - thickness * ray - place);
        }
        Vector3<double> normalInLightFrame(const Lighting& lighting) const { return turned(lighting, {0, 0, 1}); }
        Vector3<double> turned(const Lighting& lighting, const Vector3<double>& v) const {
            const bool isDirectional = lighting.kind == NACRE_LIGHT_DIRECTIONAL;
            const Vector3<double> toLight = isDirectional ? Vector3<double>{0, 0, -1} : -1 * normalized(place);
            const Vector3<double> first = normalized(cross(Vector3<double>{0, 1, 0}, toLight));
            return {dot(v, first), dot(v, cross(toLight, first)), dot(v, toLight)};
        }
        double column, row;    // texels
        Vector3<double> place; // from the light, in the map's axes
        bool inside;
        double irradiance = 1; // on a surface that faces the light
    };

    /// The transmittance over the points of the lit surface (effect/transmit/entry.glsl), for light of 1 on a surface
    /// that faces it.
    static double entrySum(const Profile& profile, int channel, const Body& body, const Lighting& lighting,
                           const Point& point) {
        const double texel = 2 * lighting.extent / lighting.mapSize;
        double wanted = 0.5 * profile.quantileRadius(0.75) / texel;
        if (lighting.kind != NACRE_LIGHT_DIRECTIONAL) {
            wanted = std::exp2(std::floor(std::log2(wanted) + 0.5));
        }
        const double radius = lighting.filterRadius == 0 ? 2 : lighting.filterRadius;
        const double spacing = std::max({0.5 * radius, 0.5, std::min(wanted, 0.25 * lighting.mapSize)});
        const SquareTaps taps(point.column, point.row, spacing, lighting.mapSize);
        const double reach = profile.quantileRadius(1 - 1e-4);
        std::vector<Vector3<double>> points;
        std::vector<double> weights;
        for (int i = 0; i < 16; ++i) {
            points.push_back(point.inLightFrame(lighting, taps.x(i), taps.y(i), body(taps.x(i), taps.y(i))));
            const bool counts = lengthOf(points.back()) <= reach + 3 * spacing * texel;
            weights.push_back(counts ? taps.weight(i) : 0);
        }
        std::vector<double> nearness = weights; // near points count most
        for (std::size_t i = 0; i < nearness.size(); ++i) {
            const double distance = lengthOf(points[i]) / (spacing * texel);
            nearness[i] /= (1 + distance * distance) * (1 + distance * distance);
        }
        const Plane plane(points, nearness);
        const double across = std::abs(plane.height) * plane.cosine();
        const Vector3<double> normal = point.normalInLightFrame(lighting);
        const double opposite = plane.cosine() * (plane.slopeX * normal[0] + plane.slopeY * normal[1] - normal[2]);
        const double share = opposite > 0 ? 0.5 + 0.5 * opposite : 0.5 * (1 + opposite) * (1 + opposite);
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            if (weights[i] > 0) {
                const double excess = lengthOf(points[i]) - lengthOf(plane.under(points[i]));
                const double own = std::abs(points[i][2] - plane.slopeX * points[i][0] - plane.slopeY * points[i][1]);
                sum += weights[i] * profile.slabTransmittance(channel, std::max(across + excess, own * plane.cosine()));
            }
        }
        return sum * plane.cosine() * share;
    }

    static NacreLight light(const Lighting& lighting) {
        NacreLight light{};
        light.kind = lighting.kind;
        light.position[0] = light.position[1] = static_cast<float>(lighting.aside);
        light.position[2] = -lightDepth;
        light.direction[2] = 1;
        std::fill(std::begin(light.irradiance), std::end(light.irradiance), 1.0f);
        light.innerConeAngle = 1.4f;
        light.outerConeAngle = 1.5f;
        light.shadowRange = shadowRange;
        const bool isSpot = lighting.kind == NACRE_LIGHT_SPOT;
        const double scale = (isSpot ? lightDistance : 1) / lighting.extent;
        light.shadowClipFromWorld[0] = light.shadowClipFromWorld[5] = static_cast<float>(scale);
        light.shadowClipFromWorld[12] = light.shadowClipFromWorld[13] = static_cast<float>(-scale * lighting.aside);
        light.shadowClipFromWorld[11] = isSpot ? 1 : 0;
        light.shadowClipFromWorld[15] = isSpot ? lightDepth : 1;
        return light;
    }

    GpuImage shadowMap(const Body& body, const Lighting& lighting) {
        const int size = lighting.mapSize;
        const auto distance = [&](int x, int y) { // from the light to the plane
            const double right = lighting.extent * ((2 * x + 1.0) / size - 1);
            const double up = lighting.extent * ((2 * y + 1.0) / size - 1);
            return lighting.kind == NACRE_LIGHT_DIRECTIONAL ? lightDistance : std::hypot(right, up, lightDistance);
        };
        std::vector<float> texels;
        for (int i = 0; i < size * size; ++i) {
            const int x = i % size;
            const int y = i / size;
            texels.push_back(static_cast<float>((distance(x, y) - body(x, y)) / shadowRange));
        }
        if (lighting.kind == NACRE_LIGHT_POINT) {
            texels.insert(texels.begin(), 4 * texels.size(), 0.0f); // the plane is in face +Z
            texels.resize(texels.size() / 5 * 6);
        }
        return gpu.createShadowMap(static_cast<std::uint32_t>(size), texels);
    }
};

TEST_F(TransmitFilterTest, TwoThicknessesAreCloseAtAnyShares) {
    for (const Material& material : {skin(), marble(), burley()}) {
        SCOPED_TRACE(material.name);
        const Error silhouette = error(material, [](int x, int y) { return 2 * x + y < 768 ? 0.0 : 2.5; });
        EXPECT_LT(silhouette.largest, 0.01);
        const Error mixture = error(material, [](int x, int y) { return noise(x, y) < 0.3 ? 0.2 : 3.0; });
        EXPECT_LT(mixture.largest, 0.02);
    }
}

TEST_F(TransmitFilterTest, TapsStayInTheMapAtAnyRadius) {
    for (const NacreLightKind kind : {NACRE_LIGHT_DIRECTIONAL, NACRE_LIGHT_SPOT, NACRE_LIGHT_POINT}) {
        for (const double side : {-1.0, 1.0}) {
            for (const float filterRadius : {1.0f, 2.0f, 3.0f, 3.5f}) {
                SCOPED_TRACE(testing::Message()
                             << "light kind " << kind << ", side " << side << ", radius " << filterRadius);
                const Body body = [](int x, int y) { return noise(x, y) < 0.4 ? 0.2 : 3.0; };
                EXPECT_LT(error(marble(), body, bordered(kind, side, filterRadius)).largest, 6e-3);
            }
        }
    }
}

TEST_F(TransmitFilterTest, MapsOfFewTexels) {
    for (const int mapSize : {1, 2, 3}) {
        SCOPED_TRACE(mapSize);
        const Body body = [](int x, int y) { return (x + y) % 2 == 0 ? 0.5 : 2.0; };
        EXPECT_LT(error(marble(), body, {.mapSize = mapSize, .extent = 10}).largest,
                  0.01); // of few points a fit rounds
    }
}

TEST_F(TransmitFilterTest, ManyThicknessesAreClose) {
    for (const Material& material : {skin(), marble(), burley()}) {
        SCOPED_TRACE(material.name);
        const Error ramp = error(material, [](int x, int y) { return std::max(0.05 * (x + 0.5 * y) - 18, 0.0); });
        EXPECT_LT(ramp.largest, 1.5e-3);
        const Error steps = error(material, [](int x, int y) { return (2 * x + y) % 11 * 0.7; });
        EXPECT_LT(steps.rms, 5e-3);
        EXPECT_LT(steps.largest, 0.02);
        const Error noisy = error(material, [](int x, int y) { return 0.05 * std::pow(200, noise(x, y)); });
        EXPECT_LT(noisy.rms, 6e-3);
        EXPECT_LT(noisy.largest, 0.03);
    }
}

TEST_F(TransmitFilterTest, ExtremesOfScaleAndThickness) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        Material material = burley();
        material.scale = scale;
        SCOPED_TRACE(scale);
        EXPECT_LT(error(material, [](int x, int y) { return noise(x, y) < 0.5 ? -1.0 : 499.0; }).largest, 1e-3);
        EXPECT_LT(error(material, [](int, int) { return 499; }).largest, 1e-3);
        EXPECT_LT(error(material, [](int, int) { return -1; }).largest, 1e-3);
    }
}

TEST_F(TransmitFilterTest, MostLightLeavesWhereItEnters) {
    Material material;
    material.layers = {{{0.6, 0.6, 0.6}, 0}, {{0.4, 0.4, 0.4}, 4}};
    const Error noisy = error(material, [](int x, int y) { return 0.05 * std::pow(200, noise(x, y)); });
    EXPECT_LT(noisy.largest, 0.03);
}

} // namespace
