// What `nacre view --headless` found, as a table and as JSON; docs/schemas/view.schema.json describes the latter.
#pragma once

#include "view/loop/headless.hpp"

#include <nlohmann/json_fwd.hpp>

#include <ostream>
#include <string>
#include <vector>

namespace nacre::app {

/// A run of frames, and what changed in it.
struct NamedRun {
    view::Moving moving;
    view::HeadlessRun run;
};

/// "nothing", "lights", "material".
const char* movingName(view::Moving moving);

/// A table for a terminal.
void printRun(std::ostream& out, const NamedRun& run);

/// `scene` is describeScene's.
std::string makeReport(const renderer::DeviceDescription& device, const nlohmann::ordered_json& scene,
                       const view::HeadlessSettings& settings, const std::vector<NamedRun>& runs);

} // namespace nacre::app
