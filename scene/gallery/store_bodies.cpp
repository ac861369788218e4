// store_bodies FILE: makes the gallery's bodies, once, when Nacre is built, and writes them as stored_bodies.cpp reads
// them.
#include "scene/gallery/stored_bodies.hpp"

#include <algorithm>
#include <fstream>
#include <future>
#include <iostream>
#include <vector>

using namespace nacre::scene::gallery;

namespace {

struct Recipe {
    std::string_view name;
    Body (*make)(std::size_t triangles);
    std::size_t triangles;
};

/// With the stage's these are as many triangles as the thesis's five models have together.
constexpr std::array<Recipe, 5> recipes{{{"head", makeHead, 120000},
                                         {"dragon", makeDragon, 150000},
                                         {"logo", makeLogo, 24000},
                                         {"shell", makeShell, 46000},
                                         {"plant", makePlant, 94542}}};

template <typename T> void write(std::ostream& file, std::span<const T> values) {
    file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
}

void writeBody(std::ostream& file, std::string_view name, const Body& body) {
    StoredBodyHeader header{{},
                            static_cast<std::uint32_t>(body.solid.positions.size()),
                            static_cast<std::uint32_t>(body.solid.indices.size())};
    std::ranges::copy(name, header.name.begin());
    write(file, std::span<const StoredBodyHeader>(&header, 1));
    write(file, std::span<const glm::vec3>(body.solid.positions));
    write(file, std::span<const glm::vec3>(body.normals));
    write(file, std::span<const std::uint32_t>(body.solid.indices));
}

} // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "store_bodies: needs the name of the file to write\n";
        return 2;
    }
    std::array<std::future<Body>, recipes.size()> bodies;
    std::ranges::transform(recipes, bodies.begin(), [](const Recipe& recipe) {
        return std::async(std::launch::async, recipe.make, recipe.triangles);
    });
    std::ofstream file(arguments[1], std::ios::binary);
    for (std::size_t i = 0; i < recipes.size(); ++i) {
        writeBody(file, recipes[i].name, bodies[i].get());
    }
    file.close();
    if (!file) {
        std::cerr << "store_bodies: cannot write " << arguments[1] << '\n';
        return 1;
    }
}
