#include "scene/gltf/gltf_deformation.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <set>

namespace nacre::scene {
namespace {

using Attribute = GltfPrimitive::Attribute;

/// Adds to each element as many components as an offset has: tangents have four, of which three are moved.
void addOffsets(const std::vector<float>& offsets, std::size_t width, double weight, Attribute& attribute) {
    const auto components = static_cast<std::size_t>(attribute.components);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        attribute.values[i / width * components + i % width] += static_cast<float>(weight) * offsets[i];
    }
}

/// A set of four influences a vertex.
struct Influences {
    std::string joints; ///< its name
    std::vector<float> joint;
    std::vector<float> weight;
};

std::vector<Influences> influencesOf(const GltfPrimitive& source) {
    std::set<std::size_t> numbers;
    for (const auto& [semantic, attribute] : source.attributes) {
        for (const std::string_view prefix : {jointsPrefix, weightsPrefix}) {
            if (const auto number = setNumber(semantic, prefix)) {
                numbers.insert(*number);
            }
        }
    }
    std::vector<Influences> result;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::string joints = std::string(jointsPrefix) + std::to_string(i);
        const std::string weights = std::string(weightsPrefix) + std::to_string(i);
        for (const std::string& name : {joints, weights}) {
            if (!source.has(name)) {
                throw SceneError(source.field + ".attributes has no " + name + ", but joints or weights up to set " +
                                 std::to_string(*numbers.rbegin()));
            }
        }
        result.push_back({joints, source.attribute(joints, 4), source.attribute(weights, 4)});
    }
    return result;
}

/// Of each joint, from the pose that the mesh was bound in to that of its node.
std::vector<glm::mat4> jointMatrices(const GltfFile& file, const tinygltf::Skin& skin, const std::string& field,
                                     std::span<const glm::mat4> nodeTransforms) {
    std::vector<float> inverseBind;
    if (skin.inverseBindMatrices >= 0) {
        inverseBind = readFloats(file, skin.inverseBindMatrices, 16, field + ".inverseBindMatrices");
        if (inverseBind.size() < skin.joints.size() * 16) {
            failGltf(file, field + ".inverseBindMatrices has fewer matrices than there are joints");
        }
    }
    std::vector<glm::mat4> matrices(skin.joints.size());
    file.budget->charge(2 * matrices.size() * sizeof(matrices[0]));
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        elementOf(file, file.model.nodes, skin.joints[i], field + ".joints[" + std::to_string(i) + "]");
        matrices[i] = nodeTransforms[static_cast<std::size_t>(skin.joints[i])];
        if (!inverseBind.empty()) {
            matrices[i] *= glm::make_mat4(&inverseBind[i * 16]);
        }
    }
    return matrices;
}

/// The mean of the joints' matrices, by weight; nothing for a vertex without weights. What has no weight may name any
/// joint.
std::optional<glm::mat4> blend(const std::vector<Influences>& sets, std::span<const glm::mat4> matrices,
                               std::size_t vertex, const std::string& where, const std::string& skin) {
    glm::mat4 sum(0);
    float total = 0;
    for (const Influences& set : sets) {
        for (std::size_t i = vertex * 4; i < vertex * 4 + 4; ++i) {
            const float joint = set.joint[i];
            if (set.weight[i] == 0) {
                continue;
            }
            if (!(joint >= 0 && joint < static_cast<float>(matrices.size()))) {
                throw SceneError(where + ".attributes." + set.joints + " names a joint that " + skin +
                                 " does not have");
            }
            sum += matrices[static_cast<std::size_t>(joint)] * set.weight[i];
            total += set.weight[i];
        }
    }
    return total > 0 ? std::optional(sum / total) : std::nullopt;
}

/// What turns normals where the matrix turns positions: the transpose of its inverse but for a positive factor, which
/// is there for singular matrices, too.
glm::mat3 normalMatrix(const glm::mat3& m) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0 ? -cofactors : cofactors;
}

void transform(Attribute& attribute, std::size_t vertex, const glm::mat3& matrix, const glm::vec3& offset) {
    float* const values = &attribute.values[vertex * static_cast<std::size_t>(attribute.components)];
    const glm::vec3 moved = matrix * glm::make_vec3(values) + offset;
    std::copy_n(&moved.x, 3, values);
}

} // namespace

void applyMorphTargets(const GltfFile& file, int mesh, std::size_t primitive, std::span<const double> weights,
                       GltfPrimitive& target) {
    const tinygltf::Primitive& source = file.model.meshes[static_cast<std::size_t>(mesh)].primitives[primitive];
    for (std::size_t i = 0; i < std::min(weights.size(), source.targets.size()); ++i) {
        for (const auto& [semantic, accessor] : source.targets[i]) {
            const auto attribute = target.attributes.find(semantic);
            if (weights[i] == 0 || attribute == target.attributes.end() || isSkinAttribute(semantic)) {
                continue;
            }
            const std::string field =
                primitiveField(mesh, primitive) + ".targets[" + std::to_string(i) + "]." + semantic;
            const int width = componentCount(file, accessor, field);
            const std::vector<float> offsets = readFloats(file, accessor, width, field);
            file.budget->charge(offsets.size() * sizeof(offsets[0]));
            if (offsets.size() != target.vertexCount * static_cast<std::size_t>(width) ||
                width > attribute->second.components) {
                failGltf(file, field + " has another count or more components than the primitive's");
            }
            addOffsets(offsets, static_cast<std::size_t>(width), weights[i], attribute->second);
        }
    }
}

void applySkin(const GltfFile& file, int skin, std::span<const glm::mat4> nodeTransforms, GltfPrimitive& target) {
    const tinygltf::Skin& source = elementOf(file, file.model.skins, skin, "skin");
    const std::string field = "skins[" + std::to_string(skin) + "]";
    const std::vector<Influences> sets = influencesOf(target);
    if (sets.empty()) {
        return;
    }
    const std::vector<glm::mat4> matrices = jointMatrices(file, source, field, nodeTransforms);
    const auto find = [&](const char* semantic) {
        const auto found = target.attributes.find(semantic);
        return found != target.attributes.end() && found->second.components >= 3 ? &found->second : nullptr;
    };
    Attribute* const positions = find("POSITION");
    Attribute* const normals = find("NORMAL");
    Attribute* const tangents = find("TANGENT");
    for (std::size_t i = 0; i < target.vertexCount; ++i) {
        const std::optional<glm::mat4> matrix = blend(sets, matrices, i, target.field, field);
        if (!matrix) {
            continue;
        }
        transform(*positions, i, glm::mat3(*matrix), glm::vec3((*matrix)[3]));
        if (normals != nullptr) {
            transform(*normals, i, normalMatrix(glm::mat3(*matrix)), glm::vec3(0));
        }
        if (tangents != nullptr) {
            transform(*tangents, i, glm::mat3(*matrix), glm::vec3(0));
        }
    }
}

} // namespace nacre::scene
