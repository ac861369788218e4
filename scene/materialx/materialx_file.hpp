// Subsurface materials of MaterialX documents (XML, https://materialx.org).
#pragma once

#include "scene/scene.hpp"

namespace nacre::scene {

/// A material, what of it was left out or assumed, a sentence each that begins with the file, and the documents that
/// were included.
struct MaterialXImport {
    Material material;
    std::vector<std::string> notes;
    std::vector<std::string> inputs;
};

/// Reads the subsurface parameters of a shader node of a document of up to 16 MiB: open_pbr_surface or
/// standard_surface. `name` is the node's or that of a surfacematerial with it; "" where there is only one.
/// `metersPerUnit` is that of lengths whose input has no unit, centimetres where it is absent, which a note tells.
/// Inputs are values, or connected to constants, in node graphs, too; others keep their defaults, with a note. Colours
/// of every space of MaterialX are brought to linear Rec.709. Documents that are included are read (parseMaterialX).
/// Throws SceneError with one sentence that names the file, the node, the input and the value.
MaterialXImport importMaterialX(const std::filesystem::path& file, const std::string& name = "",
                                std::optional<double> metersPerUnit = std::nullopt);

/// The same of a document in memory.
MaterialXImport importMaterialX(std::span<const std::uint8_t> document, const std::filesystem::path& file,
                                const std::string& name = "", std::optional<double> metersPerUnit = std::nullopt);

} // namespace nacre::scene
