#include "scene/assimp/assimp_import.hpp"

#include "core/files/quoted_text.hpp"
#include "image/color.hpp"
#include "nacre/files.hpp"
#include "scene/assimp/assimp_axes.hpp"
#include "scene/assimp/assimp_files.hpp"
#include "scene/assimp/assimp_material.hpp"
#include "scene/assimp/threemf_facts.hpp"
#include "scene/import.hpp"
#include "scene/import_isolated.hpp"
#include "scene/import_mesh.hpp"
#include "scene/named_file.hpp"

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <cmath>
#include <numbers>

namespace nacre::scene {
namespace {

constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenUVCoords |
                           aiProcess_TransformUVCoords | aiProcess_FlipUVs | aiProcess_GlobalScale;
/// A deeper hierarchy than this is an attack or an accident.
constexpr int maxNodeDepth = 1000;

glm::vec3 convert(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

glm::mat4 convert(const aiMatrix4x4& m) {
    return {glm::vec4(m.a1, m.b1, m.c1, m.d1), glm::vec4(m.a2, m.b2, m.c2, m.d2), glm::vec4(m.a3, m.b3, m.c3, m.d3),
            glm::vec4(m.a4, m.b4, m.c4, m.d4)};
}

class AssimpImporter {
public:
    AssimpImporter(const std::filesystem::path& file, const aiScene& source, Scene& scene)
        : name_(file.string()),
          extension_(extensionOf(file)),
          source_(source),
          scene_(scene),
          materials_(file, source, scene),
          meshes_(source.mNumMeshes, none) {}

    void run() {
        if (source_.mRootNode != nullptr) {
            addNode(*source_.mRootNode, axes(), 0);
        }
        if (hasLostNodes_) {
            placeTheRest();
        }
        if (scene_.instances.empty()) {
            throw SceneError(name_ + ": has no triangles");
        }
        const Bounds box = bounds(scene_);
        center_ = box.center();
        chooseUnit(2.0 * static_cast<double>(box.radius()));
        for (const aiLight* light : std::span(source_.mLights, source_.mNumLights)) {
            addLight(*light);
        }
        for (const aiCamera* camera : std::span(source_.mCameras, source_.mNumCameras)) {
            addCamera(*camera);
        }
        if (const std::string unread = materials_.unreadUses(); !unread.empty()) {
            scene_.notes.push_back(name_ + ": its materials have textures that are not read: " + unread);
        }
        scene_.inputs = materials_.inputs();
    }

private:
    /// Undoes what Assimp does to every 3DS file, turning Z to Y, where Y is up already.
    glm::mat4 axes() {
        if (extension_ != ".3ds" || hasStudioAxes(readFile(name_))) {
            return glm::mat4(1);
        }
        scene_.notes.push_back(name_ + ": was not written by 3D Studio; its y axis is taken for up");
        return {glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, -1, 0, 0), glm::vec4(0, 0, 0, 1)};
    }

    void addNode(const aiNode& node, const glm::mat4& parent, int depth) {
        if (depth > maxNodeDepth) {
            throw SceneError(name_ + ": its nodes are nested more than " + std::to_string(maxNodeDepth) + " deep");
        }
        const glm::mat4 transform = parent * convert(node.mTransformation);
        for (int i = 0; i < 16; ++i) {
            if (!(std::abs(transform[i / 4][i % 4]) <= maxCoordinate)) {
                throw SceneError(name_ + ": node " + inQuotes(node.mName.C_Str()) +
                                 " has a transform that is not finite or beyond 1e15");
            }
        }
        placed_.emplace(node.mName.C_Str(), transform);
        for (const unsigned mesh : std::span(node.mMeshes, node.mNumMeshes)) {
            place(mesh, node.mName.C_Str(), transform);
        }
        for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) {
            if (child != nullptr) {
                addNode(*child, transform, depth + 1);
            }
            hasLostNodes_ = hasLostNodes_ || child == nullptr;
        }
    }

    void place(unsigned mesh, const char* name, const glm::mat4& transform) {
        const std::uint32_t converted = this->mesh(mesh);
        if (scene_.instances.size() >= maxInstances) {
            throw SceneError(name_ + ": places more than " + std::to_string(maxInstances) + " meshes");
        }
        if (converted != none) {
            scene_.instances.push_back({name, converted, transform});
        }
    }

    /// Assimp loses nodes of RAW files with several groups, which have no transforms, and keeps their meshes.
    void placeTheRest() {
        for (unsigned mesh = 0; mesh < source_.mNumMeshes; ++mesh) {
            if (meshes_[mesh] == none) {
                place(mesh, source_.mMeshes[mesh]->mName.C_Str(), glm::mat4(1));
            }
        }
    }

    /// Scans have their colours as bytes, which are made to be shown; the other formats have linear ones.
    glm::vec4 colorOf(const aiColor4D& color) const {
        const bool areBytes = extension_ == ".ply" || extension_ == ".off" || extension_ == ".stl";
        const auto linear = [&](float value) { return areBytes ? decodeSrgb(value) : value; };
        return {linear(color.r), linear(color.g), linear(color.b), color.a};
    }

    std::uint32_t mesh(unsigned index) {
        if (index >= source_.mNumMeshes) {
            throw SceneError(name_ + ": a node names mesh " + std::to_string(index) + ", but there are only " +
                             std::to_string(source_.mNumMeshes));
        }
        const aiMesh& source = *source_.mMeshes[index];
        if (meshes_[index] != none || (source.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) {
            return meshes_[index];
        }
        Mesh mesh;
        mesh.name = source.mName.C_Str();
        mesh.vertices.resize(source.mNumVertices);
        // The normals of STL are those of its facets, whatever the shape.
        const bool hasNormals = source.HasNormals() && extension_ != ".stl";
        for (unsigned i = 0; i < source.mNumVertices; ++i) {
            Vertex& vertex = mesh.vertices[i];
            vertex.position = convert(source.mVertices[i]);
            vertex.normal = hasNormals ? convert(source.mNormals[i]) : glm::vec3(0);
            if (source.HasTextureCoords(0)) {
                vertex.uv = glm::vec2(convert(source.mTextureCoords[0][i]));
            }
            if (source.HasVertexColors(0)) {
                vertex.color = vertexColor(colorOf(source.mColors[0][i]));
            }
        }
        mesh.indices.reserve(std::size_t{source.mNumFaces} * 3);
        for (const aiFace& face : std::span(source.mFaces, source.mNumFaces)) {
            if (face.mNumIndices == 3) {
                mesh.indices.insert(mesh.indices.end(), face.mIndices, face.mIndices + 3);
            }
        }
        if (mesh.indices.empty()) {
            return none;
        }
        checkMesh(mesh, name_ + ": mesh " + inQuotes(mesh.name));
        if (hasNormals) {
            repairNormals(mesh);
            weldVertices(mesh);
        } else {
            makeSmoothNormals(mesh);
        }
        mesh.surface = materials_.surface(source.mMaterialIndex, source.HasVertexColors(0));
        if (scene_.surfaces[mesh.surface].normalTexture != none) {
            makeTangents(mesh, {});
        }
        scene_.meshes.push_back(std::move(mesh));
        return meshes_[index] = static_cast<std::uint32_t>(scene_.meshes.size() - 1);
    }

    /// By the scene's size in its own units, where the format does not say.
    void chooseUnit(double size) {
        if (extension_ == ".3mf") {
            const ThreemfFacts facts = readThreemfFacts(name_);
            scene_.metersPerUnit = facts.metersPerUnit;
            if (facts.hasUnreadColors) {
                scene_.notes.push_back(name_ + ": its colour groups and textures are not read");
            }
            return;
        }
        constexpr std::array statesUnit{".fbx", ".dae", ".blend", ".ifc", ".gltf", ".glb"};
        if (std::ranges::find(statesUnit, extension_) != statesUnit.end()) {
            return;
        }
        struct Unit {
            const char* name;
            double metres;
        };
        constexpr std::array units{Unit{"metres", 1}, Unit{"centimetres", 0.01}, Unit{"millimetres", 0.001}};
        constexpr double largest = 5;
        const auto* unit = std::ranges::find_if(units, [&](const Unit& u) { return size * u.metres < largest; });
        unit = unit == units.end() ? unit - 1 : unit;
        scene_.metersPerUnit = unit->metres;
        if (unit->metres != 1) {
            scene_.notes.push_back(name_ + ": " + unitNote + "; taken for " + unit->name);
        }
    }

    /// Where the node of a light or a camera is.
    glm::mat4 placeOf(const aiString& node) const {
        const auto found = placed_.find(node.C_Str());
        return found != placed_.end() ? found->second : glm::mat4(1);
    }

    void addLight(const aiLight& source) {
        const float strength = std::max({source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b});
        const bool known = source.mType == aiLightSource_DIRECTIONAL || source.mType == aiLightSource_POINT ||
                           source.mType == aiLightSource_SPOT;
        const glm::mat4 place = placeOf(source.mName);
        const glm::vec3 position(place * glm::vec4(convert(source.mPosition), 1));
        const glm::vec3 direction = glm::mat3(place) * convert(source.mDirection);
        const bool hasDirection = std::isfinite(glm::length(direction)) && glm::length(direction) > 0;
        if (!known || !(strength > 0) || !std::isfinite(strength) || !std::isfinite(glm::length(position)) ||
            (source.mType != aiLightSource_POINT && !hasDirection)) {
            return;
        }
        Light light;
        light.name = source.mName.C_Str();
        light.kind = source.mType == aiLightSource_DIRECTIONAL ? LightKind::Directional
                     : source.mType == aiLightSource_SPOT      ? LightKind::Spot
                                                               : LightKind::Point;
        light.color =
            glm::max(glm::vec3(source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b), 0.0f) /
            strength;
        light.position = position;
        if (hasDirection) {
            light.direction = glm::normalize(direction);
        }
        // Fixed-function lighting has no 1/π: a white surface facing a light of 1 is white.
        light.intensity = strength * std::numbers::pi_v<float>;
        if (light.kind != LightKind::Directional) {
            const float units = glm::distance(position, center_);
            const float falloff = source.mAttenuationConstant + source.mAttenuationLinear * units +
                                  source.mAttenuationQuadratic * units * units;
            const float metres = units * static_cast<float>(scene_.metersPerUnit);
            light.intensity *= metres * metres / (falloff > 0 && std::isfinite(falloff) ? falloff : 1.0f);
        }
        constexpr float widest = 1.57f;
        if (light.kind == LightKind::Spot) { // Assimp has full angles
            light.outerConeAngle = std::clamp(source.mAngleOuterCone / 2, 0.01f, widest);
            light.innerConeAngle = std::clamp(source.mAngleInnerCone / 2, 0.0f, light.outerConeAngle);
        }
        scene_.lights.push_back(std::move(light));
    }

    void addCamera(const aiCamera& source) {
        const glm::mat4 place = placeOf(source.mName);
        Camera camera;
        camera.name = source.mName.C_Str();
        camera.position = glm::vec3(place * glm::vec4(convert(source.mPosition), 1));
        const glm::vec3 forward = glm::mat3(place) * convert(source.mLookAt);
        camera.up = glm::mat3(place) * convert(source.mUp);
        const float aspect = source.mAspect > 0 ? source.mAspect : 4.0f / 3.0f;
        const float field = 2 * std::atan(std::tan(source.mHorizontalFOV / 2) / aspect);
        const float turn = glm::length(glm::cross(forward, camera.up));
        if (!std::isfinite(turn) || turn == 0 || !std::isfinite(glm::length(camera.position)) || !(field > 0.01f) ||
            !(field < 3.1f)) {
            scene_.notes.push_back(name_ + ": camera " + inQuotes(camera.name) + " looks nowhere and is left out");
            return;
        }
        camera.target = camera.position + glm::normalize(forward);
        camera.up = glm::normalize(camera.up);
        camera.verticalFieldOfView = field;
        scene_.cameras.push_back(std::move(camera));
    }

    std::string name_;
    std::string extension_;
    const aiScene& source_;
    Scene& scene_;
    AssimpMaterials materials_;
    std::vector<std::uint32_t> meshes_;
    std::map<std::string, glm::mat4> placed_;
    bool hasLostNodes_ = false;
    glm::vec3 center_{0}; ///< of everything that was placed
};

Scene importFile(const std::filesystem::path& file) {
    auto* files = new AssimpFiles(file); // the importer's own
    Assimp::Importer importer;
    importer.SetIOHandler(files);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* source = importer.ReadFile(file.string(), steps);
    if (source == nullptr) {
        const std::string reason = importer.GetErrorString();
        if (reason.find("bad_alloc") != std::string::npos) {
            throw std::bad_alloc();
        }
        if (reason.find("No meshes remaining") != std::string::npos) {
            throw SceneError(file.string() + ": has points or lines, but no triangles");
        }
        if (reason.find("No suitable reader") != std::string::npos) {
            throw SceneError(file.string() + ": is not a model in a format that is known");
        }
        throw SceneError(file.string() + ": cannot be read as a model: " + reason.substr(0, reason.find('\n')));
    }
    Scene scene;
    scene.name = file.stem().string();
    AssimpImporter(file, *source, scene).run();
    std::ranges::copy(files->inputs(), std::back_inserter(scene.inputs));
    std::ranges::copy(files->notes(), std::back_inserter(scene.notes));
    return scene;
}

} // namespace

bool assimpKnows(const std::filesystem::path& file) {
    return Assimp::Importer().IsExtensionSupported(file.extension().string());
}

Scene loadWithAssimp(const std::filesystem::path& file) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (error) {
        throw SceneError(file.string() + ": cannot be read: " + error.message());
    }
    return importIsolated(file.string(), limitsFor(size), [&file] {
        try {
            return importFile(file);
        } catch (const SceneError&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& failure) {
            throw SceneError(file.string() + ": cannot be read as a model: " + failure.what());
        }
    });
}

} // namespace nacre::scene
