// Units of length by the names that scene files and options use.
#pragma once

#include <array>

namespace nacre::scene {

struct LengthUnit {
    const char* name;
    double metres;
};

inline constexpr std::array lengthUnits{LengthUnit{"m", 1}, LengthUnit{"cm", 0.01}, LengthUnit{"mm", 0.001},
                                        LengthUnit{"in", 0.0254}, LengthUnit{"ft", 0.3048}};

} // namespace nacre::scene
