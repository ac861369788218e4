// Accuracy results as JSON (docs/schemas/accuracy.schema.json).
#pragma once

#include "bench/accuracy/accuracy_results.hpp"

namespace nacre::bench {

std::string formatAccuracyJson(const AccuracyResults& results);

} // namespace nacre::bench
