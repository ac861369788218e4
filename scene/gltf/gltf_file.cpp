#include "scene/gltf/gltf_file.hpp"

#include "core/files/json_fault.hpp"
#include "core/files/json_structure.hpp"
#include "scene/gltf/gltf_draco.hpp"
#include "scene/gltf/gltf_import.hpp"
#include "scene/gltf/gltf_material_extensions.hpp"
#include "scene/gltf/gltf_meshopt.hpp"
#include "scene/gltf/gltf_types.hpp"
#include "scene/json_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <strings.h>

namespace nacre::scene {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t glbMagic = 0x46546c67; // "glTF"
constexpr std::uint32_t glbJsonChunk = 0x4e4f534a;
constexpr std::uint32_t glbBinaryChunk = 0x004e4942;
/// Deeper JSON is refused: tinygltf reads extensions recursively.
constexpr int maxJsonDepth = 64;

/// What is understood beside the extensions of materials.
constexpr std::array knownExtensions{"EXT_mesh_gpu_instancing",    "EXT_meshopt_compression", "EXT_texture_webp",
                                     "KHR_draco_mesh_compression", "KHR_lights_punctual",     "KHR_mesh_quantization",
                                     "KHR_node_visibility",        "KHR_texture_transform"};

bool isKnown(const std::string& extension) {
    return isMaterialExtension(extension) || std::ranges::find(knownExtensions, extension) != knownExtensions.end();
}

std::uint32_t wordAt(std::span<const std::uint8_t> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof(word));
    return word;
}

struct Container {
    std::span<const std::uint8_t> json;
    std::span<const std::uint8_t> binary;
};

Container openContainer(const GltfFile& file, std::span<const std::uint8_t> bytes) {
    if (bytes.size() < 12 || wordAt(bytes, 0) != glbMagic) {
        if (file.path.extension() == ".glb") {
            failGltf(file, "does not begin with a GLB header");
        }
        return {bytes, {}};
    }
    const std::uint32_t length = wordAt(bytes, 8);
    if (length > bytes.size()) {
        failGltf(file, "is truncated: its header says " + std::to_string(length) + " bytes, it has " +
                           std::to_string(bytes.size()));
    }
    Container container;
    bytes = bytes.subspan(0, std::max(length, 12u));
    for (std::size_t offset = 12, chunk = 0; offset + 8 <= bytes.size(); ++chunk) {
        const std::size_t size = wordAt(bytes, offset);
        const std::uint32_t type = wordAt(bytes, offset + 4);
        offset += 8;
        if (size > bytes.size() - offset) {
            failGltf(file, "is truncated: chunk " + std::to_string(chunk) + " has " + std::to_string(size) +
                               " bytes, the file only " + std::to_string(bytes.size() - offset) + " more");
        }
        if (chunk == 0 && type == glbJsonChunk) {
            container.json = bytes.subspan(offset, size);
        } else if (chunk == 1 && type == glbBinaryChunk) {
            container.binary = bytes.subspan(offset, size);
        }
        offset += size;
    }
    if (container.json.empty()) {
        failGltf(file, "has no JSON chunk");
    }
    return container;
}

/// Nothing here reads them.
void dropExtras(Json& value) {
    if (value.is_object()) {
        value.erase("extras");
    }
    if (value.is_structured()) {
        std::ranges::for_each(value, dropExtras);
    }
}

/// The JSON without `extras`.
Json parseJson(const GltfFile& file, std::span<const std::uint8_t> text) {
    JsonStructure<Json> structure(maxJsonDepth, [&file] {
        failGltf(file, "its JSON is nested more than " + std::to_string(maxJsonDepth) + " deep");
    });
    Json json;
    try {
        Json::sax_parse(text.begin(), text.end(), &structure);
        json = Json::parse(text.begin(), text.end());
    } catch (const Json::exception& error) {
        failGltf(file, "is not valid JSON: " + jsonFault(error.what()));
    }
    if (!json.is_object()) {
        failGltf(file, "is not a JSON object");
    }
    dropExtras(json);
    return json;
}

/// Takes an array of objects out of the document.
std::vector<Json> takeObjects(const GltfFile& file, Json& document, const std::string& key) {
    const auto found = document.find(key);
    if (found == document.end()) {
        return {};
    }
    if (!found->is_array() || !std::ranges::all_of(*found, [](const Json& item) { return item.is_object(); })) {
        failGltf(file, key + " must be an array of objects");
    }
    std::vector<Json> items(found->begin(), found->end());
    document.erase(found);
    return items;
}

void checkExtensions(const GltfFile& file, const Json& document) {
    const auto required = document.find("extensionsRequired");
    if (required == document.end()) {
        return;
    }
    if (!required->is_array()) {
        failGltf(file, "extensionsRequired must be an array of strings");
    }
    for (const Json& name : *required) {
        if (!name.is_string() || !isKnown(name.get<std::string>())) {
            failGltf(file, "requires the extension " + shorten(name) + ", which is not supported");
        }
    }
}

/// A note for each extension that is used and not read, or read and not drawn.
void noteExtensions(GltfFile& file, const Json& document) {
    const auto used = document.find("extensionsUsed");
    if (used == document.end() || !used->is_array()) {
        return;
    }
    for (const Json& name : *used) {
        const bool isNamed = name.is_string();
        if (isNamed && !isKnown(name.get<std::string>())) {
            file.notes.push_back(file.path.string() + ": uses the extension " + shorten(name) + ", which is not read");
        } else if (isNamed && isLookLeftOut(name.get<std::string>())) {
            file.notes.push_back(file.path.string() + ": uses the extension " + shorten(name) + ", which is not drawn");
        }
    }
}

const Json* findObject(const Json& parent, const char* key) {
    const auto found = parent.find(key);
    return found != parent.end() && found->is_object() ? &*found : nullptr;
}

std::span<const std::uint8_t> loadBuffer(GltfFile& file, const Json& buffer, const std::string& field,
                                         std::span<const std::uint8_t> binary) {
    const auto length = buffer.find("byteLength");
    if (length == buffer.end() || !length->is_number_unsigned()) {
        failGltf(file, field + ".byteLength must be a whole number");
    }
    const auto size = length->get<std::uint64_t>();
    const auto uri = buffer.find("uri");
    std::span<const std::uint8_t> bytes;
    if (uri != buffer.end()) {
        if (!uri->is_string()) {
            failGltf(file, field + ".uri must be a string");
        }
        const auto text = uri->get<std::string>();
        bytes = isDataUri(text) ? file.decodedUris.emplace_back(decodeDataUri(file, text, field + ".uri"))
                                : readUri(file, text, field + ".uri");
    } else if (isMeshoptFallback(buffer)) {
        return {}; // what it would hold is decompressed from other buffers
    } else if (!binary.empty()) {
        bytes = binary;
    } else {
        failGltf(file, field + " has no uri and the file no binary chunk");
    }
    if (bytes.size() < size) {
        failGltf(file, field + " has " + std::to_string(bytes.size()) + " bytes, but its byteLength is " +
                           std::to_string(size));
    }
    return bytes.first(size);
}

GltfImage readImage(const GltfFile& file, const Json& image, const std::string& field) {
    GltfImage result;
    const auto uri = image.find("uri");
    const auto view = image.find("bufferView");
    if (uri != image.end() && uri->is_string()) {
        result.uri = uri->get<std::string>();
    } else if (view != image.end() && isGltfIndex(*view)) {
        result.bufferView = view->get<int>();
    } else {
        failGltf(file, field + " has neither a uri nor a bufferView");
    }
    if (const auto name = image.find("name"); name != image.end() && name->is_string()) {
        result.name = name->get<std::string>();
    }
    return result;
}

/// tinygltf makes 32-bit integers of all whole numbers, also of those that do not fit: these stay what they are as
/// floating-point numbers.
void keepWideIntegers(Json& value) {
    if (value.is_structured()) {
        for (Json& item : value) {
            keepWideIntegers(item);
        }
    } else if (value.is_number_integer() && !(std::abs(value.get<double>()) <= maxGltfIndex)) {
        value = value.get<double>();
    }
}

/// tinygltf demands what glTF leaves out where the matrices are identities.
void completeSkins(Json& document) {
    const auto skins = document.find("skins");
    if (skins == document.end() || !skins->is_array()) {
        return;
    }
    for (Json& skin : *skins) {
        if (skin.is_object() && !skin.contains("inverseBindMatrices")) {
            skin["inverseBindMatrices"] = -1;
        }
    }
}

/// And where a channel moves what an extension names.
void completeChannels(Json& document) {
    const auto animations = document.find("animations");
    if (animations == document.end() || !animations->is_array()) {
        return;
    }
    for (Json& animation : *animations) {
        const auto channels = animation.is_object() ? animation.find("channels") : animation.end();
        if (!animation.is_object() || channels == animation.end() || !channels->is_array()) {
            continue;
        }
        for (Json& channel : *channels) {
            if (channel.is_object() && channel.contains("target") && channel["target"].is_object() &&
                !channel["target"].contains("node")) {
                channel["target"]["node"] = -1;
            }
        }
    }
}

void parseModel(GltfFile& file, const Json& document) {
    const std::string text = document.dump();
    std::string error;
    std::string warning;
    bool parsed = false;
    try {
        parsed = tinygltf::TinyGLTF().LoadASCIIFromString(&file.model, &error, &warning, text.c_str(),
                                                          static_cast<unsigned>(text.size()), "");
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!parsed || !error.empty()) {
        failGltf(file, "is not valid glTF: " + error.substr(0, error.find_last_not_of(". \n", error.find('\n')) + 1));
    }
}

/// Whether a text begins so, whatever the case of its letters.
bool startsLike(std::string_view text, std::string_view beginning) {
    return text.size() >= beginning.size() && ::strncasecmp(text.data(), beginning.data(), beginning.size()) == 0;
}

std::string decodePercents(const std::string& uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
            std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0) {
            result += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            result += uri[i];
        }
    }
    return result;
}

} // namespace

void failGltf(const GltfFile& file, const std::string& what) {
    throw SceneError(file.path.string() + ": " + what);
}

GltfKind gltfKind(std::span<const std::uint8_t> bytes) {
    if (bytes.size() >= 8 && wordAt(bytes, 0) == glbMagic) {
        return wordAt(bytes, 4) == 1 ? GltfKind::Version1 : GltfKind::Version2;
    }
    const auto first = std::ranges::find_if(bytes, [](std::uint8_t c) { return std::isspace(c) == 0; });
    if (first == bytes.end() || (*first != '{' && *first != 0xef)) { // 0xef begins a byte order mark
        return GltfKind::None;
    }
    // Only `asset` matters; everything else is skipped while it is parsed.
    const auto filter = [](int depth, Json::parse_event_t event, Json& parsed) {
        return !(depth == 1 && event == Json::parse_event_t::key && parsed != "asset") && depth < 4;
    };
    const Json json = Json::parse(bytes.begin(), bytes.end(), filter, false);
    if (!json.is_object() || !json.contains("asset")) {
        return GltfKind::None;
    }
    const Json& asset = json["asset"];
    const Json version = asset.is_object() ? asset.value("version", Json()) : Json();
    const std::string text = version.is_string() ? version.get<std::string>() : version.dump();
    return text.starts_with("1") ? GltfKind::Version1 : GltfKind::Version2;
}

bool isDataUri(const std::string& uri) {
    return startsLike(uri, "data:");
}

// RFC 2397: percent-encoded, after ";base64" that, too. The media type does not matter here.
Bytes decodeDataUri(const GltfFile& file, const std::string& uri, const std::string& field) {
    constexpr std::string_view base64 = ";base64";
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) {
        failGltf(file, field + " " + shorten(uri) + " is a data uri without a comma");
    }
    const std::string content = decodePercents(uri.substr(comma + 1));
    if (comma < base64.size() || !startsLike(std::string_view(uri).substr(comma - base64.size()), base64)) {
        return {content.begin(), content.end()};
    }
    Bytes bytes;
    std::string mimeType;
    // tinygltf knows a list of media types, of which this is one.
    if (!tinygltf::DecodeDataURI(&bytes, mimeType, "data:application/octet-stream;base64," + content, 0, false)) {
        failGltf(file, field + " " + shorten(uri) + " is not a base64 data uri");
    }
    return bytes;
}

std::span<const std::uint8_t> readUri(const GltfFile& file, const std::string& uri, const std::string& field) {
    // Some exporters write names as they are, percent signs included.
    const std::string decoded = decodePercents(uri);
    const bool isPlain =
        decoded != uri && tryNamedFile(file.path, decoded).empty() && !tryNamedFile(file.path, uri).empty();
    return file.named->read(isPlain ? uri : decoded, file.path.string() + ": " + field);
}

GltfFile openGltf(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, GltfAnimations animations) {
    GltfFile file(path);
    const Container container = openContainer(file, bytes);
    Json document = parseJson(file, container.json);
    const Json* asset = findObject(document, "asset");
    const Json version = asset != nullptr ? asset->value("version", Json()) : Json();
    if (!version.is_string() || !version.get<std::string>().starts_with("2.")) {
        failGltf(file, "asset.version is " + version.dump() + ", must be \"2.0\"");
    }
    checkExtensions(file, document);
    noteExtensions(file, document);
    const std::vector<Json> buffers = takeObjects(file, document, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const auto binary = i == 0 ? container.binary : std::span<const std::uint8_t>();
        file.buffers.push_back(loadBuffer(file, buffers[i], "buffers[" + std::to_string(i) + "]", binary));
    }
    file.budget->addInput(bytes.size() + file.named->totalBytes());
    const std::vector<Json> images = takeObjects(file, document, "images");
    for (std::size_t i = 0; i < images.size(); ++i) {
        file.images.push_back(readImage(file, images[i], "images[" + std::to_string(i) + "]"));
    }
    if (animations == GltfAnimations::Skipped) {
        document.erase("animations");
    }
    checkGltfTypes(file, document);
    keepWideIntegers(document);
    dropDracoIndices(document);
    completeSkins(document);
    completeChannels(document);
    parseModel(file, document);
    decodeMeshoptViews(file);
    file.mostWithoutView = mostGltfElementsWithoutView(file);
    return file;
}

} // namespace nacre::scene
