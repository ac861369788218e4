#include "scene/gltf/gltf_file.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace nacre::scene {
namespace {

std::uint64_t componentBytes(const GltfFile& file, int type, const std::string& field) {
    const int size = type == TINYGLTF_COMPONENT_TYPE_DOUBLE || type == TINYGLTF_COMPONENT_TYPE_INT
                         ? -1
                         : tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    if (size <= 0) {
        failGltf(file, field + ".componentType is " + std::to_string(type) + ", must be 5120 to 5123, 5125 or 5126");
    }
    return static_cast<std::uint64_t>(size);
}

template <typename T> T load(const std::uint8_t* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

template <typename T> float loadInteger(const std::uint8_t* from, bool normalized) {
    const auto value = static_cast<float>(load<T>(from));
    return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

float loadComponent(const std::uint8_t* from, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return loadInteger<std::int8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return loadInteger<std::uint8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return loadInteger<std::int16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return loadInteger<std::uint16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return loadInteger<std::uint32_t>(from, normalized);
    default:
        return load<float>(from);
    }
}

std::uint32_t loadIndex(const std::uint8_t* from, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *from;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(from);
    default:
        return load<std::uint32_t>(from);
    }
}

/// Elements in a buffer view: byte ranges are checked, `stride` 0 means tightly packed.
struct Elements {
    const std::uint8_t* first = nullptr;
    std::uint64_t stride = 0;
};

Elements locate(const GltfFile& file, int view, std::uint64_t offset, std::uint64_t count, std::uint64_t size,
                const std::string& field) {
    const auto bytes = viewBytes(file, view, field + ".bufferView");
    const std::uint64_t declared = file.model.bufferViews[static_cast<std::size_t>(view)].byteStride;
    const std::uint64_t stride = declared != 0 ? declared : size;
    if (declared > 252) {
        failGltf(file, "bufferViews[" + std::to_string(view) + "].byteStride is " + std::to_string(declared) +
                           ", must be 4 to 252");
    }
    const std::uint64_t length = count == 0 ? 0 : (count - 1) * stride + size;
    return {slice(file, bytes, offset, length, field).data(), stride};
}

std::vector<std::uint32_t> readSparseIndices(const GltfFile& file, const tinygltf::Accessor& accessor,
                                             const std::string& field) {
    const auto& sparse = accessor.sparse;
    const std::string name = field + ".sparse.indices";
    const auto count = static_cast<std::uint64_t>(sparse.count);
    if (sparse.count < 0 || count > accessor.count || sparse.indices.byteOffset < 0) {
        failGltf(file, field + ".sparse.count is " + std::to_string(sparse.count) + ", must be 0 to " +
                           std::to_string(accessor.count));
    }
    const int type = sparse.indices.componentType;
    const Elements elements =
        locate(file, sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset), count,
               componentBytes(file, type, name), name);
    std::vector<std::uint32_t> indices(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        indices[i] = loadIndex(elements.first + i * elements.stride, type);
        if (indices[i] >= accessor.count) {
            failGltf(file, name + "[" + std::to_string(i) + "] is " + std::to_string(indices[i]) + ", must be below " +
                               std::to_string(accessor.count));
        }
    }
    return indices;
}

/// `size` is that of an element.
Elements sparseValues(const GltfFile& file, const tinygltf::Accessor& accessor, std::uint64_t count, std::uint64_t size,
                      const std::string& field) {
    const auto& values = accessor.sparse.values;
    if (values.byteOffset < 0) {
        failGltf(file, field + ".sparse.values.byteOffset is " + std::to_string(values.byteOffset));
    }
    return locate(file, values.bufferView, static_cast<std::uint64_t>(values.byteOffset), count, size,
                  field + ".sparse.values");
}

void checkCount(const GltfFile& file, const tinygltf::Accessor& accessor, const std::string& name) {
    const std::size_t most = accessor.bufferView >= 0 ? maxGltfElements : file.mostWithoutView;
    if (accessor.count > most) {
        failGltf(file,
                 name + ".count is " + std::to_string(accessor.count) + ", must be at most " + std::to_string(most));
    }
}

std::string nameOf(int accessor) {
    return "accessors[" + std::to_string(accessor) + "]";
}

} // namespace

std::size_t mostGltfElementsWithoutView(const GltfFile& file) {
    std::size_t bytes = 0;
    for (const auto& buffer : file.buffers) {
        bytes = std::max(bytes, buffer.size());
    }
    for (const Bytes& decoded : file.decodedViews) {
        bytes = std::max(bytes, decoded.size());
    }
    std::size_t most = 1024;
    for (const tinygltf::Accessor& accessor : file.model.accessors) {
        most = std::max(most, accessor.bufferView >= 0 ? std::min(accessor.count, bytes) : 0);
    }
    return std::min(most, maxGltfElements);
}

std::span<const std::uint8_t> slice(const GltfFile& file, std::span<const std::uint8_t> bytes, std::uint64_t offset,
                                    std::uint64_t size, const std::string& field) {
    if (offset > bytes.size() || size > bytes.size() - offset) {
        failGltf(file, field + " reaches from byte " + std::to_string(offset) + " over " + std::to_string(size) +
                           " bytes, but there are only " + std::to_string(bytes.size()));
    }
    return bytes.subspan(offset, size);
}

std::span<const std::uint8_t> viewBytes(const GltfFile& file, int view, const std::string& field) {
    const tinygltf::BufferView& bufferView = elementOf(file, file.model.bufferViews, view, field);
    if (const Bytes& decoded = file.decodedViews[static_cast<std::size_t>(view)]; !decoded.empty()) {
        return decoded;
    }
    const std::string name = "bufferViews[" + std::to_string(view) + "]";
    const auto buffer = elementOf(file, file.buffers, bufferView.buffer, name + ".buffer");
    return slice(file, buffer, bufferView.byteOffset, bufferView.byteLength, name);
}

int componentCount(const GltfFile& file, int accessor, const std::string& field) {
    const tinygltf::Accessor& source = elementOf(file, file.model.accessors, accessor, field);
    return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(source.type));
}

std::vector<float> readFloats(const GltfFile& file, int accessor, int components, const std::string& field) {
    const tinygltf::Accessor& source = elementOf(file, file.model.accessors, accessor, field);
    const std::string name = nameOf(accessor);
    const int actual = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(source.type));
    if (components != 0 && actual != components) {
        failGltf(file, name + ".type has " + std::to_string(actual) + " components, but " + field + " needs " +
                           std::to_string(components));
    }
    const auto width = static_cast<std::uint64_t>(actual);
    const std::uint64_t size = componentBytes(file, source.componentType, name);
    checkCount(file, source, name);
    std::vector<float> result;
    const auto copy = [&](const Elements& from, std::uint64_t element, std::uint64_t target) {
        for (std::uint64_t c = 0; c < width; ++c) {
            result[target * width + c] =
                loadComponent(from.first + element * from.stride + c * size, source.componentType, source.normalized);
        }
    };
    if (source.bufferView >= 0) {
        const Elements elements = locate(file, source.bufferView, source.byteOffset, source.count, size * width, name);
        result.resize(source.count * width);
        for (std::uint64_t i = 0; i < source.count; ++i) {
            copy(elements, i, i);
        }
    } else {
        result.resize(source.count * width);
    }
    if (source.sparse.isSparse) {
        const std::vector<std::uint32_t> indices = readSparseIndices(file, source, name);
        const Elements elements = sparseValues(file, source, indices.size(), size * width, name);
        for (std::uint64_t i = 0; i < indices.size(); ++i) {
            copy(elements, i, indices[i]);
        }
    }
    return result;
}

std::vector<std::uint32_t> readIndices(const GltfFile& file, int accessor, const std::string& field) {
    const tinygltf::Accessor& source = elementOf(file, file.model.accessors, accessor, field);
    const std::string name = nameOf(accessor);
    const int type = source.componentType;
    if (source.type != TINYGLTF_TYPE_SCALAR ||
        (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
        failGltf(file, name + " holds " + field + " and must be of unsigned integers");
    }
    checkCount(file, source, name);
    const std::uint64_t size = componentBytes(file, type, name);
    const Elements elements = locate(file, source.bufferView, source.byteOffset, source.count, size, name);
    std::vector<std::uint32_t> result(source.count);
    for (std::uint64_t i = 0; i < source.count; ++i) {
        result[i] = loadIndex(elements.first + i * elements.stride, type);
    }
    if (source.sparse.isSparse) {
        const std::vector<std::uint32_t> places = readSparseIndices(file, source, name);
        const Elements values = sparseValues(file, source, places.size(), size, name);
        for (std::uint64_t i = 0; i < places.size(); ++i) {
            result[places[i]] = loadIndex(values.first + i * values.stride, type);
        }
    }
    return result;
}

} // namespace nacre::scene
