#include "scene/gltf/gltf_types.hpp"

#include "scene/json_text.hpp"

#include <algorithm>
#include <array>

namespace nacre::scene {
namespace {

using Json = nlohmann::json;

enum class Type { Index, Number, Boolean, Text, Object, Indices, Numbers, NamedIndices, ListOfNamedIndices };

/// What a member must be where it is there; `member` is a JSON pointer.
struct Field {
    const char* member;
    Type type;
};

constexpr std::array nodeFields{Field{"/mesh", Type::Index},          Field{"/camera", Type::Index},
                                Field{"/skin", Type::Index},          Field{"/children", Type::Indices},
                                Field{"/matrix", Type::Numbers},      Field{"/rotation", Type::Numbers},
                                Field{"/translation", Type::Numbers}, Field{"/scale", Type::Numbers},
                                Field{"/weights", Type::Numbers},     Field{"/extensions", Type::Object}};
constexpr std::array primitiveFields{Field{"/attributes", Type::NamedIndices},
                                     Field{"/targets", Type::ListOfNamedIndices},
                                     Field{"/indices", Type::Index},
                                     Field{"/material", Type::Index},
                                     Field{"/mode", Type::Index},
                                     Field{"/extensions", Type::Object}};
constexpr std::array materialFields{Field{"/pbrMetallicRoughness", Type::Object},
                                    Field{"/pbrMetallicRoughness/baseColorFactor", Type::Numbers},
                                    Field{"/pbrMetallicRoughness/baseColorTexture", Type::Object},
                                    Field{"/pbrMetallicRoughness/baseColorTexture/texCoord", Type::Index},
                                    Field{"/pbrMetallicRoughness/metallicFactor", Type::Number},
                                    Field{"/pbrMetallicRoughness/roughnessFactor", Type::Number},
                                    Field{"/pbrMetallicRoughness/metallicRoughnessTexture", Type::Object},
                                    Field{"/pbrMetallicRoughness/metallicRoughnessTexture/texCoord", Type::Index},
                                    Field{"/normalTexture", Type::Object},
                                    Field{"/normalTexture/texCoord", Type::Index},
                                    Field{"/normalTexture/scale", Type::Number},
                                    Field{"/emissiveFactor", Type::Numbers},
                                    Field{"/emissiveTexture", Type::Object},
                                    Field{"/emissiveTexture/texCoord", Type::Index},
                                    Field{"/alphaMode", Type::Text},
                                    Field{"/alphaCutoff", Type::Number},
                                    Field{"/doubleSided", Type::Boolean},
                                    Field{"/extensions", Type::Object}};
constexpr std::array accessorFields{Field{"/bufferView", Type::Index},
                                    Field{"/byteOffset", Type::Index},
                                    Field{"/componentType", Type::Index},
                                    Field{"/count", Type::Index},
                                    Field{"/normalized", Type::Boolean},
                                    Field{"/sparse", Type::Object},
                                    Field{"/sparse/count", Type::Index},
                                    Field{"/sparse/indices", Type::Object},
                                    Field{"/sparse/indices/bufferView", Type::Index},
                                    Field{"/sparse/indices/byteOffset", Type::Index},
                                    Field{"/sparse/indices/componentType", Type::Index},
                                    Field{"/sparse/values", Type::Object},
                                    Field{"/sparse/values/bufferView", Type::Index},
                                    Field{"/sparse/values/byteOffset", Type::Index}};
constexpr std::array viewFields{Field{"/buffer", Type::Index}, Field{"/byteOffset", Type::Index},
                                Field{"/byteLength", Type::Index}, Field{"/byteStride", Type::Index},
                                Field{"/extensions", Type::Object}};
constexpr std::array textureFields{Field{"/source", Type::Index}, Field{"/sampler", Type::Index},
                                   Field{"/extensions", Type::Object}};
constexpr std::array samplerFields{Field{"/wrapS", Type::Index}, Field{"/wrapT", Type::Index},
                                   Field{"/magFilter", Type::Index}};
constexpr std::array skinFields{Field{"/inverseBindMatrices", Type::Index}, Field{"/joints", Type::Indices}};
constexpr std::array animationSamplerFields{Field{"/input", Type::Index}, Field{"/output", Type::Index},
                                            Field{"/interpolation", Type::Text}};
constexpr std::array channelFields{Field{"/sampler", Type::Index}, Field{"/target", Type::Object},
                                   Field{"/target/node", Type::Index}, Field{"/target/path", Type::Text}};
constexpr std::array lightFields{Field{"/color", Type::Numbers},
                                 Field{"/intensity", Type::Number},
                                 Field{"/range", Type::Number},
                                 Field{"/spot", Type::Object},
                                 Field{"/spot/innerConeAngle", Type::Number},
                                 Field{"/spot/outerConeAngle", Type::Number}};

bool isNumber(const Json& value) {
    return value.is_number();
}

bool areNamedIndices(const Json& value) {
    return value.is_object() && std::ranges::all_of(value, isGltfIndex);
}

bool hasType(const Json& value, Type type) {
    switch (type) {
    case Type::Index:
        return isGltfIndex(value);
    case Type::Number:
        return isNumber(value);
    case Type::Boolean:
        return value.is_boolean();
    case Type::Text:
        return value.is_string();
    case Type::Object:
        return value.is_object();
    case Type::Indices:
        return value.is_array() && std::ranges::all_of(value, isGltfIndex);
    case Type::Numbers:
        return value.is_array() && std::ranges::all_of(value, isNumber);
    case Type::NamedIndices:
        return areNamedIndices(value);
    case Type::ListOfNamedIndices:
        return value.is_array() && std::ranges::all_of(value, areNamedIndices);
    }
    return false;
}

const char* describe(Type type) {
    constexpr std::array texts{"a whole number, 0 or more and below 2^31",
                               "a number",
                               "true or false",
                               "a string",
                               "an object",
                               "an array of whole numbers, 0 or more and below 2^31",
                               "an array of numbers",
                               "an object of whole numbers, 0 or more and below 2^31",
                               "an array of objects of whole numbers, 0 or more and below 2^31"};
    return texts[static_cast<std::size_t>(type)];
}

void check(const GltfFile& file, const Json& object, const std::string& name, std::span<const Field> fields) {
    for (const auto& [member, type] : fields) {
        const Json::json_pointer pointer(member);
        if (!object.is_object() || !object.contains(pointer) || object[pointer].is_null()) {
            continue;
        }
        if (!hasType(object[pointer], type)) {
            std::string path = name + (member + (name.empty() ? 1 : 0)); // without the first slash
            std::ranges::replace(path, '/', '.');
            failGltf(file, path + " is " + shorten(object[pointer]) + ", must be " + describe(type));
        }
    }
}

/// Checks the elements of the document's array `key`.
void checkAll(const GltfFile& file, const Json& parent, const std::string& key, std::span<const Field> fields,
              const std::string& prefix = "") {
    const auto array = parent.find(key);
    if (array == parent.end() || !array->is_array()) {
        return;
    }
    for (std::size_t i = 0; i < array->size(); ++i) {
        check(file, (*array)[i], prefix + key + "[" + std::to_string(i) + "]", fields);
    }
}

/// Checks the elements of the array `part` of every element of the document's array `key`.
void checkParts(const GltfFile& file, const Json& document, const std::string& key, const std::string& part,
                std::span<const Field> fields) {
    const auto array = document.find(key);
    for (std::size_t i = 0; array != document.end() && array->is_array() && i < array->size(); ++i) {
        if ((*array)[i].is_object()) {
            checkAll(file, (*array)[i], part, fields, key + "[" + std::to_string(i) + "].");
        }
    }
}

} // namespace

bool isGltfIndex(const Json& value) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() <= maxGltfIndex;
}

void checkGltfTypes(const GltfFile& file, const Json& document) {
    check(file, document, "", std::array{Field{"/scene", Type::Index}});
    checkAll(file, document, "scenes", std::array{Field{"/nodes", Type::Indices}});
    checkAll(file, document, "nodes", nodeFields);
    checkAll(file, document, "meshes", std::array{Field{"/weights", Type::Numbers}});
    checkAll(file, document, "materials", materialFields);
    checkAll(file, document, "accessors", accessorFields);
    checkAll(file, document, "bufferViews", viewFields);
    checkAll(file, document, "textures", textureFields);
    checkAll(file, document, "samplers", samplerFields);
    checkAll(file, document, "skins", skinFields);
    const Json::json_pointer lights("/extensions/KHR_lights_punctual");
    if (document.contains(lights) && document[lights].is_object()) {
        checkAll(file, document[lights], "lights", lightFields, "extensions.KHR_lights_punctual.");
    }
    checkParts(file, document, "meshes", "primitives", primitiveFields);
    checkParts(file, document, "animations", "samplers", animationSamplerFields);
    checkParts(file, document, "animations", "channels", channelFields);
}

} // namespace nacre::scene
