// EXT_meshopt_compression.
#pragma once

#include "scene/gltf/gltf_file.hpp"

#include <nlohmann/json_fwd.hpp>

namespace nacre::scene {

/// Whether a buffer only stands for what is decompressed from others, and has no bytes of its own.
bool isMeshoptFallback(const nlohmann::json& buffer);

/// Fills `decodedViews`.
void decodeMeshoptViews(GltfFile& file);

} // namespace nacre::scene
