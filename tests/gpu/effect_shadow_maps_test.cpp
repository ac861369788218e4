// Shadow maps as engines have them, against closed forms: hardware depth of every projection and format, atlases,
// cubes, culled front faces and cascades; and how light falls off on its way.
#include "tests/gpu/support/slab_maps.hpp"

#include <cstdio>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr double slope = 0.04;

TEST_F(ShadowMapsTest, HardwareDepthOfEveryProjection) {
    for (const Depth& depth :
         {orthographic, orthographicReversed, perspective, perspectiveReversed, perspectiveInfinite}) {
        const bool isDirectional = depth.w == 0;
        const double reach = isDirectional ? 60 : 0.12;
        NacreLight source = light(isDirectional ? NACRE_LIGHT_DIRECTIONAL : NACRE_LIGHT_SPOT);
        setMatrix(source.shadowClipFromWorld, depth, reach);
        if (isDirectional) { // nobody reads it
            source.position[0] = 1e4f;
        }
        SCOPED_TRACE(depth.name);
        const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {256, 256}, slabMap(256, depth, reach, slope));
        const NacreImage maps[] = {map.nacre()};
        expectSlab(transmit(plane, source, maps), isDirectional, slope);
    }
}

TEST_F(ShadowMapsTest, HardwareDepthOfEveryFormat) {
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    // 16 bits of the 1900 mm between the planes would be 0.03 mm; the planes are nearer here.
    const Depth depth{"16 bits", 1.0 / 200, -400.0 / 200, 0, 1};
    setMatrix(source.shadowClipFromWorld, depth, 60);
    int formats = 0;
    for (const VkFormat format :
         {VK_FORMAT_D16_UNORM, VK_FORMAT_X8_D24_UNORM_PACK32, VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT,
          VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_R16_UNORM, VK_FORMAT_R32_SFLOAT}) {
        VkFormatProperties properties;
        vkGetPhysicalDeviceFormatProperties(gpu.physicalDevice, format, &properties);
        if ((properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) == 0) {
            continue; // 24 bits of depth are not everywhere
        }
        ++formats;
        SCOPED_TRACE(format);
        const GpuImage map = createMap(format, {256, 256}, slabMap(256, depth, 60, slope));
        const NacreImage maps[] = {map.nacre()};
        expectSlab(transmit(plane, source, maps), true, slope);
    }
    EXPECT_GE(formats, 5);
}

TEST_F(ShadowMapsTest, BallHasItsChords) {
    constexpr double radius = 5;
    constexpr std::uint32_t size = 512;
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    setMatrix(source.shadowClipFromWorld, orthographicReversed, 15);
    std::vector<float> values;
    for (std::uint32_t i = 0; i < size * size; ++i) {
        const double u = (2 * (i % size + 0.5) / size - 1) * 15, v = (2 * (i / size + 0.5) / size - 1) * 15;
        const double height = radius * radius - u * u - v * v;
        values.push_back(
            static_cast<float>(height > 0 ? orthographicReversed.at(lightDepth - 530 - std::sqrt(height)) : 0));
    }
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {size, size}, values);
    const NacreImage maps[] = {map.nacre()};
    const auto ball = [](double x, double y) {
        const double height = std::sqrt(std::max(radius * radius - x * x - y * y, 0.0));
        return Surface{
            height - 530,
            {static_cast<float>(x / radius), static_cast<float>(y / radius), static_cast<float>(height / radius), 0}};
    };
    const Result result = transmit(ball, source, maps);
    for (std::uint32_t i = 0; i < imageSize * imageSize; ++i) {
        const double r = std::hypot(x(i % imageSize), x(i / imageSize));
        if (r < 0.5 * radius) { // further out the entry's plane cuts the corner
            const double chord = 2 * std::sqrt(radius * radius - r * r);
            ASSERT_NEAR(result.thickness[i], chord, 0.02 * chord) << r;
        }
    }
}

TEST_F(ShadowMapsTest, RectangleOfAnAtlas) {
    constexpr std::uint32_t size = 128;
    constexpr VkRect2D rectangle{{70, 31}, {size, size}};
    constexpr VkExtent2D atlas{256, 200};
    NacreLight source = light(NACRE_LIGHT_SPOT);
    setMatrix(source.shadowClipFromWorld, perspective, 0.06);
    source.shadowRectangle = rectangle;
    const std::vector<float> part = slabMap(size, perspective, 0.06, slope);
    std::vector<float> values(atlas.width * atlas.height, 0.0f);
    for (std::uint32_t i = 0; i < size * size; ++i) {
        values[(i / size + 31) * atlas.width + i % size + 70] = part[i];
    }
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, atlas, values);
    const NacreImage maps[] = {map.nacre()};
    expectSlab(transmit(plane, source, maps), false, slope);
    source.shadowRectangle.offset.x = 129;
    expectRefused(source, maps,
                  "lights[0].shadowRectangle is 128x128 at 129,31, must lie within its shadow map's 256x200");
}

TEST_F(ShadowMapsTest, CubeOfHardwareDepth) {
    constexpr std::uint32_t size = 512;
    for (const Depth& depth : {perspective, perspectiveReversed, perspectiveInfinite}) {
        NacreLight source = light(NACRE_LIGHT_POINT);
        // A face's camera looks along -z, as cameras do.
        source.shadowClipFromWorld[10] = static_cast<float>(-depth.z);
        source.shadowClipFromWorld[11] = -1;
        source.shadowClipFromWorld[14] = static_cast<float>(depth.z1);
        std::vector<float> values(6 * size * size, static_cast<float>(depth.at(1900)));
        std::vector<float> face = slabMap(size, depth, 1, slope);
        std::copy(face.begin(), face.end(), values.begin() + 4 * size * size); // +Z
        const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {size, size}, values);
        const NacreImage maps[] = {map.nacre()};
        SCOPED_TRACE(depth.name);
        expectSlab(transmit(plane, source, maps), false, slope);
        source.shadowClipFromWorld[15] = 1;
        expectRefused(source, maps, "lights[0].shadowClipFromWorld has no inverse, must be the perspective projection");
    }
}

/// What lies farther towards the light than twice the authored thickness is another body, and throws a shadow; a few
/// texels and half the profile's width more are the map's and the filter's inexactness.
TEST_F(ShadowMapsTest, BeyondTwiceTheAuthoredThicknessAnotherBodyShadows) {
    constexpr double authored = 0.4, reach = 10;
    setMaterial(static_cast<float>(authored));
    const double spread = makeProfile(marble())->quantileRadius(0.75);
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    setMatrix(source.shadowClipFromWorld, orthographic, reach);
    for (const std::uint32_t size : {24u, 512u}) {
        const double own = 2 * authored + 4 * (2 * reach / size) + 0.5 * spread;
        const auto lightAt = [&](double distance) {
            const double entry = orthographic.at(lightDepth - receiverDepth - distance);
            const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {size, size},
                                           std::vector<float>(std::size_t{size} * size, static_cast<float>(entry)));
            const NacreImage maps[] = {map.nacre()};
            return transmit(plane, source, maps).light[imageSize * imageSize / 2 + imageSize / 2][0];
        };
        const double through = makeProfile(marble())->slabTransmittance(0, authored);
        EXPECT_NEAR(lightAt(0.93 * own), through, 0.02 * through) << size << " texels";
        EXPECT_EQ(lightAt(1.07 * own), 0) << size << " texels";
    }
}

/// Where texels are too coarse to tell, the authored thickness stands in, but for the share that another body shadows.
TEST_F(ShadowMapsTest, OfACoarseMapHalfAWallTakesHalfTheLight) {
    constexpr std::uint32_t size = 4;
    setMaterial(0.4f);
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    setMatrix(source.shadowClipFromWorld, orthographic, 10);
    const auto lightBefore = [&](double right) {
        std::vector<float> values;
        for (std::uint32_t i = 0; i < size * size; ++i) {
            const double distance = i % size < size / 2 ? 12 : right;
            values.push_back(static_cast<float>(orthographic.at(lightDepth - receiverDepth - distance)));
        }
        const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {size, size}, values);
        const NacreImage maps[] = {map.nacre()};
        const Result result = transmit(plane, source, maps);
        const std::size_t middle = imageSize * imageSize / 2 + imageSize / 2;
        return 0.5 * (result.light[middle - 1][0] + result.light[middle][0]);
    };
    const double whole = lightBefore(12);
    EXPECT_NEAR(lightBefore(100), 0.5 * whole, 0.03 * whole);
}

TEST_F(ShadowMapsTest, CulledFrontFacesLeaveTheAuthoredThickness) {
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    setMatrix(source.shadowClipFromWorld, orthographic, 60);
    source.shadowFrontFacesCulled = VK_TRUE;
    // The left half's own far side; before the right half another body ends, 2 mm nearer to the light.
    std::vector<float> values;
    for (std::uint32_t i = 0; i < 256 * 256; ++i) {
        values.push_back(static_cast<float>(orthographic.at(lightDepth - receiverDepth - (i % 256 < 128 ? 0 : 2))));
    }
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {256, 256}, values);
    const NacreImage maps[] = {map.nacre()};
    EXPECT_EQ(transmit(plane, source, maps).light[0][0], 0) << "no thickness is authored";
    setMaterial(1.5f);
    const Result result = transmit(plane, source, maps);
    const std::size_t middle = imageSize * imageSize / 2;
    EXPECT_NEAR(result.thickness[middle + 5], 1.5, 0.03);
    EXPECT_NEAR(result.thickness[middle + imageSize - 5], 3.5, 0.07);
    const double through = makeProfile(marble())->slabTransmittance(0, 1.5);
    EXPECT_NEAR(result.light[middle + 5][0], through, 0.02 * through);
}

/// A slab that leans towards the camera, over cascades that get coarser.
TEST_F(ShadowMapsTest, CascadesShowNoSeam) {
    constexpr std::uint32_t size = 128;
    constexpr double lean = 1;
    const auto leaning = [](double, double y) {
        const auto side = static_cast<float>(std::sqrt(0.5));
        return Surface{-receiverDepth - lean * y, {0, side, side, 0}};
    };
    const double reaches[] = {22, 30, 60, 120};
    NacreShadowCascade cascades[4]{};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    source.cascades = cascades;
    source.cascadeCount = 4;
    // Across the slab it is thinner than along the light, which reaches it under 45 degrees.
    const double light = makeProfile(marble())->slabTransmittance(0, thickness * std::sqrt(0.5)) * std::sqrt(0.5);
    GpuImage map;
    for (const NacreCascadeChoice choice : {NACRE_CASCADE_BY_VIEW_DEPTH, NACRE_CASCADE_BY_MAP}) {
        source.cascadeChoice = choice;
        std::vector<float> values;
        for (int c = 0; c < 4; ++c) {
            // Maps that are asked in order end within the picture.
            const double middle = choice == NACRE_CASCADE_BY_MAP && c < 3 ? (reaches[c] - 10 + 9 * c) : 0;
            cascades[c].layer = static_cast<std::uint32_t>(c);
            cascades[c].farDepth = static_cast<float>(490 + 10 * c);
            setMatrix(cascades[c].clipFromWorld, orthographic, reaches[c], 0, middle);
            for (std::uint32_t i = 0; i < size * size; ++i) {
                const double y = (2 * (i / size + 0.5) / size - 1) * reaches[c] + middle;
                values.push_back(
                    static_cast<float>(orthographic.at(lightDepth - receiverDepth - lean * y - thickness)));
            }
        }
        map = createMap(VK_FORMAT_D32_SFLOAT, {size, size}, values);
        const NacreImage maps[] = {map.nacre()};
        for (const float blend : {0.0f, 0.4f}) {
            source.cascadeBlend = blend;
            const Result result = transmit(leaning, source, maps);
            double least = 1e9, most = 0;
            for (std::uint32_t i = 0; i < imageSize * imageSize; ++i) {
                ASSERT_NEAR(result.thickness[i], thickness, 0.02 * thickness)
                    << i % imageSize << ", " << i / imageSize << ", choice " << choice << ", blend " << blend;
                ASSERT_NEAR(result.light[i][0], light, 0.02 * light);
                least = std::min<double>(least, result.light[i][0]);
                most = std::max<double>(most, result.light[i][0]);
            }
            EXPECT_LT(most / least, 1.01) << "seam, choice " << choice << ", blend " << blend;
            std::printf("choice %d, blend %.1f: %.2f %% between the least and the most\n", choice,
                        static_cast<double>(blend), 100 * (most / least - 1));
        }
    }
    const NacreImage maps[] = {map.nacre()};
    cascades[2].farDepth = 480;
    source.cascadeChoice = NACRE_CASCADE_BY_VIEW_DEPTH;
    expectRefused(source, maps, "lights[0].cascades[2].farDepth is 480, must be above 500");
    source.cascades = nullptr;
    expectRefused(source, maps, "lights[0].cascades is null, cascadeCount is 4");
}

/// Which cascade is asked: each has a thickness of its own.
TEST_F(ShadowMapsTest, CascadesAreChosenInOrder) {
    std::vector<float> values;
    NacreShadowCascade cascades[2]{};
    for (int c = 0; c < 2; ++c) {
        cascades[c].layer = static_cast<std::uint32_t>(c);
        cascades[c].farDepth = c == 0 ? 500.0f : 600.0f;
        setMatrix(cascades[c].clipFromWorld, orthographic, 60);
        values.insert(values.end(), 64 * 64, static_cast<float>(orthographic.at(lightDepth - receiverDepth - 1 - c)));
    }
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, values);
    const NacreImage maps[] = {map.nacre()};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    source.cascades = cascades;
    source.cascadeCount = 2;
    source.cascadeChoice = NACRE_CASCADE_BY_VIEW_DEPTH;
    const auto thicknessAt = [&](double split, float blend) {
        cascades[0].farDepth = static_cast<float>(split);
        source.cascadeBlend = blend;
        return transmit(plane, source, maps).thickness[imageSize * imageSize / 2 + imageSize / 2];
    };
    EXPECT_NEAR(thicknessAt(501, 0), 1, 0.02);
    EXPECT_NEAR(thicknessAt(499, 0), 2, 0.04);
    EXPECT_NEAR(thicknessAt(550, 0.2f), 1 + 0.5454, 0.04) << "50 of 110 mm from the end";
}

TEST_F(ShadowMapsTest, DepthBuffersAreNotTakenForLinear) {
    NacreLight source = light(NACRE_LIGHT_SPOT);
    setMatrix(source.shadowClipFromWorld, perspective, 0.12);
    source.shadowDepthEncoding = NACRE_DEPTH_LINEAR;
    source.shadowRange = 2000;
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, slabMap(64, perspective, 0.12, slope));
    const NacreImage maps[] = {map.nacre()};
    expectRefused(
        source, maps,
        "lights[0].shadowDepthEncoding is NACRE_DEPTH_LINEAR, but its map, NacreTransmitInfo::shadowMaps[0], has "
        "the depth format VK_FORMAT_D32_SFLOAT");
    source.shadowDepthEncoding = NACRE_DEPTH_HARDWARE;
    std::fill(std::begin(source.shadowClipFromWorld), std::end(source.shadowClipFromWorld), 0.0f);
    expectRefused(source, maps, "lights[0].shadowClipFromWorld has no inverse");
}

/// What of a light arrives in the middle and, through a thin slab, at every pixel.
TEST_F(ShadowMapsTest, LightFallsOffAsItSays) {
    setMaterial(1);
    const double through = makeProfile(marble())->slabTransmittance(0, 1);
    NacreLight source = light(NACRE_LIGHT_SPOT);
    source.shadowMap = NACRE_NO_SHADOW_MAP;
    source.outerConeAngle = 0.05f;
    source.innerConeAngle = 0.01f;
    const auto expectFalloff = [&](const std::function<double(double)>& falloff, const char* what) {
        const Result result = transmit(plane, source, {});
        const double outer = std::cos(source.outerConeAngle), inner = std::cos(source.innerConeAngle);
        for (std::uint32_t i = 0; i < imageSize * imageSize; ++i) {
            const double distance = 1e-3 * std::hypot(x(i % imageSize), x(i / imageSize), 500.0);
            const double cosine = 0.5 / distance;
            const double cone =
                source.outerConeAngle > 0 ? std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0) : 1;
            const double expected = through * cosine * cone * cone * falloff(distance);
            ASSERT_NEAR(result.light[i][0], expected, 0.02 * expected + 2e-3 * through)
                << what << ", " << i % imageSize << ", " << i / imageSize;
        }
    };
    const auto square = [](double d) { return 1 / (d * d); };
    expectFalloff(square, "cone");
    for (const float range : {0.0f, 505.0f, 520.0f, 800.0f}) {
        source.range = range;
        expectFalloff(
            [&](double d) {
                const double share = range > 0 ? d / (1e-3 * static_cast<double>(range)) : 0;
                return square(d) * std::clamp(1 - std::pow(share, 4), 0.0, 1.0);
            },
            "range");
    }
    source.range = 0;
    source.kind = NACRE_LIGHT_POINT;
    expectFalloff(square, "cone of a point light");
    source.outerConeAngle = source.innerConeAngle = 0;
    const float attenuations[][3] = {{1, 0, 0}, {1, 0.5f, 2}, {0, 2, 0}, {0, 0, 3}};
    for (const float(&a)[3] : attenuations) {
        std::copy(std::begin(a), std::end(a), source.attenuation);
        expectFalloff([&](double d) { return 1 / (a[0] + a[1] * d + a[2] * d * d); }, "attenuation");
    }
}

} // namespace
