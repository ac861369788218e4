// Tables with a column a channel.
#pragma once

#include "nacre/profile.hpp"

#include <string>

namespace nacre::app {

/// The line above the columns.
std::string rgbHeader();

/// A line of the table: what it is about, and the three values.
std::string rgbRow(const std::string& label, const Rgb& values);

} // namespace nacre::app
