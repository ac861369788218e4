#include "scene/import.hpp"

#include "scene/assimp/assimp_import.hpp"
#include "scene/blending.hpp"
#include "scene/default_view.hpp"
#include "scene/files/scene_file.hpp"
#include "scene/gltf/gltf_import.hpp"
#include "scene/named_file.hpp"

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <sstream>

namespace nacre::scene {
namespace {

bool startsLikeJson(std::span<const std::uint8_t> bytes) {
    const auto first = std::ranges::find_if(bytes, [](std::uint8_t c) { return std::isspace(c) == 0; });
    return first != bytes.end() && *first == '{';
}

enum class Format { Gltf, SceneFile, Assimp };

Format formatOf(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) {
        throw SceneError(file.string() + ": is empty");
    }
    const std::string extension = extensionOf(file);
    switch (gltfKind(bytes)) {
    case GltfKind::Version1:
        return Format::Assimp;
    case GltfKind::Version2:
        return Format::Gltf;
    case GltfKind::None:
        break;
    }
    if (extension == ".gltf" || extension == ".glb") {
        return Format::Gltf; // whose reader says what is wrong with it
    }
    if (extension == ".json" || (startsLikeJson(bytes) && !assimpKnows(file))) {
        return Format::SceneFile;
    }
    return Format::Assimp;
}

/// What a camera's position on the command line is relative to.
void tellOrigin(Scene& scene, const std::filesystem::path& file) {
    if (scene.origin != glm::dvec3(0)) {
        std::ostringstream note;
        note << file.string() << ": stands far from its origin and is moved there: (0, 0, 0) is its (" << std::fixed
             << std::setprecision(3) << scene.origin.x << ", " << scene.origin.y << ", " << scene.origin.z << ")";
        scene.notes.push_back(note.str());
    }
}

Scene readModel(const std::filesystem::path& file, std::span<const std::uint8_t> bytes, Format format,
                std::optional<double> time) {
    Scene scene = format == Format::Gltf ? loadGltf(file, bytes, time) : loadWithAssimp(file);
    settleBlending(scene, file);
    if (time && format != Format::Gltf) {
        scene.notes.push_back(file.string() + ": is not a glTF 2.0 file; its animations are not read");
    }
    return scene;
}

} // namespace

bool isSceneFile(const std::filesystem::path& file) {
    return formatOf(file, readFile(file)) == Format::SceneFile;
}

Scene loadModel(const std::filesystem::path& file, std::optional<double> time) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    const Format format = formatOf(file, bytes);
    if (format == Format::SceneFile) {
        throw SceneError(file.string() + ": is not a model");
    }
    return readModel(file, bytes, format, time);
}

Scene load(const std::filesystem::path& file, std::optional<double> time) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    const Format format = formatOf(file, bytes);
    if (format == Format::SceneFile) {
        return readSceneFile(file, bytes, time);
    }
    Scene scene = readModel(file, bytes, format, time);
    fitLights(scene);
    tellOrigin(scene, file);
    addMissingViewAndLights(scene);
    return scene;
}

} // namespace nacre::scene
