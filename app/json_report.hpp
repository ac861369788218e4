// What all reports in JSON share.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace nacre::app {

/// {"name": "gallery" or the file as it was given, "notes": what of the files was left out or assumed, a sentence
/// each}: `scene` in the reports of render, reference, bake and view.
nlohmann::ordered_json describeScene(const std::string& name, const std::vector<std::string>& notes);

/// The text of a report. What is not UTF-8 in it, as names of files may be, becomes U+FFFD.
std::string formatReport(const nlohmann::ordered_json& report);

} // namespace nacre::app
