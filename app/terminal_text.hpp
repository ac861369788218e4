// Text from files, as a terminal may show it.
#pragma once

#include <string>
#include <string_view>

namespace nacre::app {

/// The text with everything written out that a terminal would obey rather than show: control characters (as \x1b), the
/// marks that turn the direction of writing (as \u202e), and bytes that are no UTF-8 (as \xff). Line breaks are spaces.
std::string printable(std::string_view text);

/// The same of a text whose line breaks are ours.
std::string printableLines(std::string_view text);

} // namespace nacre::app
