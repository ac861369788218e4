// Runs a suite and leaves results.json, results.csv, report.html and the pictures in a folder.
#pragma once

#include "app/bench/harness.hpp"
#include "app/bench/suites.hpp"

#include <filesystem>

namespace nacre::bench {

/// Measures everything in the plan. The pictures are written to `folder`.
Results runPlan(renderer::Device& device, const Plan& plan, const SuiteSettings& suite,
                const std::filesystem::path& folder, const Reporter& say);

} // namespace nacre::bench
