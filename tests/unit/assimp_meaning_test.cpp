// What OBJ, MTL, PLY and STL of strangers mean: colours, names, spellings, and notes about what is left out.
#include "image/image.hpp"
#include "image/image_file.hpp"
#include "scene/import.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

using namespace nacre;
using namespace nacre::scene;
namespace fs = std::filesystem;

namespace {

const std::string corners = "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\n";
const std::string places = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const std::string face = "f 1/1 2/2 3/3 4/4\n";

class AssimpMeaning : public testing::Test {
protected:
    void SetUp() override {
        Image red = makeImage(2, 2, {"R", "G", "B"}, Encoding::Srgb);
        for (std::size_t i = 0; i < red.values.size(); i += 3) {
            red.values[i] = 1;
        }
        writePng(folder / "red.png", red);
    }
    Scene loaded(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return load(folder / name);
    }
    /// A square with that material.
    Scene square(const std::string& material, const std::string& before = "") const {
        std::ofstream(folder / "m.mtl", std::ios::binary) << material;
        return loaded("m.obj", before + "mtllib m.mtl\n" + corners + places + "usemtl a\n" + face);
    }
    /// The notes without the folder's name.
    std::vector<std::string> notesOf(const Scene& scene) const {
        std::vector<std::string> notes = scene.notes;
        for (std::string& note : notes) {
            for (std::size_t at = note.find(folder.string()); at != note.npos; at = note.find(folder.string())) {
                note.erase(at, folder.string().size() + 1);
            }
        }
        return notes;
    }
    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

using Notes = std::vector<std::string>;

TEST_F(AssimpMeaning, VertexColorsWithoutAMaterialAreSeenAsTheyAre) {
    const std::string colored = "v -0.5 -0.5 0 1 0 0\nv 0.5 -0.5 0 1 0 0\nv 0.5 0.5 0 1 0 0\n";
    const Scene scene = loaded("c.obj", colored + "f 1 2 3\n");
    EXPECT_EQ(scene.surfaces.at(scene.meshes.at(0).surface).baseColor, glm::vec4(1));
    EXPECT_EQ(scene.meshes[0].vertices.at(0).color, (glm::vec<4, std::uint16_t>(65535, 0, 0, 65535)));
    const Scene plain = loaded("p.obj", corners + "f 1 2 3\n");
    EXPECT_LT(plain.surfaces.at(plain.meshes.at(0).surface).baseColor.x, 0.9f);
    std::ofstream(folder / "k.mtl") << "newmtl a\nKd 0.5 0.5 0.5\n";
    const Scene material = loaded("k.obj", "mtllib k.mtl\n" + colored + "usemtl a\nf 1 2 3\n");
    EXPECT_FLOAT_EQ(material.surfaces.at(material.meshes.at(0).surface).baseColor.x, 0.5f);
}

TEST_F(AssimpMeaning, EmissionHasATexture) {
    const Scene scene = square("newmtl a\nKd 0 0 0\nKe 0 2 0\nmap_Ke red.png\n");
    const Surface& surface = scene.surfaces.at(scene.meshes.at(0).surface);
    ASSERT_NE(surface.emissionTexture, none);
    EXPECT_EQ(scene.textures.at(surface.emissionTexture).pixels[0], 255);
    EXPECT_EQ(surface.emission, glm::vec3(0, 2, 0));
    const Scene black = square("newmtl a\nKd 0 0 0\nmap_Ke red.png\n");
    EXPECT_EQ(black.surfaces.at(black.meshes.at(0).surface).emission, glm::vec3(1));
    const Scene gone = square("newmtl a\nKd 0 0 0\nKe 1 1 1\nmap_Ke gone.png\n");
    EXPECT_EQ(gone.surfaces.at(gone.meshes.at(0).surface).emission, glm::vec3(0));
    EXPECT_EQ(notesOf(gone), Notes{"m.obj: material \"a\": texture \"gone.png\" does not exist; it is left out"});
}

TEST_F(AssimpMeaning, TexturesThatAreNotReadAreNoted) {
    EXPECT_EQ(notesOf(square("newmtl a\nKd 1 0 0\nmap_Bump red.png\nmap_Ns red.png\n")),
              Notes{"m.obj: its materials have textures that are not read: height, shininess"});
    EXPECT_EQ(notesOf(square("newmtl a\nmap_Kd -s 2 2 1 red.png\n")),
              Notes{"m.obj: its materials scale or move textures (-s, -o), which is not read"});
    EXPECT_EQ(notesOf(square("newmtl a\nmap_Kd red.png\n")), Notes{});
}

TEST_F(AssimpMeaning, MissingLibrariesAreNoted) {
    EXPECT_EQ(notesOf(loaded("l.obj", "mtllib gone.mtl\n" + corners + "usemtl a\nf 1 2 3\n")),
              Notes{"l.obj: names \"gone.mtl\", which is not there; its materials are left out"});
}

TEST_F(AssimpMeaning, MaterialsThatNoLibraryHasAreNoted) {
    std::ofstream(folder / "some.mtl") << "newmtl b\nKd 1 0 0\n\tnewmtl  dark skin \n";
    const std::string triangle = "f 1 2 3\n";
    EXPECT_EQ(notesOf(loaded("u.obj", "mtllib some.mtl\n" + corners + "usemtl dark skin\n" + triangle)), Notes{});
    EXPECT_EQ(notesOf(loaded("u.obj", "mtllib some.mtl\n" + corners + "usemtl a\n" + triangle)),
              Notes{"u.obj: uses the material \"a\", which no library has; its faces are grey"});
    EXPECT_EQ(
        notesOf(loaded("u.obj", "mtllib some.mtl\n" + corners + "usemtl a\n" + triangle + "usemtl c\n" + triangle)),
        Notes{"u.obj: uses the material \"a\" and 1 more, which no library has; its faces are grey"});
}

TEST_F(AssimpMeaning, ALineMayNameSeveralLibraries) {
    std::ofstream(folder / "red.mtl") << "newmtl r\nKd 1 0 0\n";
    std::ofstream(folder / "blue.mtl") << "newmtl b\nKd 0 0 1\n";
    const Scene scene = loaded("two.obj", "mtllib red.mtl  blue.mtl\n" + corners + "usemtl b\nf 1 2 3\n");
    EXPECT_EQ(scene.surfaces.at(scene.meshes.at(0).surface).baseColor, glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(notesOf(scene), Notes{});
    std::ofstream(folder / "my red.mtl") << "newmtl r\nKd 1 0 0\n";
    const Scene spaced = loaded("one.obj", "mtllib my red.mtl\n" + corners + "usemtl r\nf 1 2 3\n");
    EXPECT_EQ(spaced.surfaces.at(spaced.meshes.at(0).surface).baseColor, glm::vec4(1, 0, 0, 1));
}

TEST_F(AssimpMeaning, AHundredThousandObjectsAreReadAsOne) {
    constexpr int many = 100'000;
    std::string text;
    for (int i = 0; i < many; ++i) {
        const std::string x = std::to_string(i);
        text += "o part" + x + "\nv " + x + " 0 0\nv " + x + " 1 0\nv " + x + " 0 1\nf -3 -2 -1\n";
    }
    const double start = tests::processorSeconds();
    const Scene scene = loaded("many.obj", text);
    EXPECT_LT(tests::processorSeconds() - start, 10);
    EXPECT_EQ(triangleCount(scene), many);
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(notesOf(scene).back(), "many.obj: has more than 20000 objects and groups, which are read as one");
}

TEST_F(AssimpMeaning, ATextureInAFormatThatIsNotReadIsLeftOut) {
    std::ofstream(folder / "skin.dds") << "DDS and more";
    const Scene scene = square("newmtl a\nKd 0 0 0\nmap_Kd skin.dds\n");
    const Surface& surface = scene.surfaces.at(scene.meshes.at(0).surface);
    EXPECT_EQ(surface.baseColorTexture, none);
    EXPECT_EQ(surface.baseColor, glm::vec4(1)) << "the black beside a texture is no colour";
    EXPECT_EQ(notesOf(scene), Notes{"skin.dds: is a DDS image, which is not read here; it is left out"});
}

TEST_F(AssimpMeaning, AByteOrderMarkHidesNothing) {
    const std::string mark = "\xef\xbb\xbf";
    const Scene scene = square(mark + "newmtl a\nKd 1 0 0\n", mark);
    EXPECT_EQ(scene.surfaces.at(scene.meshes.at(0).surface).baseColor, glm::vec4(1, 0, 0, 1));
}

TEST_F(AssimpMeaning, PlyMayCallItsColorsDiffuse) {
    std::string text = "ply\nformat ascii 1.0\ncomment diffuse_red is red\nelement vertex 3\n";
    for (const char* name :
         {"float x", "float y", "float z", "uchar diffuse_red", "uchar diffuse_green", "uchar diffuse_blue"}) {
        text += std::string("property ") + name + '\n';
    }
    text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const Scene scene = loaded("d.ply", text + "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n");
    EXPECT_EQ(scene.meshes.at(0).vertices.at(0).color, (glm::vec<4, std::uint16_t>(65535, 0, 0, 65535)));
}

TEST_F(AssimpMeaning, StlMayBeInCapitals) {
    std::string text =
        "SOLID PART\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1E0 0 0\nVERTEX 0 1 0\nENDLOOP\n"
        "ENDFACET\nENDSOLID PART\n";
    EXPECT_EQ(triangleCount(loaded("s.stl", text)), 1u);
}

} // namespace
