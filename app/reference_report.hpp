// The JSON that `nacre reference --json` writes; docs/schemas/reference.schema.json describes it.
#pragma once

#include "reference/checkpoint.hpp"
#include "reference/reference.hpp"

namespace nacre::app {

struct ReferenceResult {
    reference::Checkpoint checkpoint; ///< what was computed
    std::filesystem::path file;
    std::string scene;
    std::vector<std::string> notes; ///< Scene::notes; none of merged parts
    std::string stoppedBy;          ///< spp, time, noise, interruption or merge
    double seconds = 0;             ///< of this run
    double samplesPerSecond = 0;
    std::vector<std::string> warnings;
};

/// Samples that the least and the most sampled pixel of the result's part have.
std::pair<std::uint32_t, std::uint32_t> sppOf(const reference::Checkpoint& checkpoint);

std::string makeReport(const ReferenceResult& result);

} // namespace nacre::app
