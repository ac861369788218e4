// What nlohmann's library says of a JSON text.
#pragma once

#include "core/files/quoted_text.hpp"

namespace nacre {

/// What nlohmann's library says of a text, which quotes all that it has read of a string. Without the prefix
/// "[json.exception.parse_error.101] ".
inline std::string jsonFault(std::string_view message) {
    const auto end = message.starts_with('[') ? message.find("] ") : std::string_view::npos;
    return withoutMiddle(end == std::string_view::npos ? message : message.substr(end + 2));
}

} // namespace nacre
