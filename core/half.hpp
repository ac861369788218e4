// IEEE 754 half floats on the CPU.
#pragma once

#include <cstdint>

namespace nacre {

/// Rounds to the nearest half, ties to even; beyond 65504 gives infinity.
std::uint16_t toHalf(float value);
float fromHalf(std::uint16_t half);

} // namespace nacre
