#include "scene/gltf/gltf_import.hpp"

#include "scene/gltf/gltf_animation.hpp"
#include "scene/gltf/gltf_deformation.hpp"
#include "scene/gltf/gltf_instancing.hpp"
#include "scene/gltf/gltf_light.hpp"
#include "scene/gltf/gltf_material.hpp"
#include "scene/gltf/gltf_mesh.hpp"
#include "scene/gltf/gltf_pose.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace nacre::scene {
namespace {

std::string nodeField(int node) {
    return "nodes[" + std::to_string(node) + "]";
}

glm::dmat4 localTransform(const GltfFile& file, int index) {
    const tinygltf::Node& node = file.model.nodes[static_cast<std::size_t>(index)];
    const std::string field = nodeField(index);
    glm::dmat4 transform(1);
    if (!node.matrix.empty()) {
        if (node.matrix.size() != 16) {
            failGltf(file, field + ".matrix must be an array of 16 numbers");
        }
        transform = glm::make_mat4(node.matrix.data());
    } else {
        glm::quat rotation(1, 0, 0, 0);
        if (!node.rotation.empty()) {
            if (node.rotation.size() != 4) {
                failGltf(file, field + ".rotation must be an array of 4 numbers");
            }
            const auto part = [&](std::size_t i) { return static_cast<float>(node.rotation[i]); };
            rotation = glm::normalize(glm::quat(part(3), part(0), part(1), part(2)));
        }
        vectorOf(file, node.translation, glm::vec3(0), field + ".translation"); // refuses what is none
        if (!node.translation.empty()) {
            transform[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1);
        }
        const glm::vec3 scale = vectorOf(file, node.scale, glm::vec3(1), field + ".scale");
        const glm::mat3 linear = glm::mat3_cast(rotation) * glm::mat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
        for (int column = 0; column < 3; ++column) {
            transform[column] = glm::dvec4(linear[column], 0);
        }
    }
    for (int i = 0; i < 16; ++i) {
        if (!(std::abs(transform[i / 4][i % 4]) <= maxCoordinate)) {
            failGltf(file, field + " has a transform that is not finite or beyond 1e15");
        }
    }
    return transform;
}

/// [m] Nodes that stand farther from the file's origin are moved to it: a float's step is then 0.1 mm.
constexpr double farOrigin = 1000;

bool isVisible(const GltfFile& file, const tinygltf::Node& node, const std::string& field) {
    const GltfObject extension(file, node.extensions, "KHR_node_visibility", field);
    return extension.boolean("visible", true);
}

class GltfImporter {
public:
    GltfImporter(const GltfFile& file, Scene& scene) : file_(file), scene_(scene), materials_(file, scene) {}

    void run() {
        placeNodes();
        for (const int node : order_) {
            if (!hidden_[static_cast<std::size_t>(node)]) {
                addNode(node);
            }
        }
        scene_.notes.insert(scene_.notes.end(), file_.notes.begin(), file_.notes.end());
        if (skipped_ > 0) {
            scene_.notes.push_back(file_.path.string() + ": " + std::to_string(skipped_) +
                                   " primitives of points or lines are not drawn");
        }
        if (scene_.instances.empty()) {
            failGltf(file_, skipped_ > 0 ? "has points or lines, but no triangles" : "has no triangles");
        }
    }

private:
    const tinygltf::Node& node(int index) const { return file_.model.nodes[static_cast<std::size_t>(index)]; }

    /// The default scene's roots, or, without scenes, every node that is nobody's child.
    std::vector<int> roots() const {
        if (!file_.model.scenes.empty()) {
            return elementOf(file_, file_.model.scenes, std::max(file_.model.defaultScene, 0), "scene").nodes;
        }
        std::vector<bool> isChild(file_.model.nodes.size());
        for (const tinygltf::Node& parent : file_.model.nodes) {
            for (const int child : parent.children) {
                if (child >= 0 && static_cast<std::size_t>(child) < isChild.size()) {
                    isChild[static_cast<std::size_t>(child)] = true;
                }
            }
        }
        std::vector<int> result;
        for (std::size_t i = 0; i < isChild.size(); ++i) {
            if (!isChild[i]) {
                result.push_back(static_cast<int>(i));
            }
        }
        return result;
    }

    /// World transforms of all nodes of the scene, parents first.
    void placeNodes() {
        hidden_.assign(file_.model.nodes.size(), false);
        std::vector<glm::dmat4> transforms(file_.model.nodes.size(), glm::dmat4(1));
        std::vector<bool> reached(file_.model.nodes.size());
        std::vector<std::pair<int, int>> stack; // node, parent
        const std::vector<int> first = roots();
        for (auto root = first.rbegin(); root != first.rend(); ++root) {
            stack.emplace_back(*root, -1);
        }
        while (!stack.empty()) {
            const auto [index, parent] = stack.back();
            stack.pop_back();
            elementOf(file_, file_.model.nodes, index, parent < 0 ? "scene.nodes" : nodeField(parent) + ".children");
            const auto at = static_cast<std::size_t>(index);
            if (reached[at]) {
                failGltf(file_, nodeField(index) + " is reached twice: nodes must form a tree");
            }
            reached[at] = true;
            transforms[at] = localTransform(file_, index);
            if (parent >= 0) {
                transforms[at] = transforms[static_cast<std::size_t>(parent)] * transforms[at];
            }
            order_.push_back(index);
            // KHR_node_visibility: what is hidden hides its children.
            hidden_[at] = hidden_[at] || !isVisible(file_, node(index), nodeField(index));
            const std::vector<int>& children = node(index).children;
            for (auto child = children.rbegin(); child != children.rend(); ++child) {
                if (*child >= 0 && static_cast<std::size_t>(*child) < hidden_.size() && hidden_[at]) {
                    hidden_[static_cast<std::size_t>(*child)] = true;
                }
                stack.emplace_back(*child, index);
            }
        }
        moveToOrigin(transforms);
    }

    /// Floats are too coarse far from the origin. What stands there, as georeferenced models do, is moved while its
    /// transforms are doubles.
    void moveToOrigin(std::vector<glm::dmat4>& transforms) {
        glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
        for (const int index : order_) {
            if (node(index).mesh >= 0) {
                const glm::dvec3 place(transforms[static_cast<std::size_t>(index)][3]);
                low = glm::min(low, place);
                high = glm::max(high, place);
            }
        }
        const glm::dvec3 middle = 0.5 * (low + high);
        if (low.x <= high.x && glm::length(middle) > std::max(farOrigin, 4 * glm::length(high - low))) {
            scene_.origin = middle;
            for (glm::dmat4& transform : transforms) {
                transform[3] -= glm::dvec4(middle, 0);
            }
        }
        transforms_.assign(transforms.begin(), transforms.end());
    }

    void addNode(int index) {
        const tinygltf::Node& source = node(index);
        if (source.mesh >= 0) {
            elementOf(file_, file_.model.meshes, source.mesh, nodeField(index) + ".mesh");
            addMesh(index, source);
        }
        if (source.camera >= 0) {
            addCamera(elementOf(file_, file_.model.cameras, source.camera, nodeField(index) + ".camera"), index);
        }
        if (auto light = readLight(file_, source, nodeField(index), transforms_[static_cast<std::size_t>(index)])) {
            scene_.lights.push_back(std::move(*light));
        }
    }

    void addMesh(int index, const tinygltf::Node& source) {
        const tinygltf::Mesh& mesh = file_.model.meshes[static_cast<std::size_t>(source.mesh)];
        // A skin or morph weights of its own make a mesh this node's; otherwise nodes share it.
        const bool own = source.skin >= 0 || !source.weights.empty();
        const auto& weights = source.weights.empty() ? mesh.weights : source.weights;
        const glm::mat4 place = source.skin >= 0 ? glm::mat4(1) : transforms_[static_cast<std::size_t>(index)];
        const std::vector<glm::mat4> copies = readInstances(file_, source, nodeField(index));
        file_.budget->charge(copies.size() * sizeof(copies[0]));
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            std::uint32_t target = none;
            if (own) {
                target = buildMesh(source, i, weights);
            } else {
                const auto [shared, isNew] = meshes_.try_emplace({source.mesh, i}, none);
                if (isNew) {
                    shared->second = buildMesh(source, i, weights);
                }
                target = shared->second;
            }
            if (target == none) {
                continue;
            }
            if (copies.size() > maxInstances - scene_.instances.size()) {
                failGltf(file_, "places more than " + std::to_string(maxInstances) + " meshes");
            }
            const std::string& name = source.name.empty() ? mesh.name : source.name;
            file_.budget->charge(copies.size() * (sizeof(Instance) + name.size()));
            for (const glm::mat4& copy : copies) {
                scene_.instances.push_back({name, target, place * copy});
            }
        }
    }

    std::uint32_t buildMesh(const tinygltf::Node& source, std::size_t primitive, std::span<const double> weights) {
        const tinygltf::Mesh& mesh = file_.model.meshes[static_cast<std::size_t>(source.mesh)];
        std::optional<GltfPrimitive> read = readPrimitive(file_, source.mesh, primitive, source.skin >= 0);
        if (!read) {
            ++skipped_;
            return none;
        }
        if (read->indices.empty()) {
            return none;
        }
        file_.budget->charge(read->vertexCount * sizeof(Vertex) + read->indices.size() * sizeof(read->indices[0]) +
                             mesh.name.size());
        applyMorphTargets(file_, source.mesh, primitive, weights, *read);
        if (source.skin >= 0) {
            applySkin(file_, source.skin, transforms_, *read);
        }
        const std::uint32_t surface = materials_.surface(mesh.primitives[primitive].material);
        const Surface& look = scene_.surfaces[surface];
        const bool needsTangents = look.normalTexture != none;
        Mesh result = makeMesh(*read, materials_.texCoords(surface), needsTangents, look.normalUv);
        result.name = mesh.name;
        result.surface = surface;
        scene_.meshes.push_back(std::move(result));
        return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
    }

    void addCamera(const tinygltf::Camera& source, int index) {
        const glm::mat4& transform = transforms_[static_cast<std::size_t>(index)];
        const std::string field = "cameras[" + std::to_string(node(index).camera) + "]";
        Camera camera;
        camera.name = source.name.empty() ? node(index).name : source.name;
        const auto up = unitAxis(transform, 1);
        const auto back = unitAxis(transform, 2);
        if (!up || !back || glm::length(glm::cross(*up, *back)) == 0) {
            scene_.notes.push_back(file_.path.string() + ": " + nodeField(index) +
                                   " has a scale of 0: its camera looks nowhere and is left out");
            return;
        }
        camera.position = glm::vec3(transform[3]);
        camera.target = camera.position - *back;
        camera.up = *up;
        if (source.type == "orthographic") {
            camera.projection = ProjectionKind::Orthographic;
            camera.orthographicHeight = static_cast<float>(
                2 * checkRange(file_, std::abs(source.orthographic.ymag), 1e-9, 1e9, field + ".orthographic.ymag"));
        } else {
            camera.verticalFieldOfView =
                static_cast<float>(checkRange(file_, source.perspective.yfov, 1e-3, 3.14, field + ".perspective.yfov"));
        }
        scene_.cameras.push_back(std::move(camera));
    }

    const GltfFile& file_;
    Scene& scene_;
    GltfMaterials materials_;
    std::vector<glm::mat4> transforms_;
    std::vector<int> order_;
    std::vector<bool> hidden_; ///< per node
    std::map<std::pair<int, std::size_t>, std::uint32_t> meshes_;
    std::size_t skipped_ = 0;
};

} // namespace

Scene loadGltf(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, std::optional<double> time) {
    GltfFile file = openGltf(path, bytes, time ? GltfAnimations::Read : GltfAnimations::Skipped);
    if (time) {
        poseAt(file, *time);
    }
    Scene scene;
    scene.name = path.stem().string();
    GltfImporter(file, scene).run();
    scene.inputs = file.named->paths();
    return scene;
}

} // namespace nacre::scene
