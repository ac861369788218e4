// Edits as text, which a program that has crashed leaves behind.
#pragma once

#include "view/model/edited_scene.hpp"

#include <string>
#include <string_view>

namespace nacre::view {

/// Everything that was edited, as JSON. Two texts are equal where the edits are.
std::string formatEdited(const EditedScene& edited);

/// The edits of formatEdited on top of `base`, what can be edited of the same scene. `source` is what an error calls
/// the text. Throws FileError, also where the scene has other materials or surfaces by now.
EditedScene parseEdited(std::string_view text, const std::string& source, const EditedScene& base);

} // namespace nacre::view
