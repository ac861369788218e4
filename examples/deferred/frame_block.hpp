// One frame of the example, as its shaders read it: camera, sun with shadow cascades, bodies.
#pragma once

#include <vulkan/vulkan.h>

#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#include <glm/glm.hpp>

#include <cstdint>

inline constexpr std::uint32_t bodyCount = 8;
inline constexpr std::uint32_t cascadeCount = 4;
inline constexpr std::uint32_t verticesOfBody = 6 * 48 * 64; // as in ellipsoid.glsl

/// As in ellipsoid.glsl. Metres.
struct FrameBlock {
    glm::mat4 viewFromWorld, clipFromView, worldFromView;
    glm::mat4 shadowClipFromWorld[cascadeCount];
    glm::vec4 cascadeEnds;
    glm::vec4 lightDirection;
    struct {
        glm::vec4 center, radius;
    } bodies[bodyCount];
};

FrameBlock makeFrame(VkExtent2D extent, int number);
