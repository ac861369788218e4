#include "scene/gltf/gltf_mesh.hpp"

#include "scene/gltf/gltf_draco.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nacre::scene {
namespace {

std::string fieldOf(int mesh, std::size_t primitive) {
    return "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(primitive) + "]";
}

const tinygltf::Primitive& primitiveOf(const GltfFile& file, int mesh, std::size_t primitive) {
    return file.model.meshes[static_cast<std::size_t>(mesh)].primitives[primitive];
}

/// The attributes that are read; others (a second set of colours, custom ones) are not looked at. Of sets of texture
/// coordinates there are at most ten, more than anybody has.
bool isRead(const std::string& semantic) {
    constexpr std::string_view set = "TEXCOORD_";
    return semantic == "POSITION" || semantic == "NORMAL" || semantic == "TANGENT" || semantic == "COLOR_0" ||
           semantic == "JOINTS_0" || semantic == "WEIGHTS_0" ||
           (semantic.starts_with(set) && semantic.size() == set.size() + 1);
}

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

glm::vec3 vec3At(const std::vector<float>& values, std::size_t i) {
    return {values[i * 3], values[i * 3 + 1], values[i * 3 + 2]};
}

void setVec3(std::vector<float>& values, std::size_t i, const glm::vec3& v) {
    values[i * 3] = v.x;
    values[i * 3 + 1] = v.y;
    values[i * 3 + 2] = v.z;
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

std::optional<GltfPrimitive> readPrimitive(const GltfFile& file, int mesh, std::size_t primitive) {
    const tinygltf::Primitive& source = primitiveOf(file, mesh, primitive);
    const std::string field = fieldOf(mesh, primitive);
    if (source.mode < 0 || source.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        failGltf(file, field + ".mode is " + std::to_string(source.mode) + ", must be 0 to 6");
    }
    if (source.mode < TINYGLTF_MODE_TRIANGLES) {
        return std::nullopt;
    }
    if (isDraco(source)) {
        GltfPrimitive result = decodeDraco(file, source, field);
        checkCounts(result);
        return result;
    }
    GltfPrimitive result;
    result.field = file.path.string() + ": " + field;
    for (const auto& [semantic, accessor] : source.attributes) {
        if (isRead(semantic)) {
            const std::string name = field + ".attributes." + semantic;
            const int width = componentCount(file, accessor, name);
            result.attributes[semantic] = {width, readFloats(file, accessor, width, name)};
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

void applyMorphTargets(const GltfFile& file, int mesh, std::size_t primitive, std::span<const double> weights,
                       GltfPrimitive& target) {
    const tinygltf::Primitive& source = primitiveOf(file, mesh, primitive);
    for (std::size_t i = 0; i < std::min(weights.size(), source.targets.size()); ++i) {
        for (const char* semantic : {"POSITION", "NORMAL"}) {
            const auto found = source.targets[i].find(semantic);
            const auto attribute = target.attributes.find(semantic);
            if (weights[i] == 0 || found == source.targets[i].end() || attribute == target.attributes.end()) {
                continue;
            }
            const std::string field = fieldOf(mesh, primitive) + ".targets[" + std::to_string(i) + "]." + semantic;
            const std::vector<float> offsets = readFloats(file, found->second, 3, field);
            file.budget->charge(offsets.size() * sizeof(offsets[0]));
            if (offsets.size() != attribute->second.values.size()) {
                failGltf(file, field + " has another count than the primitive");
            }
            for (std::size_t k = 0; k < offsets.size(); ++k) {
                attribute->second.values[k] += static_cast<float>(weights[i]) * offsets[k];
            }
        }
    }
}

void applySkin(const GltfFile& file, int skin, std::span<const glm::mat4> nodeTransforms, GltfPrimitive& target) {
    const tinygltf::Skin& source = elementOf(file, file.model.skins, skin, "skin");
    const std::string field = "skins[" + std::to_string(skin) + "]";
    const std::vector<float> joints = target.attribute("JOINTS_0", 4);
    const std::vector<float> weights = target.attribute("WEIGHTS_0", 4);
    if (joints.empty() || weights.empty()) {
        return;
    }
    std::vector<float> inverseBind;
    if (source.inverseBindMatrices >= 0) {
        inverseBind = readFloats(file, source.inverseBindMatrices, 16, field + ".inverseBindMatrices");
        if (inverseBind.size() < source.joints.size() * 16) {
            failGltf(file, field + ".inverseBindMatrices has fewer matrices than there are joints");
        }
    }
    std::vector<glm::mat4> matrices(source.joints.size());
    file.budget->charge(2 * matrices.size() * sizeof(matrices[0]));
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        elementOf(file, file.model.nodes, source.joints[i], field + ".joints[" + std::to_string(i) + "]");
        matrices[i] = nodeTransforms[static_cast<std::size_t>(source.joints[i])];
        if (!inverseBind.empty()) {
            glm::mat4 inverse;
            std::copy_n(&inverseBind[i * 16], 16, &inverse[0][0]);
            matrices[i] *= inverse;
        }
    }
    auto& positions = target.attributes["POSITION"].values;
    const bool hasNormals = target.has("NORMAL");
    for (std::size_t i = 0; i < target.vertexCount; ++i) {
        glm::mat4 matrix(0);
        float total = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const float joint = joints[i * 4 + k];
            if (!(joint >= 0 && joint < static_cast<float>(matrices.size()))) {
                throw SceneError(target.field + ".attributes.JOINTS_0 names a joint that " + field + " does not have");
            }
            matrix += matrices[static_cast<std::size_t>(joint)] * weights[i * 4 + k];
            total += weights[i * 4 + k];
        }
        if (!(total > 0)) {
            continue;
        }
        matrix /= total;
        setVec3(positions, i, glm::vec3(matrix * glm::vec4(vec3At(positions, i), 1)));
        if (hasNormals) {
            auto& normals = target.attributes["NORMAL"].values;
            setVec3(normals, i, glm::mat3(matrix) * vec3At(normals, i));
        }
    }
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
        vertex.position = vec3At(positions, i);
        if (!normals.empty()) {
            vertex.normal = vec3At(normals, i);
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
