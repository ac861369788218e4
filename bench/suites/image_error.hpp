// How far a picture is from its reference, over the pixels that matter.
#pragma once

#include "bench/results/results.hpp"

#include <span>

namespace nacre::bench {

/// A picture of RGB pixels (three floats each) and their material ids (one float each).
struct IdentifiedPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> pixels;
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
    double peak_ = 0;
};

/// The picture at the size and with the material ids of `guide`: bilinear between those of the four nearest pixels that
/// have the same id, of which those that are not finite count as black; without such a neighbour the nearest pixel.
std::vector<float> enlarge(const IdentifiedPicture& picture, const IdentifiedPicture& guide);

} // namespace nacre::bench
