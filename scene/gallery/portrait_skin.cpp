// portrait_skin FILE: writes the skin of the portrait, from which scripts/portrait.py makes scenes/portrait.glb, as a
// binary PLY file in millimetres.
#include "scene/gallery/bodies.hpp"

#include <bit>
#include <fstream>
#include <iostream>

using namespace nacre::scene::gallery;

namespace {

constexpr std::size_t triangles = 50000;

template <typename... Values> void write(std::ostream& file, const Values&... values) {
    static_assert(std::endian::native == std::endian::little, "the PLY file says so");
    (file.write(reinterpret_cast<const char*>(&values), sizeof values), ...);
}

void writeSkin(std::ostream& file, const Body& body) {
    const Solid& solid = body.solid;
    const std::vector<glm::vec3> colors = openEyedHeadColors(solid.positions);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << solid.positions.size();
    for (const char* property : {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"})
        file << "\nproperty float " << property;
    file << "\nelement face " << solid.triangleCount() << "\nproperty list uchar uint vertex_indices\nend_header\n";
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
        write(file, solid.positions[i], body.normals[i], colors[i]);
    for (std::size_t i = 0; i < solid.indices.size(); i += 3)
        write(file, std::uint8_t(3), solid.indices[i], solid.indices[i + 1], solid.indices[i + 2]);
}

} // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "portrait_skin: needs the name of the file to write\n";
        return 2;
    }
    const Body skin = makeOpenEyedHead(triangles);
    std::ofstream file(arguments[1], std::ios::binary);
    writeSkin(file, skin);
    file.close();
    if (!file) {
        std::cerr << "portrait_skin: cannot write " << arguments[1] << '\n';
        return 1;
    }
}
