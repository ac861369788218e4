// Real models: each loads with the triangles it has, or is refused with the sentence expected.
#include "scene/import.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

using namespace nacre::scene;
namespace fs = std::filesystem;

namespace {

const fs::path assimpModels = "/usr/share/assimp/models";

/// What belongs to models without being one: textures, buffers, shaders, documents, sources of other programs.
const std::set<std::string> notModels{".png",  ".jpg",  ".jpeg", ".tga", ".bmp", ".txt",    ".md",  ".license",
                                      ".pcx",  ".dds",  ".gif",  ".tif", ".rtf", ".mtl",    ".bin", ".vert",
                                      ".frag", ".html", ".max",  ".c4d", ".zip", ".source", ".glsl"};

std::map<std::string, std::string> expectations() {
    std::map<std::string, std::string> result;
    std::ifstream table(NACRE_SOURCE_DIR "/tests/data/assimp_models.tsv");
    for (std::string line; std::getline(table, line);) {
        const std::size_t tab = line.find('\t');
        if (!line.starts_with('#') && tab != std::string::npos) {
            result[line.substr(0, tab)] = line.substr(tab + 1);
        }
    }
    return result;
}

std::string lowerExtension(const fs::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension;
}

void expectSoundScene(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(mesh.surface, scene.surfaces.size());
        ASSERT_EQ(mesh.indices.size() % 3, 0u);
        for (const std::uint32_t index : mesh.indices) {
            ASSERT_LT(index, mesh.vertices.size());
        }
        for (const Vertex& vertex : mesh.vertices) {
            ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-3);
            ASSERT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1, 1e-3);
        }
    }
    for (const Instance& instance : scene.instances) {
        ASSERT_LT(instance.mesh, scene.meshes.size());
    }
    for (const Texture& texture : scene.textures) {
        ASSERT_EQ(texture.pixels.size(), std::size_t{texture.width} * texture.height * 4);
    }
    const auto isTexture = [&](std::uint32_t index) { return index == none || index < scene.textures.size(); };
    for (const Surface& surface : scene.surfaces) {
        ASSERT_TRUE(isTexture(surface.baseColorTexture) && isTexture(surface.normalTexture) &&
                    isTexture(surface.metallicRoughnessTexture) && isTexture(surface.thicknessTexture));
        ASSERT_TRUE(surface.material == none || surface.material < scene.materials.size());
    }
}

/// "TRIANGLES", or "! " and the sentence without the file's name.
std::string outcome(const fs::path& file) {
    try {
        const Scene scene = loadModel(file);
        expectSoundScene(scene);
        return std::to_string(triangleCount(scene));
    } catch (const SceneError& error) {
        std::string sentence = error.what();
        const std::string prefix = file.string() + ": ";
        EXPECT_TRUE(sentence.starts_with(prefix)) << sentence;
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
        for (std::size_t at = sentence.find(prefix); at != std::string::npos; at = sentence.find(prefix)) {
            sentence.erase(at, prefix.size());
        }
        return "! " + sentence;
    }
}

TEST(Models, OfAssimpLoadOrAreRefusedAsTheTableSays) {
    std::map<std::string, std::string> expected = expectations();
    ASSERT_FALSE(expected.empty());
#ifdef NACRE_SANITIZED
    expected["invalid/OutOfMemory.off"] = "! is damaged: reading it fails"; // the sanitizer ends the child first
#endif
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(assimpModels)) {
        if (!entry.is_regular_file() || notModels.contains(lowerExtension(entry.path()))) {
            continue;
        }
        const std::string name = fs::relative(entry.path(), assimpModels).string();
        const auto row = expected.find(name);
        if (row == expected.end()) {
            ADD_FAILURE() << name << " is not in the table";
            continue;
        }
        const std::string actual = outcome(entry.path());
        if (row->second != "?") {
            EXPECT_EQ(actual, row->second) << name;
        }
        expected.erase(row);
    }
    for (const auto& [name, sentence] : expected) {
        ADD_FAILURE() << name << " is in the table, but not in " << assimpModels;
    }
}

TEST(Models, OfGlmark2Load) {
    const fs::path folder = "/usr/share/glmark2/models";
    EXPECT_EQ(outcome(folder / "bunny.obj"), "69666");
    EXPECT_EQ(outcome(folder / "horse.3ds"), "7172");
    EXPECT_EQ(outcome(folder / "cat.3ds"), "14348");
    EXPECT_EQ(outcome(folder / "asteroid-high.3ds"), "48000");
    EXPECT_EQ(outcome(folder / "cube.3ds"), "! material \"Materialcrat\": texture \"crate-base.b\" does not exist");
}

TEST(Models, SharedOnesLoadWherePresent) {
    const std::map<std::string, std::string> expected{{"bunny/bun_zipper.ply", "69451"},
                                                      {"dragon/dragon_uv.glb", "101239"},
                                                      {"dragon/dragon_vrip_res2.ply", "202520"},
                                                      {"head/infinite_head.gltf", "70736"},
                                                      {"logo/sss_logo.glb", "44628"},
                                                      {"lucy/Lucy100k.ply", "100000"},
                                                      {"sorrel-plant/sorrel_plant.gltf", "3818"}};
    const fs::path folder = NACRE_SOURCE_DIR "/../shared/models";
    std::string missing;
    for (const auto& [name, triangles] : expected) {
        if (fs::exists(folder / name)) {
            EXPECT_EQ(outcome(folder / name), triangles) << name;
        } else {
            missing += ' ' + name;
        }
    }
    if (!missing.empty()) {
        GTEST_SKIP() << folder << " has not" << missing;
    }
}

} // namespace
