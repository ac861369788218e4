// Smooth random fields that are the same on every machine.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace nacre::scene::gallery {

/// [-1, 1] of a lattice point: integer mixing (Wellons, "Prospecting for hash functions", 2018).
inline float latticeValue(const glm::ivec3& p) {
    auto h = std::uint32_t(p.x) * 0x9e3779b9u + std::uint32_t(p.y) * 0x85ebca6bu + std::uint32_t(p.z) * 0xc2b2ae35u;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    h ^= h >> 16;
    return float(h >> 8) * (2.f / 16777216.f) - 1;
}

/// Value noise in [-1, 1] with one feature a unit, twice differentiable.
inline float noise(const glm::vec3& p) {
    const glm::vec3 whole = glm::floor(p), f = p - whole;
    const glm::ivec3 i(whole);
    const glm::vec3 w = f * f * f * (f * (f * 6.f - 15.f) + 10.f);
    float planes[2];
    for (int z = 0; z < 2; ++z) {
        const float low = glm::mix(latticeValue(i + glm::ivec3(0, 0, z)), latticeValue(i + glm::ivec3(1, 0, z)), w.x);
        const float high = glm::mix(latticeValue(i + glm::ivec3(0, 1, z)), latticeValue(i + glm::ivec3(1, 1, z)), w.x);
        planes[z] = glm::mix(low, high, w.y);
    }
    return glm::mix(planes[0], planes[1], w.z);
}

} // namespace nacre::scene::gallery
