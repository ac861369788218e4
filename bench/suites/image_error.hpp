// How far a picture is from its reference, over the pixels that matter.
#pragma once

#include "bench/results/results.hpp"
#include "image/metrics.hpp"

#include <span>

namespace nacre::bench {

/// A picture with channels R, G and B, and the material ids of its pixels.
struct IdentifiedPicture {
    Image image;
    std::vector<float> materialIds;
};

/// What pictures are compared with, where its material ids are not 0.
class ReferencePicture {
public:
    /// Throws std::invalid_argument when sizes contradict each other or no pixel has a material.
    explicit ReferencePicture(IdentifiedPicture picture);

    /// Pixels that are not finite count as black. A picture of another size is enlarged (see `enlarge`). Throws
    /// std::invalid_argument when a picture's sizes contradict each other.
    ImageError compare(const IdentifiedPicture& picture) const;

private:
    IdentifiedPicture reference_;
    Mask mask_;
    double peak_ = 0;
};

/// The picture's values at the size and with the material ids of `guide`: bilinear between those of the four nearest
/// pixels that have the same id, of which those that are not finite count as black; without such a neighbour the
/// nearest pixel.
std::vector<float> enlarge(const IdentifiedPicture& picture, const IdentifiedPicture& guide);

} // namespace nacre::bench
