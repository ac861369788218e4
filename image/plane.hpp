// One channel of an image on its own, and separable filters of it.
#pragma once

#include "image/image.hpp"

namespace nacre {

/// Values of one channel, row 0 at the top.
struct Plane {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> values;
};

/// The taps of a filter in one dimension, an odd number; the middle one is the pixel itself.
using Taps = std::vector<float>;

/// A Gaussian of that standard deviation [> 0] px at the pixels from −radius to radius; the taps' sum is 1.
Taps gaussianTaps(double standardDeviation, int radius);

/// The plane filtered along its rows by `along`, then along its columns by `down`. Beyond the border its last pixels
/// repeat.
Plane filtered(const Plane& plane, const Taps& along, const Taps& down);

/// One channel of an image.
Plane planeOf(const Image& image, std::size_t channel);

} // namespace nacre
