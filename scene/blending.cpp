#include "scene/blending.hpp"

#include "core/files/quoted_text.hpp"

#include <algorithm>

namespace nacre::scene {
namespace {

bool isOpaque(const Texture& texture) {
    for (std::size_t i = 3; i < texture.pixels.size(); i += 4) {
        if (texture.pixels[i] != 255) {
            return false;
        }
    }
    return true;
}

bool isOpaque(const Mesh& mesh) {
    return std::ranges::all_of(mesh.vertices, [](const Vertex& vertex) { return vertex.color.w == 65535; });
}

} // namespace

void settleBlending(Scene& scene, const std::filesystem::path& file) {
    std::vector<bool> seeThrough(scene.surfaces.size());
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& surface = scene.surfaces[i];
        seeThrough[i] = surface.alphaMode == AlphaMode::Blend &&
                        (surface.baseColor.w < 1 ||
                         (surface.baseColorTexture != none && !isOpaque(scene.textures.at(surface.baseColorTexture))));
    }
    for (const Mesh& mesh : scene.meshes) {
        if (scene.surfaces[mesh.surface].alphaMode == AlphaMode::Blend && !seeThrough[mesh.surface]) {
            seeThrough[mesh.surface] = !isOpaque(mesh);
        }
    }
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        Surface& surface = scene.surfaces[i];
        if (surface.alphaMode != AlphaMode::Blend) {
            continue;
        }
        if (!seeThrough[i]) {
            surface.alphaMode = AlphaMode::Opaque;
        } else if (surface.material != none) {
            surface.alphaMode = AlphaMode::Mask;
            surface.alphaCutoff = 0.5f;
            scene.notes.push_back(file.string() + ": the surface " + inQuotes(surface.name) +
                                  " scatters light and is not blended: what has an alpha below 0.5 is left out, the "
                                  "rest is opaque");
        }
    }
}

} // namespace nacre::scene
