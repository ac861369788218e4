#include "scene/assimp/assimp_material.hpp"

#include "core/files/quoted_text.hpp"
#include "image/image_file.hpp"
#include "scene/named_file.hpp"
#include "scene/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <strings.h>

namespace nacre::scene {
namespace {

namespace fs = std::filesystem;

/// A reference without the two slashes with which Blender begins those that are relative to its file.
std::string withoutBlenderPrefix(const std::string& reference) {
    return reference.starts_with("//") ? reference.substr(2) : reference;
}

/// A texture's file: where the model says, else its name beside the model, whatever the case of its letters. Models
/// carry the paths of the machine they were made on.
fs::path findTexture(const fs::path& model, std::string reference) {
    if (fs::path named = tryNamedFile(model, reference); !named.empty()) {
        return named;
    }
    std::ranges::replace(reference, '\\', '/');
    const fs::path folder = model.parent_path().empty() ? fs::path(".") : model.parent_path();
    const std::string name = fs::path(reference).filename().string();
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        const std::string candidate = entry.path().filename().string();
        if (::strcasecmp(candidate.c_str(), name.c_str()) == 0) {
            return tryNamedFile(model, candidate);
        }
    }
    return {};
}

Texture decodeEmbedded(const aiTexture& embedded, const std::string& field, bool srgb) {
    if (embedded.mHeight == 0) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(embedded.pcData);
        return decodeTexture(std::span(bytes, embedded.mWidth), field, srgb);
    }
    Texture texture;
    texture.name = field;
    texture.width = embedded.mWidth;
    texture.height = embedded.mHeight;
    texture.srgb = srgb;
    if (texture.width == 0 || std::max(texture.width, texture.height) > maxImageSide) {
        throw SceneError(field + " is " + std::to_string(texture.width) + " x " + std::to_string(texture.height) +
                         " pixels, must be 1 to " + std::to_string(maxImageSide) + " a side");
    }
    const std::size_t count = std::size_t{texture.width} * texture.height;
    texture.pixels.reserve(count * 4);
    for (const aiTexel& texel : std::span(embedded.pcData, count)) {
        texture.pixels.insert(texture.pixels.end(), {texel.r, texel.g, texel.b, texel.a});
    }
    return texture;
}

/// Decals, which show nothing outside, are clamped.
Wrap wrapOf(aiTextureMapMode mode) {
    switch (mode) {
    case aiTextureMapMode_Mirror:
        return Wrap::Mirror;
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal:
        return Wrap::Clamp;
    default:
        return Wrap::Repeat;
    }
}

constexpr std::array colorTypes{aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE};
constexpr std::array emissionTypes{aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE};
constexpr std::array normalTypes{aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA};
constexpr std::array opacityTypes{aiTextureType_OPACITY};

/// Whether the material names a texture of one of the types, be it read or not.
bool isTextured(const aiMaterial& material, std::span<const aiTextureType> types) {
    return std::ranges::any_of(types, [&](aiTextureType type) { return material.GetTextureCount(type) > 0; });
}

float clamp01(float value) {
    return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.0f;
}

} // namespace

Texture AssimpMaterials::load(const std::string& reference, const std::string& field, bool srgb) {
    if (const aiTexture* embedded = source_.GetEmbeddedTexture(reference.c_str())) {
        return decodeEmbedded(*embedded, field, srgb);
    }
    const std::string named = withoutBlenderPrefix(reference);
    const fs::path found = findTexture(file_, named);
    if (found.empty()) {
        throw SceneError(field + " " + faultOfNamedFile(file_, named));
    }
    inputs_.push_back(found.string());
    return readTexture(found, srgb);
}

std::uint32_t AssimpMaterials::texture(const aiMaterial& material, std::span<const aiTextureType> types, bool srgb) {
    for (const aiTextureType type : types) {
        aiString path;
        std::array<aiTextureMapMode, 3> modes{};
        if (material.GetTexture(type, 0, &path, nullptr, nullptr, nullptr, nullptr, modes.data()) != aiReturn_SUCCESS ||
            path.length == 0) {
            continue;
        }
        const std::string reference = path.C_Str();
        const Wrap wrapU = wrapOf(modes[0]);
        const Wrap wrapV = wrapOf(modes[1]);
        const auto [entry, isNew] = textures_.try_emplace({reference, srgb, wrapU, wrapV}, none);
        if (isNew) {
            const std::string field = file_.string() + ": material " + inQuotes(material.GetName().C_Str()) +
                                      ": texture \"" + withoutMiddle(reference) + "\"";
            try {
                scene_.textures.push_back(load(reference, field, srgb));
                scene_.textures.back().wrapU = wrapU;
                scene_.textures.back().wrapV = wrapV;
                entry->second = static_cast<std::uint32_t>(scene_.textures.size() - 1);
            } catch (const UnreadPicture& reason) {
                scene_.notes.push_back(std::string(reason.what()) + "; it is left out");
            }
        }
        return entry->second;
    }
    return none;
}

void AssimpMaterials::addEmission(const aiMaterial& material, Surface& surface) {
    aiColor3D emission;
    if (material.Get(AI_MATKEY_COLOR_EMISSIVE, emission) == aiReturn_SUCCESS) {
        const auto positive = [](float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1e6f) : 0.0f; };
        surface.emission = {positive(emission.r), positive(emission.g), positive(emission.b)};
    }
    try {
        surface.emissionTexture = texture(material, emissionTypes, true);
    } catch (const FileError& error) {
        scene_.notes.push_back(std::string(error.what()) + "; it is left out");
    }
    if (surface.emissionTexture == none && isTextured(material, emissionTypes)) {
        surface.emission = glm::vec3(0); // which alone would light up what the texture leaves dark
    }
    // As beside textures of colour, many exporters write black.
    if (surface.emissionTexture != none && surface.emission == glm::vec3(0)) {
        surface.emission = glm::vec3(1);
    }
}

void AssimpMaterials::collectUnread(const aiMaterial& material) {
    struct Use {
        aiTextureType type;
        const char* name;
    };
    constexpr std::array uses{Use{aiTextureType_SPECULAR, "specular"},
                              Use{aiTextureType_HEIGHT, "height"},
                              Use{aiTextureType_SHININESS, "shininess"},
                              Use{aiTextureType_DISPLACEMENT, "displacement"},
                              Use{aiTextureType_LIGHTMAP, "light"},
                              Use{aiTextureType_REFLECTION, "reflection"},
                              Use{aiTextureType_METALNESS, "metalness"},
                              Use{aiTextureType_DIFFUSE_ROUGHNESS, "roughness"},
                              Use{aiTextureType_AMBIENT_OCCLUSION, "ambient occlusion"},
                              Use{aiTextureType_SHEEN, "sheen"},
                              Use{aiTextureType_CLEARCOAT, "clearcoat"},
                              Use{aiTextureType_TRANSMISSION, "transmission"}};
    for (const Use& use : uses) {
        if (material.GetTextureCount(use.type) > 0) {
            unreadUses_.insert(use.name);
        }
    }
}

std::string AssimpMaterials::unreadUses() const {
    std::string list;
    for (const std::string& use : unreadUses_) {
        list += (list.empty() ? "" : ", ") + use;
    }
    return list;
}

void AssimpMaterials::addOpacity(const aiMaterial& material, Surface& surface) {
    const std::uint32_t opacity = texture(material, opacityTypes, false);
    if (opacity == none || surface.baseColorTexture == none) {
        return;
    }
    surface.alphaMode = AlphaMode::Mask;
    aiString colorPath;
    aiString opacityPath;
    material.GetTexture(aiTextureType_DIFFUSE, 0, &colorPath);
    material.GetTexture(aiTextureType_OPACITY, 0, &opacityPath);
    if (colorPath == opacityPath) {
        return; // its alpha is the opacity
    }
    const Texture mask = scene_.textures[opacity];
    Texture masked = scene_.textures[surface.baseColorTexture];
    for (std::size_t y = 0; y < masked.height; ++y) {
        for (std::size_t x = 0; x < masked.width; ++x) {
            const std::size_t from = (y * mask.height / masked.height) * mask.width + x * mask.width / masked.width;
            masked.pixels[(y * masked.width + x) * 4 + 3] = mask.pixels[from * 4];
        }
    }
    surface.baseColorTexture = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(masked));
}

std::uint32_t AssimpMaterials::surface(unsigned index, bool hasVertexColors) {
    const auto [entry, isNew] =
        surfaces_.try_emplace({index, hasVertexColors}, static_cast<std::uint32_t>(scene_.surfaces.size()));
    if (!isNew) {
        return entry->second;
    }
    Surface surface;
    if (index < source_.mNumMaterials) {
        const aiMaterial& material = *source_.mMaterials[index];
        surface.name = material.GetName().C_Str();
        surface.baseColorTexture = texture(material, colorTypes, true);
        surface.normalTexture = texture(material, normalTypes, false);
        aiColor4D color(0.8f, 0.8f, 0.8f, 1);
        const bool hasColor = material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
                              material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS;
        // Many exporters write black beside a texture that they mean to be seen as it is.
        const bool black = color.r == 0 && color.g == 0 && color.b == 0;
        surface.baseColor = isTextured(material, colorTypes) && (black || !hasColor)
                                ? glm::vec4(1)
                                : glm::vec4(clamp01(color.r), clamp01(color.g), clamp01(color.b), 1);
        float number = 0;
        if (material.Get(AI_MATKEY_METALLIC_FACTOR, number) == aiReturn_SUCCESS) {
            surface.metallic = clamp01(number);
        }
        if (material.Get(AI_MATKEY_ROUGHNESS_FACTOR, number) == aiReturn_SUCCESS) {
            surface.roughness = clamp01(number);
        } else if (material.Get(AI_MATKEY_SHININESS, number) == aiReturn_SUCCESS && number > 0) {
            // Blinn and Phong's exponent n is α² = 2/(n + 2) (Walter et al. 2007); α = roughness².
            surface.roughness = clamp01(std::pow(2 / (number + 2), 0.25f));
        }
        int twoSided = 0;
        surface.doubleSided = material.Get(AI_MATKEY_TWOSIDED, twoSided) == aiReturn_SUCCESS && twoSided != 0;
        addEmission(material, surface);
        collectUnread(material);
        // What Assimp gives a mesh without a material is grey, and would darken colours that are all the mesh has.
        if (hasVertexColors && surface.name == AI_DEFAULT_MATERIAL_NAME) {
            surface.baseColor = glm::vec4(1);
        }
        addOpacity(material, surface);
        // Many exporters write 0 for 1.
        if (surface.alphaMode == AlphaMode::Opaque && material.Get(AI_MATKEY_OPACITY, number) == aiReturn_SUCCESS &&
            number > 0 && number < 1) {
            surface.alphaMode = AlphaMode::Blend;
            surface.baseColor.w = number;
        }
    }
    scene_.surfaces.push_back(std::move(surface));
    return entry->second;
}

} // namespace nacre::scene
