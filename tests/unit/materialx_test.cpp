// Materials of MaterialX documents, and OpenPBR's names in material files.
#include "scene/materialx/materialx_file.hpp"

#include "image/color.hpp"
#include "nacre/media.hpp"

#include <gtest/gtest.h>

#include <chrono>

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
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(import(document(deep + openPbr(input("subsurface_weight", "1")))).material.strength, 1);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

} // namespace
