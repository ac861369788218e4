// Scene files: what they place, what they refuse, and that the schema says the same as the reader.
#include "scene/files/scene_file.hpp"

#include "core/files/quoted_text.hpp"
#include "image/image_file.hpp"
#include "nacre/presets.hpp"
#include "scene/files/save_scene_file.hpp"
#include "scene/import.hpp"
#include "scene/surface_material.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numbers>
#include <set>

using namespace nacre;
using namespace nacre::scene;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// A folder with a triangle, a material and an environment, removed with the test.
class SceneFile : public testing::Test {
protected:
    void SetUp() override {
        std::ofstream(folder / "triangle.obj") << "mtllib triangle.mtl\no triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                                  "usemtl red\nf 1 2 3\n";
        std::ofstream(folder / "triangle.mtl") << "newmtl red\nKd 1 0 0\n";
        std::ofstream(folder / "soap.json") << R"({"meanFreePath": [1, 2, 3]})";
        std::ofstream sky(folder / "sky.hdr", std::ios::binary);
        sky << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
        sky.write("\x80\x80\x80\x81\x80\x80\x80\x82", 8);
        writePng(folder / "thick.png", {2, 1, {"Y"}, {0.2f, 1}, Encoding::Srgb});
    }

    Scene read(const std::string& text) const {
        const fs::path file = folder / "scene.json";
        std::ofstream(file) << text;
        return load(file);
    }
    Scene read(const Json& json) const { return read(json.dump()); }

    /// The sentence without the folder; "" when the file is accepted.
    template <typename Text> std::string error(const Text& text) const {
        try {
            read(text);
        } catch (const SceneError& failure) {
            std::string sentence = failure.what();
            EXPECT_TRUE(sentence.starts_with(folder.string() + "/")) << sentence;
            return sentence.substr(folder.string().size() + 1);
        }
        return "";
    }

    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

Json minimal() {
    return {{"models", {{{"model", "triangle.obj"}}}}};
}

/// Every key of every object.
Json everything() {
    return Json::parse(R"({
        "$schema": "scene.schema.json", "name": "all", "metersPerUnit": 0.01, "exposure": 2,
        "models": [{"model": "triangle.obj", "name": "a", "instances": ["triangle"], "units": "mm",
                    "translate": [1, 2, 3], "rotate": [0, 0, 90], "scale": 2, "material": "skin",
                    "materials": {"red": "soap.json"},
                    "surface": {"baseColor": [0.1, 0.2, 0.3], "metallic": 0.4, "roughness": 0.5, "specular": 0.7,
                                "thickness": 5, "thicknessTexture": "thick.png", "scale": 2, "scaleTexture": "thick.png",
                                "transmissionTexture": "thick.png", "transmissionColorTexture": "thick.png",
                                "doubleSided": true},
                    "surfaces": {"red": {"roughness": 0.6}}}],
        "lights": [{"name": "l", "type": "spot", "color": [1, 2, 3], "intensity": 4, "position": [1, 2, 3],
                    "direction": [0, 0, -2], "range": 5, "innerConeAngle": 10, "outerConeAngle": 60,
                    "castsShadow": false}],
        "cameras": [{"name": "c", "position": [0, 0, 9], "target": [0, 1, 0], "up": [0, 2, 0],
                     "projection": "orthographic", "verticalFieldOfView": 90, "orthographicHeight": 3,
                     "offCenter": [0.5, -0.5], "nearPlane": 1, "farPlane": 20}],
        "environment": {"image": "sky.hdr", "intensity": 2, "rotation": 180, "zenith": [1, 1, 1],
                        "horizon": [2, 2, 2], "ground": [3, 3, 3]}})");
}

TEST_F(SceneFile, SetsEveryMember) {
    const Scene scene = read(everything());
    EXPECT_EQ(scene.name, "all");
    EXPECT_DOUBLE_EQ(scene.metersPerUnit, 0.01);
    EXPECT_FLOAT_EQ(scene.exposure, 2);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "a/triangle");
    // Millimetres to centimetres, twice as large, a quarter turn about z: (1, 0, 0) goes to (1, 2.2, 3).
    const glm::vec3 corner(scene.instances[0].transform * glm::vec4(1, 0, 0, 1));
    EXPECT_NEAR(glm::distance(corner, glm::vec3(1, 2.2f, 3)), 0, 1e-5);
    ASSERT_EQ(scene.surfaces.size(), 1u);
    const Surface& surface = scene.surfaces[0];
    EXPECT_EQ(scene.materials.at(surface.material).name, "soap");
    EXPECT_EQ(surface.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 1));
    EXPECT_FLOAT_EQ(surface.metallic, 0.4f);
    EXPECT_FLOAT_EQ(surface.roughness, 0.6f);
    EXPECT_FLOAT_EQ(surface.specular, 0.7f);
    EXPECT_FLOAT_EQ(surface.thickness, 5);
    const Texture& thickness = scene.textures.at(surface.thicknessTexture);
    EXPECT_FALSE(thickness.srgb);
    EXPECT_EQ(thickness.pixels[1], 51); // green of the first texel, 0.2
    EXPECT_FLOAT_EQ(surface.scale, 2);
    EXPECT_FALSE(scene.textures.at(surface.scaleTexture).srgb);
    EXPECT_FALSE(scene.textures.at(surface.transmissionTexture).srgb);
    EXPECT_TRUE(scene.textures.at(surface.transmissionColorTexture).srgb);
    EXPECT_TRUE(surface.doubleSided);
    ASSERT_EQ(scene.lights.size(), 1u);
    const Light& light = scene.lights[0];
    EXPECT_EQ(light.kind, LightKind::Spot);
    EXPECT_EQ(light.color, glm::vec3(1, 2, 3));
    EXPECT_EQ(light.direction, glm::vec3(0, 0, -1));
    EXPECT_FLOAT_EQ(light.outerConeAngle, std::numbers::pi_v<float> / 3);
    EXPECT_FALSE(light.castsShadow);
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.projection, ProjectionKind::Orthographic);
    EXPECT_FLOAT_EQ(camera.verticalFieldOfView, std::numbers::pi_v<float> / 2);
    EXPECT_EQ(camera.offCenter, glm::vec2(0.5f, -0.5f));
    EXPECT_FLOAT_EQ(camera.farPlane, 20);
    ASSERT_TRUE(scene.environment.image.has_value());
    EXPECT_EQ(scene.environment.image->width, 2u);
    EXPECT_FLOAT_EQ(scene.environment.rotation, std::numbers::pi_v<float>);
    EXPECT_EQ(scene.environment.ground, glm::vec3(3));
}

TEST_F(SceneFile, AThicknessTextureNeedsAThickness) {
    Json json = minimal();
    json["models"][0]["surface"] = {{"thicknessTexture", "thick.png"}};
    EXPECT_EQ(error(json), "scene.json: models[0].surface.thickness is missing");
    json["models"][0]["surface"]["thickness"] = 3;
    EXPECT_EQ(error(json), "");
    json["models"][0]["surface"]["thicknessTexture"] = "thin.png";
    EXPECT_NE(error(json).find("models[0].surface.thicknessTexture is \"thin.png\""), std::string::npos);
}

TEST_F(SceneFile, FillsInWhatIsMissing) {
    const Scene scene = read(minimal());
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.lights.size(), 3u);
    EXPECT_FALSE(scene.environment.image.has_value());
}

/// A square at (10⁶, 0, 0) under a light of 50,000 lux.
void writeFarAndBright(const fs::path& file) {
    nacre::test::GltfBuilder builder;
    builder.setSquare();
    builder.json["nodes"][0]["translation"] = {1e6, 0, 0};
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 50000}}};
    const std::vector<std::uint8_t> bytes = builder.glb();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

TEST_F(SceneFile, GivesLightsOfModelsTheStrengthTheyHaveAlone) {
    writeFarAndBright(folder / "bright.glb");
    Json json = minimal();
    json["models"][0]["model"] = "bright.glb";
    EXPECT_FLOAT_EQ(read(json).lights.at(0).intensity, load(folder / "bright.glb").lights.at(0).intensity);
    EXPECT_FLOAT_EQ(read(json).lights.at(0).intensity, std::numbers::pi_v<float>);
    json["lights"] = {{{"type", "directional"}, {"direction", {0, 0, -1}}, {"intensity", 50000}}};
    EXPECT_FLOAT_EQ(read(json).lights.at(0).intensity, 50000); // what the scene file says is meant
}

TEST_F(SceneFile, PlacesFarModelsWhereTheyAre) {
    writeFarAndBright(folder / "far.glb");
    Json json = minimal();
    json["models"][0]["model"] = "far.glb";
    EXPECT_EQ(bounds(read(json)).low, glm::vec3(1e6f, 0, 0));
    json["models"][0]["translate"] = {-1e6, 0, 0};
    EXPECT_EQ(bounds(read(json)).low, glm::vec3(0));
    EXPECT_EQ(bounds(read(json)).high, glm::vec3(1, 1, 0));
}

TEST_F(SceneFile, GivesMaterialsByNameFileValueAndNull) {
    for (const auto& [value, name] : std::initializer_list<std::pair<Json, std::string>>{
             {"marble", "marble"}, {"soap.json", "soap"}, {{{"name", "own"}, {"meanFreePath", {1, 1, 1}}}, "own"}}) {
        Json json = minimal();
        json["models"][0]["material"] = value;
        const Scene scene = read(json);
        EXPECT_EQ(scene.materials.at(scene.surfaces[0].material).name, name);
    }
    Json json = minimal();
    json["models"][0]["material"] = "skin";
    json["models"][0]["materials"] = {{"red", nullptr}};
    EXPECT_EQ(read(json).surfaces[0].material, none);
}

TEST_F(SceneFile, NamesTheFieldThatIsWrong) {
    const std::tuple<const char*, Json, std::string> cases[]{
        {"/lights/0/intensity", -3, "lights[0].intensity is -3, must be a number from 0 to 1e+09"},
        {"/lights/0/intensity", 2e9, "lights[0].intensity is 2000000000.0, must be a number from 0 to 1e+09"},
        {"/lights/0/color/1", -1, "lights[0].color[1] is -1, must be a number from 0 to 1e+09"},
        {"/lights/0/type", "laser", R"(lights[0].type is "laser", must be one of "directional", "spot", "point")"},
        {"/lights/0/direction", {0, 0, 0}, "lights[0].direction is [0,0,0], must be a direction other than (0, 0, 0)"},
        {"/lights/0/innerConeAngle", 80, "lights[0].innerConeAngle is 80, must be at most outerConeAngle"},
        {"/lights/0/castsShadow", 1, "lights[0].castsShadow is 1, must be true or false"},
        {"/cameras/0/position", {0, 1, 0}, "cameras[0].position is [0,1,0], must be another point than the target"},
        {"/cameras/0/up", {0, 1, -9}, "cameras[0].up is parallel to the view direction"},
        {"/cameras/0/farPlane", 0.5, "cameras[0].farPlane is 0.5, must be beyond nearPlane"},
        {"/cameras/0/verticalFieldOfView", 180,
         "cameras[0].verticalFieldOfView is 180, must be a number from 0.01 to 170"},
        {"/models", Json::array(), "models is [], must be an array with at least one model"},
        {"/models/0/model", "no.obj", R"(models[0].model is "no.obj", must be "gallery" or an existing file)"},
        {"/models/0/scale", 0, "models[0].scale is 0, must be a number above 0 and at most 1e+09"},
        {"/models/0/translate", {1, 2}, "models[0].translate is [1,2], must be an array of 3 numbers"},
        {"/models/0/instances", {"dog"}, R"(models[0].instances is ["dog"], must be of "triangle")"},
        {"/models/0/units", "miles", R"(models[0].units is "miles", must be one of "m", "cm", "mm", "in", "ft")"},
        {"/models/0/material", "skim", R"(models[0].material is "skim", must be a preset's name)"},
        {"/models/0/material", {{"meanFreePath", {-1, 1, 1}}}, "models[0].material: meanFreePath[0] is -1"},
        {"/models/0/materials",
         {{"blue", "skin"}},
         "models[0].materials.blue: the model has no such surface, only \"red\""},
        {"/models/0/surface/roughness", 2, "models[0].surface.roughness is 2, must be a number from 0 to 1"},
        {"/environment/image", "no.hdr", R"(environment.image is "no.hdr", must be an existing .hdr or .exr file)"},
        {"/metersPerUnit", 0, "metersPerUnit is 0, must be a number from 1e-06 to 1000000"},
        {"/lights", 3, "lights is 3, must be an array"},
        {"/lights/0", 3, "lights[0] is 3, must be an object"},
        {"/name", 3, "name is 3, must be a string"},
    };
    for (const auto& [pointer, value, sentence] : cases) {
        Json json = everything();
        json[Json::json_pointer(pointer)] = value;
        EXPECT_TRUE(error(json).starts_with("scene.json: " + sentence)) << pointer << ": " << error(json);
    }
    for (const char* pointer : {"/models", "/models/0/model", "/lights/0/type", "/lights/0/direction",
                                "/lights/0/position", "/cameras/0/position"}) {
        Json json = everything();
        const Json::json_pointer at(pointer);
        json[at.parent_pointer()].erase(at.back());
        EXPECT_NE(error(json).find(at.back() + " is missing"), std::string::npos) << error(json);
    }
}

TEST_F(SceneFile, IsRefusedInAShortSentenceWhateverItQuotes) {
    const std::string name = std::string(10'000, 'x') + "end";
    const std::pair<const char*, Json> longOnes[] = {
        {"/models/0/material", name},    {"/models/0/materials", {{name, "skin"}}},
        {"/models/0/instances", {name}}, {"/models/0/surfaces", {{name, 1}}},
        {"/models/0", {{name, 1}}},      {"/environment/image", name}};
    for (const auto& [pointer, value] : longOnes) {
        Json json = everything();
        json[Json::json_pointer(pointer)] = value;
        const std::string sentence = error(json);
        EXPECT_TRUE(sentence.starts_with("scene.json: ")) << sentence;
        EXPECT_LT(sentence.size(), 1000u) << pointer;
    }
    EXPECT_LT(nacre::inQuotes(std::string(10'000, '\x80')).size(), 120u); // no character begins there
    EXPECT_EQ(nacre::listNames(std::vector<Light>{}), "none");
    EXPECT_LT(nacre::listNames(std::vector<Light>(30, Light{.name = name})).size(), 3000u);
}

TEST_F(SceneFile, NamesOnlyFilesBesideItOrBelow) {
    fs::create_directories(folder / "inner");
    fs::copy_file(folder / "triangle.obj", folder / "inner/own.obj");
    const auto errorInside = [&](const std::string& pointer, const std::string& reference) {
        Json json = Json::parse(R"({"models": [{"model": "own.obj"}], "environment": {}})");
        json[Json::json_pointer(pointer)] = reference;
        std::ofstream(folder / "inner/scene.json") << json.dump();
        try {
            load(folder / "inner/scene.json");
        } catch (const SceneError& failure) {
            return std::string(failure.what());
        }
        return std::string();
    };
    const std::pair<const char*, const char*> fields[] = {
        {"/models/0/model", "triangle.obj"}, {"/models/0/material", "soap.json"}, {"/environment/image", "sky.hdr"}};
    for (const auto& [pointer, name] : fields) {
        for (const std::string up : {"../", "..\\", "./../"}) {
            EXPECT_NE(errorInside(pointer, up + name).find("lies outside the folder"), std::string::npos)
                << pointer << ": " << errorInside(pointer, up + name);
        }
        EXPECT_NE(errorInside(pointer, (folder / name).string()).find("not a path relative"), std::string::npos);
        EXPECT_NE(errorInside(pointer, std::string(5000, 'x')).find("must be "), std::string::npos);
    }
}

TEST_F(SceneFile, SharesWhatLooksTheSame) {
    Json json = minimal();
    for (int i = 0; i < 1000; ++i) {
        json["models"].push_back({{"model", "triangle.obj"}, {"name", std::to_string(i)}, {"translate", {i, 0, 0}}});
    }
    json["models"].push_back({{"model", "triangle.obj"}, {"material", "skin"}});
    const Scene scene = read(json);
    ASSERT_EQ(scene.instances.size(), 1002u);
    EXPECT_EQ(scene.meshes.size(), 2u); // with and without skin
    EXPECT_EQ(scene.instances[1000].name, "999/" + scene.instances[0].name);
    EXPECT_EQ(scene.instances[1000].mesh, scene.instances[0].mesh);
    EXPECT_EQ(scene.instances[1000].transform[3], scene.instances[0].transform[3] + glm::vec4(999, 0, 0, 0));
    EXPECT_EQ(scene.surfaces.at(scene.meshes.at(scene.instances[1001].mesh).surface).material, 0u);
    json["models"][500]["turn"] = 1; // an unknown key is found in every entry
    EXPECT_NE(error(json).find("models[500].turn"), std::string::npos);
}

TEST_F(SceneFile, RefusesWhatIsNotItsJson) {
    EXPECT_NE(error(std::string("{\"models\": [\n{\"model\": NaN}]}")).find("is not valid JSON: parse error at line 2"),
              std::string::npos);
    EXPECT_NE(error(std::string("{\"exposure\": 1e999}")).find("number overflow"), std::string::npos);
    EXPECT_EQ(error(std::string("{\"name\": \"a\", \"name\": \"b\"}")), "scene.json: the key \"name\" is given twice");
    EXPECT_EQ(error(std::string("[1]")), "scene.json: the scene is [1], must be an object");
    EXPECT_EQ(error(std::string("")), "scene.json: is empty");
    EXPECT_NE(error(std::string(100000, '[')), "");
    const std::string whole = everything().dump();
    for (std::size_t size = 0; size < whole.size(); size += 7) {
        EXPECT_NE(error(whole.substr(0, size)), "") << size;
    }
}

/// `{"$ref": …}` replaced by what it stands for.
Json resolve(const Json& schema, Json part) {
    while (part.contains("$ref") && part["$ref"].get<std::string>().starts_with("#/")) {
        part = schema.at(Json::json_pointer(part["$ref"].get<std::string>().substr(1)));
    }
    return part;
}

class SceneSchema : public SceneFile {
protected:
    /// The keys that the reader lists for the object at `pointer`.
    std::set<std::string> readersKeys(const Json::json_pointer& pointer) const {
        Json json = everything();
        json[pointer]["unheardOf"] = 1;
        const std::string sentence = error(json);
        const std::string marker = "unheardOf\" is unknown, there are ";
        const std::size_t begin = sentence.find(marker);
        EXPECT_NE(begin, std::string::npos) << sentence;
        std::set<std::string> keys;
        std::istringstream list(sentence.substr(begin + marker.size()));
        for (std::string key; std::getline(list >> std::ws, key, ',');) {
            keys.insert(key);
        }
        return keys;
    }

    void expectLimit(const Json::json_pointer& pointer, double value, bool accepted) const {
        Json json = everything();
        json[pointer] = value;
        const std::string sentence = error(json);
        const std::string limit = "must be "; // other complaints are about how values go together
        const bool refused = sentence.find(limit) != std::string::npos &&
                             sentence.find("beyond") == std::string::npos &&
                             sentence.find("at most outer") == std::string::npos;
        EXPECT_EQ(!refused, accepted) << pointer << " = " << value << ": " << sentence;
    }

    void compareNumber(const Json& limits, const Json::json_pointer& pointer) const {
        const double high = limits.at("maximum");
        expectLimit(pointer, high, true);
        expectLimit(pointer, high * 1.01, false);
        const bool excluded = limits.contains("exclusiveMinimum");
        const double low = limits.at(excluded ? "exclusiveMinimum" : "minimum");
        expectLimit(pointer, low, !excluded);
        expectLimit(pointer, low - std::max(std::abs(low) * 0.01, 1e-7), false);
    }

    void compareValue(const Json& schema, const Json& part, const Json::json_pointer& pointer) const {
        const Json resolved = resolve(schema, part);
        const std::string type = resolved.value("type", "");
        if (resolved.contains("anyOf")) { // a number or three, a material
            if (resolved["anyOf"][0].value("type", "") == "number") {
                compareNumber(resolved["anyOf"][0], pointer);
            }
        } else if (type == "object" && resolved.contains("properties")) {
            compareObject(schema, resolved, pointer);
        } else if (type == "array" && resolve(schema, resolved["items"]).value("type", "") == "object") {
            compareObject(schema, resolve(schema, resolved["items"]), pointer / 0);
        } else if (type == "array" && resolved["items"].value("type", "") == "number") {
            compareNumber(resolved["items"], pointer / 0);
        } else if (type == "number") {
            compareNumber(resolved, pointer);
        } else if (resolved.contains("enum")) {
            for (const Json& choice : resolved["enum"]) {
                Json json = everything();
                json[pointer] = choice;
                EXPECT_EQ(error(json), "") << choice;
            }
        }
    }

    void compareObject(const Json& schema, const Json& object, const Json::json_pointer& pointer) const {
        EXPECT_FALSE(object.at("additionalProperties").get<bool>()) << pointer;
        std::set<std::string> keys;
        for (const auto& [key, part] : object.at("properties").items()) {
            keys.insert(key);
            EXPECT_TRUE(everything()[pointer].contains(key)) << pointer << " " << key;
            compareValue(schema, part, pointer / key);
        }
        EXPECT_EQ(keys, readersKeys(pointer)) << pointer;
    }
};

TEST_F(SceneSchema, HasTheKeysAndRangesOfTheReader) {
    const Json schema = Json::parse(std::ifstream(NACRE_SOURCE_DIR "/docs/schemas/scene.schema.json"));
    EXPECT_EQ(error(everything()), "");
    compareObject(schema, schema, Json::json_pointer(""));
}

/// Equal but for the last bits of what was turned into degrees or made a unit vector.
void expectAlike(const Scene& scene, const Scene& other) {
    ASSERT_EQ(scene.surfaces.size(), other.surfaces.size());
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& one = scene.surfaces[i];
        const Surface& two = other.surfaces[i];
        EXPECT_EQ(one.baseColor, two.baseColor) << one.name;
        EXPECT_EQ(one.metallic, two.metallic);
        EXPECT_EQ(one.roughness, two.roughness);
        EXPECT_EQ(one.specular, two.specular);
        EXPECT_EQ(one.thickness, two.thickness);
        ASSERT_EQ(one.material == none, two.material == none);
        EXPECT_TRUE(one.material == none || scene.materials[one.material] == other.materials[two.material]);
    }
    ASSERT_EQ(scene.lights.size(), other.lights.size());
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        EXPECT_EQ(scene.lights[i].kind, other.lights[i].kind);
        EXPECT_EQ(scene.lights[i].intensity, other.lights[i].intensity);
        EXPECT_EQ(scene.lights[i].castsShadow, other.lights[i].castsShadow);
        EXPECT_NEAR(glm::distance(scene.lights[i].direction, other.lights[i].direction), 0, 1e-6f);
        EXPECT_FLOAT_EQ(scene.lights[i].outerConeAngle, other.lights[i].outerConeAngle);
    }
    ASSERT_EQ(scene.cameras.size(), other.cameras.size());
    EXPECT_EQ(scene.cameras[0].position, other.cameras[0].position);
    EXPECT_EQ(scene.cameras[0].orthographicHeight, other.cameras[0].orthographicHeight);
    EXPECT_FLOAT_EQ(scene.cameras[0].verticalFieldOfView, other.cameras[0].verticalFieldOfView);
    EXPECT_EQ(scene.instances.at(0).transform, other.instances.at(0).transform);
    EXPECT_EQ(scene.exposure, other.exposure);
    EXPECT_EQ(scene.environment.image.has_value(), other.environment.image.has_value());
    EXPECT_FLOAT_EQ(scene.environment.rotation, other.environment.rotation);
}

TEST_F(SceneFile, AModelIsSavedWithWhatWasEdited) {
    const fs::path source = folder / "triangle.obj";
    const fs::path target = folder / "saved.json";
    const std::vector<Surface> read = load(source).surfaces;
    Scene scene = load(source);
    scene.lights = {{.name = "lamp", .kind = LightKind::Spot, .intensity = 0.1f, .outerConeAngle = 0.3f}};
    scene.exposure = 0.3f;
    scene.materials = {*findPreset("wax")};
    scene.surfaces[0].material = 0;
    saveSceneFile(scene, read, source, target); // the surface is not as its material says
    expectAlike(load(target), scene);
    setSurfaceMaterial(scene, scene.surfaces[0], 0);
    scene.lights.clear();
    saveSceneFile(scene, load(target).surfaces, target, target);
    expectAlike(load(target), scene);
    EXPECT_EQ(Json::parse(std::ifstream(target))["models"][0].count("surfaces"), 0u);
}

TEST_F(SceneFile, IsSavedOverItselfAndElsewhere) {
    const Scene scene = read(everything());
    const fs::path above = folder / "above.json";
    saveSceneFile(scene, scene.surfaces, folder / "scene.json", above);
    expectAlike(load(above), scene);
    Scene without = scene;
    without.surfaces[0].material = none;
    saveSceneFile(without, scene.surfaces, above, above);
    expectAlike(load(above), without);
}

TEST_F(SceneFile, IsNotSavedWhereItCouldNotBeRead) {
    const Scene scene = read(minimal());
    fs::create_directory(folder / "below");
    const auto sentence = [&](const fs::path& target) {
        try {
            saveSceneFile(scene, scene.surfaces, folder / "scene.json", target);
        } catch (const FileError& failure) {
            return std::string(failure.what());
        }
        return std::string();
    };
    EXPECT_NE(sentence(folder / "below/scene.json").find("has to be in the folder of"), std::string::npos);
    EXPECT_NE(sentence(folder / "triangle.obj").find("is made of this file"), std::string::npos);
    EXPECT_NE(sentence("/dev/full").find("cannot be written"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "below/scene.json"));
}

/// Files and what models have are named in any bytes.
TEST_F(SceneFile, IsNotSavedWithNamesThatAreNotUtf8) {
    const fs::path target = folder / "saved.json";
    const auto sentence = [&](const fs::path& source, const auto& edit) {
        Scene scene = load(source);
        const std::vector<Surface> read = scene.surfaces;
        edit(scene);
        try {
            saveSceneFile(scene, read, source, target);
        } catch (const FileError& failure) {
            return std::string(failure.what());
        }
        return std::string("it was saved");
    };
    const std::string start = target.string() + ": cannot be written: ";
    const std::string end = ", which is not UTF-8";
    const fs::path model = folder / "h\xf6hle.obj";
    fs::copy_file(folder / "triangle.obj", model);
    EXPECT_EQ(sentence(model, [](Scene&) {}), start + "models[0].model is \"h\xf6hle.obj\"" + end);
    EXPECT_EQ(sentence(folder / "triangle.obj", [](Scene& scene) { scene.lights = {{.name = "l\xe4mp"}}; }),
              start + "lights[0].name is \"l\xe4mp\"" + end);
    std::ofstream(folder / "named.mtl") << "newmtl h\xf6lz\nKd 1 0 0\n";
    std::ofstream(folder / "named.obj") << "mtllib named.mtl\nusemtl h\xf6lz\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(sentence(folder / "named.obj", [](Scene& scene) { scene.surfaces.at(0).roughness = 0.9f; }),
              start + "models[0].surfaces has the key \"h\xf6lz\"" + end);
    EXPECT_FALSE(fs::exists(target));
}

TEST(Scenes, ExamplesLoad) {
    for (const fs::directory_entry& entry : fs::directory_iterator(NACRE_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() == ".glb") {
            continue; // a scene's model
        }
        const Scene scene = load(entry.path());
        EXPECT_GT(triangleCount(scene), 0u);
        ASSERT_FALSE(scene.materials.empty());
        std::set<std::uint32_t> used; // what no instance uses is dropped
        for (const Instance& instance : scene.instances) {
            used.insert(scene.surfaces.at(scene.meshes.at(instance.mesh).surface).material);
        }
        used.erase(none);
        EXPECT_EQ(used.size(), scene.materials.size());
    }
}

} // namespace
