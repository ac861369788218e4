#include "scene/gallery/stored_bodies.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

// stored_bodies.S
extern "C" const std::uint8_t nacreGalleryBodies[];
extern "C" const std::uint8_t nacreGalleryBodiesEnd[];

namespace nacre::scene::gallery {

namespace {

template <typename T> void take(std::vector<T>& values, std::size_t count, const std::uint8_t*& at) {
    values.resize(count);
    std::memcpy(static_cast<void*>(values.data()), at, count * sizeof(T));
    at += count * sizeof(T);
}

} // namespace

Body storedBody(std::string_view name) {
    for (const std::uint8_t* at = nacreGalleryBodies; at != nacreGalleryBodiesEnd;) {
        StoredBodyHeader header;
        std::memcpy(&header, at, sizeof header);
        at += sizeof header;
        if (name == header.name.data()) {
            Body body;
            take(body.solid.positions, header.vertices, at);
            take(body.normals, header.vertices, at);
            take(body.solid.indices, header.indices, at);
            return body;
        }
        at += header.vertices * 2 * sizeof(glm::vec3) + header.indices * sizeof(std::uint32_t);
    }
    throw std::out_of_range("the gallery has no body " + std::string(name));
}

} // namespace nacre::scene::gallery
