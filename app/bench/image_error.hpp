// How far a picture is from its reference, over the pixels that matter.
#pragma once

#include "app/bench/results.hpp"

#include <span>

namespace nacre::bench {

/// Compares RGB pixels (three floats each) where `materialIds` (one float each) is not 0. Pixels that are not finite in
/// the picture count as black. Throws std::invalid_argument when the sizes differ or no pixel has a material.
ImageError compareImages(std::span<const float> picture, std::span<const float> reference,
                         std::span<const float> materialIds);

} // namespace nacre::bench
