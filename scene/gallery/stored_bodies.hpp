// The gallery's bodies take seconds to make, so they are made when Nacre is built (store_bodies.cpp) and lie in the
// program as bytes.
#pragma once

#include "scene/gallery/bodies.hpp"

#include <array>
#include <string_view>

namespace nacre::scene::gallery {

/// The head, the dragon, the logo, the shell or the plant, as it was made. Throws std::out_of_range for any other name.
Body storedBody(std::string_view name);

/// What lies in front of a body's bytes: positions, normals, then indices.
struct StoredBodyHeader {
    std::array<char, 16> name; ///< padded with zeros
    std::uint32_t vertices;
    std::uint32_t indices;
};

} // namespace nacre::scene::gallery
