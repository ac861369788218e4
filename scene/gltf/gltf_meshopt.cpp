#include "scene/gltf/gltf_meshopt.hpp"

#include <cmath>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

namespace nacre::scene {
namespace {

using tinygltf::Value;

constexpr const char* meshoptExtension = "EXT_meshopt_compression";

std::uint64_t wholeNumber(const GltfFile& file, const Value& object, const char* key, const std::string& field) {
    const Value& value = object.Get(key);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : (object.Has(key) ? -1.0 : 0.0);
    if (!(number >= 0 && number <= 4294967295.0 && number == std::floor(number))) {
        failGltf(file, field + "." + key + " must be a whole number, 0 or more");
    }
    return static_cast<std::uint64_t>(number);
}

std::string textOf(const Value& object, const char* key, const char* fallback) {
    const Value& value = object.Get(key);
    return value.IsString() ? value.Get<std::string>() : fallback;
}

/// One buffer view.
Bytes decodeMeshopt(const GltfFile& file, const Value& extension, const std::string& field) {
    const auto number = [&](const char* key) { return wholeNumber(file, extension, key, field); };
    const std::uint64_t count = number("count");
    const std::uint64_t stride = number("byteStride");
    const std::string mode = textOf(extension, "mode", "");
    const std::string filter = textOf(extension, "filter", "NONE");
    const auto buffer = elementOf(file, file.buffers, static_cast<int>(number("buffer")), field + ".buffer");
    const auto source = slice(file, buffer, number("byteOffset"), number("byteLength"), field);
    if (stride == 0 || stride > 256 || count > maxGltfViewBytes / stride) {
        failGltf(file, field + " has " + std::to_string(count) + " elements of " + std::to_string(stride) +
                           " bytes, which is not possible");
    }
    const bool octahedral = filter == "OCTAHEDRAL" && (stride == 4 || stride == 8);
    const bool quaternion = filter == "QUATERNION" && stride == 8;
    const bool exponential = filter == "EXPONENTIAL" && stride % 4 == 0;
    if (filter != "NONE" && (mode != "ATTRIBUTES" || !(octahedral || quaternion || exponential))) {
        failGltf(file, field + ".filter \"" + filter + "\" does not go with mode \"" + mode + "\" and byteStride " +
                           std::to_string(stride));
    }
    file.budget->charge(count * stride);
    Bytes result(count * stride);
    int error = -1;
    if (mode == "ATTRIBUTES" && stride % 4 == 0) {
        error = meshopt_decodeVertexBuffer(result.data(), count, stride, source.data(), source.size());
    } else if (mode == "TRIANGLES" && count % 3 == 0 && (stride == 2 || stride == 4)) {
        error = meshopt_decodeIndexBuffer(result.data(), count, stride, source.data(), source.size());
    } else if (mode == "INDICES" && (stride == 2 || stride == 4)) {
        error = meshopt_decodeIndexSequence(result.data(), count, stride, source.data(), source.size());
    } else {
        failGltf(file, field + ".mode \"" + mode + "\" does not go with byteStride " + std::to_string(stride) +
                           " and count " + std::to_string(count));
    }
    if (error != 0) {
        failGltf(file, field + " cannot be decompressed: its data are damaged");
    }
    if (octahedral) {
        meshopt_decodeFilterOct(result.data(), count, stride);
    } else if (quaternion) {
        meshopt_decodeFilterQuat(result.data(), count, stride);
    } else if (exponential) {
        meshopt_decodeFilterExp(result.data(), count, stride);
    }
    return result;
}

} // namespace

bool isMeshoptFallback(const nlohmann::json& buffer) {
    const nlohmann::json::json_pointer fallback(std::string("/extensions/") + meshoptExtension + "/fallback");
    return buffer.contains(fallback) && buffer[fallback] == true;
}

void decodeMeshoptViews(GltfFile& file) {
    file.decodedViews.resize(file.model.bufferViews.size());
    for (std::size_t i = 0; i < file.decodedViews.size(); ++i) {
        const auto& extensions = file.model.bufferViews[i].extensions;
        const auto found = extensions.find(meshoptExtension);
        if (found != extensions.end() && found->second.IsObject()) {
            file.decodedViews[i] = decodeMeshopt(
                file, found->second, "bufferViews[" + std::to_string(i) + "].extensions." + meshoptExtension);
        }
    }
}

} // namespace nacre::scene
