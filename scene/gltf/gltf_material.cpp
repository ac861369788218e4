#include "scene/gltf/gltf_material.hpp"

#include "image/image_file.hpp"
#include "scene/gltf/gltf_scale_texture.hpp"
#include "scene/surface_material.hpp"
#include "scene/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nacre::scene {
namespace {

/// A reference that tinygltf has parsed (TextureInfo or NormalTextureInfo).
template <typename Info> GltfTextureUse useOf(const GltfFile& file, const Info& info, const std::string& field) {
    GltfTextureUse use;
    use.texture = info.index;
    use.texCoord = info.texCoord;
    use.field = field;
    readTextureTransform(GltfObject(file, info.extensions, "KHR_texture_transform", field), use);
    return use;
}

glm::vec4 readColor(const GltfFile& file, const std::vector<double>& values, std::size_t count,
                    const glm::vec4& fallback, const std::string& field) {
    if (values.empty()) {
        return fallback;
    }
    if (values.size() != count) {
        failGltf(file, field + " must be an array of " + std::to_string(count) + " numbers");
    }
    glm::vec4 color(1);
    for (std::size_t i = 0; i < count; ++i) {
        const double value = checkRange(file, values[i], 0, 1, field + "[" + std::to_string(i) + "]");
        color[static_cast<int>(i)] = static_cast<float>(value);
    }
    return color;
}

Wrap wrapOf(const GltfFile& file, int wrap, const std::string& field) {
    switch (wrap) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return Wrap::Repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::Mirror;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::Clamp;
    default:
        failGltf(file, field + " is " + std::to_string(wrap) + ", must be 10497, 33648 or 33071");
    }
}

/// Red, green and blue are linear; alpha is as it is.
glm::vec4 linearMean(const Texture& texture) {
    glm::dvec4 sum(0);
    const std::size_t count = texture.pixels.size() / 4;
    const std::array<double, 256> linear = linearValues(texture.srgb);
    for (std::size_t pixel = 0; pixel < count; ++pixel) {
        const std::uint8_t* rgba = &texture.pixels[pixel * 4];
        sum += glm::dvec4(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]], rgba[3] / 255.0);
    }
    return glm::vec4(sum / static_cast<double>(count));
}

void replaceLook(const GltfSpecularGlossiness& look, Surface& surface) {
    surface.baseColor = look.diffuse;
    surface.metallic = 0;
    surface.roughness = static_cast<float>(1 - look.glossiness);
    surface.specular = std::min(std::max({look.specular.x, look.specular.y, look.specular.z}) / 0.08f, 1.0f);
}

} // namespace

std::uint32_t GltfMaterials::surface(int material) {
    const auto found = surfaces_.find(material);
    if (found != surfaces_.end()) {
        return found->second;
    }
    static const tinygltf::Material standard;
    const std::string field = "materials[" + std::to_string(material) + "]";
    const auto& source = material < 0 ? standard : elementOf(file_, file_.model.materials, material, "material");
    return surfaces_[material] = convert(source, field);
}

std::uint32_t GltfMaterials::convert(const tinygltf::Material& source, const std::string& field) {
    const auto& pbr = source.pbrMetallicRoughness;
    const std::string pbrField = field + ".pbrMetallicRoughness";
    const GltfMaterialExtensions extensions = readMaterialExtensions(file_, source.extensions, field);
    Surface surface;
    surface.name = source.name;
    surface.baseColor = readColor(file_, pbr.baseColorFactor, 4, glm::vec4(1), pbrField + ".baseColorFactor");
    surface.metallic = static_cast<float>(checkRange(file_, pbr.metallicFactor, 0, 1, pbrField + ".metallicFactor"));
    surface.roughness = static_cast<float>(checkRange(file_, pbr.roughnessFactor, 0, 1, pbrField + ".roughnessFactor"));
    const double ior = extensions.ior;
    const double reflectance = ior == 0 ? 1 : std::pow((ior - 1) / (ior + 1), 2);
    surface.specular = static_cast<float>(std::min(reflectance * extensions.specularFactor / 0.08, 1.0));
    surface.emission = glm::vec3(readColor(file_, source.emissiveFactor, 3, glm::vec4(0), field + ".emissiveFactor")) *
                       static_cast<float>(extensions.emissiveStrength);
    if (extensions.specularGlossiness) {
        replaceLook(*extensions.specularGlossiness, surface);
    }
    surface.doubleSided = source.doubleSided;
    surface.normalScale =
        static_cast<float>(checkRange(file_, source.normalTexture.scale, -1e3, 1e3, field + ".normalTexture.scale"));
    std::array<int, 2> texCoords{0, -1};
    readTextures(source, extensions, field, surface, texCoords);
    surface.alphaMode = source.alphaMode == "MASK"    ? AlphaMode::Mask
                        : source.alphaMode == "BLEND" ? AlphaMode::Blend
                                                      : AlphaMode::Opaque;
    surface.alphaCutoff =
        source.alphaMode == "MASK"
            ? static_cast<float>(checkRange(file_, source.alphaCutoff, 0, 1e3, field + ".alphaCutoff"))
            : 0.5f;
    readSubsurface(source, extensions, field, surface);
    if (extensions.clearTransmission > 0 && surface.material == none) {
        scene_.notes.push_back(file_.path.string() + ": " + field +
                               ".extensions.KHR_materials_transmission is not drawn");
    }
    scene_.surfaces.push_back(std::move(surface));
    texCoords_.push_back(texCoords);
    return static_cast<std::uint32_t>(scene_.surfaces.size() - 1);
}

void GltfMaterials::readTextures(const tinygltf::Material& source, const GltfMaterialExtensions& extensions,
                                 const std::string& field, Surface& surface, std::array<int, 2>& texCoords) {
    const auto& pbr = source.pbrMetallicRoughness;
    GltfTextureUse baseColor = extensions.specularGlossiness ? extensions.specularGlossiness->diffuseTexture
                                                             : useOf(file_, pbr.baseColorTexture,
                                                                     field + ".pbrMetallicRoughness.baseColorTexture");
    // Without a base colour texture, what the medium scatters is the colour that is seen.
    if (baseColor.texture < 0) {
        baseColor = extensions.multiscatterColorTexture;
    }
    const GltfTextureUse normal = useOf(file_, source.normalTexture, field + ".normalTexture");
    const GltfTextureUse metallicRoughness =
        useOf(file_, pbr.metallicRoughnessTexture, field + ".pbrMetallicRoughness.metallicRoughnessTexture");
    const GltfTextureUse& thickness = extensions.thicknessTexture;
    const GltfTextureUse emission = useOf(file_, source.emissiveTexture, field + ".emissiveTexture");

    surface.baseColorTexture = texture(baseColor, true);
    surface.normalTexture = texture(normal, false);
    surface.metallicRoughnessTexture = texture(metallicRoughness, false);
    surface.thicknessTexture = texture(thickness, false);
    surface.emissionTexture = texture(emission, true);
    surface.transmissionTexture = texture(extensions.diffuseTransmissionTexture, false);
    surface.transmissionColorTexture = texture(extensions.diffuseTransmissionColorTexture, true);
    // Where the texture cannot be read, its factor alone would light up what it leaves dark.
    if (emission.texture >= 0 && surface.emissionTexture == none) {
        surface.emission = glm::vec3(0);
    }
    const std::array<std::pair<const GltfTextureUse&, TextureCoordinates&>, 8> uses{
        {{baseColor, surface.baseColorUv},
         {normal, surface.normalUv},
         {metallicRoughness, surface.metallicRoughnessUv},
         {thickness, surface.thicknessUv},
         {emission, surface.emissionUv},
         {extensions.diffuseTransmissionTexture, surface.transmissionUv},
         {extensions.diffuseTransmissionColorTexture, surface.transmissionColorUv},
         {extensions.multiscatterColorTexture, surface.scaleUv}}};
    bool first = true;
    for (const auto& [use, coordinates] : uses) {
        if (use.texture < 0) {
            continue;
        }
        if (std::exchange(first, false)) {
            texCoords[0] = use.texCoord;
        } else if (use.texCoord != texCoords[0] && texCoords[1] < 0) {
            texCoords[1] = use.texCoord;
        }
        coordinates.transform = use.transform;
        coordinates.second = use.texCoord != texCoords[0];
        if (coordinates.second && use.texCoord != texCoords[1]) {
            scene_.notes.push_back(file_.path.string() + ": " + use.field + ".texCoord is " +
                                   std::to_string(use.texCoord) + ", the material's third; " +
                                   std::to_string(texCoords[1]) + " is used");
        }
    }
}

void GltfMaterials::readSubsurface(const tinygltf::Material& source, const GltfMaterialExtensions& extensions,
                                   const std::string& field, Surface& surface) {
    GltfMedium medium = extensions.medium;
    const bool textured = surface.baseColorTexture != none;
    const std::uint32_t colors = texture(extensions.multiscatterColorTexture, true);
    if (colors != none) {
        medium.multiscatterColor *= glm::vec3(mean(colors));
    }
    const bool isVolume = isDense(medium);
    if (isVolume) {
        setEntry(extensions, surface, medium);
    }
    if (medium.thickness > 0) {
        surface.thickness = static_cast<float>(medium.thickness * 1000);
    }
    std::optional<Material> material = makeMaterial(medium, source.name);
    if (!material) {
        surface.transmissionTexture = surface.transmissionColorTexture = none;
        return;
    }
    if (isVolume && colors != none) {
        setScale(surface, medium, extensions.medium.multiscatterColor, colors);
    }
    const bool dense = medium.scatters && medium.multiscatterColor != glm::vec3(0);
    const float entering = isVolume && surface.transmissionTexture != none ? mean(surface.transmissionTexture).w : 1;
    const float scattering = dense ? entering * static_cast<float>(material->strength) : 0;
    if (!textured && dense) {
        const glm::vec3 seen = medium.multiscatterColor * medium.transmissionColor.value_or(glm::vec3(1));
        surface.baseColor = glm::vec4(glm::mix(glm::vec3(surface.baseColor), seen, scattering), surface.baseColor.w);
    }
    if (medium.thickness <= 0) {
        surface.thickness = static_cast<float>(thinWallThickness);
    }
    material->albedo = {surface.baseColor.x, surface.baseColor.y, surface.baseColor.z};
    material->roughness = surface.roughness;
    material->specular = surface.specular;
    surface.material = addMaterial(scene_, std::move(*material), file_.path.string() + ": " + field);
}

void GltfMaterials::setEntry(const GltfMaterialExtensions& extensions, Surface& surface, GltfMedium& medium) {
    if (surface.transmissionColorTexture != none) {
        *medium.transmissionColor *= glm::vec3(mean(surface.transmissionColorTexture));
        scene_.notes.push_back(file_.path.string() + ": " + extensions.diffuseTransmissionColorTexture.field +
                               " is averaged to one colour, because the volume scatters");
    }
    surface.transmissionColorTexture = none;
    if (medium.transmission > medium.thinTransmission) { // which then says how much enters
        surface.transmissionTexture = none;
    }
    surface.transmissionSetsStrength = surface.transmissionTexture != none;
}

void GltfMaterials::setScale(Surface& surface, const GltfMedium& medium, const glm::vec3& factor,
                             std::uint32_t colors) {
    const std::array<float, 8> lengths{factor.x,
                                       factor.y,
                                       factor.z,
                                       medium.attenuationColor.x,
                                       medium.attenuationColor.y,
                                       medium.attenuationColor.z,
                                       static_cast<float>(medium.attenuationDistance),
                                       static_cast<float>(medium.anisotropy)};
    const auto [entry, isNew] = scales_.try_emplace({colors, lengths});
    if (isNew) {
        file_.budget->charge(scene_.textures[colors]);
        if (auto made = makeScaleTexture(medium, factor, scene_.textures[colors])) {
            entry->second = {made->largest, static_cast<std::uint32_t>(scene_.textures.size())};
            scene_.textures.push_back(std::move(made->texture));
        }
    }
    surface.scale = entry->second.largest;
    surface.scaleTexture = entry->second.texture;
}

const glm::vec4& GltfMaterials::mean(std::uint32_t texture) {
    const auto [entry, isNew] = means_.try_emplace(texture);
    if (isNew) {
        entry->second = linearMean(scene_.textures[texture]);
    }
    return entry->second;
}

int GltfMaterials::imageOf(const tinygltf::Texture& texture, const std::string& field) {
    if (const GltfObject webp(file_, texture.extensions, "EXT_texture_webp", field); webp.exists()) {
        return webp.index("source");
    }
    if (texture.source < 0) {
        std::string extensions;
        for (const auto& extension : texture.extensions) {
            extensions += (extensions.empty() ? " but for " : " and ") + extension.first;
        }
        scene_.notes.push_back(file_.path.string() + ": " + field + " has no image" +
                               (extensions.empty() ? "" : extensions + ", which is not read") + "; it is left out");
    }
    return texture.source;
}

std::uint32_t GltfMaterials::texture(const GltfTextureUse& use, bool srgb) {
    if (use.texture < 0) {
        return none;
    }
    const tinygltf::Texture& source = elementOf(file_, file_.model.textures, use.texture, use.field + ".index");
    const std::string textureField = "textures[" + std::to_string(use.texture) + "]";
    const int imageIndex = imageOf(source, textureField);
    if (imageIndex < 0) {
        return none;
    }
    const GltfImage& image = elementOf(file_, file_.images, imageIndex, textureField + ".source");
    Texture sampling;
    if (source.sampler >= 0) {
        const std::string samplerField = "samplers[" + std::to_string(source.sampler) + "]";
        const tinygltf::Sampler& sampler =
            elementOf(file_, file_.model.samplers, source.sampler, textureField + ".sampler");
        sampling.wrapU = wrapOf(file_, sampler.wrapS, samplerField + ".wrapS");
        sampling.wrapV = wrapOf(file_, sampler.wrapT, samplerField + ".wrapT");
        sampling.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    const std::string field = "images[" + std::to_string(imageIndex) + "]";
    // Images that name the same file or bytes are one.
    const std::string place = image.bufferView >= 0  ? "bufferViews[" + std::to_string(image.bufferView) + "]"
                              : isDataUri(image.uri) ? field
                                                     : image.uri;
    const auto key = std::tuple(place, srgb, sampling.wrapU, sampling.wrapV, sampling.nearest);
    if (const auto found = textures_.find(key); found != textures_.end()) {
        return found->second;
    }
    try {
        Texture texture = decode(image, field, srgb);
        texture.wrapU = sampling.wrapU;
        texture.wrapV = sampling.wrapV;
        texture.nearest = sampling.nearest;
        scene_.textures.push_back(std::move(texture));
    } catch (const UnreadPicture& reason) {
        scene_.notes.push_back(std::string(reason.what()) + "; it is left out");
        return textures_[key] = none;
    }
    return textures_[key] = static_cast<std::uint32_t>(scene_.textures.size() - 1);
}

Texture GltfMaterials::decode(const GltfImage& image, const std::string& field, bool srgb) {
    const std::uint64_t readBefore = file_.named->totalBytes();
    Bytes decoded;
    std::span<const std::uint8_t> bytes;
    if (image.bufferView >= 0) {
        bytes = viewBytes(file_, image.bufferView, field + ".bufferView");
    } else if (isDataUri(image.uri)) {
        bytes = decoded = decodeDataUri(file_, image.uri, field + ".uri");
    } else {
        bytes = readUri(file_, image.uri, field + ".uri");
    }
    file_.budget->addInput(file_.named->totalBytes() - readBefore);
    Texture texture = decodeTexture(bytes, file_.path.string() + ": " + field, srgb);
    texture.name = image.name.empty() ? field : image.name;
    file_.budget->charge(texture);
    return texture;
}

} // namespace nacre::scene
