// A developer build's shaders: a copy of the project is configured, its shaders are changed and broken, and the effect
// compiles and loads them again.
#include "effect/api/nacre_developer.h"
#include "tests/gpu/support/effect.hpp"
#include "tests/gpu/support/project_copy.hpp"

using namespace nacre;
using namespace nacre::tests;

namespace {

TEST_F(GpuTest, ReloadsShadersAndKeepsThePipelinesWhereOneIsBroken) {
    const ProjectCopy project({"cmake", "core", "developer", "effect", "include"}, "-DNACRE_BUILD_APP=OFF");
    const std::string file = "effect/separable/scatter_separable.comp";
    const std::string line = "return light / max(weight, vec3(1e-20));";
    const ScatterInput input = ScatterInput::plane(32, 32, Projection::perspective(32, 32, 40), 100);
    NacreContextInfo info = gpu.contextInfo(input.extent);
    info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
    Effect effect(gpu, info);
    const Material material = skin();
    effect.setMaterials({&material, 1});
    const std::size_t middle = input.index(16, 16);
    const auto draw = [&] { return effect.scatter(input, NACRE_TECHNIQUE_SEPARABLE); };
    const std::vector<Float4> before = draw();
    EXPECT_NEAR(before[middle][0], 1, 1e-3f);

    project.change(file, line, "return 0.5 * light / max(weight, vec3(1e-20));");
    ASSERT_EQ(nacreReloadShaders(effect.context), NACRE_SUCCESS);
    const std::vector<Float4> halved = draw();
    EXPECT_NEAR(halved[middle][0], 0.25f * before[middle][0], 1e-3f) << "along rows and columns";

    project.change(file, "0.5 * light", "0.5 * lihgt");
    EXPECT_EQ(nacreReloadShaders(effect.context), NACRE_ERROR_INVALID_ARGUMENT);
    ASSERT_FALSE(effect.messages.empty());
    EXPECT_NE(effect.messages.back().find("scatter_separable.comp"), std::string::npos) << effect.messages.back();
    EXPECT_NE(effect.messages.back().find("'lihgt' : undeclared identifier"), std::string::npos)
        << effect.messages.back();
    EXPECT_EQ(draw(), halved);

    project.change(file, "return 0.5 * lihgt / max(weight, vec3(1e-20));", line);
    ASSERT_EQ(nacreReloadShaders(effect.context), NACRE_SUCCESS);
    EXPECT_EQ(draw(), before);
}

} // namespace
