#include "frame_block.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace {

constexpr float nearPlane = 0.01f;

/// A projection that looks along -Z, with depth 1 at the near plane and 0 infinitely far. Vulkan's clip space has y
/// down.
glm::mat4 reversedPerspective(float fieldOfView, float aspect) {
    const float f = 1 / std::tan(fieldOfView / 2);
    return {{f / aspect, 0, 0, 0}, {0, -f, 0, 0}, {0, 0, 0, -1}, {0, 0, nearPlane, 0}};
}

/// The light's matrix for the part of the camera's frustum between two depths.
glm::mat4 cascadeMatrix(const FrameBlock& frame, float from, float to) {
    glm::vec3 corners[8];
    glm::vec3 middle(0);
    for (int i = 0; i < 8; ++i) {
        const float depth = i < 4 ? from : to;
        const glm::vec4 point((i & 1 ? depth : -depth) / frame.clipFromView[0][0],
                              (i & 2 ? depth : -depth) / frame.clipFromView[1][1], -depth, 1);
        corners[i] = frame.worldFromView * point;
        middle += corners[i] / 8.0f;
    }
    float radius = 0;
    for (const glm::vec3& corner : corners) {
        radius = std::max(radius, glm::length(corner - middle));
    }
    const glm::vec3 direction(frame.lightDirection);
    const glm::mat4 view = glm::lookAt(middle - direction, middle, glm::vec3(0, 1, 0));
    return glm::ortho(-radius, radius, -radius, radius, 0.0f, 2.0f) * view;
}

} // namespace

FrameBlock makeFrame(VkExtent2D extent, int number) {
    FrameBlock frame{};
    const float aside = 0.002f * static_cast<float>(number);
    frame.viewFromWorld =
        glm::lookAt(glm::vec3(0.01f + aside, 0.055f, 0.17f), glm::vec3(0, 0.022f, 0), glm::vec3(0, 1, 0));
    frame.worldFromView = glm::inverse(frame.viewFromWorld);
    frame.clipFromView =
        reversedPerspective(0.7f, static_cast<float>(extent.width) / static_cast<float>(extent.height));
    frame.lightDirection = glm::vec4(glm::normalize(glm::vec3(-0.25f, -0.45f, 0.85f)), 6.0f);
    frame.cascadeEnds = {0.14f, 0.2f, 0.32f, 0.8f};
    for (std::uint32_t i = 0; i < cascadeCount; ++i) {
        frame.shadowClipFromWorld[i] =
            cascadeMatrix(frame, i == 0 ? nearPlane : frame.cascadeEnds[i - 1], frame.cascadeEnds[i]);
    }
    frame.bodies[0] = {{0, -0.1f, -0.1f, 0}, {0.6f, 0.1f, 0.6f, 0}}; // the table
    for (int i = 1; i < int{bodyCount}; ++i) {                       // balls and sheets, one behind the other
        const bool isSheet = i % 2 == 0;
        const float x = 0.05f * static_cast<float>(i % 3 - 1);
        const float z = 0.06f - 0.045f * static_cast<float>(i);
        frame.bodies[i] = {{x, 0.021f, z, 1 + i % 3}, {0.02f, 0.02f, isSheet ? 0.0015f : 0.02f, 0}};
    }
    return frame;
}
