#include "scene/gltf/gltf_mesh.hpp"

#include "scene/gltf/gltf_draco.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <charconv>
#include <numeric>

namespace nacre::scene {
namespace {

void checkCounts(const GltfPrimitive& primitive) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        throw SceneError(primitive.field + " has no POSITION");
    }
    for (const auto& [semantic, attribute] : primitive.attributes) {
        const std::size_t count = attribute.values.size() / static_cast<std::size_t>(attribute.components);
        if (count != primitive.vertexCount) {
            throw SceneError(primitive.field + ".attributes." + semantic + " has " + std::to_string(count) +
                             " elements, but POSITION has " + std::to_string(primitive.vertexCount));
        }
    }
}

/// The attribute COLOR_0, RGB or RGBA; empty where there is none.
std::vector<glm::vec4> colorsOf(const GltfPrimitive& source) {
    const auto found = source.attributes.find("COLOR_0");
    if (found == source.attributes.end()) {
        return {};
    }
    const auto width = static_cast<std::size_t>(found->second.components);
    if (width != 3 && width != 4) {
        throw SceneError(source.field + ".attributes.COLOR_0 has " + std::to_string(width) +
                         " components, must have 3 or 4");
    }
    std::vector<glm::vec4> colors(source.vertexCount, glm::vec4(1));
    for (std::size_t i = 0; i < found->second.values.size(); ++i) {
        colors[i / width][static_cast<int>(i % width)] = found->second.values[i];
    }
    return colors;
}

} // namespace

std::string primitiveField(int mesh, std::size_t primitive) {
    return "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(primitive) + "]";
}

std::optional<std::size_t> setNumber(std::string_view semantic, std::string_view prefix) {
    if (!semantic.starts_with(prefix)) {
        return std::nullopt;
    }
    semantic.remove_prefix(prefix.size());
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(semantic.data(), semantic.data() + semantic.size(), number);
    const bool isCanonical = error == std::errc() && end == semantic.data() + semantic.size() &&
                             (semantic.size() == 1 || semantic.front() != '0');
    return isCanonical ? std::optional(number) : std::nullopt;
}

bool isSkinAttribute(std::string_view semantic) {
    return setNumber(semantic, jointsPrefix) || setNumber(semantic, weightsPrefix);
}

bool isReadAttribute(std::string_view semantic, bool isSkinned) {
    constexpr std::string_view set = "TEXCOORD_";
    return semantic == "POSITION" || semantic == "NORMAL" || semantic == "TANGENT" || semantic == "COLOR_0" ||
           (isSkinned && isSkinAttribute(semantic)) || (semantic.starts_with(set) && semantic.size() == set.size() + 1);
}

std::vector<float> GltfPrimitive::attribute(const std::string& name, int components) const {
    const auto found = attributes.find(name);
    if (found == attributes.end()) {
        return {};
    }
    if (found->second.components != components) {
        throw SceneError(field + ".attributes." + name + " has " + std::to_string(found->second.components) +
                         " components, must have " + std::to_string(components));
    }
    return found->second.values;
}

GltfPrimitive::Attribute readAttribute(const GltfFile& file, int accessor, const std::string& semantic,
                                       const std::string& field) {
    const std::string name = field + ".attributes." + semantic;
    GltfPrimitive::Attribute result;
    result.components = componentCount(file, accessor, name);
    result.values = readFloats(file, accessor, result.components, name);
    if (isSkinAttribute(semantic)) { // any number of sets may share an accessor
        file.budget->charge(result.values.size() * sizeof(result.values[0]));
    }
    return result;
}

std::optional<GltfPrimitive> readPrimitive(const GltfFile& file, int mesh, std::size_t primitive, bool isSkinned) {
    const tinygltf::Primitive& source = file.model.meshes[static_cast<std::size_t>(mesh)].primitives[primitive];
    const std::string field = primitiveField(mesh, primitive);
    if (source.mode < 0 || source.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        failGltf(file, field + ".mode is " + std::to_string(source.mode) + ", must be 0 to 6");
    }
    if (source.mode < TINYGLTF_MODE_TRIANGLES) {
        return std::nullopt;
    }
    if (isDraco(source)) {
        GltfPrimitive result = decodeDraco(file, source, field, isSkinned);
        checkCounts(result);
        return result;
    }
    GltfPrimitive result;
    result.field = file.path.string() + ": " + field;
    for (const auto& [semantic, accessor] : source.attributes) {
        if (isReadAttribute(semantic, isSkinned)) {
            result.attributes[semantic] = readAttribute(file, accessor, semantic, field);
        }
    }
    result.vertexCount = result.attribute("POSITION", 3).size() / 3;
    checkCounts(result);
    std::vector<std::uint32_t> indices(result.vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
    if (source.indices >= 0) {
        indices = readIndices(file, source.indices, field + ".indices");
    }
    result.indices = triangleList(static_cast<PrimitiveMode>(source.mode), indices);
    return result;
}

Mesh makeMesh(const GltfPrimitive& source, const std::array<int, 2>& texCoords, bool needsTangents,
              const TextureCoordinates& normalUv) {
    const std::vector<float> positions = source.attribute("POSITION", 3);
    const std::vector<float> normals = source.attribute("NORMAL", 3);
    const std::vector<float> tangents = source.attribute("TANGENT", 4);
    const std::vector<float> uvs = source.attribute("TEXCOORD_" + std::to_string(texCoords[0]), 2);
    const std::vector<float> secondUvs = source.attribute("TEXCOORD_" + std::to_string(texCoords[1]), 2);
    const std::vector<glm::vec4> colors = colorsOf(source);
    Mesh mesh;
    mesh.indices = source.indices;
    mesh.vertices.resize(source.vertexCount);
    for (std::size_t i = 0; i < source.vertexCount; ++i) {
        Vertex& vertex = mesh.vertices[i];
        vertex.position = glm::make_vec3(&positions[i * 3]);
        if (!normals.empty()) {
            vertex.normal = glm::make_vec3(&normals[i * 3]);
        }
        if (!tangents.empty()) {
            vertex.tangent = {tangents[i * 4], tangents[i * 4 + 1], tangents[i * 4 + 2], tangents[i * 4 + 3]};
        }
        if (!uvs.empty()) {
            vertex.uv = {uvs[i * 2], uvs[i * 2 + 1]};
        }
        if (!secondUvs.empty()) {
            vertex.secondUv = {secondUvs[i * 2], secondUvs[i * 2 + 1]};
        }
        if (!colors.empty()) {
            vertex.color = vertexColor(colors[i]);
        }
    }
    checkMesh(mesh, source.field);
    if (normals.empty()) {
        makeFlatNormals(mesh); // glTF 2.0, section 3.7.2.1
    }
    repairNormals(mesh);
    if (needsTangents && (tangents.empty() || normals.empty())) {
        makeTangents(mesh, normalUv);
    }
    return mesh;
}

} // namespace nacre::scene
