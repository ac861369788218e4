// Scenes in other units: what is said in metres looks as what is said in millimetres.
#include "tests/gpu/support/slab_maps.hpp"

#include <cmath>

using namespace nacre;
using namespace nacre::tests;

namespace {

/// mm, of a unit of the scene: neither powers of two nor near to each other.
constexpr double units[] = {0.3, 10, 1000};

/// A matrix of millimetres for points in units.
void toUnits(float* matrix, double unit) {
    for (int i = 0; i < 12; ++i) { // not the translation
        matrix[i] *= static_cast<float>(unit);
    }
}

void toUnits(NacreView& view, double unit) {
    view.metersPerUnit = static_cast<float>(1e-3 * unit);
}

void toUnits(NacreLight& light, double unit) {
    for (float& coordinate : light.position) {
        coordinate /= static_cast<float>(unit);
    }
    light.shadowRange /= static_cast<float>(unit);
    toUnits(light.shadowClipFromWorld, unit);
}

void toUnits(ScatterInput& input, double unit) {
    toUnits(input.view, unit);
    toUnits(input.view.clipFromView, unit);
    for (float& depth : input.depth) {
        depth /= static_cast<float>(unit);
    }
}

void expectSame(std::span<const Float4> actual, std::span<const Float4> expected, double unit) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(actual[i][0], expected[i][0], 1e-3 * expected[i][0] + 1e-5) << "unit " << unit << ", pixel " << i;
    }
}

using UnitsOfScatterTest = GpuTest;

TEST_F(UnitsOfScatterTest, EveryTechniqueBlursAsWide) {
    constexpr NacreTechnique techniques[] = {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BRUTE, NACRE_TECHNIQUE_BANK,
                                             NACRE_TECHNIQUE_BURLEY, NACRE_TECHNIQUE_BANK_SURFACES};
    // Light in stripes on two planes, one 5 mm behind the other.
    ScatterInput stripes = ScatterInput::plane(48, 32, Projection::perspective(48, 32, 1000), 500);
    for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 48; ++x) {
            stripes.irradiance[stripes.index(x, y)] = x / 6 % 2 != 0 ? Float4{1, 1, 1, 1} : Float4{0.1f, 0.1f, 0.1f, 1};
            stripes.depth[stripes.index(x, y)] += y < 16 ? 0.0f : 5.0f;
        }
    }
    NacreContextInfo info = gpu.contextInfo(stripes.extent);
    info.techniques = 0;
    for (const NacreTechnique technique : techniques) {
        info.techniques |= 1u << technique;
    }
    Effect effect(gpu, info);
    const Material material = marble();
    effect.setMaterials(std::span(&material, 1));
    for (const NacreTechnique technique : techniques) {
        SCOPED_TRACE(technique);
        const std::vector<Float4> expected = effect.scatter(stripes, technique);
        for (const double unit : units) {
            ScatterInput input = stripes;
            toUnits(input, unit);
            expectSame(effect.scatter(input, technique), expected, unit);
        }
    }
}

class UnitsOfTransmitTest : public ShadowMapsTest {
protected:
    static constexpr double toLight[] = {-0.6, 0.8}; ///< along x and z
    static constexpr double reach = 10;              ///< mm, half of the map

    /// A plane that faces the camera and is lit on its left; on its right normals are turned from the light, so that it
    /// comes through there.
    static ScatterInput plane() {
        ScatterInput input =
            ScatterInput::plane(imageSize, imageSize, Projection::orthographic(imageSize, imageSize, 4), receiverDepth);
        for (std::uint32_t i = 0; i < imageSize * imageSize; ++i) {
            input.normal.push_back(i % imageSize < imageSize / 2 ? Float4{0, 0, 1, 0} : Float4{0.96f, 0, 0.28f, 0});
        }
        return input;
    }
    /// Entries above that plane, `thick` towards the light: how far from what the camera sees it may take for the same
    /// surface decides whether they count as seen.
    static std::vector<float> entries(std::uint32_t size, double thick) {
        std::vector<float> values;
        for (std::uint32_t i = 0; i < size * size; ++i) {
            const double across = (2 * (i % size + 0.5) / size - 1) * reach;
            values.push_back(
                static_cast<float>(orthographic.at(lightDepth - across * toLight[0] / toLight[1] - thick)));
        }
        return values;
    }
    /// A directional light whose map's middle is the plane's.
    static NacreLight slanted() {
        NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
        source.direction[0] = static_cast<float>(-toLight[0]);
        source.direction[2] = static_cast<float>(-toLight[1]);
        float(&m)[16] = source.shadowClipFromWorld;
        m[0] = static_cast<float>(toLight[1] / reach);
        m[8] = static_cast<float>(-toLight[0] / reach);
        m[12] = static_cast<float>(-toLight[0] * receiverDepth / reach);
        m[5] = static_cast<float>(1 / reach);
        m[2] = static_cast<float>(-toLight[0] * orthographic.z);
        m[10] = static_cast<float>(-toLight[1] * orthographic.z);
        m[14] = static_cast<float>((lightDepth - toLight[1] * receiverDepth) * orthographic.z + orthographic.z1);
        m[15] = 1;
        return source;
    }
    /// The call with everything in other units.
    Result callInUnits(ScatterInput input, NacreLight light, std::span<const NacreImage> maps, double unit) {
        toUnits(input, unit);
        toUnits(light, unit);
        Result result;
        EXPECT_EQ(call(input, std::span(&light, 1), maps, result), NACRE_SUCCESS);
        return result;
    }
};

TEST_F(UnitsOfTransmitTest, ABodyIsAsThickAndAsMuchOfItsLitSideIsSeen) {
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {24, 24}, entries(24, 2.5));
    const NacreImage maps[] = {map.nacre()};
    const NacreLight source = slanted();
    Result expected;
    ASSERT_EQ(call(plane(), std::span(&source, 1), maps, expected), NACRE_SUCCESS);
    const std::size_t middle = imageSize * imageSize / 2 + imageSize / 2;
    EXPECT_EQ(expected.light[middle + 1][0], 0) << "its entry is seen";
    EXPECT_GT(expected.light[middle + 10][0], 0.01) << "its entry is not lit";
    for (const double unit : units) {
        const Result result = callInUnits(plane(), source, maps, unit);
        expectSame(result.light, expected.light, unit);
        for (std::size_t i = 0; i < expected.thickness.size(); ++i) {
            ASSERT_NEAR(result.thickness[i], expected.thickness[i], 1e-3 * expected.thickness[i] + 1e-5)
                << "unit " << unit << ", pixel " << i;
        }
    }
}

/// Two cascades with a thickness each, split behind the receiver, before it, and blended into each other there.
TEST_F(UnitsOfTransmitTest, CascadesEndAsFar) {
    std::vector<float> values;
    for (int c = 0; c < 2; ++c) {
        values.insert(values.end(), 64 * 64, static_cast<float>(orthographic.at(lightDepth - receiverDepth - 1 - c)));
    }
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, values);
    const NacreImage maps[] = {map.nacre()};
    struct {
        double split;
        float blend;
        double thickness;
    } const cases[] = {{501, 0, 1}, {499, 0, 2}, {550, 0.2f, 1 + 0.5454}};
    for (const double unit : units) {
        for (const auto& [split, blend, thick] : cases) {
            NacreShadowCascade cascades[2]{};
            for (int c = 0; c < 2; ++c) {
                cascades[c].layer = static_cast<std::uint32_t>(c);
                cascades[c].farDepth = static_cast<float>((c == 0 ? split : 600) / unit);
                setMatrix(cascades[c].clipFromWorld, orthographic, 60);
                toUnits(cascades[c].clipFromWorld, unit);
            }
            NacreLight source = light(NACRE_LIGHT_DIRECTIONAL);
            source.cascades = cascades;
            source.cascadeCount = 2;
            source.cascadeChoice = NACRE_CASCADE_BY_VIEW_DEPTH;
            source.cascadeBlend = blend;
            ScatterInput input = ScatterInput::plane(imageSize, imageSize,
                                                     Projection::orthographic(imageSize, imageSize, 1), receiverDepth);
            input.normal.assign(imageSize * imageSize, {0, 0, 1, 0});
            toUnits(input, unit);
            Result result;
            ASSERT_EQ(call(input, std::span(&source, 1), maps, result), NACRE_SUCCESS);
            EXPECT_NEAR(result.thickness[imageSize * imageSize / 2 + imageSize / 2], thick, 0.03 * thick)
                << "unit " << unit << ", split " << split;
        }
    }
}

/// Lights whose distance counts: their irradiance falls with metres, whatever the unit.
TEST_F(UnitsOfTransmitTest, LampsShineAsFar) {
    const GpuImage map = createMap(VK_FORMAT_D32_SFLOAT, {64, 64}, slabMap(64, perspective, 0.12, 0));
    const NacreImage maps[] = {map.nacre()};
    NacreLight source = light(NACRE_LIGHT_SPOT);
    setMatrix(source.shadowClipFromWorld, perspective, 0.12);
    ScatterInput plane =
        ScatterInput::plane(imageSize, imageSize, Projection::orthographic(imageSize, imageSize, 1), receiverDepth);
    plane.normal.assign(imageSize * imageSize, {0, 0, 1, 0});
    Result expected;
    ASSERT_EQ(call(plane, std::span(&source, 1), maps, expected), NACRE_SUCCESS);
    EXPECT_GT(expected.light[imageSize * imageSize / 2 + imageSize / 2][0], 1e-3);
    for (const double unit : units) {
        const Result result = callInUnits(plane, source, maps, unit);
        expectSame(result.light, expected.light, unit);
    }
}

} // namespace
