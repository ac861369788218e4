// Slabs of physical media, skin by its content, and the materials they make.
#include "nacre/gaussian.hpp"
#include "nacre/layering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace nacre;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// 1/mm, from the sources' formulas and tables with a calculator.
constexpr Rgb eumelanosomes{35.03, 49.45, 89.65};
constexpr Rgb pheomelanosomes{17.06, 27.90, 65.21};
constexpr Rgb oxygenatedBlood{0.8065, 23.034, 23.818};
constexpr Rgb deoxygenatedBlood{5.0569, 28.601, 12.524};
constexpr Rgb baseline{0.03310, 0.04593, 0.10825};
constexpr Rgb pureWater{2.493e-4, 4.478e-5, 2.694e-5};

void expectRgb(const Rgb& value, const Rgb& expected, double relative) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(value[channel], expected[channel], relative * expected[channel]) << channel;
    }
}

TEST(Skin, AbsorbsAsItsChromophoresDo) {
    expectRgb(skinAbsorption({}), baseline, 1e-3);
    expectRgb(skinAbsorption({.melanin = 1}), eumelanosomes, 1e-3);
    expectRgb(skinAbsorption({.melanin = 1, .eumelanin = 0}), pheomelanosomes, 1e-3);
    expectRgb(skinAbsorption({.haemoglobin = 1, .oxygenation = 1}), oxygenatedBlood, 1e-3);
    expectRgb(skinAbsorption({.haemoglobin = 1, .oxygenation = 0}), deoxygenatedBlood, 1e-3);
    Rgb wet = skinAbsorption({.water = 1});
    for (std::size_t channel = 0; channel < 3; ++channel) {
        wet[channel] -= skinAbsorption({})[channel];
    }
    expectRgb(wet, pureWater, 1e-3);
    Rgb mixed;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        mixed[channel] = 0.1 * (0.25 * pheomelanosomes[channel] + 0.75 * eumelanosomes[channel]) +
                         0.2 * (0.6 * oxygenatedBlood[channel] + 0.4 * deoxygenatedBlood[channel]) +
                         0.7 * baseline[channel];
    }
    expectRgb(skinAbsorption({.melanin = 0.1, .eumelanin = 0.75, .haemoglobin = 0.2, .oxygenation = 0.6}), mixed, 1e-3);
    expectRgb(skinReducedScattering(), {3.468, 4.017, 5.179}, 1e-3);
}

TEST(Skin, RefusesContentThatIsNone) {
    EXPECT_EQ(findFault(SkinContent{.melanin = 2}), "melanin is 2, must be in [0, 1]");
    EXPECT_EQ(findFault(SkinContent{.melanin = 0.6, .haemoglobin = 0.5}),
              "melanin + haemoglobin is 1.1, must be in [0, 1]");
    EXPECT_THROW(skinAbsorption({.oxygenation = -1}), std::invalid_argument);
    EXPECT_EQ(findFault(std::vector<Slab>{{.medium = {"", {1, 1, 1}, {}, 1.4, {0, 1, 0}}, .thickness = 1}}),
              "slabs[0].anisotropy[1] is 1, must be in [-0.99, 0.99]");
}

// Fair and dark skin: melanin in the epidermis takes light of every colour, and most of the blue.
TEST(Skin, DarkensWithMelanin) {
    const auto albedo = [](double melanin) {
        return LayeredMedium({makeSkinSlab({.melanin = melanin}, 0.1),
                              makeSkinSlab({.haemoglobin = 0.02, .water = 0.65}, infinity)})
            .diffuseReflectance();
    };
    const Rgb fair = albedo(0.01);
    const Rgb dark = albedo(0.3);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_LT(dark[channel], 0.7 * fair[channel]);
    }
    EXPECT_GT(fair[0], fair[1]);
    EXPECT_GT(fair[0], 0.4);
    EXPECT_LT(dark[2] / fair[2], dark[0] / fair[0]);
}

// The multipole of a half space is the dipole, whose CDF is known in closed form.
TEST(Slab, OfAHalfSpaceHasTheDipolesCdf) {
    for (const MeasuredMedium& measured : {jensenMedia()[0], jensenMedia()[8]}) {
        const LayeredMedium stack({{measured.medium, infinity}});
        for (int channel = 0; channel < 3; ++channel) {
            for (const double r : {1e-3, 0.05, 0.3, 1.0, 4.0, 20.0}) {
                EXPECT_NEAR(stack.reflectanceCdf(channel, r), dipoleCdf(measured.medium, channel, r), 1e-4)
                    << measured.medium.name << channel << ", " << r;
            }
        }
    }
}

TEST(Slab, DescribesAMaterial) {
    Material material;
    material.meanFreePath = {1, 1, 1};
    const std::vector<Slab> slabs{makeSkinSlab({.melanin = 0.02}, 0.1), makeSkinSlab({.haemoglobin = 0.02}, infinity)};
    describeBySlabs(material, slabs);
    EXPECT_EQ(findFault(material), "");
    EXPECT_EQ(material.slabs, slabs);
    EXPECT_FALSE(material.meanFreePath);
    EXPECT_LE(material.layers.size(), static_cast<std::size_t>(slabLayerCount));
    const LayeredMedium stack(slabs);
    EXPECT_EQ(material.albedo, stack.diffuseReflectance());
    EXPECT_NEAR(material.specular, std::pow(0.4 / 2.4, 2) / 0.08, 1e-12);
    // The layers' light goes as far as the stack's.
    const SumOfGaussiansProfile profile(material.layers);
    const Rgb error = stack.cdfError(material.layers);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_LT(error[static_cast<std::size_t>(channel)], 0.02);
        EXPECT_NEAR(profile.cdf(channel, 0.5), stack.reflectanceCdf(channel, 0.5),
                    error[static_cast<std::size_t>(channel)] + 1e-3);
    }
}

// A half space without absorption returns all light, some of it from as far as one likes.
TEST(Slab, OfAWhiteHalfSpaceIsStillAMaterial) {
    Material material;
    describeBySlabs(material, {{{"white", {1, 1, 1}, {0, 0, 0}, 1.4}, infinity}});
    EXPECT_EQ(findFault(material), "");
    EXPECT_NEAR(material.albedo[0], 1, 1e-6);
}

} // namespace
