// The three suites.
#pragma once

#include "bench/suites/suite_plan.hpp"

#include <filesystem>

namespace nacre::bench {

struct SuiteSettings {
    bool quick = false;          ///< smaller pictures and fewer values
    std::filesystem::path scene; ///< a model or scene file; empty = the gallery
    double seconds = 240;        ///< after this long no configuration is asked for more than the least number of frames
};

/// Experiments 1, 2 and 3 of the thesis, chapter 4.5.
Plan makeThesisPlan(const SuiteSettings& settings);

/// Time against resolution, coverage, footprint, materials, layers, lights and triangles.
Plan makeSweepPlan(const SuiteSettings& settings);

/// Every technique at every quality, with its error, on several views.
Plan makeParetoPlan(const SuiteSettings& settings);

} // namespace nacre::bench
