// Puts small glTF files together for tests.
#pragma once

#include "scene/gltf/gltf_import.hpp"

#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace nacre::test {

class GltfBuilder {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    std::vector<std::uint8_t> binary;

    template <typename T> std::size_t addView(const std::vector<T>& values) {
        binary.resize((binary.size() + 3) / 4 * 4);
        const std::size_t offset = binary.size();
        const std::size_t size = values.size() * sizeof(T);
        binary.resize(offset + size);
        std::memcpy(binary.data() + offset, values.data(), size);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
        return json["bufferViews"].size() - 1;
    }

    std::size_t addAccessor(std::size_t view, int componentType, std::size_t count, const char* type) {
        json["accessors"].push_back(
            {{"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", type}});
        return json["accessors"].size() - 1;
    }

    std::size_t addFloats(const std::vector<float>& values, const char* type, std::size_t components) {
        return addAccessor(addView(values), 5126, values.size() / components, type);
    }

    std::size_t addIndices(const std::vector<std::uint16_t>& values) {
        return addAccessor(addView(values), 5123, values.size(), "SCALAR");
    }

    /// One node with one mesh of one primitive.
    nlohmann::json& setPrimitive(nlohmann::json primitive) {
        json["nodes"] = {{{"mesh", 0}}};
        json["meshes"] = {{{"primitives", {std::move(primitive)}}}};
        return json["meshes"][0]["primitives"][0];
    }

    /// A unit square in the xy plane, with texture coordinates whose v points down.
    nlohmann::json& setSquare() {
        const auto positions = addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
        const auto uvs = addFloats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
        const auto indices = addIndices({0, 1, 2, 0, 2, 3});
        return setPrimitive({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"indices", indices}});
    }

    std::vector<std::uint8_t> glb() {
        json["buffers"][0]["byteLength"] = binary.size();
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<std::uint8_t> chunk = binary;
        chunk.resize((chunk.size() + 3) / 4 * 4);
        std::vector<std::uint8_t> result;
        const auto word = [&result](std::size_t value) {
            for (int shift = 0; shift < 32; shift += 8) {
                result.push_back(static_cast<std::uint8_t>(value >> shift));
            }
        };
        word(0x46546c67);
        word(2);
        word(12 + 8 + text.size() + 8 + chunk.size());
        word(text.size());
        word(0x4e4f534a);
        result.insert(result.end(), text.begin(), text.end());
        word(chunk.size());
        word(0x004e4942);
        result.insert(result.end(), chunk.begin(), chunk.end());
        return result;
    }

    scene::Scene load() { return scene::loadGltf("test.glb", glb()); }

    /// The error that loading ends with, "" when it loads.
    std::string error() {
        try {
            load();
        } catch (const scene::SceneError& failure) {
            return failure.what();
        }
        return "";
    }
};

} // namespace nacre::test
