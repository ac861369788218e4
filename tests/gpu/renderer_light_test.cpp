// Light that comes through bodies, where shadow maps tell little or something else stands in the way.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "nacre/presets.hpp"

#include <algorithm>
#include <string>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;

class ThroughLight : public RendererTest {};

/// Pixels of `transmitted` where the subsurface body is, seen from +Z; red.
struct Seen {
    Pixels light, id;

    float at(std::uint32_t x, std::uint32_t y) const { return tests::at(light, x, y); }
    std::vector<float> ofBody() const {
        std::vector<float> result;
        for (std::size_t i = 0; i < id.values.size(); ++i) {
            if (id.values[i] != 0) {
                result.push_back(light.values[3 * i]);
            }
        }
        return result;
    }
    float largest() const { return std::ranges::max(ofBody()); }
    double shareAbove(float value) const {
        const std::vector<float> body = ofBody();
        return static_cast<double>(std::ranges::count_if(body, [&](float light_) { return light_ > value; })) /
               static_cast<double>(body.size());
    }
};

Seen transmitted(const scene::Scene& scene) {
    renderer::RenderSettings settings = plainSettings();
    settings.transmit = true;
    const renderer::Offscreen renderer = render(scene, settings);
    return {renderer.read(Output::Transmitted), renderer.read(Output::Material)};
}

/// A scene of one subsurface body that is seen whole.
scene::Scene bodyScene(const scene::Mesh& mesh, float height, const char* material) {
    scene::Scene scene = darkScene(2);
    scene.cameras[0].projection = scene::ProjectionKind::Orthographic;
    scene.cameras[0].orthographicHeight = height;
    add(scene, mesh).material = 0;
    scene.materials = {*findPreset(material)};
    return scene;
}

glm::mat4 at(const glm::vec3& place) {
    return glm::translate(glm::mat4(1), place);
}

/// Directional, spot and point lights behind the origin, of about the same strength there.
std::vector<scene::Light> backLights() {
    std::vector<scene::Light> lights{directional({0.1f, -0.05f, 1}, 1), spot({-0.2f, 0.1f, -2}, {0.1f, -0.05f, 1}, 4),
                                     point({-0.2f, 0.1f, -2}, 4)};
    return lights;
}

// A sheet that stands before everything else is lit all over, but where something stands in the way.
TEST_F(ThroughLight, SheetsShineWithTheShadowsOfWhatIsBehindThem) {
    scene::Scene scene = bodyScene(square(1), 1.2f, "leaf");
    scene.surfaces[0].doubleSided = true;
    add(scene, box({0.1f, 0.2f, 0.01f}), at({0.1f, 0, -0.1f}));
    for (const scene::Light& light : backLights()) {
        scene.lights = {light};
        const Seen seen = transmitted(scene);
        EXPECT_GT(seen.shareAbove(0.3f), 0.95) << light.name;
        EXPECT_LT(seen.at(88, 45), 1e-3f) << light.name;
    }
}

// An authored thickness says how thick the receiver's own body is. What is much farther is another one.
TEST_F(ThroughLight, WallsShadowBodiesOfAuthoredThickness) {
    for (const bool wall : {false, true}) {
        for (const float thickness : {0.5f, 4.0f}) {
            scene::Scene scene = bodyScene(box({0.1f, 0.1f, 1e-3f * thickness}), 0.15f, "skin");
            scene.surfaces[0].thickness = thickness;
            if (wall) {
                add(scene, box({1.2f, 1.2f, 0.1f}), at({0, 0, -0.3f}));
            }
            for (const scene::Light& light : backLights()) {
                if (!wall && light.kind != scene::LightKind::Directional) {
                    continue;
                }
                scene.lights = {light};
                const Seen seen = transmitted(scene);
                if (wall) {
                    EXPECT_LT(seen.largest(), 1e-3f) << light.name << ", " << thickness << " mm";
                } else {
                    EXPECT_GT(seen.at(80, 45), thickness < 1 ? 0.3f : 0.01f)
                        << light.name << ", " << thickness << " mm";
                }
            }
        }
    }
}

// Where texels are larger than the profile is wide, a body is as thick as it is authored, or dark.
TEST_F(ThroughLight, CoarseMapsLeaveBodiesDark) {
    for (const float thickness : {-1.0f, 200.0f, 0.5f}) {
        scene::Scene scene = bodyScene(sphere(0.1f, 24), 0.24f, "skin");
        scene.surfaces[0].thickness = thickness;
        add(scene, box(glm::vec3(10)), at({300, 0, 0}));
        scene.lights = {directional({0.3f, -0.4f, 1})};
        const Seen seen = transmitted(scene);
        if (thickness == 0.5f) { // as thin as it is said to be
            EXPECT_GT(seen.at(80, 45), 0.2f);
        } else {
            EXPECT_LT(seen.at(80, 45), 1e-3f) << thickness;
            EXPECT_LT(seen.largest(), 5e-3f) << thickness;
        }
    }
}

// Light that reaches the inside of a body through a hole in its mesh does not enter there.
TEST_F(ThroughLight, BackSidesAreNoEntry) {
    for (const bool mirrored : {false, true}) {
        scene::Mesh bust = sphere(0.1f, 32);
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i + 2 < bust.indices.size(); i += 3) {
            if (bust.vertices[bust.indices[i]].position.y > -0.06f) {
                kept.insert(kept.end(), bust.indices.begin() + static_cast<std::ptrdiff_t>(i),
                            bust.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
            }
        }
        bust.indices = kept;
        scene::Scene scene = bodyScene(bust, 0.24f, "skin");
        scene.instances[0].transform = glm::scale(glm::mat4(1), {mirrored ? -1.0f : 1.0f, 1, 1});
        for (const scene::Light& light :
             {directional({0, 1, -0.2f}), spot({0, -1, 0.2f}, {0, 1, -0.2f}), point({0, -1, 0.2f})}) {
            if (mirrored && light.kind != scene::LightKind::Directional) {
                continue;
            }
            scene.lights = {light};
            const Seen seen = transmitted(scene);
            float crown = 0;
            for (std::uint32_t y = 0; y < 30; ++y) {
                for (std::uint32_t x = 0; x < 160; ++x) {
                    crown = std::max(crown, seen.at(x, y));
                }
            }
            EXPECT_LT(crown, 1e-3f) << light.name << (mirrored ? ", mirrored" : "");
        }
    }
}

// What is near a lamp shadows what is far from it, in a large scene, too.
TEST_F(ThroughLight, LampsShadowWithWhatIsNearThem) {
    scene::Scene scene = bodyScene(square(0.1f), 0.15f, "leaf");
    scene.surfaces[0].doubleSided = true;
    add(scene, box(glm::vec3(10)), at({300, 0, 0}));
    for (const bool covered : {false, true}) {
        if (covered) {
            add(scene, box({0.03f, 0.03f, 0.001f}), at({0, 0, -0.49f}));
        }
        for (const scene::Light& light : {spot({0, 0, -0.5f}, {0, 0, 1}), point({0, 0, -0.5f})}) {
            scene.lights = {light};
            const float middle = transmitted(scene).at(80, 45);
            EXPECT_TRUE(covered ? middle < 1e-3f : middle > 1) << light.name << ' ' << middle;
        }
    }
}

// A cone up to 90 degrees wide is shadowed to its rim.
TEST_F(ThroughLight, WideConesAreShadowedToTheirRim) {
    constexpr float rim = 86.2f; // degrees, at the column below
    const auto column = static_cast<std::uint32_t>(80 + 0.45f / 1.2f * 90);
    for (const float degrees : {80.0f, 88.0f, 90.0f}) {
        scene::Scene scene = bodyScene(square(1), 1.2f, "leaf");
        scene::Light light = spot({0, 0, 0.03f}, {0, 0, -1}, 0.01f);
        light.outerConeAngle = light.innerConeAngle = degrees * pi / 180;
        scene.lights = {light};
        const float lit = tests::at(render(scene, plainSettings()).read(Output::Irradiance), column, 45);
        EXPECT_EQ(lit > 0, degrees > rim) << degrees << ' ' << lit;
        add(scene, box({0.02f, 0.05f, 0.02f}), at({0.3f, 0, 0.02f}));
        const Pixels shadowed = render(scene, plainSettings()).read(Output::Irradiance);
        EXPECT_EQ(tests::at(shadowed, column, 45), 0) << degrees;
        EXPECT_GT(tests::at(shadowed, 90, 45), 0) << degrees;
    }
}

// Surroundings that are bright above shine through a slab that is seen from below, as far as its thickness lets them.
TEST_F(ThroughLight, SurroundingsShineThroughLocalThickness) {
    scene::Scene scene = bodyScene(box({0.2f, 0.001f, 0.2f}), 0.1f, "skin-burley");
    scene.surfaces[0].baseColor = glm::vec4(1);
    scene.surfaces[0].specular = 0;
    scene.environment = {};
    scene.environment.zenith = glm::vec3(2);
    scene.environment.horizon = scene.environment.ground = glm::vec3(0.5f);
    scene.cameras[0].up = {0, 0, -1};
    scene.cameras[0].position = {0, 2, 0};
    const float above = tests::at(render(scene, plainSettings()).read(Output::Irradiance), 80, 45);
    scene.cameras[0].position = {0, -2, 0};
    renderer::RenderSettings settings = plainSettings();
    settings.scatter = settings.transmit = true;
    const auto profile = makeProfile(scene.materials[0]);
    for (const float thickness : {-1.0f, 0.3f, 1.0f}) {
        scene.surfaces[0].thickness = thickness;
        const renderer::Offscreen renderer = render(scene, settings);
        const Pixels radiance = renderer.read(Output::Radiance);
        const float below = tests::at(renderer.read(Output::Irradiance), 80, 45);
        EXPECT_GT(above, 1.2f * below);
        for (int channel = 0; channel < 3; ++channel) {
            const double through = profile->slabTransmittance(channel, static_cast<double>(thickness));
            const float share = thickness < 0 ? 0.0f : static_cast<float>(through);
            EXPECT_NEAR(pi * tests::at(radiance, 80, 45, static_cast<std::size_t>(channel)),
                        (1 - share) * below + share * above, 0.02f * above)
                << thickness << " mm, channel " << channel;
        }
    }
}

} // namespace
} // namespace nacre::tests
