// Importers: normals, tangents, units, views, and models that would bring a process down.
#include "scene/default_view.hpp"
#include "scene/import.hpp"

#include "scene/import_isolated.hpp"
#include "scene/import_mesh.hpp"
#include "scene/surface_material.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <numbers>
#include <random>

using namespace nacre;
using namespace nacre::scene;
namespace fs = std::filesystem;

namespace {

template <typename Action> std::string errorOf(Action action) {
    try {
        action();
    } catch (const SceneError& failure) {
        return failure.what();
    }
    return "";
}

class Import : public testing::Test {
protected:
    fs::path store(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }
    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

/// A sphere of latitude and longitude as a list of facets.
std::vector<std::array<glm::vec3, 3>> sphereFacets(int rows) {
    const auto point = [rows](int i, int j) {
        if (i == 0 || i == rows) {
            return glm::vec3(0, i == 0 ? 1 : -1, 0);
        }
        const float theta = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(rows);
        const float phi = std::numbers::pi_v<float> * static_cast<float>(j % (2 * rows)) / static_cast<float>(rows);
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
    };
    std::vector<std::array<glm::vec3, 3>> facets;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < 2 * rows; ++j) {
            facets.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
            facets.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
        }
    }
    return facets;
}

std::string stl(const std::vector<std::array<glm::vec3, 3>>& facets) {
    std::ostringstream text;
    text.precision(9);
    text << "solid test\n";
    for (const auto& facet : facets) {
        text << "facet normal 0 0 1\nouter loop\n";
        for (const glm::vec3& p : facet) {
            text << "vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
        }
        text << "endloop\nendfacet\n";
    }
    text << "endsolid test\n";
    return text.str();
}

/// A wavy square of `side` by `side` quads as an ASCII PLY without normals.
std::string ply(int side) {
    std::ostringstream text;
    const int count = (side + 1) * (side + 1);
    text << "ply\nformat ascii 1.0\nelement vertex " << count
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << side * side * 2
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < count; ++i) {
        const double x = i % (side + 1);
        const double y = i / (side + 1);
        text << x / side << ' ' << y / side << ' ' << 0.1 * std::sin(x * 6 / side) * std::cos(y * 5 / side) << '\n';
    }
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const int a = y * (side + 1) + x;
            text << "3 " << a << ' ' << a + 1 << ' ' << a + side + 2 << '\n';
            text << "3 " << a << ' ' << a + side + 2 << ' ' << a + side + 1 << '\n';
        }
    }
    return text.str();
}

TEST_F(Import, SmoothsStlOverItsFacets) {
    const Scene scene = loadModel(store("sphere.stl", stl(sphereFacets(24))));
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(triangleCount(scene), 24u * 48 * 2);
    EXPECT_LT(mesh.vertices.size(), 24u * 48 + 100); // positions are shared, not three a facet
    for (const std::uint32_t index : mesh.indices) {
        const Vertex& vertex = mesh.vertices[index];
        EXPECT_GT(glm::dot(vertex.normal, glm::normalize(vertex.position)), 0.99f);
    }
}

TEST_F(Import, KeepsTheEdgesOfABox) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < 8; ++i) {
        text += std::to_string(i & 1) + " " + std::to_string(i >> 1 & 1) + " " + std::to_string(i >> 2) + "\n";
    }
    text += "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
    const Scene scene = loadModel(store("box.ply", text));
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(triangleCount(scene), 12u);
    EXPECT_EQ(mesh.vertices.size(), 24u);
    for (const Vertex& vertex : mesh.vertices) {
        const glm::vec3 n = glm::abs(vertex.normal);
        EXPECT_NEAR(std::max({n.x, n.y, n.z}), 1, 1e-5);
        EXPECT_GT(glm::dot(vertex.normal, vertex.position - glm::vec3(0.5f)), 0);
    }
}

TEST_F(Import, ReadsALargePlyInTime) {
    const fs::path file = store("large.ply", ply(317)); // 200,978 triangles
    const double start = tests::processorSeconds();
    const Scene scene = loadModel(file);
    const double seconds = tests::processorSeconds() - start;
    EXPECT_EQ(triangleCount(scene), 317u * 317 * 2);
    RecordProperty("seconds", std::to_string(seconds));
#if defined(NDEBUG) && !defined(NACRE_SANITIZED)
    EXPECT_LT(seconds, 3);
#endif
}

TEST_F(Import, TakesASensibleUnitWhereNoneIsStated) {
    for (const auto& [scale, metres] : {std::pair(1.0f, 1.0), std::pair(100.0f, 0.01), std::pair(1500.0f, 0.001)}) {
        auto facets = sphereFacets(4);
        for (auto& facet : facets) {
            for (glm::vec3& p : facet) {
                p *= scale;
            }
        }
        const Scene scene = loadModel(store("sphere.stl", stl(facets)));
        EXPECT_DOUBLE_EQ(scene.metersPerUnit, metres);
        EXPECT_EQ(scene.notes.empty(), metres == 1);
    }
}

std::string chunk(std::uint16_t identifier, const std::string& content) {
    const auto length = static_cast<std::uint32_t>(content.size() + 6);
    std::string result(6, '\0');
    std::memcpy(result.data(), &identifier, 2);
    std::memcpy(result.data() + 2, &length, 4);
    return result + content;
}

TEST_F(Import, Turns3dsUprightWhereItsZIsUp) {
    const float positions[]{0, 0, 0, 1, 0, 0, 0, 0, 5};
    const std::uint16_t face[]{0, 1, 2, 0};
    const auto raw = [](const auto& values) {
        return std::string(reinterpret_cast<const char*>(values), sizeof(values));
    };
    const std::string mesh =
        chunk(0x4110, std::string("\3\0", 2) + raw(positions)) + chunk(0x4120, std::string("\1\0", 2) + raw(face));
    const std::string object = chunk(0x4000, std::string("m\0", 2) + chunk(0x4100, mesh));
    const std::string version = chunk(0x3d3e, std::string("\3\0\0\0", 4));
    const Bounds studio = bounds(loadModel(store("studio.3ds", chunk(0x4d4d, chunk(0x3d3d, version + object)))));
    EXPECT_NEAR(studio.high.y, 5, 1e-5);
    const Bounds other = bounds(loadModel(store("other.3ds", chunk(0x4d4d, chunk(0x3d3d, object)))));
    EXPECT_NEAR(other.high.z, 5, 1e-5);
}

TEST_F(Import, NamesTheMissingTexture) {
    store("a.mtl", "newmtl skin\nmap_Kd nowhere.png\n");
    const fs::path file =
        store("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl skin\nf 1/1 2/1 3/1\n");
    EXPECT_EQ(errorOf([&] { loadModel(file); }),
              file.string() + ": material \"skin\": texture \"nowhere.png\" does not exist");
}

TEST_F(Import, PlacesAllGroupsOfRaw) {
    const std::string triangle = "0 0 0 1 0 0 0 1 0\n";
    EXPECT_EQ(triangleCount(loadModel(store("groups.raw", "a\n" + triangle + "b\n" + triangle + "c\n" + triangle))),
              3u);
}

TEST_F(Import, RefusesWhatIsNoModel) {
    const auto sentence = [](const fs::path& file) {
        const std::string error = errorOf([&] { loadModel(file); });
        EXPECT_TRUE(error.starts_with(file.string() + ": ")) << error;
        return error.substr(std::min(error.size(), file.string().size() + 2));
    };
    EXPECT_EQ(sentence(folder / "none.obj"), "cannot be read: No such file or directory");
    EXPECT_EQ(sentence(folder), "cannot be read: it is not a file");
    EXPECT_EQ(sentence(store("empty.ply", "")), "is empty");
    EXPECT_EQ(sentence(store("notes.unheard", "some words")), "is not a model in a format that is known");
    EXPECT_EQ(sentence(store("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n# a line and nothing else\n")),
              "has points or lines, but no triangles");
    EXPECT_NE(sentence(store("bad.gltf", "{\"asset\": ")).find("is not valid JSON"), std::string::npos);
    EXPECT_EQ(sentence(store("bad.glb", "no header here")), "does not begin with a GLB header");
    EXPECT_NE(sentence(store("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")).find("must be finite"),
              std::string::npos);
}

/// Assimp 5.2 reads past the end of truncated binary PLY files and trusts the counts in their headers.
TEST_F(Import, SurvivesDamagedPly) {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                       "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const std::size_t header = text.size();
    const float positions[]{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    text.append(reinterpret_cast<const char*>(positions), sizeof(positions));
    for (const auto& face : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
        text += '\3';
        text.append(reinterpret_cast<const char*>(face.data()), 12);
    }
    EXPECT_EQ(triangleCount(loadModel(store("whole.ply", text))), 2u);
    for (std::size_t size = header; size < text.size(); size += 5) {
        const fs::path file = store("damaged.ply", text.substr(0, size));
        const std::string sentence = errorOf([&] { loadModel(file); });
        EXPECT_TRUE(sentence.empty() || sentence.starts_with(file.string() + ": ")) << sentence;
    }
}

TEST(Isolation, TurnsCrashesIntoSentences) {
    const auto run = [](const std::function<Scene()>& read, const nacre::ProcessLimits& limits = {}) {
        return errorOf([&] { importIsolated("file", limits, read); });
    };
    EXPECT_EQ(run([]() -> Scene { std::abort(); }), "file: is damaged: reading it fails with \"Aborted\"");
    EXPECT_EQ(run([]() -> Scene { throw SceneError("file: own words"); }), "file: own words");
    EXPECT_EQ(run([]() -> Scene { throw std::bad_alloc(); }),
              "file: needs more memory than its size explains; it is probably damaged");
    EXPECT_EQ(run([]() -> Scene { ::_exit(0); }), "file: is damaged: reading it fails");
    const auto spin = []() -> Scene {
        volatile bool forever = true;
        while (forever) {
        }
        return {};
    };
    EXPECT_EQ(run(spin, {1, 1 << 30}), "file: takes too long to read; it is probably damaged");
    const auto sleep = []() -> Scene {
        ::sleep(1000);
        return {};
    };
    EXPECT_EQ(run(sleep, {1, 1 << 30}), "file: takes too long to read; it is probably damaged");
}

TEST(Isolation, EndsWithItsParent) {
    int pipes[2];
    ASSERT_EQ(::pipe(pipes), 0);
    const pid_t parent = ::fork();
    if (parent == 0) {
        ::close(pipes[0]);
        importIsolated("file", {}, [&]() -> Scene {
            (void)!::write(pipes[1], "x", 1);
            ::sleep(1000);
            return {};
        });
        ::_exit(0);
    }
    ::close(pipes[1]);
    char byte = 0;
    EXPECT_EQ(::read(pipes[0], &byte, 1), 1); // the child is reading
    ::kill(parent, SIGTERM);
    ::waitpid(parent, nullptr, 0);
    pollfd end{pipes[0], POLLIN, 0};
    ASSERT_EQ(::poll(&end, 1, 10'000), 1) << "the child goes on without its parent";
    EXPECT_EQ(::read(pipes[0], &byte, 1), 0);
    ::close(pipes[0]);
}

TEST(Isolation, BringsEveryMemberAcross) {
    const auto make = [] {
        Scene scene;
        scene.name = "name";
        scene.meshes.push_back({"mesh", {Vertex{{1, 2, 3}, {0, 0, 1}, {1, 0, 0, -1}, {0.5f, 0.25f}}}, {0, 0, 0}, 0});
        scene.textures.push_back({"texture", 1, 1, true, Wrap::Clamp, Wrap::Mirror, true, {1, 2, 3, 4}});
        Surface surface;
        surface.name = "surface";
        surface.baseColor = {0.1f, 0.2f, 0.3f, 0.4f};
        surface.baseColorTexture = 0;
        surface.alphaMode = AlphaMode::Blend;
        surface.doubleSided = true;
        surface.normalUv = {glm::mat3(2), true};
        scene.surfaces.push_back(surface);
        scene.instances.push_back({"instance", 0, glm::mat4(2)});
        Light light;
        light.name = "light";
        light.kind = LightKind::Spot;
        light.castsShadow = false;
        scene.lights.push_back(light);
        Camera camera;
        camera.name = "camera";
        camera.orthographicHeight = 7;
        scene.cameras.push_back(camera);
        scene.metersPerUnit = 0.01;
        scene.notes = {"note"};
        return scene;
    };
    const Scene scene = importIsolated("file", {}, make);
    EXPECT_EQ(scene.name, "name");
    EXPECT_EQ(scene.meshes.at(0).vertices.at(0).uv, glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(scene.meshes[0].indices.size(), 3u);
    EXPECT_EQ(scene.textures.at(0).pixels, (std::vector<std::uint8_t>{1, 2, 3, 4}));
    EXPECT_EQ(scene.textures[0].wrapU, Wrap::Clamp);
    EXPECT_EQ(scene.textures[0].wrapV, Wrap::Mirror);
    EXPECT_TRUE(scene.textures[0].nearest);
    EXPECT_EQ(scene.surfaces.at(0).name, "surface");
    EXPECT_EQ(scene.surfaces[0].baseColor.w, 0.4f);
    EXPECT_TRUE(scene.surfaces[0].doubleSided);
    EXPECT_EQ(scene.instances.at(0).transform, glm::mat4(2));
    EXPECT_EQ(scene.lights.at(0).kind, LightKind::Spot);
    EXPECT_FALSE(scene.lights[0].castsShadow);
    EXPECT_EQ(scene.cameras.at(0).orthographicHeight, 7);
    EXPECT_DOUBLE_EQ(scene.metersPerUnit, 0.01);
    EXPECT_EQ(scene.notes, std::vector<std::string>{"note"});
}

TEST_F(Import, ShowsTheWholeModel) {
    const Scene scene = load(store("sphere.stl", stl(sphereFacets(8))));
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    float widest = 0;
    for (const Vertex& vertex : scene.meshes[0].vertices) {
        const glm::vec3 ray = glm::normalize(vertex.position - camera.position);
        widest = std::max(widest, std::acos(glm::dot(ray, forward)));
    }
    EXPECT_LE(widest, camera.verticalFieldOfView / 2);
    EXPECT_GE(widest, camera.verticalFieldOfView / 2 * 0.9f);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_GT(glm::dot(scene.lights[0].direction, forward), 0); // key from the front
    EXPECT_LT(glm::dot(scene.lights[2].direction, forward), 0); // back light from behind
}

TEST_F(Import, FitsBrightLightsAmongEachOther) {
    Scene scene = load(store("sphere.stl", stl(sphereFacets(4))));
    scene.lights.resize(2);
    scene.lights[0].color = scene.lights[1].color = glm::vec3(1);
    scene.lights[0].intensity = 2;
    scene.lights[1].intensity = 1;
    fitLights(scene);
    EXPECT_EQ(scene.lights[0].intensity, 2);
    for (const float factor : {1e-3f, 1e5f}) {
        scene.lights[0].intensity = 2 * factor;
        scene.lights[1].intensity = 1 * factor;
        fitLights(scene);
        EXPECT_NEAR(scene.lights[0].intensity, std::numbers::pi * 2 / 3, 1e-5);
        EXPECT_NEAR(scene.lights[1].intensity, std::numbers::pi / 3, 1e-5);
    }
    EXPECT_EQ(scene.exposure, 1); // the sky and built-in lights stay as bright as they look
    EXPECT_EQ(scene.environment.intensity, 1);
}

TEST_F(Import, AssignsAMaterialToEverySurface) {
    Scene scene = load(store("sphere.stl", stl(sphereFacets(4))));
    Material material;
    material.name = "wax";
    material.meanFreePath = Rgb{1, 1, 1};
    material.albedo = {0.9, 0.7, 0.5};
    assignMaterial(scene, material);
    ASSERT_EQ(scene.materials.size(), 1u);
    for (const Surface& surface : scene.surfaces) {
        EXPECT_EQ(surface.material, 0u);
        EXPECT_FLOAT_EQ(surface.baseColor.y, 0.7f);
    }
}

} // namespace
