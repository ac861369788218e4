// NacreMaterial::secondSurfaces: `bank` scatters frames whose materials ask for them as `bank-surfaces` does, others as
// before.
#include "tests/gpu/support/scene_input.hpp"

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr std::uint32_t both = 1u << NACRE_TECHNIQUE_BANK | 1u << NACRE_TECHNIQUE_BANK_SURFACES;

class SecondSurfacesTest : public GpuTest {
protected:
    SecondSurfacesTest()
        : scene_(makeScatterScene({.kind = SceneKind::Thin, .footprint = 20, .width = 96, .height = 64})),
          input_(toInput(scene_)),
          asking_(scene_.materials) {
        asking_.back().secondSurfaces = true;
    }
    std::unique_ptr<Effect> makeEffect(std::uint32_t techniques) {
        NacreContextInfo info = gpu.contextInfo(input_.extent);
        info.techniques = techniques;
        auto effect = std::make_unique<Effect>(gpu, info);
        effect->setMaterials(scene_.materials);
        return effect;
    }
    NacreCost cost(Effect& effect, NacreTechnique technique) {
        NacreCost result{};
        EXPECT_EQ(nacreGetScatterCost(effect.context, technique, &result), NACRE_SUCCESS);
        return result;
    }
    ScatterScene scene_;
    ScatterInput input_;
    std::vector<Material> asking_; ///< the scene's, one of which asks
};

TEST_F(SecondSurfacesTest, OneMaterialThatAsksIsEnough) {
    const auto effect = makeEffect(both);
    const std::vector<Float4> one = effect->scatter(input_, NACRE_TECHNIQUE_BANK);
    const std::vector<Float4> two = effect->scatter(input_, NACRE_TECHNIQUE_BANK_SURFACES);
    EXPECT_NE(one, two);
    effect->setMaterials(asking_);
    EXPECT_EQ(effect->scatter(input_, NACRE_TECHNIQUE_BANK), two);
    EXPECT_EQ(effect->scatter(input_, NACRE_TECHNIQUE_DEFAULT), two);
    EXPECT_EQ(effect->scatter(input_, NACRE_TECHNIQUE_BANK_SURFACES), two);
    effect->setMaterials(scene_.materials);
    EXPECT_EQ(effect->scatter(input_, NACRE_TECHNIQUE_BANK), one);
}

TEST_F(SecondSurfacesTest, OtherTechniquesAndOtherContextsDoNotAsk) {
    const auto effect = makeEffect(1u << NACRE_TECHNIQUE_BANK | 1u << NACRE_TECHNIQUE_SEPARABLE);
    const std::vector<Float4> bank = effect->scatter(input_, NACRE_TECHNIQUE_BANK);
    const std::vector<Float4> separable = effect->scatter(input_, NACRE_TECHNIQUE_SEPARABLE);
    effect->setMaterials(asking_);
    EXPECT_EQ(effect->scatter(input_, NACRE_TECHNIQUE_BANK), bank);
    EXPECT_EQ(effect->scatter(input_, NACRE_TECHNIQUE_SEPARABLE), separable);
}

TEST_F(SecondSurfacesTest, AFrameAsksTheMaterialsThatItBeganWith) {
    const auto effect = makeEffect(both);
    const std::vector<Float4> one = effect->scatter(input_, NACRE_TECHNIQUE_BANK);
    const ScatterImages images(gpu, input_);
    ASSERT_EQ(nacreBeginFrame(effect->context, 0), NACRE_SUCCESS);
    effect->setMaterials(asking_);
    gpu.run([&](VkCommandBuffer commandBuffer) {
        EXPECT_EQ(nacreCmdScatter(effect->context, commandBuffer, &images.info), NACRE_SUCCESS);
    });
    EXPECT_EQ(downloadLight(gpu, images.scattered), one);
}

TEST_F(SecondSurfacesTest, CostsAreOfThePassesThatWillRun) {
    const auto effect = makeEffect(both);
    const NacreCost surfaces = cost(*effect, NACRE_TECHNIQUE_BANK_SURFACES);
    EXPECT_LT(cost(*effect, NACRE_TECHNIQUE_BANK).intermediateBytes, surfaces.intermediateBytes);
    effect->setMaterials(asking_);
    EXPECT_EQ(cost(*effect, NACRE_TECHNIQUE_BANK).intermediateBytes, surfaces.intermediateBytes);
    EXPECT_EQ(cost(*effect, NACRE_TECHNIQUE_BANK).passNames, surfaces.passNames);
}

TEST_F(SecondSurfacesTest, BothTechniquesShareATable) {
    NacreMemoryRequirements one{};
    NacreMemoryRequirements two{};
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    info.techniques = 1u << NACRE_TECHNIQUE_BANK;
    ASSERT_EQ(nacreGetMemoryRequirements(&info, &one), NACRE_SUCCESS);
    info.techniques = both;
    ASSERT_EQ(nacreGetMemoryRequirements(&info, &two), NACRE_SUCCESS);
    EXPECT_EQ(one.host.size, two.host.size);
    EXPECT_LT(one.device.size, two.device.size);
}

} // namespace
