// What scatter and transmit add up to: no light is taken, none is given twice.
#include "tests/gpu/support/renderer_scenes.hpp"

#include "image/metrics.hpp"
#include "nacre/presets.hpp"
#include "scene/gallery/gallery.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace nacre::tests {
namespace {

using renderer::Output;
using renderer::Pixels;
using Energy = std::array<double, 3>;

class Sum : public RendererTest {};

renderer::RenderSettings sumSettings(std::uint32_t side = 100) {
    renderer::RenderSettings settings = plainSettings();
    settings.width = settings.height = side;
    settings.shadowMapSize = 10 * side;
    settings.scatter = settings.transmit = true;
    return settings;
}

/// A body around the origin that is seen whole from +Z, without specular reflection, of albedo 1.
scene::Scene bodyScene(const scene::Mesh& mesh, float radius, const Material& material) {
    constexpr float distance = 40; // in radii
    scene::Scene scene = darkScene(radius * distance);
    scene.cameras[0].verticalFieldOfView = 2 * std::atan(1.1f / distance);
    scene::Surface& surface = add(scene, mesh);
    surface.material = 0;
    surface.baseColor = glm::vec4(1);
    surface.specular = 0;
    scene.materials.push_back(material);
    return scene;
}

/// A uniform white environment of radiance 1.
void setFurnace(scene::Scene& scene) {
    scene.environment = {};
    scene.environment.zenith = scene.environment.horizon = scene.environment.ground = glm::vec3(1);
}

/// The camera turned about its target's vertical.
scene::Camera turned(scene::Camera camera, double degrees) {
    const auto angle = static_cast<float>(degrees * std::numbers::pi / 180);
    camera.position = camera.target + glm::vec3(glm::rotate(glm::mat4(1), angle, glm::vec3(0, 1, 0)) *
                                                glm::vec4(camera.position - camera.target, 0));
    return camera;
}

void setEffect(renderer::Offscreen& renderer, bool scatter, bool transmit) {
    renderer::EffectSettings settings;
    settings.scatter = scatter;
    settings.transmit = transmit;
    renderer.setEffect(settings);
}

/// Radiance over the pixels with a subsurface material, times pi.
Energy energy(renderer::Offscreen& renderer, const scene::Camera& camera) {
    renderer.render(camera);
    const Pixels radiance = renderer.read(Output::Radiance);
    const Pixels id = renderer.read(Output::Material);
    Energy sum{};
    for (std::size_t i = 0; i < radiance.values.size(); ++i) {
        sum[i % 3] += id.values[i / 3] != 0 ? static_cast<double>(pi * radiance.values[i]) : 0;
    }
    return sum;
}

double largestRmsRadius(const Material& material) {
    const auto profile = makeProfile(material);
    return std::max({profile->rmsRadius(0), profile->rmsRadius(1), profile->rmsRadius(2)});
}

// --- Closed bodies: light changes its place, not its amount ---

/// What switching the effect on adds, over what a light from the camera's side shows. (Over what the same light shows
/// it would be without meaning from behind, where that is next to nothing.)
void expectSameEnergy(scene::Scene scene, const std::string& what) {
    scene.lights = {directional({0, 0, -1})};
    renderer::Offscreen renderer(device(), scene, sumSettings());
    Energy front{};
    for (const double degrees : {0.0, 90.0, 180.0}) {
        const scene::Camera camera = turned(scene.cameras[0], degrees);
        setEffect(renderer, false, false);
        const Energy off = energy(renderer, camera);
        setEffect(renderer, true, true);
        const Energy on = energy(renderer, camera);
        front = degrees == 0 ? off : front;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR((on[channel] - off[channel]) / front[channel], 0, 0.01)
                << what << ", light " << degrees << " degrees from the camera, channel " << channel;
        }
    }
}

TEST_F(Sum, ClosedBodiesKeepTheirLight) {
    for (const char* name : {"skin", "marble", "jade", "whole-milk"}) {
        const Material& material = *findPreset(name);
        const auto radius = static_cast<float>(10 * largestRmsRadius(material) * 1e-3); // 20 rms radii across
        expectSameEnergy(bodyScene(sphere(radius, 64), radius, material), name + std::string(" ball"));
        expectSameEnergy(bodyScene(box(glm::vec3(1.4f * radius)), radius, material), name + std::string(" box"));
    }
}

TEST_F(Sum, HeadsKeepTheirLight) {
    for (const char* name : {"skin", "marble"}) {
        scene::Scene scene = scene::makeGallery();
        std::erase_if(scene.instances, [](const scene::Instance& instance) { return instance.name != "head"; });
        ASSERT_EQ(scene.instances.size(), 1);
        scene::Surface& surface = scene.surfaces[scene.meshes[scene.instances[0].mesh].surface];
        surface.specular = 0;
        const scene::Bounds bounds = scene::bounds(scene);
        scene.environment.intensity = 0;
        scene.cameras = {{.name = "camera",
                          .position = bounds.center() + glm::vec3(0, 0, 10 * bounds.radius()),
                          .target = bounds.center(),
                          .verticalFieldOfView = 0.2f}};
        scene.materials[surface.material] = *findPreset(name);
        expectSameEnergy(scene, name + std::string(" head"));
        setFurnace(scene);
        scene.lights.clear();
        renderer::Offscreen renderer(device(), scene, sumSettings());
        const Energy on = energy(renderer, scene.cameras[0]);
        setEffect(renderer, false, false);
        const Energy off = energy(renderer, scene.cameras[0]);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(on[channel] / off[channel], 1, 0.01) << name << " head in a furnace, channel " << channel;
        }
    }
}

// --- A white furnace is white ---

/// But for what ambient occlusion finds at silhouettes, which is in the irradiance with and without the effect.
void expectWhite(const scene::Scene& scene, const std::string& what) {
    const renderer::Offscreen renderer = render(scene, sumSettings());
    const Pixels radiance = renderer.read(Output::Radiance);
    const Pixels specular = renderer.read(Output::Specular); // at grazing angles every surface reflects
    const Pixels irradiance = renderer.read(Output::Irradiance);
    const Pixels id = renderer.read(Output::Material);
    Energy diffuse{}, arriving{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < radiance.values.size(); ++i) {
        if (id.values[i / 3] == 0) {
            continue;
        }
        ++count;
        diffuse[i % 3] += static_cast<double>(pi * (radiance.values[i] - specular.values[i]));
        arriving[i % 3] += static_cast<double>(irradiance.values[i]);
        ASSERT_NEAR(radiance.values[i] - specular.values[i], 1, 0.1) << what << ", pixel " << i / 3;
    }
    EXPECT_GT(count, 3000) << what;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(diffuse[channel] / arriving[channel], 1, 0.01) << what << ", channel " << channel;
        EXPECT_NEAR(3 * arriving[channel] / static_cast<double>(count), std::numbers::pi, 0.02 * std::numbers::pi)
            << what;
    }
}

TEST_F(Sum, BallsAreWhiteInAFurnace) {
    for (const char* name : {"skin", "wax"}) {
        scene::Scene scene = bodyScene(sphere(0.01f, 64), 0.01f, *findPreset(name));
        setFurnace(scene);
        expectWhite(scene, name);
    }
}

TEST_F(Sum, ThinWallsAreWhiteInAFurnace) {
    for (const double share : {0.0, 0.4, 1.0}) {
        Material material = *findPreset("leaf");
        material.diffuseTransmission = share;
        scene::Scene scene = bodyScene(square(0.02f), 0.014f, material);
        scene.surfaces[0].doubleSided = true;
        scene.surfaces[0].thickness = 0.01f;
        setFurnace(scene);
        expectWhite(scene, "a wall that lets through " + std::to_string(share));
    }
}

TEST_F(Sum, ASheetUnderTheSkyIsAsBrightAsWithoutTransmit) {
    scene::Scene scene = bodyScene(square(0.02f), 0.014f, *findPreset("leaf"));
    scene.surfaces[0].doubleSided = true;
    scene.surfaces[0].baseColor = {0.22f, 0.42f, 0.08f, 1};
    setFurnace(scene);
    scene.lights = {directional({0, 0, -1}, 0)};
    renderer::Offscreen renderer(device(), scene, sumSettings());
    const Energy on = energy(renderer, scene.cameras[0]);
    setEffect(renderer, true, false);
    const Energy off = energy(renderer, scene.cameras[0]);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(on[channel] / off[channel], 1, 0.01) << channel;
    }
}

// --- Thin walls divide the light, each side in its colour ---

TEST_F(Sum, ThinWallsDivideTheLightOfALamp) {
    constexpr double share = 0.25;
    Material material = *findPreset("leaf");
    material.diffuseTransmission = share;
    material.diffuseTransmissionColor = Rgb{0.1, 0.9, 0.5};
    const glm::vec3 color(0.8f, 0.4f, 0.2f);
    for (const float side : {1.0f, -1.0f}) {
        scene::Scene scene = bodyScene(square(0.02f), 0.014f, material);
        scene.surfaces[0].doubleSided = true;
        scene.surfaces[0].baseColor = glm::vec4(color, 1);
        scene.surfaces[0].thickness = 0.001f;
        scene.lights = {directional({0, 0, -side}, pi)};
        const Pixels radiance = render(scene, sumSettings()).read(Output::Radiance);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double reflected = (1 - share) * static_cast<double>(color[static_cast<int>(channel)]);
            const double through = share * (*material.diffuseTransmissionColor)[channel];
            EXPECT_NEAR(at(radiance, 50, 50, channel), side > 0 ? reflected : through, 0.01) << side << ' ' << channel;
        }
    }
}

// --- Balls against the integral of their profile over the whole surface, hidden entry points included ---

/// Mean of max(0, a + b·cos φ) over all φ, b ≥ 0.
double positiveMean(double a, double b) {
    if (std::abs(a) >= b) {
        return std::max(a, 0.0);
    }
    const double phi = std::acos(-a / b);
    return (a * phi + b * std::sin(phi)) / std::numbers::pi;
}

/// ∫ R(|x − y|) max(0, n_y·l) dA over a sphere, where n_x·l is `cosine`. Points at a chord r from x lie on a circle,
/// and the area between two chords is that of the plane, 2πr dr; so rings weigh as much as the profile's CDF grows.
double ballIrradiance(const Profile& profile, int channel, double diameter, double cosine) {
    constexpr int rings = 400;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const auto chordAt = [&](double ring) { return diameter * ring * ring / (rings * rings); };
    double sum = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const double share = profile.cdf(channel, chordAt(ring + 1)) - profile.cdf(channel, chordAt(ring));
        const double angle = 2 * std::asin(std::min(1.0, chordAt(ring + 0.5) / diameter));
        sum += share * positiveMean(std::cos(angle) * cosine, std::sin(angle) * sine);
    }
    return sum;
}

/// The same as a table over the cosine.
class BallTable {
public:
    BallTable(const Profile& profile, int channel, double diameter) {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            values_[i] = ballIrradiance(profile, channel, diameter, 2.0 * static_cast<double>(i) / last - 1);
        }
    }
    double at(double cosine) const {
        const double place = 0.5 * (std::clamp(cosine, -1.0, 1.0) + 1) * last;
        const auto i = std::min(static_cast<std::size_t>(place), values_.size() - 2);
        const double share = place - static_cast<double>(i);
        return (1 - share) * values_[i] + share * values_[i + 1];
    }

private:
    static constexpr double last = 512;
    std::array<double, 513> values_{};
};

struct BallError {
    Energy ratio{};           ///< energy of scattered + transmitted over the integral's
    double decibels = 0;      ///< PSNR of scattered + transmitted, peak = the integral's largest value
    double scatteredOnly = 0; ///< PSNR of scattered
};

/// A ball under a light from +Z.
class Ball {
public:
    Ball(const Material& material, double diameter)
        : scene_(ballScene(material, static_cast<float>(0.5e-3 * diameter))),
          renderer_(device(), scene_, sumSettings(200)) {
        const auto profile = makeProfile(material);
        for (int channel = 0; channel < 3; ++channel) {
            tables_.emplace_back(*profile, channel, diameter);
        }
    }

    /// As a camera sees it that stands `degrees` from the light.
    BallError measure(double degrees);

private:
    static scene::Scene ballScene(const Material& material, float radius) {
        scene::Scene scene = bodyScene(sphere(radius, 128), radius, material);
        scene.lights = {directional({0, 0, -1})};
        return scene;
    }

    scene::Scene scene_;
    renderer::Offscreen renderer_;
    std::vector<BallTable> tables_;
};

BallError Ball::measure(double degrees) {
    renderer_.render(turned(scene_.cameras[0], degrees));
    const Pixels normal = renderer_.read(Output::Normal);
    const Pixels scattered = renderer_.read(Output::Scattered);
    const Pixels transmitted = renderer_.read(Output::Transmitted);
    const Pixels id = renderer_.read(Output::Material);
    Energy ours{}, exact{};
    double peak = 0, count = 0, squares = 0, squaresScattered = 0;
    for (std::size_t i = 0; i < scattered.values.size(); ++i) {
        const std::size_t pixel = i / 3, channel = i % 3;
        if (id.values[pixel] == 0) {
            continue;
        }
        const glm::vec3 n(normal.values[3 * pixel], normal.values[3 * pixel + 1], normal.values[3 * pixel + 2]);
        const double expected = tables_[channel].at(static_cast<double>(glm::normalize(n).z));
        const auto alone = static_cast<double>(scattered.values[i]);
        const double sum = alone + static_cast<double>(transmitted.values[i]);
        ours[channel] += sum;
        exact[channel] += expected;
        squares += (sum - expected) * (sum - expected);
        squaresScattered += (alone - expected) * (alone - expected);
        peak = std::max(peak, expected);
        ++count;
    }
    BallError error{.decibels = psnr(squares / count, peak), .scatteredOnly = psnr(squaresScattered / count, peak)};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        error.ratio[channel] = ours[channel] / exact[channel];
    }
    return error;
}

TEST_F(Sum, BallsHaveTheLightOfTheSurfaceIntegral) {
    const Material& material = *findPreset("skin-burley");
    const auto profile = makeProfile(material);
    for (const double diameter : {2.0, 5.0, 10.0, 20.0, 50.0}) {
        Ball ball(material, diameter);
        for (const double degrees : {0.0, 60.0, 90.0}) {
            const BallError error = ball.measure(degrees);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                // What the camera does not see is taken to be lit like what it sees, which is far from true where a
                // body is hardly larger than the profile (docs/theory.md, "The sum").
                const double width = diameter / profile->rmsRadius(static_cast<int>(channel));
                const double tolerance = width > 7 ? 0.01 : width > 3.5 ? 0.07 : width > 1.7 ? 0.25 : 0.9;
                EXPECT_NEAR(error.ratio[channel], 1, tolerance)
                    << diameter << " mm, light at " << degrees << " degrees, channel " << channel;
            }
        }
    }
}

// Beyond the terminator of a ball lit from the side, light enters where the camera sees it: scatter has it already.
TEST_F(Sum, NoLightIsCountedTwice) {
    for (const double diameter : {5.0, 10.0, 40.0}) {
        const BallError error = Ball(*findPreset("skin-burley"), diameter).measure(90);
        EXPECT_GT(error.decibels, error.scatteredOnly - 3.5) << diameter;
        EXPECT_GT(error.decibels, diameter < 10 ? 37 : 48) << diameter;
    }
}

} // namespace
} // namespace nacre::tests
