// A copy of the project whose shaders a test may change and break, for programs that have the sources of a developer
// build.
#pragma once

#include "developer/shader_build.hpp"
#include "tests/support/temporary_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>

namespace nacre::tests {

/// The project's shaders, but for the baselines', with a build folder of their own, compiled. As long as it lives the
/// program takes them from there.
class ProjectCopy {
public:
    /// `folders`: what is configured. `options`: for CMake.
    ProjectCopy(std::initializer_list<const char*> folders, const std::string& options) {
        const std::filesystem::path project = NACRE_SOURCE_DIR;
        std::filesystem::copy(project / "CMakeLists.txt", folder_.path);
        for (const char* folder : folders) {
            std::filesystem::copy(project / folder, folder_.path / folder, std::filesystem::copy_options::recursive);
        }
        const std::string path = folder_.path.string();
        const std::string command = "cmake -G Ninja -DNACRE_DEVELOPER=ON -DNACRE_BUILD_TESTS=OFF "
                                    "-DNACRE_BUILD_BASELINES=OFF " +
                                    options + " -S '" + path + "' -B '" + path + "/build' > '" + path + "/log'";
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

} // namespace nacre::tests
