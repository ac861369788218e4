// The viewer's loop without a window: what frames take, and turntables.
#pragma once

#include "renderer/graphics_device.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nacre::view {

struct HeadlessSettings {
    std::uint32_t frames = 120; ///< [≥ 2] of each run
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t shadowMapSize = 2048;
};

/// Median and 99th percentile, the nearest value at or above that share.
struct Distribution {
    double median = 0;
    double p99 = 0;
};
Distribution distributionOf(std::vector<double> values);

/// What this program has allocated and not freed, bytes.
std::int64_t heapBytes();

/// What changes from frame to frame beside the camera.
enum class Moving { Nothing, Lights, Material };

/// What the frames of one run took, ms.
struct HeadlessRun {
    Distribution frame;                                 ///< on the device
    Distribution effect;                                ///< scatter and transmit, on the device
    Distribution processor;                             ///< from the first change to the submission, without waits
    Distribution interval;                              ///< from one frame to the next
    std::vector<std::pair<std::string, double>> passes; ///< medians, in order
    std::uint32_t memoryFrame = 0;                      ///< 100, or half of the frames where there are fewer than 200
    std::int64_t memory = 0;                            ///< bytes that the program had allocated after that frame
    std::int64_t memoryAtEnd = 0;
    std::uint64_t deviceAllocations = 0; ///< made while frames were drawn
    std::uint64_t waits = 0;             ///< for the device, but for the fence of the frame whose place the next takes
};

/// Draws `frames` frames while the camera goes around the scene, and the lights with it or the first material's scale
/// up and down.
HeadlessRun runHeadless(renderer::Device& device, const scene::Scene& scene, const HeadlessSettings& settings,
                        Moving moving);

struct TurntableSettings {
    std::uint32_t count = 36; ///< [≥ 1] frames of a whole turn
    std::uint32_t first = 0;  ///< frames that are drawn, [first, last]
    std::uint32_t last = 35;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t samples = 16; ///< [≥ 1] of a picture
    std::uint32_t shadowMapSize = 2048;
    std::filesystem::path folder; ///< gets 0000.png, 0001.png, …
};

/// Draws pictures from around the scene. Frame i is the same whichever frames are drawn beside it.
void drawTurntable(renderer::Device& device, const scene::Scene& scene, const TurntableSettings& settings);

} // namespace nacre::view
