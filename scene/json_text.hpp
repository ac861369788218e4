// JSON values as sentences quote them.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace nacre::scene {

/// A value as JSON has it, of at most 60 characters.
inline std::string shorten(const nlohmann::json& value) {
    const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

} // namespace nacre::scene
