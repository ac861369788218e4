// The techniques that this library has, in the order in which the benchmark takes them.
#pragma once

#include "nacre/nacre.h"

#include <vector>

namespace nacre::bench {

/// All but the reference of errors, `brute`; the default first.
std::vector<NacreTechnique> realTimeTechniques();

} // namespace nacre::bench
