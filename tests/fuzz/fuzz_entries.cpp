#include "tests/fuzz/fuzz_entries.hpp"

#include "image/codecs.hpp"
#include "scene/assimp/assimp_import.hpp"
#include "scene/default_view.hpp"
#include "scene/files/scene_file.hpp"
#include "scene/gltf/gltf_import.hpp"
#include "scene/materialx/materialx_file.hpp"
#include "tests/fuzz/sound_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace nacre::fuzz {
namespace {

using Bytes = std::span<const std::uint8_t>;
namespace fs = std::filesystem;

/// The folder that files read lie in: what they name is there.
const fs::path files = fs::path(NACRE_SOURCE_DIR) / "tests/fuzz/files";

/// Runs `read`, which may refuse the bytes with one line.
template <typename Read> void refusing(const Read& read) {
    try {
        read();
    } catch (const FileError& error) {
        const std::string sentence = error.what();
        if (sentence.empty() || sentence.size() > mostOfSentence) {
            std::abort();
        }
    }
}

/// What `scene::load` does to a model.
void readModel(scene::Scene scene) {
    scene::fitLights(scene);
    scene::addMissingViewAndLights(scene);
    requireSound(scene);
}

void readGltf(Bytes bytes) {
    refusing([&] { readModel(scene::loadGltf(files / "fuzzed.gltf", bytes)); });
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.find("animations") != std::string_view::npos) {
        constexpr double time = 0.5;
        refusing([&] { readModel(scene::loadGltf(files / "fuzzed.gltf", bytes, time)); });
    }
}

void readSceneFile(Bytes bytes) {
    refusing([&] { requireSound(scene::readSceneFile(files / "fuzzed.json", bytes)); });
}

void readMaterialFile(Bytes bytes) {
    refusing([&] {
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const Material material = parseMaterial(text, "fuzzed.json");
        // Slabs are fitted at every turn, which takes a second.
        const bool isFitted = !material.slabs.empty();
        if (!findFault(material).empty() ||
            (!isFitted && parseMaterial(formatMaterial(material), "written.json") != material)) {
            std::abort();
        }
    });
}

void readMaterialX(Bytes bytes) {
    refusing([&] {
        if (!findFault(scene::importMaterialX(bytes, files / "fuzzed.mtlx").material).empty()) {
            std::abort();
        }
    });
}

/// The first byte chooses the ending of the file's name.
void readWithAssimp(Bytes bytes) {
    constexpr std::array endings{".obj", ".ply", ".stl", ".off", ".dae", ".fbx", ".3ds",
                                 ".3mf", ".x",   ".lwo", ".dxf", ".ac",  ".gltf"};
    if (bytes.empty()) {
        return;
    }
    static const tests::TemporaryFolder folder;
    const fs::path file = folder.path / (std::string("fuzzed") + endings[bytes[0] % endings.size()]);
    writeFileAtomically(file, bytes.subspan(1));
    refusing([&] { readModel(scene::loadWithAssimp(file)); });
    fs::remove(file);
}

void requirePixels(const Image& image) {
    if (image.pixelCount() == 0 || image.pixelCount() * image.channels.size() != image.values.size()) {
        std::abort();
    }
}

/// As `nacre compare`, environments and textures read pictures; without those that go to readBitmap's decoder, which
/// would be a process each.
void readPicture(Bytes bytes) {
    if (!isExr(bytes) && !isHdr(bytes) && !isPng(bytes) && !isJpeg(bytes) && !isWebp(bytes)) {
        return;
    }
    refusing([&] { requirePixels(decodeImage(bytes, "fuzzed")); });
    refusing([&] { requirePixels(decodeRadiance(bytes, "fuzzed")); });
    refusing([&] { decodeBytes(bytes, "fuzzed"); });
}

/// The decoder that pictures of these kinds get in a process of its own, in this one.
void readBitmap(Bytes bytes) {
    refusing([&] {
        const IntegerImage image = decodeBitmapHere(bytes, "fuzzed");
        if (image.bytes.size() != image.channels * image.width * image.height) {
            std::abort();
        }
    });
}

constexpr std::array all{
    Entry{"gltf", readGltf},           Entry{"scene_file", readSceneFile}, Entry{"material_file", readMaterialFile},
    Entry{"materialx", readMaterialX}, Entry{"assimp", readWithAssimp},    Entry{"picture", readPicture},
    Entry{"bitmap", readBitmap}};

} // namespace

std::span<const Entry> entries() {
    return all;
}

} // namespace nacre::fuzz
