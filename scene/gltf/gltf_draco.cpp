#include "scene/gltf/gltf_draco.hpp"

#include "scene/gltf/gltf_object.hpp"

#include <draco/compression/decode.h>
#include <nlohmann/json.hpp>

namespace nacre::scene {
namespace {

constexpr const char* dracoExtension = "KHR_draco_mesh_compression";

GltfPrimitive::Attribute decodeAttribute(const GltfFile& file, const draco::Mesh& mesh,
                                         const draco::PointAttribute& attribute, const std::string& field) {
    const auto width = static_cast<std::size_t>(attribute.num_components());
    if (width == 0 || width > 4) {
        failGltf(file, field + " has " + std::to_string(width) + " components, must have 1 to 4");
    }
    if (attribute.data_type() == draco::DT_BOOL) { // Draco takes any byte of the file for one
        failGltf(file, field + " has components that are true or false, which glTF does not have");
    }
    draco::GeometryAttribute plain = attribute;
    plain.set_normalized(false); // the accessor says so
    GltfPrimitive::Attribute result;
    result.components = static_cast<int>(width);
    file.budget->charge(mesh.num_points() * width * sizeof(float)); // many attributes may share the compressed one
    result.values.resize(mesh.num_points() * width);
    for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(point));
        if (value.value() >= attribute.size() ||
            !plain.ConvertValue(value, static_cast<std::int8_t>(width), &result.values[point * width])) {
            failGltf(file, field + " is damaged");
        }
    }
    return result;
}

} // namespace

void dropDracoIndices(nlohmann::json& document) {
    const auto meshes = document.find("meshes");
    if (meshes == document.end() || !meshes->is_array()) {
        return;
    }
    const nlohmann::json::json_pointer compressed(std::string("/extensions/") + dracoExtension);
    for (nlohmann::json& mesh : *meshes) {
        if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) {
            continue;
        }
        for (nlohmann::json& primitive : mesh["primitives"]) {
            if (primitive.is_object() && primitive.contains(compressed) && primitive[compressed].is_object()) {
                primitive.erase("indices");
            }
        }
    }
}

bool isDraco(const tinygltf::Primitive& primitive) {
    return primitive.extensions.contains(dracoExtension);
}

GltfPrimitive decodeDraco(const GltfFile& file, const tinygltf::Primitive& source, const std::string& field,
                          bool isSkinned) {
    const GltfObject extension(file, source.extensions, dracoExtension, field);
    const std::string name = field + ".extensions." + dracoExtension;
    const auto bytes = viewBytes(file, extension.index("bufferView"), name + ".bufferView");
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok() || decoded.value() == nullptr) {
        failGltf(file, name + " cannot be decompressed: " + decoded.status().error_msg_string());
    }
    const draco::Mesh& mesh = *decoded.value();
    GltfPrimitive result;
    result.field = file.path.string() + ": " + field;
    result.vertexCount = mesh.num_points();
    for (const auto& [semantic, accessor] : source.attributes) {
        if (!isReadAttribute(semantic, isSkinned)) {
            continue;
        }
        const int id = extension.object("attributes").index(semantic.c_str());
        if (id < 0) { // stays uncompressed
            result.attributes[semantic] = readAttribute(file, accessor, semantic, field);
            continue;
        }
        const std::string attributeName = name + ".attributes." + semantic;
        const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
        if (attribute == nullptr) {
            failGltf(file, attributeName + " is " + std::to_string(id) + ", which the compressed data do not have");
        }
        result.attributes[semantic] = decodeAttribute(file, mesh, *attribute, attributeName);
        const auto& declared = elementOf(file, file.model.accessors, accessor, field + ".attributes." + semantic);
        const int type = declared.componentType;
        if (declared.normalized && type != TINYGLTF_COMPONENT_TYPE_FLOAT &&
            attribute->data_type() != draco::DT_FLOAT32) {
            const double most = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 255
                                : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 65535
                                : type == TINYGLTF_COMPONENT_TYPE_BYTE           ? 127
                                                                                 : 32767;
            for (float& value : result.attributes[semantic].values) {
                value = std::max(value / static_cast<float>(most), -1.0f);
            }
        }
    }
    result.indices.reserve(std::size_t{mesh.num_faces()} * 3);
    for (std::uint32_t face = 0; face < mesh.num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(face))) {
            result.indices.push_back(point.value());
        }
    }
    return result;
}

} // namespace nacre::scene
