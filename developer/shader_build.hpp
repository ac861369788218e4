// The project's shaders as its build folder has them, compiled anew on demand. Only developer builds (NACRE_DEVELOPER)
// use it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nacre::developer {

/// The build folder: that of this build or, where the environment variable NACRE_SHADER_BUILD is set, the one it names.
std::string buildFolder();

/// Builds target `shaders` there: compiles what has changed. Throws std::runtime_error with the compiler's message.
void compileShaders();

/// The words of `library`/spirv/`name`.spv. Throws std::runtime_error naming the file.
std::vector<std::uint32_t> readSpirv(const std::string& library, const std::string& name);

} // namespace nacre::developer
