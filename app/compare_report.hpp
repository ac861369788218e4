// What `nacre compare` found, as text and as JSON (docs/schemas/comparison.schema.json).
#pragma once

#include "app/compare_inputs.hpp"

namespace nacre::app {

/// A bound that was asked for, and what it is held against.
struct BoundCheck {
    std::string option; ///< e.g. "--max-flip"
    double bound = 0;
    double value = 0;
    bool holds = true;
};

std::vector<BoundCheck> checkBounds(const CompareOptions& options, const Comparison& comparison);

/// The table.
std::string describeComparison(const CompareOptions& options, const CompareInputs& inputs,
                               const Comparison& comparison);

/// The JSON text. `differenceRange` is the difference that is white in the picture of it.
std::string makeComparisonReport(const CompareOptions& options, const CompareInputs& inputs,
                                 const Comparison& comparison, const std::vector<BoundCheck>& bounds,
                                 double differenceRange);

} // namespace nacre::app
