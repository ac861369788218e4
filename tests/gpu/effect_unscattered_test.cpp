// Pixels without a material: they get the irradiance or, with skipUnscattered, are left as they are.
#include "tests/gpu/support/scene_input.hpp"

#include <limits>

namespace nacre::tests {
namespace {

constexpr std::uint16_t unsetId = 200;
constexpr Float4 mark{-3, -5, -7, -9};

class UnscatteredTest : public GpuTest, public testing::WithParamInterface<NacreTechnique> {
protected:
    // The scattered image, filled with `mark` before.
    std::vector<Float4> scatter(Effect& effect, const ScatterInput& input, VkBool32 skipUnscattered) {
        ScatterImages images(gpu, input);
        uploadLight(gpu, images.scattered, std::vector<Float4>(input.irradiance.size(), mark));
        images.info.technique = GetParam();
        images.info.skipUnscattered = skipUnscattered;
        nacreBeginFrame(effect.context, 0);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &images.info), NACRE_SUCCESS);
        });
        return downloadLight(gpu, images.scattered);
    }
};

INSTANTIATE_TEST_SUITE_P(Techniques, UnscatteredTest,
                         testing::Values(NACRE_TECHNIQUE_BANK, NACRE_TECHNIQUE_BANK_SURFACES, NACRE_TECHNIQUE_SEPARABLE,
                                         NACRE_TECHNIQUE_BURLEY, NACRE_TECHNIQUE_THESIS, NACRE_TECHNIQUE_BRUTE),
                         [](const auto& technique) {
                             std::string name = nacreTechniqueString(technique.param);
                             std::erase(name, '-');
                             return name;
                         });

// Silhouettes, holes, a strip without a material wider than any tile, and every way in which a pixel of a material may
// not scatter: no strength, no depth, a footprint below a pixel.
ScatterInput anyPixels(const ScatterScene& scene) {
    ScatterInput input = toInput(scene);
    input.strength.assign(input.depth.size(), 1);
    for (std::uint32_t y = 0; y < input.extent.height; ++y) {
        for (std::uint32_t x = 0; x < input.extent.width; ++x) {
            const std::size_t i = input.index(x, y);
            if (x >= 70 && x < 110) {
                input.materialId[i] = 0;
            } else if (y < 10) {
                input.materialId[i] = unsetId;
            } else if (y < 14) {
                input.strength[i] = 0;
            } else if (y < 18) {
                input.depth[i] = std::numeric_limits<float>::infinity();
            }
        }
    }
    return input;
}

void expectLeft(const ScatterInput& input, std::span<const Float4> written, std::span<const Float4> result) {
    int left = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const bool isLeft = input.materialId[i] == 0 || input.materialId[i] == unsetId;
        left += isLeft ? 1 : 0;
        ASSERT_NE(written[i], mark) << "pixel " << i << " was not written";
        ASSERT_EQ(result[i], isLeft ? mark : written[i]) << "pixel " << i << ", id " << input.materialId[i];
    }
    EXPECT_GT(left, 0);
}

TEST_P(UnscatteredTest, ArePassedOnOrLeftAlone) {
    NacreContextInfo info = gpu.contextInfo({168, 90});
    info.techniques = 1u << GetParam();
    Effect effect(gpu, info);
    for (const SceneKind kind : {SceneKind::Thin, SceneKind::Spheres}) {
        ScatterScene scene = makeScatterScene({.kind = kind, .footprint = 12, .width = 168, .height = 90});
        scene.materials.back().layers = {{{1, 1, 1}, 1e-8}}; // below a pixel
        scene.materials.back().meanFreePath.reset();
        effect.setMaterials(scene.materials);
        ScatterInput input = anyPixels(scene);
        for (const bool withAlbedo : {false, true}) {
            input.albedo.assign(withAlbedo ? input.depth.size() : 0, {0.9f, 0.5f, 0.25f, 1});
            const std::vector<Float4> written = scatter(effect, input, VK_FALSE);
            expectLeft(input, written, scatter(effect, input, VK_TRUE));
        }
    }
}

} // namespace
} // namespace nacre::tests
