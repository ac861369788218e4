// How far two pictures are from each other, measured beside the window.
#pragma once

#include "image/image.hpp"

#include <array>
#include <future>
#include <optional>

namespace nacre::view {

/// What is compared.
struct SidePair {
    Image first; ///< R G B as a display shows them, linear
    Image second;
    Image firstLight; ///< R G B; empty where light is not known
    Image secondLight;
};

struct SideError {
    double psnr = 0; ///< dB, of the sRGB encoded values; infinite where the pictures are equal
    double flip = 0; ///< [0, 1] the mean
    /// Light of the first over that of the second, red, green and blue.
    std::optional<std::array<double, 3>> energyRatio;
    Image map; ///< FLIP of every pixel as a heat map, R G B, sRGB encoded
};

/// Throws std::invalid_argument for pictures of different sizes.
SideError measureSides(const SidePair& pair);

/// Measures on a thread of its own, one pair at a time; of pairs that come meanwhile, the last.
class SideErrorTask {
public:
    void begin(SidePair pair);
    /// What has been measured, once.
    std::optional<SideError> take();
    bool isBusy() const { return running_.valid(); }

private:
    std::future<SideError> running_;
    std::optional<SidePair> next_;
};

} // namespace nacre::view
