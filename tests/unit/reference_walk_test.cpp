// The random walk against published figures and theory: half spaces, a slab, a searchlight, white furnaces.
#include "reference/random_walk.hpp"

#include "nacre/burley.hpp"
#include "nacre/media.hpp"
#include "nacre/presets.hpp"
#include "tests/support/mean.hpp"
#include "tests/support/reference_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace {

using namespace nacre;
using namespace nacre::test;
using reference::Boundary;
using reference::Incidents;
using reference::RandomWalk;
using reference::WalkMedium;

constexpr double pi = std::numbers::pi;

#ifdef NACRE_SANITIZED
// The sanitizers, which take many times as long, look at memory: a quarter of the walks, and twice the noise.
constexpr int fewer = 4;
constexpr double noise = 2;
#else
constexpr int fewer = 1;
constexpr double noise = 1;
#endif

/// Chandrasekhar's H function of isotropic scattering (Radiative Transfer, 1950, chapter V), by iterating
/// 1/H(μ) = √(1 − α) + α/2 ∫₀¹ μ′H(μ′)/(μ + μ′) dμ′ on Gauss nodes of μ.
class HFunction {
public:
    explicit HFunction(double albedo) : albedo_(albedo) {
        for (int i = 0; i < nodes; ++i) { // the midpoint rule after μ = t² has no trouble at 0
            const double t = (i + 0.5) / nodes;
            cosines_[i] = t * t;
            weights_[i] = 2 * t / nodes;
            values_[i] = 1;
        }
        for (int iteration = 0; iteration < 2000; ++iteration) {
            std::array<double, nodes> next{};
            for (int i = 0; i < nodes; ++i) {
                next[i] = 0.5 * (values_[i] + at(cosines_[i])); // halfway, for without absorption it would swing
            }
            values_ = next;
        }
    }
    double at(double cosine) const {
        double sum = 0;
        for (int i = 0; i < nodes; ++i) {
            sum += weights_[i] * cosines_[i] * values_[i] / (cosine + cosines_[i]);
        }
        return 1 / (std::sqrt(1 - albedo_) + 0.5 * albedo_ * sum);
    }
    /// Share that a half space returns of a beam that arrives at this cosine.
    double returned(double cosine) const { return 1 - std::sqrt(1 - albedo_) * at(cosine); }
    /// The same of even light: 2 ∫ returned(μ) μ dμ.
    double returnedOfEvenLight() const {
        double sum = 0;
        for (int i = 0; i < nodes; ++i) {
            sum += 2 * weights_[i] * cosines_[i] * (1 - std::sqrt(1 - albedo_) * values_[i]);
        }
        return sum;
    }

private:
    static constexpr int nodes = 64;
    double albedo_;
    std::array<double, nodes> cosines_{};
    std::array<double, nodes> weights_{};
    std::array<double, nodes> values_{};
};

TEST(HFunctionTest, HasChandrasekharsValues) {
    // Radiative Transfer, table XI: H(1) for albedos .9 and 1 (here .99999).
    EXPECT_NEAR(HFunction(0.9).at(1), 1.8501, 2e-3);
    EXPECT_NEAR(HFunction(1 - 1e-9).at(1), 2.9078, 4e-3);
}

WalkMedium mediumOf(const Rgb& albedo, double extinction = 1, double anisotropy = 0) {
    WalkMedium medium;
    medium.albedo = albedo;
    medium.extinction = {extinction, extinction, extinction};
    medium.anisotropy = anisotropy;
    return medium;
}

/// A body whose top is y = 0, and walks into it from above.
class Walks {
public:
    explicit Walks(scene::Mesh mesh, const Material& material = burleyMaterial({1, 1, 1}),
                   Boundary boundary = Boundary::Matched)
        : scene_(makeScene(std::move(mesh), material)),
          geometry_(scene_),
          light_(geometry_),
          walk_(geometry_, light_, boundary, 0) {}

    /// `visit` gets every walk that came out; `direction` makes a direction for each from its random numbers.
    template <typename Direction, typename Visit>
    void run(const WalkMedium& medium, int count, Direction direction, Visit visit) {
        const trace::Place top{{0, 0, 0}, {0, 1, 0}};
        for (int i = 0; i < count; ++i) {
            trace::Random random(3, 0, static_cast<std::uint32_t>(i));
            const glm::dvec3 way = direction(random);
            const auto exit = walk_.walk(medium, 0, top, way, random, incidents_);
            visit(exit, exit ? geometry_.placeOf(exit->hit) : trace::Place{});
        }
    }
    const Incidents& incidents() const { return incidents_; }
    const RandomWalk& walk() const { return walk_; }
    const trace::Geometry& geometry() const { return geometry_; }

private:
    static scene::Scene makeScene(scene::Mesh mesh, const Material& material) {
        scene::Scene scene = darkScene();
        addMesh(scene, std::move(mesh), addSurface(scene, &material));
        scene.environment = evenSurroundings(1 / std::numbers::pi_v<float>);
        return scene;
    }
    scene::Scene scene_;
    trace::Geometry geometry_;
    reference::EntryLight light_;
    RandomWalk walk_;
    Incidents incidents_;
};

scene::Mesh halfSpace() {
    return box({-3000, -3000, -3000}, {3000, 0, 3000});
}

glm::dvec3 evenly(trace::Random& random) {
    return trace::cosineDirection({0, -1, 0}, random);
}

struct HalfSpace {
    Rgb albedo;
    int walks; ///< dark half spaces return few of them
};

class HalfSpaceTest : public testing::TestWithParam<HalfSpace> {};

TEST_P(HalfSpaceTest, ReturnsWhatChandrasekharHas) {
    Walks walks(halfSpace());
    Mean even;
    Mean perpendicular;
    const WalkMedium medium = mediumOf(GetParam().albedo);
    const auto addTo = [](Mean& mean) {
        return [&mean](const std::optional<RandomWalk::Exit>& exit, const trace::Place&) {
            mean.add(exit ? exit->weight : glm::dvec3(0));
        };
    };
    walks.run(medium, GetParam().walks / fewer, evenly, addTo(even));
    walks.run(
        medium, GetParam().walks / fewer, [](trace::Random&) { return glm::dvec3(0, -1, 0); }, addTo(perpendicular));
    for (int channel = 0; channel < 3; ++channel) {
        const HFunction h(GetParam().albedo[channel]);
        SCOPED_TRACE(GetParam().albedo[channel]);
        EXPECT_NEAR(even.value()[channel] / h.returnedOfEvenLight(), 1, 0.01 * noise);
        EXPECT_NEAR(perpendicular.value()[channel] / h.returned(1), 1, 0.01 * noise);
        // What the inversion of docs/theory.md 3 takes for granted.
        EXPECT_NEAR(even.value()[channel], diffuseAlbedo(GetParam().albedo[channel], 0), 0.005 * noise);
    }
    EXPECT_EQ(walks.incidents().lost + walks.incidents().cut + walks.incidents().overlapped, 0u);
}

// Albedos far apart share their flights: what spectral sampling has to stand.
INSTANTIATE_TEST_SUITE_P(Albedos, HalfSpaceTest,
                         testing::Values(HalfSpace{{0.1, 0.1, 0.1}, 400000}, HalfSpace{{0.3, 0.5, 0.7}, 300000},
                                         HalfSpace{{0.9, 0.95, 0.8}, 60000}, HalfSpace{{0.99, 0.999, 0.99}, 40000}),
                         [](const auto& test) { return "Set" + std::to_string(test.index); });

TEST(SlabTest, ReturnsAndLetsThroughWhatVanDeHulstHas) {
    // Optical depth 1, albedo .99, isotropic, lit at a cosine of .5 (van de Hulst 1980, Multiple Light Scattering).
    Walks walks(box({-3000, -1, -3000}, {3000, 0, 3000}));
    Mean mean; // x: returned, y: let through
    const glm::dvec3 direction(std::sqrt(0.75), -0.5, 0);
    walks.run(
        mediumOf({0.99, 0.99, 0.99}), 100000, [&](trace::Random&) { return direction; },
        [&](const std::optional<RandomWalk::Exit>& exit, const trace::Place& place) {
            const double weight = exit ? exit->weight.g : 0;
            mean.add({place.normal.y > 0.5 ? weight : 0, place.normal.y < -0.5 ? weight : 0, 0});
        });
    EXPECT_NEAR(mean.value().x, 0.48652, 0.005);
    EXPECT_NEAR(mean.value().y, 0.49163, 0.005);
    EXPECT_LT(mean.standardError().x, 0.0017);
}

TEST(SlabTest, ChannelsOfDifferentMediaAreEachRight) {
    // Three extinctions in one walk against a walk for each.
    WalkMedium medium = mediumOf({0.9, 0.8, 0.95});
    medium.extinction = {0.3, 1, 4};
    const auto returned = [](const WalkMedium& of, int count) {
        Walks walks(box({-3000, -1, -3000}, {3000, 0, 3000}));
        Mean mean;
        walks.run(of, count, evenly, [&](const std::optional<RandomWalk::Exit>& exit, const trace::Place& place) {
            mean.add(exit && place.normal.y > 0.5 ? exit->weight : glm::dvec3(0));
        });
        return mean;
    };
    const Mean together = returned(medium, 60000 / fewer);
    for (int channel = 0; channel < 3; ++channel) {
        WalkMedium alone = mediumOf(Rgb{medium.albedo[channel], medium.albedo[channel], medium.albedo[channel]},
                                    medium.extinction[channel]);
        const Mean one = returned(alone, 40000 / fewer);
        const double error = std::hypot(one.standardError()[0], together.standardError()[channel]);
        EXPECT_NEAR(together.value()[channel], one.value()[0], 3.5 * error) << channel;
        EXPECT_LT(error / one.value()[0], 0.02 * noise);
    }
}

TEST(SlabTest, ForwardScatteringFollowsSimilarity) {
    // Thick enough for diffusion: g = .8 with five times the events returns nearly what g = 0 does.
    const auto returned = [](const WalkMedium& medium) {
        Walks walks(halfSpace());
        Mean mean;
        walks.run(medium, 20000 / fewer, evenly, [&](const std::optional<RandomWalk::Exit>& exit, const trace::Place&) {
            mean.add(exit ? exit->weight : glm::dvec3(0));
        });
        return mean.value().g;
    };
    const double reduced = reducedAlbedo(0.99, 0.8);
    EXPECT_NEAR(returned(mediumOf({0.99, 0.99, 0.99}, 1, 0.8)), returned(mediumOf({reduced, reduced, reduced})),
                0.015 * noise);
}

TEST(SearchlightTest, SpreadsAsTheFitToItSays) {
    // Christensen and Burley 2015, searchlight: their own fit is right to some 2.5 % of the CDF.
    const double albedo = 0.9;
    Walks walks(halfSpace());
    std::vector<std::pair<double, double>> exits; // radius and weight
    walks.run(
        mediumOf({albedo, albedo, albedo}), 60000, [](trace::Random&) { return glm::dvec3(0, -1, 0); },
        [&](const std::optional<RandomWalk::Exit>& exit, const trace::Place& place) {
            if (exit) {
                exits.emplace_back(std::hypot(place.position.x, place.position.z), exit->weight.g);
            }
        });
    double total = 0;
    for (const auto& [radius, weight] : exits) {
        total += weight;
    }
    const double reflectance = HFunction(albedo).returned(1);
    const double d = 1 / burleyShape(reflectance, BurleyEntry::Searchlight);
    const BurleyProfile burley({d, d, d});
    for (const double radius : {0.5, 1.0, 2.0, 4.0, 8.0}) {
        double within = 0;
        for (const auto& [at, weight] : exits) {
            within += at <= radius ? weight : 0;
        }
        EXPECT_NEAR(within / total, burley.cdf(0, radius), 0.03) << radius;
    }
}

struct Furnace {
    std::string name;
    Boundary boundary;
    Rgb meanFreePath; ///< channels apart share their flights and are noisier
    int walks;
};

class FurnaceTest : public testing::TestWithParam<Furnace> {};

TEST_P(FurnaceTest, NothingIsLostInAWhiteBody) {
    const Material white = burleyMaterial(GetParam().meanFreePath);
    Walks walks(ball(2, 24), white, GetParam().boundary);
    trace::Ray ray;
    ray.origin = {0.3f, 5, 0.4f};
    ray.direction = {0, -1, 0};
    const trace::SurfacePoint point = walks.geometry().surfaceAt(*walks.geometry().visible(ray));
    Mean mean;
    Incidents incidents;
    for (int i = 0; i < GetParam().walks / fewer; ++i) {
        trace::Random random(5, 0, static_cast<std::uint32_t>(i));
        mean.add(walks.walk().radiance(point, false, random, incidents) * pi);
    }
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(mean.value()[channel], 1, 0.005 * noise);
    }
    EXPECT_EQ(incidents.lost + incidents.cut, 0u);
}

INSTANTIATE_TEST_SUITE_P(Bodies, FurnaceTest,
                         testing::Values(Furnace{"Matched", Boundary::Matched, {0.3, 0.3, 0.3}, 3000},
                                         Furnace{"MatchedInColour", Boundary::Matched, {0.4, 0.3, 0.25}, 100000},
                                         Furnace{"Fresnel", Boundary::Fresnel, {0.3, 0.3, 0.3}, 3000}),
                         [](const auto& test) { return test.param.name; });

class AlbedoTest : public testing::TestWithParam<Boundary> {};

TEST_P(AlbedoTest, AThickBodyHasItsSurfacesAlbedo) {
    // The inversions: matched by Kulla and Conty, Fresnel by the dipole, which is less exact.
    Material material = burleyMaterial({0.02, 0.02, 0.02});
    Walks walks(box({-50, -100, -50}, {50, 0, 50}), material, GetParam());
    const reference::MediumModel model(material, GetParam(), 0);
    trace::Ray ray;
    ray.origin = {0.3f, 5, 0.4f};
    ray.direction = {0, -1, 0};
    trace::SurfacePoint point = walks.geometry().surfaceAt(*walks.geometry().visible(ray));
    point.albedo = {0.3f, 0.6f, 0.85f};
    Mean mean;
    Incidents incidents;
    for (std::uint32_t i = 0; i < 20000 / fewer; ++i) {
        trace::Random random(5, 0, i);
        mean.add(walks.walk().radiance(point, false, random, incidents) * pi);
    }
    const double tolerance = GetParam() == Boundary::Matched ? 0.012 * noise : 0.06 * noise;
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(mean.value()[channel], point.albedo[channel], tolerance) << channel;
    }
}

INSTANTIATE_TEST_SUITE_P(Boundaries, AlbedoTest, testing::Values(Boundary::Matched, Boundary::Fresnel),
                         [](const auto& test) { return test.param == Boundary::Matched ? "Matched" : "Fresnel"; });

TEST(MediumModelTest, MeasuredPresetsKeepTheirCoefficients) {
    const Material* preset = findPreset("skin1");
    ASSERT_NE(preset, nullptr);
    ASSERT_NE(reference::findMedium(*preset), nullptr);
    Material scaled = *preset;
    scaled.scale = 2;
    const reference::MediumModel model(scaled, Boundary::Matched, 0);
    const WalkMedium medium = model.at({0.44, 0.22, 0.13});
    EXPECT_NEAR(medium.extinction[0], 0.5 * (0.74 + 0.032), 1e-9);
    EXPECT_NEAR(medium.albedo[0], 0.74 / (0.74 + 0.032), 1e-9);
    EXPECT_NEAR(medium.gain[0] * diffuseAlbedo(medium.albedo[0], 0), 0.44, 1e-9);
    EXPECT_EQ(reference::findMedium(*findPreset("wax")), nullptr);
    EXPECT_EQ(reference::findMedium(*findPreset("skin-burley")), nullptr);
}

TEST(MediumModelTest, LayersOfABurleyProfileGiveItsMeanFreePath) {
    Material material;
    material.layers = burleyLayers({0.7, 0.3, 0.1});
    const reference::MediumModel model(material, Boundary::Matched, 0);
    EXPECT_NEAR(model.length()[0] / 0.7, 1, 0.02);
    EXPECT_NEAR(model.length()[2] / 0.1, 1, 0.02);
    EXPECT_LT(model.profileError(), 0.01);
    // And the medium whose Burley profile has them, by Christensen and Burley's fit.
    const WalkMedium medium = model.at({0.8, 0.5, 0.2});
    const Rgb back = burleyMeanFreePath({0.8, 0.5, 0.2},
                                        {1 / medium.extinction[0], 1 / medium.extinction[1], 1 / medium.extinction[2]});
    EXPECT_NEAR(back[1], model.length()[1], 1e-9);
}

TEST(RandomWalkRulesTest, OpenOverlappingAndNestedBodiesAreTold) {
    const Material material = burleyMaterial({1, 1, 1});
    scene::Scene scene = darkScene();
    const std::uint32_t skin = addSurface(scene, &material);
    const std::uint32_t bone = addSurface(scene, nullptr);
    addMesh(scene, ball(2, 12), skin);
    addMesh(scene, ball(1, 8), bone);
    scene.instances.back().name = "bone";
    {
        trace::Geometry geometry(scene);
        const reference::EntryLight light(geometry);
        const RandomWalk walk(geometry, light, Boundary::Matched, 0);
        ASSERT_EQ(walk.warnings().size(), 1u);
        EXPECT_NE(walk.warnings()[0].find("'bone'"), std::string::npos);
    }
    // A second ball of the same material that sticks out: the walk leaves when it has left both.
    addMesh(scene, ball(2, 12), skin, glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1.5f, 0, 1));
    {
        trace::Geometry geometry(scene);
        const reference::EntryLight light(geometry);
        const RandomWalk walk(geometry, light, Boundary::Matched, 0);
        Incidents incidents;
        int inside = 0;
        for (std::uint32_t i = 0; i < 2000; ++i) {
            trace::Random random(5, 0, i);
            const trace::Place top{{0, 3.5f, 0}, {0, 1, 0}};
            const auto exit = walk.walk(mediumOf({1, 1, 1}), 0, top, {0, -1, 0}, random, incidents);
            ASSERT_TRUE(exit.has_value());
            const glm::vec3 place = geometry.placeOf(exit->hit).position;
            inside += glm::length(place) < 1.9f || glm::length(place - glm::vec3(0, 1.5f, 0)) < 1.9f ? 1 : 0;
        }
        EXPECT_EQ(inside, 0);
        EXPECT_GT(incidents.overlapped, 100u);
    }
    // A plane has no inside to come back from.
    scene::Scene open = darkScene();
    addMesh(open, rectangle({-1, -1}, {1, 1}, 0), addSurface(open, &material));
    trace::Geometry geometry(open);
    const reference::EntryLight light(geometry);
    const RandomWalk walk(geometry, light, Boundary::Matched, 0);
    Incidents incidents;
    for (std::uint32_t i = 0; i < 200; ++i) {
        trace::Random random(5, 0, i);
        walk.walk(mediumOf({1, 1, 1}), 0, {{0, 0, 0}, {0, 1, 0}}, {0, -1, 0}, random, incidents);
    }
    EXPECT_GT(incidents.lost, 20u);
    ASSERT_EQ(walk.warnings().size(), 1u);
    EXPECT_NE(walk.warnings()[0].find("not closed"), std::string::npos);
}

} // namespace
