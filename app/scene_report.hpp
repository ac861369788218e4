// What every report in JSON says of the scene that a command has loaded.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace nacre::app {

/// {"name": "gallery" or the file as it was given, "notes": what of the files was left out or assumed, a sentence
/// each}: `scene` in the reports of render, reference, bake and view.
nlohmann::ordered_json describeScene(const std::string& name, const std::vector<std::string>& notes);

} // namespace nacre::app
