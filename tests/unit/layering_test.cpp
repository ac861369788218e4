#include "nacre/gaussian.hpp"
#include "nacre/layering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace nacre;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Slab grey(double scattering, double absorption, double thickness, double refractiveIndex = 1) {
    return {{"grey", {scattering, scattering, scattering}, {absorption, absorption, absorption}, refractiveIndex},
            thickness};
}

// The multipole of Donner and Jensen 2005 summed image by image, α′/2 · Σ (sgn z_r·e^{−|z_r|q} − sgn z_v·e^{−|z_v|q}),
// of what meets something inside the slab, from the mean depth of that.
TEST(Slab, EqualsTheSumOfTheMultipoleImages) {
    const Slab slab = grey(2, 0.05, 3, 1.4);
    const double extinction = 2.05;
    const double albedo = 2 / extinction;
    const double extrapolation = 2.0 / 3 * boundaryFactor(1.4) / extinction;
    const double unscattered = std::exp(-3 * extinction);
    const double depth = 1 / extinction - 3 * unscattered / (1 - unscattered);
    for (const double k : {0.0, 0.1, 1.0, 5.0}) {
        const double q = std::sqrt(k * k + 3 * 0.05 * extinction);
        const auto term = [q](double z) { return std::copysign(std::exp(-std::abs(z) * q), z); };
        double reflectance = 0;
        double transmittance = unscattered;
        for (int i = -200; i <= 200; ++i) {
            const double shift = 2 * i * (3 + 2 * extrapolation);
            const double real = shift + depth;
            const double virtualSource = shift - depth - 2 * extrapolation;
            const double half = 0.5 * albedo * (1 - unscattered);
            reflectance += half * (term(real) - term(virtualSource));
            transmittance += half * (term(3 - real) - term(3 - virtualSource));
        }
        const SlabResponse response = slabResponse(slab, 0, k);
        EXPECT_NEAR(response.reflectanceTop, reflectance, 1e-12) << k;
        EXPECT_NEAR(response.transmittanceDown, transmittance, 1e-12) << k;
        EXPECT_DOUBLE_EQ(response.reflectanceTop, response.reflectanceBottom);
        EXPECT_DOUBLE_EQ(response.transmittanceDown, response.transmittanceUp);
    }
}

// Shares that come back and through of a beam that enters an index-matched slab of extinction 1, scattered evenly.
struct Walked {
    double reflectance = 0, transmittance = 0;
};
Walked walkThrough(double thickness, double albedo, int walks) {
    std::mt19937 generator(1);
    const auto uniform = [&] { return (static_cast<double>(generator()) + 0.5) / 4294967296.0; };
    Walked walked;
    for (int i = 0; i < walks; ++i) {
        double z = 0;
        double cosine = 1;
        for (double weight = 1.0 / walks; weight > 1e-4 / walks; weight *= albedo) {
            z -= cosine * std::log(uniform());
            if (z < 0 || z > thickness) {
                (z < 0 ? walked.reflectance : walked.transmittance) += weight;
                break;
            }
            cosine = 2 * uniform() - 1;
        }
    }
    return walked;
}

TEST(Slab, EqualsRandomWalksAtAnyThickness) {
    constexpr int walks = 100000; // a standard deviation of 0.0016 at most
    for (const double absorption : {0.0, 0.01, 0.1}) {
        for (const double thickness : {0.01, 0.1, 0.3, 1.0, 2.0, 4.0, 8.0}) {
            const Walked expected = walkThrough(thickness, 1 - absorption, walks);
            const SlabResponse response = slabResponse(grey(1 - absorption, absorption, thickness), 0, 0);
            // Of an albedo of 0.9 diffusion theory itself, the dipole's too, reflects 0.03 less of a thick slab.
            EXPECT_NEAR(response.reflectanceTop, expected.reflectance, absorption < 0.1 ? 0.012 : 0.035) << thickness;
            EXPECT_NEAR(response.transmittanceDown, expected.transmittance, 0.016) << thickness;
        }
    }
}

TEST(Slab, LetsEverythingThroughAsItBecomesThin) {
    for (const double absorption : {0.0, 1.0}) {
        const SlabResponse response = slabResponse(grey(1, absorption, 1e-6, 1.4), 0, 0, 1, 1.3);
        EXPECT_NEAR(response.transmittanceDown, 1, 1e-5);
        EXPECT_NEAR(response.reflectanceTop, 0, 1e-5);
        EXPECT_GE(response.reflectanceTop, 0);
    }
    const LayeredMedium matched({grey(1, 0, 1e-6), grey(1, 0.1, infinity)});
    EXPECT_NEAR(matched.diffuseReflectance()[0] / LayeredMedium({grey(1, 0.1, infinity)}).diffuseReflectance()[0], 1,
                1e-4);
    // Of a denser body the film has the surface: a beam reflected there, in place of the diffusion's own boundary.
    const LayeredMedium film({grey(1, 0, 1e-6, 1.3), grey(1, 0.1, infinity, 1.3)});
    EXPECT_NEAR(film.diffuseReflectance()[0] / LayeredMedium({grey(1, 0.1, infinity, 1.3)}).diffuseReflectance()[0], 1,
                0.15);
}

TEST(Slab, LosesNothingWithoutAbsorption) {
    for (const double thickness : {0.1, 1.0, 10.0, 1000.0}) {
        for (const double below : {1.0, 1.3, 2.0}) {
            const SlabResponse response = slabResponse(grey(1, 0, thickness, 1.4), 0, 0, 1, below);
            EXPECT_NEAR(response.reflectanceTop + response.transmittanceDown, 1, 1e-9);
            EXPECT_NEAR(response.reflectanceBottom + response.transmittanceUp, 1, 1e-9);
        }
    }
}

TEST(Slab, InfinitelyThickIsTheDipole) {
    for (const MeasuredMedium& measured : jensenMedia()) {
        const LayeredMedium medium({{measured.medium, infinity}});
        const Rgb expected = nacre::diffuseReflectance(measured.medium);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(medium.diffuseReflectance()[channel], expected[channel], 1e-6) << measured.medium.name;
            EXPECT_EQ(medium.diffuseTransmittance()[channel], 0);
        }
    }
    const Medium& skin = jensenMedia()[8].medium;
    const RadialProfile profile = dipoleProfile(skin);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(LayeredMedium({{skin, infinity}}).rmsRadius()[channel] / profile.rmsRadius(channel), 1, 2e-4);
    }
    EXPECT_THROW(LayeredMedium({{skin, infinity}}).transmittanceLayers(4), std::logic_error);
}

// Two half slabs against the whole, index-matched, σa = 0.01 σs′.
TEST(Stack, OfTwoHalvesIsTheWholeAsFarAsDiffusionTheoryGoes) {
    const struct {
        double thickness, reflectance, transmittance;
    } expected[] = {{8, 0.001, 0.07}, {4, 0.005, 0.06}, {2, 0.01, 0.03}, {1, 0.02, 0.02}, {0.1, 0.02, 0.01}};
    for (const auto& [thickness, reflectance, transmittance] : expected) {
        const SlabResponse whole = slabResponse(grey(1, 0.01, thickness), 0, 0);
        const SlabResponse half = slabResponse(grey(1, 0.01, 0.5 * thickness), 0, 0);
        const SlabResponse two = stacked(half, half);
        EXPECT_NEAR(two.reflectanceTop / whole.reflectanceTop, 1, reflectance);
        EXPECT_NEAR(two.transmittanceDown / whole.transmittanceDown, 1, transmittance);
    }
}

// Layered skin's epidermis as one slab, and as two and five.
TEST(Stack, HardlyDependsOnHowASlabIsSplit) {
    const auto epidermis = [](double thickness) {
        return Slab{{"epidermis", {4.8, 6.0, 6.5}, {0.21, 0.21, 0.50}, 1.4}, thickness};
    };
    const Slab upperDermis{{"upper dermis", {3.2, 4.0, 4.6}, {0.016, 0.019, 0.030}, 1.34}, 0.20};
    const Slab bloodyDermis{{"bloody dermis", {0.45, 0.47, 0.48}, {0.0085, 0.10, 2.5}, 1.4}, infinity};
    const LayeredMedium skin = layeredSkin();
    const Rgb whole = skin.diffuseReflectance();
    for (const std::vector<double>& thicknesses :
         {std::vector{0.02, 0.23}, std::vector{0.125, 0.125}, std::vector(5, 0.05)}) {
        std::vector<Slab> slabs;
        for (const double thickness : thicknesses) {
            slabs.push_back(epidermis(thickness));
        }
        slabs.insert(slabs.end(), {upperDermis, bloodyDermis});
        const LayeredMedium split(slabs);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(split.diffuseReflectance()[channel] / whole[channel], 1, 0.1);
            EXPECT_LT(split.reflectanceLayers(8).maxError[channel], 0.006);
        }
        EXPECT_NEAR(split.rmsRadius()[0] / skin.rmsRadius()[0], 1, 0.05);
    }
}

// Diffusion theory's reflectance of so thin a slab on so dark a body rises with the frequency.
TEST(Stack, HasAnRmsRadiusWhereverItReflects) {
    const LayeredMedium thin({grey(6.5, 0.5, 0.02, 1.4), grey(0.48, 2.5, infinity, 1.4)});
    EXPECT_GE(thin.rmsRadius()[0], 0);
    EXPECT_TRUE(std::isinf(LayeredMedium({grey(1, 0, infinity)}).rmsRadius()[0]));
    EXPECT_TRUE(std::isfinite(LayeredMedium({grey(1, 0, 100)}).rmsRadius()[0]));
}

TEST(Stack, DependsOnTheOrderForReflectionAndNotForTransmission) {
    const LayeredMedium one({grey(1, 0.001, 1), grey(3, 0.5, 1)});
    const LayeredMedium other({grey(3, 0.5, 1), grey(1, 0.001, 1)});
    EXPECT_GT(one.diffuseReflectance()[0], 1.1 * other.diffuseReflectance()[0]);
    EXPECT_NEAR(one.diffuseTransmittance()[0], other.diffuseTransmittance()[0], 1e-12);
    EXPECT_DOUBLE_EQ(one.response(0, 0.3).reflectanceBottom, other.response(0, 0.3).reflectanceTop);
}

TEST(Stack, NeverReturnsMoreThanArrives) {
    const LayeredMedium medium({grey(5, 0, 0.5, 1.4), grey(0.5, 0, 2, 1.3), grey(2, 0.001, 3, 1.5)});
    const double returned = medium.diffuseReflectance()[0] + medium.diffuseTransmittance()[0];
    EXPECT_LT(returned, 1);
    EXPECT_GT(returned, 0.95);
}

TEST(Stack, BecomesLayers) {
    const LayeredMedium skin = layeredSkin();
    const LayerFit fitted = skin.reflectanceLayers(8);
    const SumOfGaussiansProfile profile(fitted.layers);
    const Rgb whole = skin.diffuseReflectance();
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_LT(fitted.maxError[channel], 0.003);
        for (const double k : {0.05, 0.5, 2.0}) {
            double transform = 0;
            for (const Layer& layer : profile.layers()) {
                transform += layer.weight[channel] * std::exp(-0.5 * layer.variance * k * k);
            }
            EXPECT_NEAR(transform, skin.response(channel, k).reflectanceTop / whole[channel], 0.003);
        }
    }
    // Red goes furthest and comes back most, as in skin.
    EXPECT_GT(whole[0], whole[1]);
    EXPECT_GT(whole[1], whole[2]);
    EXPECT_GT(profile.rmsRadius(0), profile.rmsRadius(1));
    EXPECT_GT(profile.rmsRadius(1), profile.rmsRadius(2));

    const LayeredMedium sheet({grey(2, 0.05, 1, 1.4), grey(1, 0.01, 1, 1.3)});
    const LayerFit through = sheet.transmittanceLayers(6);
    EXPECT_LT(through.maxError[0], 0.003);
}

TEST(Stack, NamesItsFaults) {
    const auto faultOf = [](std::vector<Slab> slabs) {
        try {
            LayeredMedium medium(std::move(slabs));
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(faultOf({}), "slabs has 0 entries, must have 1 to 32");
    EXPECT_EQ(faultOf({grey(1, 0, 1), grey(1, 0, 0)}), "slabs[1].thickness is 0, must be in [1e-06, inf] mm");
    EXPECT_EQ(faultOf({grey(1, 0, infinity), grey(1, 0, 1)}),
              "slabs[0].thickness is infinite, which only the last may be");
    EXPECT_EQ(faultOf({grey(1, -1, 1)}), "slabs[0].absorption[0] is -1, must be in [0, 1000000] 1/mm");
}

} // namespace
