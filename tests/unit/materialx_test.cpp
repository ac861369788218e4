// Materials of MaterialX documents, and OpenPBR's names in material files.
#include "scene/materialx/materialx_file.hpp"

#include "image/color.hpp"
#include "nacre/media.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

using namespace nacre;
using scene::importMaterialX;
using scene::MaterialXImport;

namespace {

std::string input(const std::string& name, const std::string& value, const std::string& more = "") {
    return "<input name=\"" + name + "\" value=\"" + value + "\" " + more + "/>";
}

std::string document(const std::string& nodes) {
    return "<?xml version=\"1.0\"?><materialx version=\"1.39\">" + nodes + "</materialx>";
}

std::string openPbr(const std::string& inputs, const std::string& name = "surface") {
    return "<open_pbr_surface name=\"" + name + "\" type=\"surfaceshader\">" + inputs + "</open_pbr_surface>";
}

std::string standardSurface(const std::string& inputs) {
    return "<standard_surface name=\"surface\" type=\"surfaceshader\">" + inputs + "</standard_surface>";
}

MaterialXImport import(const std::string& text, const std::string& name = "", std::optional<double> unit = {}) {
    return importMaterialX({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "test.mtlx", name, unit);
}

std::string errorOf(const std::string& text, const std::string& name = "") {
    try {
        import(text, name);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

void expectNear(const Rgb& a, const Rgb& b, double tolerance = 1e-6) {
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(a[i], b[i], tolerance * std::max(1.0, std::abs(b[i]))) << i;
    }
}

TEST(MaterialX, BringsOpenPbr) {
    const MaterialXImport read = import(document(openPbr(
        input("subsurface_weight", "0.75") + input("subsurface_color", "0.9, 0.6, 0.3") +
        input("subsurface_radius", "0.2", "unit=\"centimeter\"") + input("subsurface_radius_scale", "1, 0.5,0.2") +
        input("base_color", "0.1, 0.2, 0.3") + input("subsurface_scatter_anisotropy", "0.5") +
        input("specular_weight", "0.5") + input("specular_ior", "1.4") + input("specular_roughness", " 0.35 "))));
    const Material& material = read.material;
    EXPECT_EQ(read.notes, std::vector<std::string>{});
    EXPECT_EQ(material.name, "surface");
    EXPECT_EQ(material.strength, 0.75);
    EXPECT_EQ(material.roughness, 0.35);
    EXPECT_NEAR(material.specular, 0.5 * (0.4 / 2.4) * (0.4 / 2.4) / 0.08, 1e-12);
    expectNear(material.albedo, {0.7, 0.5, 0.3});
    expectNear(material.meanFreePath.value(), burleyMeanFreePath({0.9, 0.6, 0.3}, {2, 1, 0.4}, 0.5));
    EXPECT_EQ(material.diffuseTransmission, 0);
    EXPECT_EQ(findFault(material), "");
}

// What a document says and what a material file says with the same names is the same.
TEST(MaterialX, IsWhatAMaterialFileSays) {
    const Material imported =
        import(document(openPbr(input("subsurface_weight", "1") + input("subsurface_radius", "3"))), "", 0.001)
            .material;
    Material read = parseMaterial(R"({"name": "surface", "subsurface_weight": 1, "subsurface_radius": 3})", "file");
    read.description = imported.description;
    EXPECT_EQ(read, imported);
    EXPECT_EQ(parseMaterial(formatMaterial(read), "written"), read);
    const Material own =
        parseMaterial(R"({"subsurface_weight": 1, "albedo": [0.1, 0.2, 0.3], "strength": 0.4})", "file");
    EXPECT_EQ(own.albedo, (Rgb{0.1, 0.2, 0.3})); // by a name of its own
    EXPECT_EQ(own.strength, 0.4);
}

TEST(MaterialX, BringsStandardSurface) {
    const MaterialXImport read = import(document(standardSurface(
        input("subsurface", "1") + input("subsurface_color", "0.8,0.5,0.4") + input("subsurface_scale", "0.1") +
        input("subsurface_radius", "1,0.35,0.2") + input("subsurface_anisotropy", "-0.2"))));
    expectNear(read.material.meanFreePath.value(), burleyMeanFreePath({0.8, 0.5, 0.4}, {1, 0.35, 0.2}, -0.2));
    EXPECT_EQ(read.material.roughness, 0.2); // its default
    EXPECT_EQ(read.notes,
              std::vector<std::string>{
                  "test.mtlx: standard_surface \"surface\": subsurface_radius has no unit; taken for centimetres"});
}

TEST(MaterialX, BringsThinWalls) {
    const Material sheet =
        import(document(openPbr(input("subsurface_weight", "1") + input("geometry_thin_walled", "true") +
                                input("subsurface_scatter_anisotropy", "0.5"))))
            .material;
    EXPECT_EQ(sheet.diffuseTransmission, 0.75);
    const Material standard =
        import(document(standardSurface(input("subsurface", "0.5") + input("thin_walled", "true")))).material;
    EXPECT_EQ(standard.diffuseTransmission, 0.25);
}

TEST(MaterialX, FollowsConstantsAndNamesTheRest) {
    const std::string color = "0.5, 0.5, 0.5";
    const MaterialXImport read =
        import(document("<constant name=\"weight\" type=\"float\">" + input("value", "0.6") + "</constant>" +
                        openPbr("<input name=\"subsurface_weight\" nodename=\"weight\" />"
                                "<input name=\"subsurface_color\" nodegraph=\"graph\" output=\"out\" />" +
                                input("base_color", color, "colorspace=\"srgb_texture\"") +
                                input("subsurface_radius", "1", "unit=\"inch\"") + input("coat_weight", "1"))));
    EXPECT_EQ(read.material.strength, 0.6);
    const double base = decodeSrgb(0.5f);
    const double mixed = 0.4 * base + 0.6 * 0.8;
    expectNear(read.material.albedo, {mixed, mixed, mixed});
    expectNear(read.material.meanFreePath.value(), burleyMeanFreePath({0.8, 0.8, 0.8}, {25.4, 12.7, 6.35}));
    EXPECT_EQ(read.notes, std::vector<std::string>{"test.mtlx: open_pbr_surface \"surface\": subsurface_color is "
                                                   "computed by nodes, which are not read; it has its default"});
}

TEST(MaterialX, FollowsConstantsThroughGraphs) {
    const std::string graph =
        "<nodegraph name=\"g\" colorspace=\"srgb_texture\"><input name=\"k\" value=\"0.5,0.5,0.5\"/>"
        "<dot name=\"d\"><input name=\"in\" interfacename=\"k\"/></dot>"
        "<constant name=\"c\"><input name=\"value\" nodename=\"d\"/></constant>"
        "<constant name=\"r\"><input name=\"value\" value=\"+2\" unit=\"millimeter\"/></constant>"
        "<output name=\"color\" nodename=\"c\"/><output name=\"radius\" nodename=\"r\"/></nodegraph>";
    // A constant of the same name outside of the graph is another.
    const std::string other = "<constant name=\"c\"><input name=\"value\" value=\"0.1,0.1,0.1\"/></constant>";
    const MaterialXImport read =
        import(document(other + graph +
                        openPbr(input("subsurface_weight", "1") +
                                "<input name=\"subsurface_color\" nodegraph=\"g\" output=\"color\"/>"
                                "<input name=\"subsurface_radius\" nodegraph=\"g\" output=\"radius\"/>")));
    const double gray = decodeSrgb(0.5f);
    EXPECT_EQ(read.notes, std::vector<std::string>{});
    expectNear(read.material.albedo, {gray, gray, gray});
    expectNear(read.material.meanFreePath.value(), burleyMeanFreePath({gray, gray, gray}, {2, 1, 0.5}));
    const std::string circle = "<dot name=\"a\"><input name=\"in\" nodename=\"b\"/></dot>"
                               "<dot name=\"b\"><input name=\"in\" nodename=\"a\"/></dot>";
    EXPECT_EQ(import(document(circle + openPbr(input("subsurface_weight", "1") +
                                               "<input name=\"subsurface_color\" nodename=\"a\"/>" +
                                               input("subsurface_radius", "1", "unit=\"inch\""))))
                  .notes.size(),
              1u);
}

TEST(MaterialX, BringsColorsOfEverySpace) {
    const auto colorIn = [](const std::string& space, const std::string& color) {
        return import("<materialx version=\"1.39\" colorspace=\"" + space + "\">" +
                      openPbr(input("subsurface_weight", "1") + input("subsurface_color", color)) + "</materialx>")
            .material.albedo;
    };
    expectNear(colorIn("g22_rec709", "0.5,0.5,0.5"), {0.217638, 0.217638, 0.217638}, 1e-5);
    expectNear(colorIn("g18_rec709", "0.5,0,0"), {0.287175, 0, 0}, 1e-5);
    for (const char* space : {"acescg", "lin_ap1", "lin_adobergb", "lin_displayp3"}) {
        expectNear(colorIn(space, "0.5,0.5,0.5"), {0.5, 0.5, 0.5}, 1e-5); // white stays white
    }
    // Rec.709's green in Display P3, and P3's own, which is beyond it.
    expectNear(colorIn("lin_displayp3", "0.177538,0.966806,0.072397"), {0, 1, 0}, 2e-5);
    expectNear(colorIn("lin_displayp3", "0,1,0"), {0, 1, 0});
    EXPECT_NE(import("<materialx colorspace=\"odd\">" +
                     openPbr(input("subsurface_weight", "1") + input("subsurface_color", "0.5,0.5,0.5")) +
                     "</materialx>")
                  .notes.at(0)
                  .find("\"odd\""),
              std::string::npos);
}

TEST(MaterialX, ReadsWhatItIncludes) {
    const nacre::tests::TemporaryFolder temporary;
    const auto write = [&](const std::string& name, const std::string& text) {
        std::ofstream(temporary.path / name) << text;
        return temporary.path / name;
    };
    const auto including = [](const std::string& name) { return "<xi:include href=\"" + name + "\"/>"; };
    std::filesystem::create_directory(temporary.path / "sub");
    write("sub/skin.mtlx", "<materialx colorspace=\"srgb_texture\">" + including("more.mtlx") +
                               openPbr(input("subsurface_weight", "1") + input("subsurface_color", "0.5,0.5,0.5") +
                                       "<input name=\"subsurface_radius\" nodename=\"r\"/>") +
                               "</materialx>");
    write("sub/more.mtlx", document(including("../a.mtlx") + "<constant name=\"r\">" +
                                    input("value", "1", "unit=\"inch\"") + "</constant>"));
    const MaterialXImport read =
        importMaterialX(write("a.mtlx", document(including("sub/skin.mtlx") + including("../none.mtlx"))));
    const double gray = decodeSrgb(0.5f);
    expectNear(read.material.albedo, {gray, gray, gray});
    expectNear(read.material.meanFreePath.value(), burleyMeanFreePath({gray, gray, gray}, {25.4, 12.7, 6.35}));
    EXPECT_EQ(read.inputs.size(), 2u);
    ASSERT_EQ(read.notes.size(), 2u); // a.mtlx is not below sub
    EXPECT_NE(read.notes[0].find("more.mtlx: includes \"../a.mtlx\", which lies outside"), std::string::npos);
    EXPECT_NE(read.notes[1].find("a.mtlx: includes \"../none.mtlx\", which does not exist; it is left out"),
              std::string::npos);
    EXPECT_THROW(importMaterialX(write("b.mtlx", document(including("c.txt")))), FileError);
    write("c.txt", "not XML");
    EXPECT_THROW(importMaterialX(write("b.mtlx", document(including("c.txt")))), FileError);
}

TEST(MaterialX, IsChosenByName) {
    const std::string two = document(openPbr(input("subsurface_weight", "0.1"), "a") + "<nodegraph name=\"g\">" +
                                     openPbr(input("subsurface_weight", "0.2"), "b") +
                                     "</nodegraph><surfacematerial name=\"m\"><input name=\"surfaceshader\" "
                                     "nodename=\"b\"/></surfacematerial>");
    EXPECT_EQ(import(two, "a").material.strength, 0.1);
    EXPECT_EQ(import(two, "b").material.strength, 0.2);
    EXPECT_EQ(import(two, "m").material.strength, 0.2);
    EXPECT_EQ(import(two, "m").material.name, "m");
    EXPECT_EQ(errorOf(two), "test.mtlx: has several shader nodes, one must be chosen by its name: \"a\", \"b\"");
    EXPECT_EQ(errorOf(two, "c"), "test.mtlx: has no shader node or material \"c\", only \"a\", \"b\"");
}

TEST(MaterialX, IsRefusedInASentence) {
    const std::string node = "test.mtlx: open_pbr_surface \"surface\": ";
    const auto with = [](const std::string& name, const std::string& value, const std::string& more = "") {
        return errorOf(document(openPbr(input("subsurface_weight", "1") + input(name, value, more))));
    };
    EXPECT_EQ(with("subsurface_radius", "-1"), node + "subsurface_radius is \"-1\", must be a number, 0 to 1e+06");
    EXPECT_EQ(with("subsurface_radius", "nan"), node + "subsurface_radius is \"nan\", must be a number, 0 to 1e+06");
    EXPECT_EQ(with("subsurface_radius", "1", "unit=\"cubit\""),
              node + "subsurface_radius is \"cubit\", must be a unit of length of MaterialX");
    EXPECT_EQ(with("subsurface_color", "1, 2"), node + "subsurface_color is \"1, 2\", must be three numbers, 0 to 1");
    EXPECT_EQ(with("subsurface_color", "0 0 0 0"),
              node + "subsurface_color is \"0 0 0 0\", must be three numbers, 0 to 1");
    EXPECT_EQ(with("geometry_thin_walled", "1"), node + "geometry_thin_walled is \"1\", must be true or false");
    EXPECT_EQ(with("specular_ior", "0.5"), node + "specular_ior is \"0.5\", must be a number, 1 to 3");
    EXPECT_EQ(errorOf(document(openPbr(""))),
              node + "has a subsurface weight of 0: no light travels under the surface");
    EXPECT_EQ(errorOf(document("")), "test.mtlx: has neither an open_pbr_surface nor a standard_surface");
    EXPECT_EQ(errorOf("<svg/>"), "test.mtlx: is not a MaterialX document: it has no element materialx");
    EXPECT_TRUE(errorOf("<materialx><a></materialx>").starts_with("test.mtlx: is not valid XML: "));
    EXPECT_TRUE(errorOf("").starts_with("test.mtlx: is not valid XML: "));
}

// A document's own entities are neither expanded nor fetched, and no depth of nesting takes the stack.
TEST(MaterialX, MayNotUnfold) {
    std::string bomb = "<!DOCTYPE materialx [<!ENTITY a0 \"aaaaaaaaaa\"><!ENTITY x SYSTEM \"file:///etc/passwd\">";
    for (int i = 1; i < 12; ++i) {
        const std::string before = "&a" + std::to_string(i - 1) + ";";
        std::string ten;
        for (int k = 0; k < 10; ++k) {
            ten += before;
        }
        bomb += "<!ENTITY a" + std::to_string(i) + " \"" + ten + "\">";
    }
    bomb += "]>" + document(openPbr(input("subsurface_weight", "1"), "&a11;&x;")).substr(21);
    EXPECT_EQ(import(bomb).material.name, "&a11;&x;");

    std::string deep;
    constexpr int depth = 400'000;
    for (int i = 0; i < depth; ++i) {
        deep += "<nodegraph>";
    }
    for (int i = 0; i < depth; ++i) {
        deep += "</nodegraph>";
    }
    const double start = tests::processorSeconds();
    EXPECT_EQ(import(document(deep + openPbr(input("subsurface_weight", "1")))).material.strength, 1);
    EXPECT_LT(tests::processorSeconds() - start, 5);
}

} // namespace
