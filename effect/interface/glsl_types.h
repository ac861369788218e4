// The types of GLSL in C++, and constants that both have. Headers of blocks are included by both: their structures are
// vec4-aligned, so that std140, std430 and C++ agree, which static_asserts at their ends check.
#ifndef NACRE_EFFECT_GLSL_TYPES_H
#define NACRE_EFFECT_GLSL_TYPES_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>

namespace nacre::effect {

using uint = std::uint32_t;
struct vec2 {
    float x, y;
};
struct ivec2 {
    std::int32_t x, y;
};
struct ivec4 {
    std::int32_t x, y, z, w;
};
struct vec4 {
    float x, y, z, w;
};
struct uvec2 {
    uint x, y;
};
struct uvec4 {
    uint x, y, z, w;
};
struct mat4 {
    vec4 columns[4];
};

} // namespace nacre::effect

#define NACRE_CONSTANT inline constexpr uint
#define NACRE_FUNCTION constexpr
#else
#define NACRE_CONSTANT const uint
#define NACRE_FUNCTION
#endif

#endif
