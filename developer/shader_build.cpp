#include "developer/shader_build.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace nacre::developer {
namespace {

/// As a word of the shell.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char letter : text) {
        result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    }
    return result + "'";
}

} // namespace

std::string buildFolder() {
    const char* folder = std::getenv("NACRE_SHADER_BUILD");
    return folder ? folder : NACRE_BUILD_FOLDER;
}

void compileShaders() {
    const std::string command = "cmake --build " + quoted(buildFolder()) + " --target shaders 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) {
        throw std::runtime_error("cannot run " + command);
    }
    std::string output;
    std::array<char, 4096> part;
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe)) {
        output.append(part.data(), count);
    }
    if (pclose(pipe) != 0) {
        throw std::runtime_error("the shaders do not compile: " + output);
    }
}

std::vector<std::uint32_t> readSpirv(const std::string& library, const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(buildFolder()) / library / "spirv" / (name + ".spv");
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
    if (size <= 0 || size % 4 != 0) {
        throw std::runtime_error(path.string() + " is no SPIR-V; build the target shaders");
    }
    std::vector<std::uint32_t> words(static_cast<std::size_t>(size) / 4);
    file.seekg(0);
    file.read(reinterpret_cast<char*>(words.data()), size);
    if (!file) {
        throw std::runtime_error(path.string() + " cannot be read");
    }
    return words;
}

} // namespace nacre::developer
