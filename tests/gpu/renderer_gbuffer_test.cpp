// What the camera sees: depth under every projection, normals, textures, masks, ids; and the finished picture.
#include "tests/gpu/support/renderer_scenes.hpp"

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class GBuffer : public RendererTest {};

/// A plane tilted about Y, so that depth changes across the picture.
scene::Scene tiltedPlane() {
    scene::Scene scene = darkScene(2);
    add(scene, square(4), glm::rotate(glm::mat4(1), 0.6f, {0, 1, 0}));
    return scene;
}

/// Distance along the view direction, by intersecting the view ray with the plane.
float expectedDepth(const scene::Camera& camera, const Pixels& pixels, std::uint32_t x, std::uint32_t y) {
    const float width = static_cast<float>(pixels.width);
    const float height = static_cast<float>(pixels.height);
    const glm::vec2 ndc(2 * (static_cast<float>(x) + 0.5f) / width - 1 - camera.offCenter.x,
                        1 - 2 * (static_cast<float>(y) + 0.5f) / height - camera.offCenter.y);
    const glm::vec3 normal = glm::vec3(glm::rotate(glm::mat4(1), 0.6f, {0, 1, 0}) * glm::vec4(0, 0, 1, 0));
    const bool perspective = camera.projection == scene::ProjectionKind::Perspective;
    const float half = perspective ? std::tan(camera.verticalFieldOfView / 2) : camera.orthographicHeight / 2;
    const glm::vec3 plane(ndc.x * half * width / height, ndc.y * half, 0);
    const glm::vec3 origin = camera.position + (perspective ? glm::vec3(0) : plane);
    const glm::vec3 ray = glm::vec3(0, 0, -1) + (perspective ? plane : glm::vec3(0));
    return -glm::dot(origin, normal) / glm::dot(ray, normal);
}

void expectDepth(const scene::Scene& scene) {
    const Pixels depth = render(scene, plainSettings()).read(Output::Depth);
    for (std::uint32_t y = 2; y < depth.height; y += 9) {
        for (std::uint32_t x = 2; x < depth.width; x += 9) {
            const float expected = expectedDepth(scene.cameras[0], depth, x, y);
            ASSERT_NEAR(at(depth, x, y), expected, 1e-4f * expected) << x << ", " << y;
        }
    }
}

TEST_F(GBuffer, LinearDepthOfAPerspective) {
    expectDepth(tiltedPlane());
}

TEST_F(GBuffer, LinearDepthOfAnOrthographicProjection) {
    scene::Scene scene = tiltedPlane();
    scene.cameras[0].projection = scene::ProjectionKind::Orthographic;
    scene.cameras[0].orthographicHeight = 0.8f;
    expectDepth(scene);
}

TEST_F(GBuffer, LinearDepthOffCentre) {
    scene::Scene scene = tiltedPlane();
    scene.cameras[0].offCenter = {0.3f, -0.2f};
    expectDepth(scene);
    scene.cameras[0].projection = scene::ProjectionKind::Orthographic;
    scene.cameras[0].orthographicHeight = 0.8f;
    expectDepth(scene);
}

TEST_F(GBuffer, NothingIsInfinitelyFarAndShowsTheSurroundings) {
    scene::Scene scene = darkScene(2);
    add(scene, square(0.5f));
    scene.environment.intensity = 1;
    scene.environment.image = nacre::Image{8, 4, {"R", "G", "B", "A"}, std::vector<float>(8 * 4 * 4, 0.25f)};
    const renderer::Offscreen renderer = render(scene, plainSettings());
    EXPECT_TRUE(std::isinf(at(renderer.read(Output::Depth), 2, 2)));
    EXPECT_EQ(at(renderer.read(Output::Normal), 2, 2, 2), 0);
    EXPECT_NEAR(at(renderer.read(Output::Radiance), 2, 2), 0.25f, 1e-3f);
}

TEST_F(GBuffer, NormalsFollowMapMirrorAndSide) {
    scene::Scene scene = darkScene(2);
    scene::Surface& surface = add(scene, square(4), glm::scale(glm::mat4(1), {-1, 2, 1}));
    scene::Texture texture{.name = "normals", .width = 1, .height = 1, .pixels = {204, 128, 230, 255}};
    surface.normalTexture = 0;
    scene.textures.push_back(texture);
    Pixels normal = render(scene, plainSettings()).read(Output::Normal);
    // The tangent +X is mirrored to -X.
    const glm::vec3 texel = glm::normalize(glm::vec3(204, 127.5f, 230) / 127.5f - 1.0f);
    EXPECT_NEAR(at(normal, 80, 45, 0), -texel.x, 0.01f);
    EXPECT_NEAR(at(normal, 80, 45, 2), texel.z, 0.01f);

    // From behind: single-sided surfaces vanish, double-sided ones turn round.
    scene.cameras[0].position.z = -2;
    EXPECT_TRUE(std::isinf(at(render(scene, plainSettings()).read(Output::Depth), 80, 45)));
    scene.surfaces[0].doubleSided = true;
    normal = render(scene, plainSettings()).read(Output::Normal);
    EXPECT_LT(at(normal, 80, 45, 2), -0.5f);
}

TEST_F(GBuffer, TexturesAreSrgbTransformedAndMultiplied) {
    scene::Scene scene = darkScene(2);
    // As wide as the picture, so that the pixels looked at are the texels' centres.
    scene::Surface& surface = add(scene, square(2.2f));
    surface.baseColor = {0.5f, 1, 1, 1};
    surface.baseColorTexture = 0;
    // Left half grey, right half black; the transform moves the right half to the left.
    scene.textures.push_back(
        {.name = "halves", .width = 2, .height = 1, .srgb = true, .pixels = {188, 188, 188, 255, 0, 0, 0, 255}});
    Pixels albedo = render(scene, plainSettings()).read(Output::Albedo);
    // sRGB 188 is 0.5029 in linear light.
    EXPECT_NEAR(at(albedo, 40, 45, 0), 0.2514f, 0.01f);
    EXPECT_NEAR(at(albedo, 40, 45, 1), 0.5029f, 0.01f);
    EXPECT_NEAR(at(albedo, 120, 45, 1), 0, 0.01f);
    scene.surfaces[0].baseColorUv.transform[2] = {0.5f, 0, 1};
    albedo = render(scene, plainSettings()).read(Output::Albedo);
    EXPECT_NEAR(at(albedo, 40, 45, 1), 0, 0.01f);
    EXPECT_NEAR(at(albedo, 120, 45, 1), 0.5029f, 0.01f);
}

TEST_F(GBuffer, VertexColorsEmissionAndWrapsAreSeen) {
    scene::Scene scene = darkScene(2);
    scene::Mesh mesh = square(2.2f);
    for (scene::Vertex& vertex : mesh.vertices) {
        vertex.uv *= 2.0f;
        vertex.color = {65535, 32768, 0, 65535};
    }
    scene::Surface& surface = add(scene, std::move(mesh));
    surface.baseColor = {1, 1, 1, 1};
    surface.specular = 0;
    surface.emission = {0.5f, 0.5f, 0.5f};
    surface.emissionTexture = 0;
    // Left half white, right half black, mirrored: white is outside, black in the middle.
    scene.textures.push_back({.name = "halves",
                              .width = 2,
                              .height = 1,
                              .wrapU = scene::Wrap::Mirror,
                              .wrapV = scene::Wrap::Clamp,
                              .nearest = true,
                              .pixels = {255, 255, 255, 255, 0, 0, 0, 255}});
    const renderer::Offscreen renderer = render(scene, plainSettings());
    const Pixels albedo = renderer.read(Output::Albedo);
    EXPECT_NEAR(at(albedo, 80, 45, 0), 1, 1e-3f);
    EXPECT_NEAR(at(albedo, 80, 45, 1), 0.5f, 1e-3f);
    EXPECT_NEAR(at(albedo, 80, 45, 2), 0, 1e-3f);
    const Pixels radiance = renderer.read(Output::Radiance);
    for (const std::uint32_t x : {10u, 25u, 135u, 150u}) {
        EXPECT_NEAR(at(radiance, x, 45), 0.5f, 1e-3f) << x;
    }
    for (const std::uint32_t x : {55u, 75u, 85u, 105u}) {
        EXPECT_NEAR(at(radiance, x, 45), 0, 1e-3f) << x;
    }
}

TEST_F(GBuffer, EveryTextureHasCoordinatesOfItsOwn) {
    scene::Scene scene = darkScene(2);
    scene::Mesh mesh = square(2.2f);
    for (scene::Vertex& vertex : mesh.vertices) {
        vertex.secondUv = {vertex.uv.y, vertex.uv.x};
    }
    scene::Surface& surface = add(scene, std::move(mesh));
    surface.baseColor = {1, 1, 1, 1};
    surface.specular = 0;
    surface.emission = {1, 1, 1};
    surface.baseColorTexture = surface.emissionTexture = surface.metallicRoughnessTexture = 0;
    surface.emissionUv.second = true;
    surface.metallicRoughnessUv.transform[0].x = 2;
    surface.metallic = 1;
    // Left half white, right half black.
    scene.textures.push_back(
        {.name = "halves", .width = 2, .height = 1, .nearest = true, .pixels = {255, 255, 255, 255, 0, 0, 0, 255}});
    const renderer::Offscreen renderer = render(scene, plainSettings());
    const Pixels albedo = renderer.read(Output::Albedo);
    const Pixels radiance = renderer.read(Output::Radiance);
    // Metal, which has no diffuse albedo, is left of a quarter and again right of the middle.
    for (const auto& [x, color, emission] : {std::tuple(15u, 0.0f, 1.0f), std::tuple(65u, 1.0f, 1.0f),
                                             std::tuple(95u, 0.0f, 1.0f), std::tuple(145u, 0.0f, 1.0f)}) {
        EXPECT_NEAR(at(albedo, x, 20), color, 1e-3f) << x;
        EXPECT_NEAR(at(radiance, x, 20), emission, 1e-3f) << x;     // v = 0.35
        EXPECT_NEAR(at(radiance, x, 70), 1 - emission, 1e-3f) << x; // v = 0.66
    }
}

TEST_F(GBuffer, MinifiedTexturesShowTheirAverageEverywhere) {
    // Checks that mip levels are right in every pixel of many small triangles, those at their borders too.
    scene::Scene scene = darkScene(2);
    add(scene, square(2, 128)).baseColorTexture = 0;
    scene.surfaces[0].baseColor = glm::vec4(1);
    scene::Texture texture{.name = "gradient", .width = 256, .height = 256};
    for (std::uint32_t y = 0; y < 256; ++y) {
        for (std::uint32_t x = 0; x < 256; ++x) {
            const auto value = static_cast<std::uint8_t>((x + y) % 2 == 0 ? x : x / 2);
            texture.pixels.insert(texture.pixels.end(), {value, value, value, 255});
        }
    }
    scene.textures.push_back(std::move(texture));
    const Pixels albedo = render(scene, plainSettings()).read(Output::Albedo);
    for (std::uint32_t y = 5; y < 85; ++y) {
        for (std::uint32_t x = 30; x < 130; ++x) {
            const glm::vec3 position = onPlane(scene.cameras[0], albedo, x, y, 0);
            ASSERT_NEAR(at(albedo, x, y), 0.75f * (position.x / 2 + 0.5f), 0.05f) << x << ", " << y;
        }
    }
}

TEST_F(GBuffer, MaterialIdsAreIndicesPlusOne) {
    scene::Scene scene = darkScene(2);
    add(scene, square(1), glm::translate(glm::mat4(1), {-0.5f, 0, 0})).material = 1;
    add(scene, square(1), glm::translate(glm::mat4(1), {0.5f, 0, 0}));
    for (const char* name : {"first", "second"}) {
        scene.materials.push_back(Material{.name = name, .description = {}, .layers = {{{1, 1, 1}, 1}}});
    }
    const renderer::Offscreen renderer = render(scene, plainSettings());
    const Pixels id = renderer.read(Output::Material);
    EXPECT_EQ(at(id, 60, 45), 2);
    EXPECT_EQ(at(id, 100, 45), 0);
    EXPECT_EQ(at(id, 2, 2), 0);
    float covered = 0;
    for (const float value : id.values) {
        covered += value != 0 ? 1 : 0;
    }
    EXPECT_FLOAT_EQ(static_cast<float>(renderer.report().subsurfaceCoverage), covered / (160 * 90));
    EXPECT_EQ(renderer.report().triangles, 4);
}

TEST_F(GBuffer, PictureIsTheToneMappedRadiance) {
    scene::Scene scene = darkScene(2);
    add(scene, square(4)).baseColor = glm::vec4(0);
    scene.surfaces[0].specular = 0;
    scene.surfaces[0].emission = {0.5f, 0.5f, 0.5f};
    scene.exposure = 0.5f;
    renderer::RenderSettings settings = plainSettings();
    const Pixels color = render(scene, settings).read(Output::Color);
    // Khronos PBR Neutral takes 0.04 off in its straight part: 0.21 is 0.4963 in sRGB.
    EXPECT_NEAR(at(color, 80, 45), 0.4963f, 0.003f);

    settings.samples = 2;
    const renderer::Offscreen fine = render(scene, settings);
    EXPECT_EQ(fine.read(Output::Color).width, 160);
    EXPECT_EQ(fine.read(Output::Depth).width, 320);
    EXPECT_NEAR(at(fine.read(Output::Color), 80, 45), 0.4963f, 0.003f);
}

} // namespace
} // namespace nacre::tests
