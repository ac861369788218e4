// A developer build's shaders: a copy of the project is configured, its shaders are changed and broken, and the effect
// compiles and loads them again.
#include "developer/shader_build.hpp"
#include "effect/api/nacre_developer.h"
#include "tests/gpu/support/effect.hpp"
#include "tests/support/temporary_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace nacre;
using namespace nacre::tests;

namespace {

/// What the effect's shaders are compiled from, with a build folder of its own.
class ProjectCopy {
public:
    ProjectCopy() {
        const std::filesystem::path project = NACRE_SOURCE_DIR;
        for (const char* part : {"CMakeLists.txt", "cmake", "core", "developer", "effect", "include"}) {
            std::filesystem::copy(project / part, folder_.path / part, std::filesystem::copy_options::recursive);
        }
        const std::string path = folder_.path.string();
        const std::string command = "cmake -G Ninja -DNACRE_DEVELOPER=ON -DNACRE_BUILD_APP=OFF -DNACRE_BUILD_TESTS=OFF "
                                    "-S '" +
                                    path + "' -B '" + path + "/build' > '" + path + "/log'";
        if (std::system(command.c_str()) != 0) {
            throw std::runtime_error("failed: " + command);
        }
        setenv("NACRE_SHADER_BUILD", (path + "/build").c_str(), 1);
        developer::compileShaders();
    }
    ~ProjectCopy() { unsetenv("NACRE_SHADER_BUILD"); }
    ProjectCopy(const ProjectCopy&) = delete;

    /// Puts `after` in the place of `before`, which is there once.
    void change(const std::string& file, const std::string& before, const std::string& after) const {
        std::stringstream text;
        text << std::ifstream(folder_.path / file).rdbuf();
        std::string changed = text.str();
        const std::size_t place = changed.find(before);
        if (place == std::string::npos || changed.find(before, place + 1) != std::string::npos) {
            throw std::runtime_error(file + " does not have once: " + before);
        }
        std::ofstream(folder_.path / file) << changed.replace(place, before.size(), after);
    }

private:
    TemporaryFolder folder_;
};

TEST_F(GpuTest, ReloadsShadersAndKeepsThePipelinesWhereOneIsBroken) {
    const ProjectCopy project;
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
