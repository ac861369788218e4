// A MaterialX document as a tree: what it includes, and where the value of an input comes from.
#pragma once

#include "scene/scene.hpp"

#include <pugixml.hpp>

namespace nacre::scene {

/// The document, of up to 16 MiB. The elements of the documents that it includes (of its folder or below, 64 files and
/// 16 MiB in all) stand behind its own; one that cannot be read is left out, with a note. Names of what was included
/// are appended to `inputs`. Throws SceneError for what is not MaterialX.
pugi::xml_document parseMaterialX(std::span<const std::uint8_t> bytes, const std::filesystem::path& file,
                                  std::vector<std::string>& notes, std::vector<std::string>& inputs);

/// The element that has an input's value, which may be the input itself: connections are followed through `constant`
/// and `dot` nodes, through the outputs of node graphs and through the inputs of their own. Empty where a value is
/// computed.
pugi::xml_node valueOf(const pugi::xml_node& input);

/// The colour space of an element: that of the nearest element around it that has one. "" where none has.
std::string_view colorSpaceOf(const pugi::xml_node& element);

/// Colours of a space of MaterialX in linear Rec.709; nothing for a space that is not known.
std::optional<Rgb> toLinearRec709(const Rgb& color, std::string_view space);

} // namespace nacre::scene
