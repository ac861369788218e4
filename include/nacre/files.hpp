// Material files (JSON, docs/schemas/material.schema.json), and whole files in and out. Target nacre::files; the effect
// does not need it.
#pragma once

#include "nacre/material.hpp"

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace nacre {

/// What is wrong with a file: one sentence that names the file, the field and the value.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Largest file that is read at all, bytes.
inline constexpr std::uint64_t maxFileBytes = std::uint64_t{2} << 30;

/// Reads a whole file of up to `maxBytes`; throws FileError naming the file and the system's reason.
std::vector<std::uint8_t> readFile(const std::filesystem::path& file, std::uint64_t maxBytes = maxFileBytes);

/// Writes bytes to `file` by way of a temporary neighbour, fsync and a rename; the neighbour is removed on failure.
/// An existing device or pipe is written in place. Throws FileError naming the file and the system's reason.
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

/// Reads a material from JSON text. Keys are the names of Material's members; those left out keep their defaults, and
/// exactly one of `layers`, `meanFreePath` and `slabs` must be there. A material of slabs has their layers and, where
/// the text gives none, their albedo and specular (`describeBySlabs`). `sourceName` is what an error calls the text,
/// e.g. a file name or "scene.json: materials[2]". Refused with a FileError: what is not JSON, a key that is unknown or
/// given twice, a value of the wrong type, and everything findFault finds.
Material parseMaterial(std::string_view json, std::string_view sourceName);

/// The material as JSON text that parseMaterial turns into an equal material. Throws FileError for a faulty material,
/// and for one whose layers are not those of its slabs.
std::string formatMaterial(const Material& material);

/// parseMaterial of a file of up to 1 MiB; a material without a name is called like the file.
Material loadMaterial(const std::filesystem::path& file);

/// Writes formatMaterial's text; the file appears complete or not at all.
void saveMaterial(const Material& material, const std::filesystem::path& file);

} // namespace nacre
