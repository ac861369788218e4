#include "scene/gallery/gallery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <span>

namespace nacre::scene {
namespace {

const Scene& gallery() {
    static const Scene scene = makeGallery();
    return scene;
}

/// The instances whose surface scatters: the bodies.
std::vector<const Mesh*> bodies() {
    std::vector<const Mesh*> result;
    for (const Instance& instance : gallery().instances) {
        const Mesh& mesh = gallery().meshes[instance.mesh];
        if (gallery().surfaces[mesh.surface].material != none)
            result.push_back(&mesh);
    }
    return result;
}

/// FNV-1a over the bytes.
class Hash {
public:
    template <typename T> void add(std::span<const T> values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (std::size_t i = 0; i < values.size_bytes(); ++i)
            state_ = (state_ ^ bytes[i]) * 0x100000001b3u;
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xcbf29ce484222325u;
};

std::uint64_t hashOf(const Scene& scene) {
    Hash hash;
    for (const Mesh& mesh : scene.meshes) {
        hash.add(std::span(mesh.vertices));
        hash.add(std::span(mesh.indices));
    }
    for (const Texture& texture : scene.textures)
        hash.add(std::span(texture.pixels));
    for (const Instance& instance : scene.instances)
        hash.add(std::span(&instance.transform, 1));
    return hash.value();
}

/// Corners that share a place, whatever their other attributes.
std::vector<std::uint32_t> welded(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.vertices.size()), place(mesh.vertices.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto key = [&](std::uint32_t i) {
        const glm::vec3& p = mesh.vertices[i].position;
        return std::tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < order.size(); ++i)
        place[order[i]] = i > 0 && key(order[i - 1]) == key(order[i]) ? place[order[i - 1]] : order[i];
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t index : mesh.indices)
        indices.push_back(place[index]);
    return indices;
}

} // namespace

TEST(Gallery, HasFiveBodiesAndTheThesissTriangles) {
    EXPECT_EQ(bodies().size(), 5u);
    EXPECT_EQ(triangleCount(gallery()), 436508u);
}

TEST(Gallery, BodiesAreClosed) {
    for (const Mesh* mesh : bodies()) {
        const std::vector<std::uint32_t> indices = welded(*mesh);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (std::size_t i = 0; i < indices.size(); ++i)
            edges.emplace_back(indices[i], indices[i % 3 == 2 ? i - 2 : i + 1]);
        std::sort(edges.begin(), edges.end());
        EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end())
            << mesh->name << ": two triangles run along an edge in the same direction";
        const bool paired = std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
            return std::binary_search(edges.begin(), edges.end(), std::pair(edge.second, edge.first));
        });
        EXPECT_TRUE(paired) << mesh->name << ": an edge has one triangle only";
    }
}

TEST(Gallery, BodiesAreTurnedOutward) {
    for (const Mesh* mesh : bodies()) {
        double volume = 0;
        for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
            const glm::dvec3 a = mesh->vertices[mesh->indices[i]].position,
                             b = mesh->vertices[mesh->indices[i + 1]].position,
                             c = mesh->vertices[mesh->indices[i + 2]].position;
            volume += glm::dot(a, glm::cross(b, c)) / 6;
        }
        EXPECT_GT(volume, 1e-6) << mesh->name; // 1 cm³
    }
}

TEST(Gallery, TrianglesHaveAreaAndVerticesAreFinite) {
    for (const Mesh& mesh : gallery().meshes) {
        ASSERT_EQ(mesh.indices.size() % 3, 0u);
        ASSERT_LT(*std::max_element(mesh.indices.begin(), mesh.indices.end()), mesh.vertices.size());
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.vertices[mesh.indices[i]].position,
                            b = mesh.vertices[mesh.indices[i + 1]].position,
                            c = mesh.vertices[mesh.indices[i + 2]].position;
            const float longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
            ASSERT_GT(glm::length(glm::cross(b - a, c - a)), 1e-4f * longest * longest) << mesh.name << " " << i / 3;
        }
        for (const Vertex& vertex : mesh.vertices) {
            ASSERT_TRUE(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z)) << mesh.name;
            ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-4f) << mesh.name;
            ASSERT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1, 1e-4f) << mesh.name;
            ASSERT_NEAR(glm::dot(glm::vec3(vertex.tangent), vertex.normal), 0, 1e-4f) << mesh.name;
        }
    }
}

TEST(Gallery, IsMadeOfFiveMaterialsOneOfTenLayers) {
    std::set<std::uint32_t> used;
    std::set<std::string> names;
    std::size_t most = 0;
    for (const Mesh* mesh : bodies())
        used.insert(gallery().surfaces[mesh->surface].material);
    for (const std::uint32_t index : used) {
        const Material& material = gallery().materials.at(index);
        EXPECT_EQ(findFault(material), "");
        names.insert(material.name);
        most = std::max(most, material.layers.size());
    }
    EXPECT_GE(names.size(), 5u);
    EXPECT_EQ(most, 10u);
}

TEST(Gallery, IsTheSameEveryTimeButForTheLights) {
    const auto inFront = [](const Light& light) {
        return light.kind == LightKind::Directional ? light.direction.z < 0 : light.position.z > 0;
    };
    const Scene frontLit = makeGallery(GalleryLight::Front);
    EXPECT_EQ(hashOf(gallery()), hashOf(frontLit));
    const std::vector<Light> front = frontLit.lights, back = galleryLights(GalleryLight::Back);
    ASSERT_FALSE(front.empty());
    ASSERT_FALSE(back.empty());
    EXPECT_TRUE(std::all_of(front.begin(), front.end(), inFront));
    EXPECT_TRUE(std::none_of(back.begin(), back.end(), inFront));
    EXPECT_EQ(gallery().lights.size(), front.size() + back.size());
    std::set<LightKind> kinds;
    for (const Light& light : gallery().lights) {
        EXPECT_TRUE(light.castsShadow) << light.name;
        kinds.insert(light.kind);
    }
    EXPECT_EQ(kinds.size(), 3u);
}

TEST(Gallery, FitsTheCamera) {
    ASSERT_FALSE(gallery().cameras.empty());
    const Camera& camera = gallery().cameras.front();
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
    const float height = std::tan(0.5f * camera.verticalFieldOfView), width = height * 16 / 9;
    for (const Instance& instance : gallery().instances) {
        const Mesh& mesh = gallery().meshes[instance.mesh];
        if (gallery().surfaces[mesh.surface].material == none)
            continue;
        for (const Vertex& vertex : mesh.vertices) {
            const glm::vec3 d = glm::vec3(instance.transform * glm::vec4(vertex.position, 1)) - camera.position;
            const float depth = glm::dot(d, forward);
            ASSERT_LT(std::abs(glm::dot(d, right)), width * depth) << instance.name;
            ASSERT_LT(std::abs(glm::dot(d, up)), height * depth) << instance.name;
        }
    }
}

} // namespace nacre::scene
