// What the headers that nacre_shader makes (NAME.spv.h) define: a shader's SPIR-V, and its name.
#pragma once

#include <cstdint>
#include <span>

namespace nacre {

struct EmbeddedShader {
    const char* name; ///< spirv/NAME.spv in the build folder of its library has the same words
    std::span<const std::uint32_t> words;

    constexpr operator std::span<const std::uint32_t>() const { return words; }
};

} // namespace nacre
