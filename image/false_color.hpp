// Pictures of differences: signed, and as a heat map.
#pragma once

#include "image/image.hpp"

#include <array>

namespace nacre {

/// The colour of a share [0, 1], from black over violet, red and orange to white, sRGB encoded in [0, 1]. Lightness L*
/// is 100 times the share, so that equal steps look equal (Kovesi 2015, Good Colour Maps: How to Design Them); hue and
/// chroma are ours, the chroma as far as sRGB goes.
std::array<float, 3> heatColor(double share);

/// The first channel of a map through heatColor, `largest` [> 0] being the end of it; what is not finite is drawn as
/// `largest`.
Image heatMap(const Image& map, double largest = 1);

/// Colours of what the image has more (brighter than grey) and less (darker) than the reference, grey where they are
/// equal: 0.5 + (image − reference) / (2 · largest), sRGB encoded. Throws std::invalid_argument where sizes or channels
/// differ.
Image signedDifference(const Image& image, const Image& reference, double largest);

} // namespace nacre
