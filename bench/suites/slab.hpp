// The sweep's test body, of which everything can be chosen.
#pragma once

#include "bench/suites/suite_plan.hpp"

namespace nacre::bench {

/// A slab of 320 mm x 180 mm x 0.3 mm that fills a picture of 16:9, seen from the front.
struct SlabSettings {
    std::uint32_t triangles = 20'000; ///< at least
    std::uint32_t columns = 1;        ///< of patches in a grid
    std::uint32_t rows = 1;           ///< of patches in a grid
    std::uint32_t materials = 1;      ///< [1, columns · rows], which patches have in turn, row by row
    double coverage = 1;              ///< share of the slab, from the left, that the patches cover
    std::uint32_t lights = 2;         ///< spot lights with shadow maps, in front and behind in turn
};
std::shared_ptr<const View> makeSlab(const SlabSettings& settings);

} // namespace nacre::bench
