// The schema and the reader agree on key names, ranges and defaults.
#include "nacre/files.hpp"
#include "nacre/presets.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

using namespace nacre;
using Json = nlohmann::json;

namespace {

// Kept for as long as the program runs, so that loops may run over parts of it.
const Json& schema() {
    static const Json parsed = Json::parse(std::ifstream(NACRE_SOURCE_DIR "/docs/schemas/material.schema.json"));
    return parsed;
}

Json minimal() {
    return {{"meanFreePath", {1, 1, 1}}};
}

Json minimalLayers() {
    return {{"layers", Json::array({{{"weight", {1, 1, 1}}, {"variance", 1}}})}};
}

Json minimalSlabs() {
    const Json slab{{"absorption", {0.1, 0.1, 0.1}}, {"reducedScattering", {1, 1, 1}}, {"thickness", 1}};
    return {{"slabs", Json::array({slab})}};
}

Json minimalOpenPbr() {
    return {{"subsurface_weight", 1}};
}

bool isOfOpenPbr(const std::string& key) {
    return key.find('_') != std::string::npos;
}

bool accepts(const Json& material) {
    try {
        parseMaterial(material.dump(), "test");
        return true;
    } catch (const FileError&) {
        return false;
    }
}

// A material with every member of OpenPBR at the schema's default.
Json openPbrDefaults() {
    Json all = minimalOpenPbr();
    for (const auto& [key, property] : schema().at("properties").items()) {
        if (isOfOpenPbr(key) && property.contains("default")) {
            all[key] = property.at("default");
        }
    }
    return all;
}

// Checks that the reader's range at `value`, a reference into `material`, is the schema's.
void expectRange(const Json& limits, const Json& material, const Json::json_pointer& value) {
    for (const double factor : {1.0, 1.01}) {
        Json high = material;
        high[value] = limits.at("maximum").get<double>() * factor;
        EXPECT_EQ(accepts(high), factor == 1) << high;
        Json low = material;
        const double minimum = limits.at("minimum");
        low[value] = factor == 1 ? minimum : minimum - 0.01 * std::max(minimum, 1e-6);
        EXPECT_EQ(accepts(low), factor == 1) << low;
    }
}

TEST(MaterialSchema, HasTheKeysOfTheReader) {
    for (const auto& [key, property] : schema().at("properties").items()) {
        Json material = key == "layers"    ? minimalLayers()
                        : key == "slabs"   ? minimalSlabs()
                        : isOfOpenPbr(key) ? minimalOpenPbr()
                                           : minimal();
        if (!material.contains(key)) {
            const std::string type = property.value("type", "");
            const Json value = type == "boolean" ? Json(true) : type == "array" ? Json({1, 1, 1}) : Json("text");
            material[key] = property.value("default", value);
        }
        EXPECT_TRUE(accepts(material)) << material;
    }
    Json unknown = minimal();
    unknown["unheardOf"] = 1;
    EXPECT_FALSE(accepts(unknown));
    EXPECT_FALSE(schema().at("additionalProperties").get<bool>());

    // A material with every member set writes no key that the schema lacks, and lacks only the alternative profile.
    Material material;
    material.layers = {{{1, 1, 1}, 1}};
    const Json written = Json::parse(formatMaterial(material));
    for (const auto& [key, value] : written.items()) {
        EXPECT_TRUE(schema().at("properties").contains(key)) << key;
    }
    EXPECT_EQ(written.size() + 15, schema().at("properties").size()); // the absent ones, OpenPBR's and $schema
}

TEST(MaterialSchema, HasTheRangesOfTheReader) {
    const Json properties = schema().at("properties");
    for (const char* key : {"strength", "translucency", "diffuseTransmission", "scale", "roughness", "specular",
                            "secondLobe", "secondLobeRoughness"}) {
        expectRange(properties.at(key), minimal(), Json::json_pointer(std::string("/") + key));
    }
    Json albedo = minimal();
    albedo["albedo"] = {0.5, 0.5, 0.5};
    expectRange(properties.at("albedo").at("items"), albedo, Json::json_pointer("/albedo/1"));
    expectRange(properties.at("meanFreePath").at("items"), minimal(), Json::json_pointer("/meanFreePath/2"));
    const Json layer = properties.at("layers").at("items").at("properties");
    expectRange(layer.at("variance"), minimalLayers(), Json::json_pointer("/layers/0/variance"));

    // A second layer keeps the channel's sum above 0.
    Json two = minimalLayers();
    two["layers"].push_back(two["layers"][0]);
    expectRange(layer.at("weight").at("items"), two, Json::json_pointer("/layers/0/weight/0"));
    EXPECT_EQ(properties.at("layers").at("maxItems"), maxLayers);
    EXPECT_EQ(properties.at("layers").at("minItems"), 1);
}

TEST(MaterialSchema, HasTheNamesOfOpenPbr) {
    const Json all = openPbrDefaults();
    for (const auto& [key, property] : schema().at("properties").items()) {
        if (!isOfOpenPbr(key) || property.at("type") == "boolean") {
            continue;
        }
        const bool isColor = property.at("type") == "array";
        expectRange(isColor ? property.at("items") : property, all,
                    Json::json_pointer("/" + key + (isColor ? "/1" : "")));
    }
    // The defaults are the schema's: a file that gives them all means what one with the weight alone does.
    EXPECT_EQ(parseMaterial(all.dump(), "test"), parseMaterial(minimalOpenPbr().dump(), "test"));
}

TEST(MaterialSchema, HasTheSlabsOfTheReader) {
    const Json slabs = schema().at("properties").at("slabs");
    EXPECT_EQ(slabs.at("maxItems"), maxLayers);
    const Json slab = slabs.at("items").at("properties");
    Json thin = minimalSlabs();
    thin["slabs"][0]["refractiveIndex"] = 1;
    thin["slabs"][0]["anisotropy"] = {0, 0, 0};
    for (const char* key : {"absorption", "reducedScattering", "anisotropy"}) {
        expectRange(slab.at(key).at("items"), thin, Json::json_pointer(std::string("/slabs/0/") + key + "/1"));
    }
    expectRange(slab.at("refractiveIndex"), thin, Json::json_pointer("/slabs/0/refractiveIndex"));
    const Json skin = slab.at("skin").at("properties");
    Json content = {{"slabs", Json::array({{{"skin", Json::object()}, {"thickness", 1}}})}};
    for (const auto& [key, property] : skin.items()) {
        content["slabs"][0]["skin"][key] = property.at("default");
    }
    for (const auto& [key, property] : skin.items()) {
        expectRange(property, content, Json::json_pointer("/slabs/0/skin/" + key));
    }

    // Everything that is written is in the schema, and has the defaults of the reader.
    const Json bare = {{"slabs", Json::array({{{"skin", Json::object()}, {"thickness", 1}}})}};
    const Json written = Json::parse(formatMaterial(parseMaterial(bare.dump(), "test"))).at("slabs").at(0);
    for (const auto& [key, value] : written.items()) {
        EXPECT_TRUE(slab.contains(key)) << key;
    }
    EXPECT_EQ(written.at("skin"), content["slabs"][0]["skin"]);
    EXPECT_EQ(written.at("refractiveIndex"), slab.at("refractiveIndex").at("default"));
}

TEST(MaterialSchema, HasTheDefaultsOfTheReader) {
    Json written = Json::parse(formatMaterial(parseMaterial(minimal().dump(), "test")));
    for (const auto& [key, property] : schema().at("properties").items()) {
        if (property.contains("default") && !isOfOpenPbr(key)) {
            EXPECT_EQ(written.at(key), property.at("default")) << key;
        }
    }
}

TEST(MaterialSchema, AllowsExactlyOneProfile) {
    const Json expected =
        Json::parse(R"([{"required": ["layers"]}, {"required": ["meanFreePath"]}, {"required": ["slabs"]},
                        {"required": ["subsurface_weight"]}])");
    EXPECT_EQ(schema().at("oneOf"), expected);
    Json both = minimalLayers();
    both.update(minimal());
    EXPECT_FALSE(accepts(both));
    for (Json material : {minimal(), minimalLayers(), minimalSlabs()}) {
        material.update(minimalOpenPbr());
        EXPECT_FALSE(accepts(material)) << material;
    }
    EXPECT_FALSE(accepts({{"subsurface_radius", 1}}));
    EXPECT_FALSE(accepts(Json::object()));
}

TEST(MaterialSchema, HasTheEnumerationOfTheReader) {
    for (const Json& name : schema().at("properties").at("albedoUse").at("enum")) {
        Json material = minimal();
        material["albedoUse"] = name;
        EXPECT_TRUE(accepts(material)) << name;
        EXPECT_EQ(Json::parse(formatMaterial(parseMaterial(material.dump(), "test"))).at("albedoUse"), name);
    }
}

TEST(Presets, RoundTripThroughFiles) {
    for (const Material& preset : presets()) {
        const Material read = parseMaterial(formatMaterial(preset), preset.name);
        EXPECT_EQ(read.name, preset.name);
        EXPECT_EQ(read.description, preset.description);
        EXPECT_EQ(read.layers, preset.layers);
        EXPECT_EQ(read.meanFreePath, preset.meanFreePath);
        EXPECT_EQ(read.albedoUse, preset.albedoUse);
        EXPECT_EQ(read.strength, preset.strength);
        EXPECT_EQ(read.translucency, preset.translucency);
        EXPECT_EQ(read.scale, preset.scale);
        EXPECT_EQ(read.secondSurfaces, preset.secondSurfaces);
        EXPECT_EQ(read.albedo, preset.albedo);
        EXPECT_EQ(read.roughness, preset.roughness);
        EXPECT_EQ(read.specular, preset.specular);
    }
}

} // namespace
