#include "scene/import_isolated.hpp"

#include <cstring>
#include <type_traits>

namespace nacre::scene {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Appends values to bytes.
class Writer {
public:
    template <typename T> void operator()(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof(T));
    }
    void operator()(const std::string& text) { array(text.data(), text.size()); }
    template <typename T> void operator()(const std::vector<T>& values) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            array(values.data(), values.size());
        } else {
            (*this)(values.size());
            for (const T& value : values) {
                exchange(*this, value);
            }
        }
    }
    Bytes bytes;

private:
    template <typename T> void array(const T* values, std::size_t count) {
        (*this)(count);
        append(values, count * sizeof(T));
    }
    void append(const void* data, std::size_t size) {
        const auto* begin = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), begin, begin + size);
    }
};

/// Takes values from bytes, in the same order. The bytes are from a child that may have gone astray: sizes are checked.
class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    template <typename T> void operator()(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        take(&value, 1);
    }
    void operator()(std::string& text) {
        text.resize(count(1));
        take(text.data(), text.size());
    }
    template <typename T> void operator()(std::vector<T>& values) {
        values.resize(count(std::is_trivially_copyable_v<T> ? sizeof(T) : 1));
        if constexpr (std::is_trivially_copyable_v<T>) {
            take(values.data(), values.size());
        } else {
            for (T& value : values) {
                exchange(*this, value);
            }
        }
    }

private:
    std::size_t count(std::size_t elementSize) {
        std::size_t result = 0;
        (*this)(result);
        if (result > rest_.size() / elementSize) {
            throw std::length_error("damaged result");
        }
        return result;
    }
    template <typename T> void take(T* values, std::size_t number) {
        if (number * sizeof(T) > rest_.size()) {
            throw std::length_error("damaged result");
        }
        if (number > 0) {
            std::memcpy(static_cast<void*>(values), rest_.data(), number * sizeof(T));
        }
        rest_ = rest_.subspan(number * sizeof(T));
    }
    std::span<const std::uint8_t> rest_;
};

// exchange(archive, value): the members that cross, in one order for both directions.
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, std::string>
void exchange(A& archive, T& text) {
    archive(text);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Mesh>
void exchange(A& archive, T& mesh) {
    archive(mesh.name), archive(mesh.vertices), archive(mesh.indices), archive(mesh.surface);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Texture>
void exchange(A& archive, T& texture) {
    archive(texture.name), archive(texture.width), archive(texture.height), archive(texture.srgb);
    archive(texture.wrapU), archive(texture.wrapV), archive(texture.nearest), archive(texture.pixels);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Surface>
void exchange(A& archive, T& s) {
    archive(s.name), archive(s.baseColor), archive(s.metallic), archive(s.roughness), archive(s.specular);
    archive(s.normalScale), archive(s.emission);
    for (const TextureSlot& slot : textureSlots) {
        archive(s.*slot.texture), archive(s.*slot.coordinates);
    }
    archive(s.alphaMode), archive(s.alphaCutoff), archive(s.doubleSided), archive(s.thickness), archive(s.scale);
    archive(s.transmissionSetsStrength), archive(s.material);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Instance>
void exchange(A& archive, T& instance) {
    archive(instance.name), archive(instance.mesh), archive(instance.transform);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Light>
void exchange(A& archive, T& l) {
    archive(l.name), archive(l.kind), archive(l.color), archive(l.intensity), archive(l.position);
    archive(l.direction), archive(l.range), archive(l.innerConeAngle), archive(l.outerConeAngle);
    archive(l.castsShadow);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Camera>
void exchange(A& archive, T& c) {
    archive(c.name), archive(c.position), archive(c.target), archive(c.up), archive(c.projection);
    archive(c.verticalFieldOfView), archive(c.orthographicHeight), archive(c.offCenter), archive(c.nearPlane);
    archive(c.farPlane);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Scene>
void exchange(A& archive, T& scene) {
    archive(scene.name), archive(scene.meshes), archive(scene.textures), archive(scene.surfaces);
    archive(scene.instances), archive(scene.lights), archive(scene.cameras), archive(scene.metersPerUnit);
    archive(scene.exposure), archive(scene.inputs), archive(scene.notes);
}

} // namespace

Scene importIsolated(const std::string& name, const ProcessLimits& limits, const std::function<Scene()>& read) {
    const Bytes bytes = runIsolated(name, limits, [&read] {
        Writer writer;
        const Scene scene = read();
        exchange(writer, scene);
        return std::move(writer.bytes);
    });
    Scene scene;
    try {
        Reader reader(bytes);
        exchange(reader, scene);
    } catch (const std::length_error&) {
        throw SceneError(name + ": is damaged: reading it fails");
    }
    return scene;
}

} // namespace nacre::scene
