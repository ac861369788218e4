// Compose: scattered and transmitted light as one image that is added.
#include "technique.hpp"

#include "compose.spv.h"

namespace nacre::effect {
namespace {

constexpr Pass passes[] = {
    {.name = "nacre compose", .file = "compose", .spirv = compose_spv, .grid = tiles<16, 8>},
};

} // namespace

const Technique composeTechnique{.name = "compose", .passes = passes};

} // namespace nacre::effect
