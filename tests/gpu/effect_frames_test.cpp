// Frames in flight, views, material updates, resizing, timestamps and several contexts.
#include "nacre/nacre.hpp"
#include "tests/gpu/support/effect.hpp"

#include <cmath>

using namespace nacre;
using namespace nacre::tests;

namespace {

class FramesTest : public GpuTest {
protected:
    FramesTest() : input_(ScatterInput::plane(32, 16, Projection::perspective(32, 16, 1000), 500)) {
        for (std::uint32_t y = 0; y < 16; ++y) {
            for (std::uint32_t x = 0; x < 16; ++x) {
                input_.irradiance[input_.index(x, y)] = {0, 0, 0, 1};
            }
        }
    }
    NacreContextInfo info() const {
        NacreContextInfo result = gpu.contextInfo(input_.extent);
        result.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        return result;
    }
    ScatterImages images() {
        ScatterImages result(gpu, input_);
        result.info.technique = NACRE_TECHNIQUE_SEPARABLE;
        return result;
    }
    static Material wide(double variance) {
        Material material;
        material.layers = {{{1, 1, 1}, variance}};
        return material;
    }
    std::vector<Float4> alone(const Material& material) {
        Effect effect(gpu, info());
        effect.setMaterials({&material, 1});
        return effect.scatter(input_, NACRE_TECHNIQUE_SEPARABLE);
    }
    ScatterInput input_;
};

TEST_F(FramesTest, AFrameSeesTheMaterialsSetBeforeItBegan) {
    const Material first = wide(0.1);
    const Material second = wide(4);
    const std::vector<Float4> expected[] = {alone(first), alone(second)};
    Effect effect(gpu, info());
    ScatterImages targets[] = {images(), images()};
    const VkCommandBuffer commandBuffer = gpu.begin();
    effect.setMaterials({&first, 1});
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    ASSERT_EQ(nacreCmdScatter(effect.context, commandBuffer, &targets[0].info), NACRE_SUCCESS);
    // The first frame is recorded and not yet run.
    effect.setMaterials({&second, 1});
    ASSERT_EQ(nacreBeginFrame(effect.context, 1), NACRE_SUCCESS);
    ASSERT_EQ(nacreCmdScatter(effect.context, commandBuffer, &targets[1].info), NACRE_SUCCESS);
    gpu.submit(commandBuffer);
    EXPECT_EQ(gpu.download<Float4>(targets[0].scattered), expected[0]);
    EXPECT_EQ(gpu.download<Float4>(targets[1].scattered), expected[1]);
}

TEST_F(FramesTest, ManyUpdatesReachEveryFrame) {
    const std::vector<Material> materials = {wide(0.1), wide(1), wide(4)};
    std::vector<std::vector<Float4>> expected;
    for (const Material& material : materials) {
        expected.push_back(alone(material));
    }
    Effect effect(gpu, info());
    ScatterImages target = images();
    for (std::uint32_t i = 0; i < 200; ++i) {
        const std::size_t which = i * 7 % 3;
        effect.setMaterials({&materials[which], 1});
        if (i % 20 != 0) {
            continue;
        }
        ASSERT_EQ(nacreBeginFrame(effect.context, i / 20 % 2), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            ASSERT_EQ(nacreCmdScatter(effect.context, commandBuffer, &target.info), NACRE_SUCCESS);
        });
        ASSERT_EQ(gpu.download<Float4>(target.scattered), expected[which]);
    }
}

TEST_F(FramesTest, RefusedMaterialsChangeNothing) {
    const Material material = wide(1);
    Effect effect(gpu, info());
    effect.setMaterials({&material, 1});
    const std::vector<Float4> expected = effect.scatter(input_, NACRE_TECHNIQUE_SEPARABLE);
    std::vector<NacreLayer> storage;
    NacreMaterial materials[2] = {toNacre(wide(9), storage), nacreDefaultMaterial()};
    ASSERT_NE(nacreSetMaterials(effect.context, 1, 2, materials), NACRE_SUCCESS);
    EXPECT_EQ(effect.scatter(input_, NACRE_TECHNIQUE_SEPARABLE), expected);
}

TEST_F(FramesTest, ViewsAreRecordsOfOneFrame) {
    const Material material = wide(1);
    const std::vector<Float4> expected = alone(material);
    NacreContextInfo two = info();
    two.recordsPerFrame = 2;
    Effect effect(gpu, two);
    effect.setMaterials({&material, 1});
    const ScatterImages left = images();
    const ScatterImages right = images();
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    gpu.run([&](VkCommandBuffer commandBuffer) {
        EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &left.info), NACRE_SUCCESS);
        EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &right.info), NACRE_SUCCESS);
    });
    EXPECT_EQ(gpu.download<Float4>(left.scattered), expected);
    EXPECT_EQ(gpu.download<Float4>(right.scattered), expected);
}

TEST_F(FramesTest, ResizingKeepsTheMaterials) {
    const Material material = wide(1);
    NacreContextInfo small = info();
    small.maxExtent = {8, 8};
    Effect effect(gpu, small);
    effect.setMaterials({&material, 1});
    EXPECT_THROW(effect.scatter(input_, NACRE_TECHNIQUE_SEPARABLE), std::runtime_error);
    EXPECT_EQ(nacreResize(effect.context, {0, 0}, nullptr), NACRE_ERROR_INVALID_ARGUMENT);
    ASSERT_EQ(nacreResize(effect.context, input_.extent, nullptr), NACRE_SUCCESS);
    EXPECT_EQ(effect.scatter(input_, NACRE_TECHNIQUE_SEPARABLE), alone(material));
}

TEST_F(FramesTest, ContextsAreIndependent) {
    const Material first = wide(0.1);
    const Material second = wide(4);
    Effect a(gpu, info());
    Effect b(gpu, info());
    a.setMaterials({&first, 1});
    b.setMaterials({&second, 1});
    EXPECT_EQ(a.scatter(input_, NACRE_TECHNIQUE_SEPARABLE), alone(first));
    EXPECT_EQ(b.scatter(input_, NACRE_TECHNIQUE_SEPARABLE), alone(second));
}

TEST_F(FramesTest, TheWrapperOwnsItsContext) {
    std::vector<NacreLayer> storage;
    const NacreMaterial material = toNacre(wide(1), storage);
    Context context;
    ASSERT_EQ(Context::create(info(), context), NACRE_SUCCESS);
    Context moved = std::move(context);
    EXPECT_FALSE(context);
    ASSERT_TRUE(moved);
    ASSERT_EQ(moved.setMaterials(1, {&material, 1}), NACRE_SUCCESS);
    ASSERT_EQ(moved.beginFrame(0), NACRE_SUCCESS);
    ScatterImages target = images();
    gpu.run(
        [&](VkCommandBuffer commandBuffer) { EXPECT_EQ(moved.cmdScatter(commandBuffer, target.info), NACRE_SUCCESS); });
    EXPECT_EQ(gpu.download<Float4>(target.scattered), alone(wide(1)));
    NacreContextInfo wrong = info();
    wrong.headerVersion = 0;
    EXPECT_EQ(Context::create(wrong, moved), NACRE_ERROR_VERSION_MISMATCH);
    EXPECT_TRUE(moved) << "a failure keeps the old context";
}

TEST_F(FramesTest, EveryPassIsTimed) {
    const Material material = wide(1);
    Effect effect(gpu, info());
    effect.setMaterials({&material, 1});
    NacreCost cost{};
    ASSERT_EQ(nacreGetScatterCost(effect.context, NACRE_TECHNIQUE_SEPARABLE, &cost), NACRE_SUCCESS);
    ASSERT_EQ(cost.passCount, 2u);
    EXPECT_STREQ(cost.passNames[0], "nacre separable rows");
    ScatterImages target = images();
    ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    const std::vector<double> times =
        gpu.runTimed(cost.passCount + 1, [&](VkCommandBuffer commandBuffer, VkQueryPool pool) {
            target.info.timestamps = {pool, 0};
            EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &target.info), NACRE_SUCCESS);
        });
    for (const double time : times) {
        EXPECT_GT(time, 0);
    }
}

} // namespace
