// What a frame took.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nacre::renderer {

struct PassTime {
    std::string name;
    double microseconds = 0;
};

/// Device memory of one part of the renderer.
struct MemoryUse {
    std::string name;
    std::uint64_t bytes = 0;
};

/// What a frame did.
struct FrameReport {
    /// In order of execution. The effect's are called "transmit: …" and "scatter: …".
    std::vector<PassTime> passes;
    double totalMicroseconds = 0;     ///< first to last timestamp
    double recordingMicroseconds = 0; ///< processor time to record it
    /// Of the effect alone: of one repetition, or without repetitions the sum of the effect's passes.
    double effectMicroseconds = 0;
    double copyMicroseconds = 0;   ///< of the effect alone: of the pass "copy", repeated alike
    std::uint64_t copyBytes = 0;   ///< what the pass "copy" reads and writes; 0 without RenderSettings::copyFloor
    std::vector<MemoryUse> memory; ///< of the renderer's parts, and of the effect's intermediates and materials
    std::uint32_t scatterDispatches = 0;
    std::uint32_t transmitDispatches = 0;
    std::uint64_t effectBytes = 0; ///< intermediates of the effect
    std::uint64_t triangles = 0;
    std::uint32_t lights = 0;
    std::uint32_t shadowLayersDrawn = 0; ///< layers of the shadow maps; a point light has six
    std::uint32_t materials = 0;
    double subsurfaceCoverage = 0; ///< [0, 1] share of pixels with a subsurface material
};

} // namespace nacre::renderer
