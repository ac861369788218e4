// Which map, which place of it and which cascade tells about a receiver, and what nothing tells: every one has a
// thickness of its own here.
#include "tests/gpu/support/slab_maps.hpp"

#include <array>
#include <limits>
#include <utility>

using namespace nacre;
using namespace nacre::tests;

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// As in the section "Cube Map Face Selection" of Vulkan's specification, read backwards: where a place of a face lies.
Vector cubeDirection(int face, double s, double t) {
    const Vector directions[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    return directions[face];
}

class ShadowChoiceTest : public ShadowMapsTest {
protected:
    /// A map of one depth: that of an entry `thick` before the receiver.
    static std::vector<float> even(std::uint32_t size, const Depth& depth, double thick) {
        return std::vector<float>(size * size, static_cast<float>(depth.at(lightDepth - receiverDepth - thick)));
    }
    static std::size_t at(int column, int row) { return static_cast<std::size_t>(row) * imageSize + column; }
};

TEST_F(ShadowChoiceTest, EveryFaceOfACubeLiesAsVulkanSays) {
    constexpr std::uint32_t size = 512, firstLayer = 2;
    constexpr double far = 500, slopes[] = {0.2, -0.3};
    for (int face = 0; face < 6; ++face) {
        const Vector along = cubeDirection(face, 0, 0);
        const int axis = face / 2;
        Vector across{};
        across[(axis + 1) % 3] = slopes[0];
        across[(axis + 2) % 3] = slopes[1];
        /// Along a direction from the light, the distance of a plane that leans.
        const auto entry = [&](const Vector& direction) {
            return (far - thickness) / (dot(direction, along) - dot(direction, across)) *
                   std::sqrt(dot(direction, direction));
        };
        NacreLight source = light(NACRE_LIGHT_POINT);
        source.outerConeAngle = source.innerConeAngle = 0;
        source.shadowDepthEncoding = NACRE_DEPTH_LINEAR;
        source.shadowRange = 2000;
        for (int i = 0; i < 3; ++i) {
            source.position[i] = static_cast<float>((i == 2 ? -receiverDepth : 0) - far * along[i]);
        }
        source.shadowLayer = firstLayer;
        std::vector<float> values((firstLayer + 6) * size * size, 1);
        for (std::uint32_t i = 0; i < size * size; ++i) {
            const Vector direction =
                cubeDirection(face, 2 * (i % size + 0.5) / size - 1, 2 * (i / size + 0.5) / size - 1);
            values[(firstLayer + face) * size * size + i] = static_cast<float>(entry(direction) / 2000);
        }
        const GpuImage map = createMap(VK_FORMAT_R32_SFLOAT, {size, size}, values);
        const NacreImage maps[] = {map.nacre()};
        const auto surface = [&](double x, double y) {
            return Surface{
                -receiverDepth + 0.7 * x - 0.4 * y,
                {static_cast<float>(along[0]), static_cast<float>(along[1]), static_cast<float>(along[2]), 0}};
        };
        const Result result = transmit(surface, source, maps);
        for (int row = 18; row < 22; ++row) {
            for (int column = 18; column < 22; ++column) {
                const double px = x(column), py = -x(row);
                const Vector way{px - source.position[0], py - source.position[1],
                                 surface(px, py).z - source.position[2]};
                const double expected = std::sqrt(dot(way, way)) - entry(way);
                EXPECT_NEAR(result.thickness[at(column, row)], expected, 0.03 * expected + 0.02)
                    << "face " << face << ", " << column << ", " << row;
            }
        }
    }
}

TEST_F(ShadowChoiceTest, EachOfSixteenMapsIsAsked) {
    GpuImage images[NACRE_MAX_SHADOW_MAPS];
    NacreImage maps[NACRE_MAX_SHADOW_MAPS];
    const auto thick = [](std::uint32_t map) { return 1 + 0.25 * map; };
    for (std::uint32_t i = 0; i < NACRE_MAX_SHADOW_MAPS; ++i) {
        images[i] = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, even(64, orthographic, thick(i)));
        maps[i] = images[i].nacre();
    }
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    setMatrix(source.shadowClipFromWorld, orthographic, 60);
    for (std::uint32_t i = 0; i < NACRE_MAX_SHADOW_MAPS; ++i) {
        source.shadowMap = i;
        EXPECT_NEAR(transmit(plane, source, maps).thickness[at(20, 20)], thick(i), 0.02 * thick(i)) << "map " << i;
    }
}

TEST_F(ShadowChoiceTest, OutsideOfItsMapNothingIsTold) {
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, even(64, orthographic, thickness));
    const NacreImage maps[] = {map.nacre()};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    setMatrix(source.shadowClipFromWorld, orthographic, 10);
    const Result result = transmit(plane, source, maps);
    for (int row = 0; row < int{imageSize}; ++row) {
        for (int column = 0; column < int{imageSize}; ++column) {
            const double border = std::max(std::abs(x(column)), std::abs(x(row)));
            if (border > 10) {
                ASSERT_EQ(result.light[at(column, row)][0], 0) << column << ", " << row;
            } else if (border < 8) {
                ASSERT_NEAR(result.thickness[at(column, row)], thickness, 0.02 * thickness);
            }
        }
    }
}

TEST_F(ShadowChoiceTest, WhereNothingWasDrawnNothingShines) {
    for (const Depth& depth : {orthographicReversed, perspective, perspectiveInfinite}) {
        const bool isDirectional = depth.w == 0;
        NacreLight source = light(isDirectional ? NACRE_LIGHT_DIRECTIONAL : NACRE_LIGHT_SPOT);
        setMatrix(source.shadowClipFromWorld, depth, isDirectional ? 60 : 0.12);
        const float cleared = depth.z > 0 ? 1.0f : 0.0f;
        const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, std::vector<float>(64 * 64, cleared));
        const NacreImage maps[] = {map.nacre()};
        EXPECT_EQ(transmit(plane, source, maps).light[at(20, 20)][0], 0) << depth.name;
    }
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    source.shadowDepthEncoding = NACRE_DEPTH_LINEAR;
    setMatrix(source.shadowClipFromWorld, orthographic, 60);
    const auto with = [&](float value, float range) {
        source.shadowRange = range;
        const GpuImage map = createMap(VK_FORMAT_R32_SFLOAT, {64, 64}, std::vector<float>(64 * 64, value));
        const NacreImage maps[] = {map.nacre()};
        const Result result = transmit(plane, source, maps);
        return std::pair(result.light[at(20, 20)][0], result.thickness[at(20, 20)]);
    };
    const double entry = lightDepth - receiverDepth - thickness;
    EXPECT_GT(with(0.5f, static_cast<float>(2 * entry)).first, 0.01);
    EXPECT_EQ(with(1, static_cast<float>(entry)), std::pair(0.0f, 0.0f)) << "1 is nothing, whatever the range";
    EXPECT_EQ(with(-0.5f, static_cast<float>(2 * entry)).first, 0) << "a body's back is no entry";
}

/// Texels as large as light goes far do not tell; where they are empty nothing shadows, either.
TEST_F(ShadowChoiceTest, WhereACoarseMapIsEmptyTheAuthoredThicknessStandsIn) {
    setMaterial(1);
    const double through = makeProfile(marble())->slabTransmittance(0, 1);
    NacreLight source = light(NACRE_LIGHT_SPOT);
    setMatrix(source.shadowClipFromWorld, perspectiveInfinite, 0.8);
    source.shadowRange = 450; // nearer to the light than the receivers
    for (const NacreDepthEncoding encoding : {NACRE_DEPTH_HARDWARE, NACRE_DEPTH_LINEAR}) {
        source.shadowDepthEncoding = encoding;
        const float nothing = encoding == NACRE_DEPTH_HARDWARE ? 0.0f : 1.0f;
        const GpuImage map = createMap(VK_FORMAT_R32_SFLOAT, {7, 7}, std::vector<float>(7 * 7, nothing));
        const NacreImage maps[] = {map.nacre()};
        const double expected = through / (0.5 * 0.5);
        EXPECT_NEAR(transmit(plane, source, maps).light[at(20, 20)][0], expected, 0.02 * expected) << encoding;
    }
}

/// By map: the first that has the point in it; over its border it goes over into the next, whatever farDepth says.
TEST_F(ShadowChoiceTest, CascadesByMapBlendTowardsTheNearerBorder) {
    constexpr double reach = 12;
    NacreShadowCascade cascades[2]{};
    std::vector<float> values = even(64, orthographic, 1);
    const std::vector<float> second = even(64, orthographic, 2);
    values.insert(values.end(), second.begin(), second.end());
    setMatrix(cascades[0].clipFromWorld, orthographic, reach);
    setMatrix(cascades[1].clipFromWorld, orthographic, 60);
    cascades[1].layer = 1;
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, values);
    const NacreImage maps[] = {map.nacre()};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    source.cascades = cascades;
    source.cascadeCount = 2;
    source.cascadeBlend = 0.5f;
    const Result result = transmit(plane, source, maps);
    for (int row = 0; row < int{imageSize}; row += 3) {
        for (int column = 0; column < int{imageSize}; column += 3) {
            const double inside = 1 - std::max(std::abs(x(column)), std::abs(x(row))) / reach;
            const double expected = 2 - std::clamp(inside / 0.5, 0.0, 1.0);
            ASSERT_NEAR(result.thickness[at(column, row)], expected, 0.04) << column << ", " << row;
        }
    }
}

/// By view depth: the next also where the first, which reaches as far, does not have the point.
TEST_F(ShadowChoiceTest, ACascadeThatLacksThePointLeavesItToTheNext) {
    NacreShadowCascade cascades[2]{};
    std::vector<float> values = even(64, orthographic, 1);
    const std::vector<float> second = even(64, orthographic, 2);
    values.insert(values.end(), second.begin(), second.end());
    setMatrix(cascades[0].clipFromWorld, orthographic, 10);
    setMatrix(cascades[1].clipFromWorld, orthographic, 60);
    cascades[1].layer = 1;
    cascades[0].farDepth = 600;
    cascades[1].farDepth = 700;
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, values);
    const NacreImage maps[] = {map.nacre()};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    source.cascades = cascades;
    source.cascadeCount = 2;
    source.cascadeChoice = NACRE_CASCADE_BY_VIEW_DEPTH;
    const Result result = transmit(plane, source, maps);
    EXPECT_NEAR(result.thickness[at(20, 20)], 1, 0.02);
    EXPECT_NEAR(result.thickness[at(2, 20)], 2, 0.04);
    EXPECT_NEAR(result.thickness[at(20, 37)], 2, 0.04);
}

/// What hardware depth has, linear depth has by itself: rectangles, culled front faces, and cascades with ranges.
TEST_F(ShadowChoiceTest, LinearMapsHaveAllOfIt) {
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    source.shadowDepthEncoding = NACRE_DEPTH_LINEAR;
    source.shadowRange = 1000;
    setMatrix(source.shadowClipFromWorld, orthographic, 60);
    constexpr double distance = lightDepth - receiverDepth;
    const auto thicknessBy = [&](VkExtent2D size, const std::vector<float>& values) {
        const GpuImage map = createMap(VK_FORMAT_R32_SFLOAT, size, values);
        const NacreImage maps[] = {map.nacre()};
        return transmit(plane, source, maps).thickness[at(20, 20)];
    };
    std::vector<float> atlas(128 * 100, 0.4f);
    for (std::uint32_t i = 0; i < 64 * 64; ++i) {
        atlas[(i / 64 + 20) * 128 + i % 64 + 50] = static_cast<float>((distance - thickness) / 1000);
    }
    source.shadowRectangle = {{50, 20}, {64, 64}};
    EXPECT_NEAR(thicknessBy({128, 100}, atlas), thickness, 0.02 * thickness);
    source.shadowRectangle = {};

    source.shadowFrontFacesCulled = VK_TRUE;
    setMaterial(1.5f);
    EXPECT_NEAR(thicknessBy({64, 64}, std::vector<float>(64 * 64, static_cast<float>(distance / 1000))), 1.5, 0.03);
    source.shadowFrontFacesCulled = VK_FALSE;
    setMaterial(0);

    NacreShadowCascade cascades[2]{};
    std::vector<float> values(64 * 64, static_cast<float>((distance - 1) / 1000)); // in the light's range
    values.insert(values.end(), 64 * 64, static_cast<float>((distance - 2) / 2000));
    for (NacreShadowCascade& cascade : cascades) {
        setMatrix(cascade.clipFromWorld, orthographic, 60);
    }
    cascades[1].layer = 1;
    cascades[1].range = 2000;
    cascades[1].farDepth = 600;
    source.cascades = cascades;
    source.cascadeCount = 2;
    source.cascadeChoice = NACRE_CASCADE_BY_VIEW_DEPTH;
    cascades[0].farDepth = 501;
    EXPECT_NEAR(thicknessBy({64, 64}, values), 1, 0.02);
    cascades[0].farDepth = 499;
    EXPECT_NEAR(thicknessBy({64, 64}, values), 2, 0.04);
}

TEST_F(ShadowChoiceTest, LightsWithCascadesOfTheirOwnAddUp) {
    NacreShadowCascade cascades[2]{};
    NacreLight lights[2];
    std::vector<float> values;
    for (std::uint32_t i = 0; i < 2; ++i) {
        setMatrix(cascades[i].clipFromWorld, orthographic, 60);
        cascades[i].layer = i;
        lights[i] = light(NACRE_LIGHT_DIRECTIONAL);
        lights[i].cascades = &cascades[i];
        lights[i].cascadeCount = 1;
        const std::vector<float> layer = even(64, orthographic, 1 + i);
        values.insert(values.end(), layer.begin(), layer.end());
    }
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, values);
    const NacreImage maps[] = {map.nacre()};
    const Result result = transmit(plane, lights, maps);
    const std::unique_ptr<Profile> profile = makeProfile(marble());
    const double expected = profile->slabTransmittance(0, 1) + profile->slabTransmittance(0, 2);
    EXPECT_NEAR(result.thickness[at(20, 20)], 1, 0.02) << "the smallest";
    EXPECT_NEAR(result.light[at(20, 20)][0], expected, 0.02 * expected);
}

TEST_F(ShadowChoiceTest, NormalsThatAreNoNumbersStayDarkAndStrengthEndsAtOne) {
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, even(64, orthographic, 1));
    const NacreImage maps[] = {map.nacre()};
    NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
    setMatrix(source.shadowClipFromWorld, orthographic, 60);
    ScatterInput input =
        ScatterInput::plane(imageSize, imageSize, Projection::orthographic(imageSize, imageSize, 1 / pixel), 500);
    input.normal.assign(input.depth.size(), {0, 0, 1, 0});
    input.strength.assign(input.depth.size(), 1);
    input.normal[at(5, 5)][0] = std::numeric_limits<float>::quiet_NaN();
    input.strength[at(20, 20)] = 3;
    Result result;
    ASSERT_EQ(call(input, {&source, 1}, maps, result), NACRE_SUCCESS);
    EXPECT_EQ(result.light[at(5, 5)][0], 0);
    EXPECT_GT(result.light[at(21, 20)][0], 0.01f);
    EXPECT_NEAR(result.light[at(20, 20)][0], result.light[at(21, 20)][0], 1e-4);
}

TEST_F(ShadowChoiceTest, WrongMapsAreNamed) {
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, even(64, orthographic, 1));
    const auto refuse = [&](const std::function<void(NacreLight&)>& change, const std::string& sentence,
                            VkFormat format = VK_FORMAT_R32_SFLOAT) {
        NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
        setMatrix(source.shadowClipFromWorld, orthographic, 60);
        source.shadowRange = 1000;
        change(source);
        NacreImage image = map.nacre();
        image.format = format;
        expectRefused(source, {&image, 1}, sentence);
    };
    const auto linear = [](NacreLight& source) { source.shadowDepthEncoding = NACRE_DEPTH_LINEAR; };
    for (const auto& [format, name] : {std::pair{VK_FORMAT_D16_UNORM, "VK_FORMAT_D16_UNORM"},
                                       std::pair{VK_FORMAT_X8_D24_UNORM_PACK32, "VK_FORMAT_X8_D24_UNORM_PACK32"},
                                       std::pair{VK_FORMAT_D24_UNORM_S8_UINT, "VK_FORMAT_D24_UNORM_S8_UINT"},
                                       std::pair{VK_FORMAT_D32_SFLOAT_S8_UINT, "VK_FORMAT_D32_SFLOAT_S8_UINT"}}) {
        refuse(linear, std::string("has the depth format ") + name, format);
    }
    constexpr float infinite = std::numeric_limits<float>::infinity();
    refuse([&](NacreLight& s) { linear(s), s.shadowRange = infinite; }, "lights[0].shadowRange is inf");
    refuse([](NacreLight& s) { s.direction[0] = infinite; }, "lights[0].direction[0] is inf");
    refuse([](NacreLight& s) { s.shadowClipFromWorld[1] = infinite; }, "lights[0].shadowClipFromWorld[1] is inf");
    refuse([](NacreLight& s) { s.shadowRectangle = {{0, 1}, {64, 64}}; }, "shadowRectangle is 64x64 at 0,1, must lie");
    refuse([](NacreLight& s) { s.shadowRectangle = {{-1, 0}, {8, 8}}; }, "shadowRectangle is 8x8 at -1,0, must lie");
    refuse([](NacreLight& s) { s.shadowRectangle = {{0, 0}, {8, 0}}; }, "shadowRectangle is 8x0 at 0,0, must lie");
    NacreShadowCascade cascade{};
    setMatrix(cascade.clipFromWorld, orthographic, 60);
    cascade.farDepth = infinite;
    refuse(
        [&](NacreLight& s) {
            s.cascades = &cascade, s.cascadeCount = 1, s.cascadeChoice = NACRE_CASCADE_BY_VIEW_DEPTH;
        },
        "lights[0].cascades[0].farDepth is inf");
}

} // namespace
