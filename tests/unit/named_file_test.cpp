// Files that a file names lie beside it or below, whatever the spelling.
#include "scene/import.hpp"
#include "scene/named_file.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

using namespace nacre::scene;
namespace fs = std::filesystem;

namespace {

class NamedFile : public testing::Test {
protected:
    NamedFile() {
        fs::create_directories(folder / "scene/textures");
        write("secret.bin", "secret");
        write("scene/near.bin", "near");
        write("scene/textures/below.bin", "below");
    }

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

    /// What is wrong with a reference of scene/owner.gltf, after the reference itself; "" when it is found.
    std::string faultOf(const std::string& reference) const {
        try {
            findNamedFile(folder / "scene/owner.gltf", reference, "owner.gltf: uri");
        } catch (const SceneError& error) {
            const std::string sentence = error.what();
            EXPECT_TRUE(sentence.starts_with("owner.gltf: uri \"")) << sentence;
            const std::size_t end = reference.size() > 100 ? sentence.find("...") + 2 : sentence.rfind('"');
            return sentence.substr(end + 1);
        }
        return "";
    }

    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

TEST_F(NamedFile, IsFoundBesideOrBelow) {
    for (const char* reference : {"near.bin", "./near.bin", "textures/below.bin", "textures\\below.bin",
                                  "textures/../near.bin", ".//textures//below.bin"}) {
        EXPECT_EQ(faultOf(reference), "") << reference;
    }
    fs::create_symlink("textures/below.bin", folder / "scene/link.bin");
    EXPECT_EQ(faultOf("link.bin"), "");
}

TEST_F(NamedFile, IsRefusedElsewhere) {
    const std::string outside = " lies outside the folder of the file that names it";
    for (const char* reference : {"../secret.bin", "..\\secret.bin", "textures/../../secret.bin",
                                  "textures\\..\\..\\secret.bin", "./../secret.bin"}) {
        EXPECT_EQ(faultOf(reference), outside) << reference;
    }
    fs::create_symlink("../secret.bin", folder / "scene/out.bin");
    fs::create_directory_symlink("..", folder / "scene/up");
    EXPECT_EQ(faultOf("out.bin"), outside);
    EXPECT_EQ(faultOf("up/secret.bin"), outside);
    fs::create_directory(folder / "scene-of-another");
    write("scene-of-another/near.bin", "");
    EXPECT_EQ(faultOf("../scene-of-another/near.bin"), outside);
    const std::string absolute = " is not a path relative to the file that names it";
    EXPECT_EQ(faultOf("/etc/passwd"), absolute);
    EXPECT_EQ(faultOf("\\etc\\passwd"), absolute);
    EXPECT_EQ(faultOf((folder / "scene/near.bin").string()), absolute);
}

TEST_F(NamedFile, IsRefusedInOneSentenceWhenItCannotBeRead) {
    EXPECT_EQ(faultOf("none.bin"), " does not exist");
    EXPECT_EQ(faultOf("near.bin/none"), " does not exist");
    EXPECT_EQ(faultOf("textures"), " is not a regular file");
    EXPECT_EQ(faultOf("."), " lies outside the folder of the file that names it");
    EXPECT_EQ(faultOf(""), " is empty");
    EXPECT_EQ(faultOf(std::string("near.bin\0.png", 13)), " has a character that file names cannot have");
    EXPECT_EQ(faultOf(std::string(5000, 'x')), " cannot be read: File name too long");
    fs::create_symlink("circle.bin", folder / "scene/circle.bin");
    EXPECT_EQ(faultOf("circle.bin"), " cannot be read: Too many levels of symbolic links");
    ASSERT_EQ(::mkfifo((folder / "scene/pipe").c_str(), 0600), 0);
    EXPECT_EQ(faultOf("pipe"), " is not a regular file");
    EXPECT_TRUE(tryNamedFile(folder / "scene/owner.gltf", "pipe").empty());
}

TEST_F(NamedFile, IsReadOnce) {
    NamedFiles files(folder / "scene/owner.gltf");
    const auto bytes = files.read("near.bin", "uri");
    EXPECT_EQ(files.read("textures/../near.bin", "uri").data(), bytes.data());
    EXPECT_EQ(files.totalBytes(), 4u);
    EXPECT_EQ(files.paths(), std::vector<std::string>{fs::canonical(folder / "scene/near.bin").string()});
}

// A model that names the current folder's files by their bare names, as the command line does.
TEST_F(NamedFile, OfAModelInTheCurrentFolder) {
    EXPECT_FALSE(tryNamedFile("owner.gltf", "none.bin").has_filename());
}

/// An OBJ whose material library and texture lie where the model puts them.
TEST_F(NamedFile, OfAssimpIsHeldToTheSameRule) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    const std::string mtl = "newmtl red\nKd 1 0 0\n";
    write("outside.mtl", mtl);
    write("scene/inside.mtl", mtl);
    write("scene/a.obj", "mtllib ../outside.mtl\n" + obj);
    write("scene/b.obj", "mtllib inside.mtl\n" + obj);
    const Scene kept = loadModel(folder / "scene/b.obj");
    EXPECT_EQ(kept.surfaces.at(0).baseColor, glm::vec4(1, 0, 0, 1));
    ASSERT_EQ(kept.inputs.size(), 1u);
    EXPECT_TRUE(fs::equivalent(kept.inputs[0], folder / "scene/inside.mtl"));
    const Scene refused = loadModel(folder / "scene/a.obj");
    EXPECT_NE(refused.surfaces.at(0).baseColor, glm::vec4(1, 0, 0, 1));
    EXPECT_TRUE(refused.inputs.empty());
}

} // namespace
