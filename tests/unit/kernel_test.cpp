#include "nacre/burley.hpp"
#include "nacre/gaussian.hpp"
#include "nacre/kernel.hpp"
#include "nacre/presets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace nacre;

namespace {

// What holds for every kernel: normalised, symmetric, rising offsets, no negative weight.
void expectWellFormed(const Kernel& kernel, int tapCount, double tolerance = 1e-12) {
    ASSERT_EQ(kernel.size(), static_cast<std::size_t>(tapCount));
    EXPECT_EQ(kernel[kernel.size() / 2].offset, 0);
    Rgb sum{};
    for (std::size_t i = 0; i < kernel.size(); ++i) {
        const KernelTap& mirrored = kernel[kernel.size() - 1 - i];
        EXPECT_EQ(kernel[i].offset, -mirrored.offset);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_GE(kernel[i].weight[channel], 0);
            EXPECT_NEAR(kernel[i].weight[channel], mirrored.weight[channel], 1e-15);
            sum[channel] += kernel[i].weight[channel];
        }
        if (i > 0) {
            EXPECT_GT(kernel[i].offset, kernel[i - 1].offset);
        }
    }
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(sum[channel], 1, tolerance);
    }
}

// Root mean square difference between the staircase a kernel makes of an edge and the edge response, over ±reach.
double edgeError(const Kernel& kernel, const Profile& profile, int channel, double reach) {
    constexpr int steps = 2000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = reach * ((i + 0.5) / steps * 2 - 1);
        double response = 0;
        for (const KernelTap& tap : kernel) {
            response += tap.offset < x ? tap.weight[channel] : 0;
        }
        const double difference = response - profile.lineSpreadCumulative(channel, x);
        sum += difference * difference;
    }
    return std::sqrt(sum / steps);
}

TEST(LineSpreadKernel, IsWellFormedForEveryPresetAndTapCount) {
    for (const Material& preset : presets()) {
        const auto profile = makeProfile(preset);
        for (const int tapCount : {3, 11, 17, 25, 63, 255}) {
            SCOPED_TRACE(preset.name + " with " + std::to_string(tapCount) + " taps");
            expectWellFormed(lineSpreadKernel(*profile, tapCount), tapCount);
        }
    }
}

TEST(LineSpreadKernel, WeightsAreTheMassesOfTheCellsAroundTheTaps) {
    const BurleyProfile profile({1, 0.4, 0.2});
    const Kernel kernel = lineSpreadKernel(profile, 25);
    // Up to between two taps, the kernel's light lies between the edge responses at the two.
    for (int channel = 0; channel < 3; ++channel) {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < kernel.size(); ++i) {
            sum += kernel[i].weight[channel];
            EXPECT_GE(sum, profile.lineSpreadCumulative(channel, kernel[i].offset));
            EXPECT_LE(sum, profile.lineSpreadCumulative(channel, kernel[i + 1].offset));
        }
    }
}

TEST(LineSpreadKernel, EdgeResponseConvergesToTheProfiles) {
    for (const char* name : {"skin", "marble", "skin-burley", "nacre"}) {
        const auto profile = makeProfile(*findPreset(name));
        for (int channel = 0; channel < 3; ++channel) {
            const double reach = profile->inverseCdf(channel, 0.99);
            double last = 1;
            for (const int tapCount : {11, 25, 63, 255}) {
                const double error = edgeError(lineSpreadKernel(*profile, tapCount), *profile, channel, reach);
                EXPECT_LT(error, 0.7 * last) << name << " channel " << channel << " taps " << tapCount;
                last = error;
            }
            EXPECT_LT(last, 0.006) << name;
        }
    }
}

TEST(LineSpreadKernel, SecondMomentNearsTheProfiles) {
    const auto profile = makeProfile(*findPreset("skin"));
    const Kernel kernel = lineSpreadKernel(*profile, 255, 20);
    for (int channel = 0; channel < 3; ++channel) {
        double moment = 0;
        for (const KernelTap& tap : kernel) {
            moment += tap.weight[channel] * tap.offset * tap.offset;
        }
        EXPECT_NEAR(std::sqrt(2 * moment), profile->rmsRadius(channel), 0.01 * profile->rmsRadius(channel));
    }
}

TEST(LineSpreadKernel, LosesNoLightBeyondItsRadiusAndKeepsItsTapsWithin) {
    const BurleyProfile profile({1, 1, 1});
    const Kernel kernel = lineSpreadKernel(profile, 11, 3); // 29 % of the light lies beyond 3 d
    expectWellFormed(kernel, 11);
    EXPECT_LT(kernel.back().offset, 3);
}

TEST(LineSpreadKernel, ScalesWithTheProfile) {
    const Kernel small = lineSpreadKernel(BurleyProfile({1, 0.5, 0.2}), 17);
    const Kernel large = lineSpreadKernel(BurleyProfile({10, 5, 2}), 17);
    for (std::size_t i = 0; i < small.size(); ++i) {
        EXPECT_NEAR(large[i].offset, 10 * small[i].offset, 1e-9);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(large[i].weight[channel], small[i].weight[channel], 1e-9);
        }
    }
}

TEST(LineSpreadKernel, TakesAPointMass) {
    const SumOfGaussiansProfile profile(std::vector<Layer>{{{1, 1, 0}, 0}, {{0, 1, 1}, 1}});
    const Kernel kernel = lineSpreadKernel(profile, 11);
    expectWellFormed(kernel, 11);
    EXPECT_DOUBLE_EQ(kernel[5].weight[0], 1);
    EXPECT_GT(kernel[5].weight[1], 0.5);
    const SumOfGaussiansProfile allStays(std::vector<Layer>{{{1, 1, 1}, 0}});
    const Kernel still = lineSpreadKernel(allStays, 11);
    EXPECT_EQ(still[5].weight, (Rgb{1, 1, 1}));
    EXPECT_LE(still.back().offset, 1e-6);
}

TEST(LineSpreadKernel, RefusesWhatIsOutOfRange) {
    const BurleyProfile profile({1, 1, 1});
    for (const int tapCount : {-1, 0, 1, 2, 4, 16, 257}) {
        EXPECT_THROW(lineSpreadKernel(profile, tapCount), std::invalid_argument) << tapCount;
    }
    for (const double radius : {-1.0, double(NAN), double(INFINITY)}) {
        EXPECT_THROW(lineSpreadKernel(profile, 11, radius), std::invalid_argument) << radius;
    }
}

// The tables that the demo ships (SeparableSSS.h of the separable-sss repository), offset >= 0 side.
TEST(JimenezKernel, ReproducesTheShippedTables) {
    const std::vector<std::vector<std::array<double, 4>>> tables{{{0.560479, 0.669086, 0.784728, 0},
                                                                  {0.0771802, 0.113491, 0.0793803, 0.08},
                                                                  {0.0821904, 0.0358608, 0.0209261, 0.32},
                                                                  {0.03639, 0.0130999, 0.00643685, 0.72},
                                                                  {0.0192831, 0.00282018, 0.00084214, 1.28},
                                                                  {0.00471691, 0.000184771, 5.07566e-05, 2}},
                                                                 {{0.536343, 0.624624, 0.748867, 0},
                                                                  {0.0324462, 0.0656718, 0.0532821, 0.03125},
                                                                  {0.0582416, 0.0659959, 0.0411329, 0.125},
                                                                  {0.0571056, 0.0287432, 0.0172844, 0.28125},
                                                                  {0.0347317, 0.0151085, 0.00871983, 0.5},
                                                                  {0.0216301, 0.00794618, 0.00376991, 0.78125},
                                                                  {0.0144609, 0.00317269, 0.00106399, 1.125},
                                                                  {0.0100386, 0.000914679, 0.000275702, 1.53125},
                                                                  {0.00317394, 0.000134823, 3.77269e-05, 2}},
                                                                 {{0.530605, 0.613514, 0.739601, 0},
                                                                  {0.0211412, 0.0459286, 0.0378196, 0.0208333},
                                                                  {0.0402784, 0.0657244, 0.04631, 0.0833333},
                                                                  {0.0493588, 0.0367726, 0.0219485, 0.1875},
                                                                  {0.0410172, 0.0199899, 0.0118481, 0.333333},
                                                                  {0.0263642, 0.0119715, 0.00684598, 0.520833},
                                                                  {0.017924, 0.00711691, 0.00347194, 0.75},
                                                                  {0.0128496, 0.00356329, 0.00132016, 1.02083},
                                                                  {0.0094389, 0.00139119, 0.000416598, 1.33333},
                                                                  {0.00700976, 0.00049366, 0.000151938, 1.6875},
                                                                  {0.00500364, 0.00020094, 5.28848e-05, 2.08333},
                                                                  {0.00333804, 7.85443e-05, 1.2945e-05, 2.52083},
                                                                  {0.000973794, 1.11862e-05, 9.43437e-07, 3}}};
    for (const auto& table : tables) {
        const int tapCount = 2 * static_cast<int>(table.size()) - 1;
        const Kernel kernel = jimenezKernel(tapCount);
        expectWellFormed(kernel, tapCount);
        for (std::size_t i = 0; i < table.size(); ++i) {
            const KernelTap& tap = kernel[table.size() - 1 + i];
            EXPECT_NEAR(tap.offset, table[i][3], 1e-5);
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(tap.weight[channel] / table[i][channel], 1, 1e-5) << tapCount << " taps, tap " << i;
            }
        }
    }
}

TEST(JimenezKernel, StrengthZeroLeavesTheLightWhereItIs) {
    const Kernel kernel = jimenezKernel(11, {0, 1, 0}, {1, 0, 1});
    expectWellFormed(kernel, 11);
    EXPECT_EQ(kernel[5].weight[0], 1);
    EXPECT_NEAR(kernel[5].weight[1], 1, 1e-12); // a falloff of 0 scatters nowhere
    EXPECT_THROW(jimenezKernel(11, {2, 1, 1}), std::invalid_argument);
    EXPECT_THROW(jimenezKernel(11, {1, 1, 1}, {1, -1, 1}), std::invalid_argument);
    EXPECT_THROW(jimenezKernel(12), std::invalid_argument);
}

TEST(SliceKernel, IsTheJimenezConstructionOfTheLayers) {
    // d'Eon's red terms 2 to 6 in every channel, full strength, no stretch: the two constructions are one.
    const std::vector<Layer> layers{{{0.100, 0.100, 0.100}, 0.0484},
                                    {{0.118, 0.118, 0.118}, 0.187},
                                    {{0.113, 0.113, 0.113}, 0.567},
                                    {{0.358, 0.358, 0.358}, 1.99},
                                    {{0.078, 0.078, 0.078}, 7.41}};
    const Kernel slice = sliceKernel(layers, 8, 2);
    const Kernel demo = jimenezKernel(17, {1, 1, 1}, {0.999, 0.999, 0.999});
    for (std::size_t i = 0; i < slice.size(); ++i) {
        EXPECT_DOUBLE_EQ(slice[i].offset, demo[i].offset);
        EXPECT_NEAR(slice[i].weight[0], demo[i].weight[0], 1e-12);
    }
}

TEST(SliceKernel, IsWellFormedFromRadiusThreeToThirteenAndWorseThanTheLineSpread) {
    for (const char* name : {"skin", "marble", "nacre"}) {
        const Material& preset = *findPreset(name);
        const auto profile = makeProfile(preset);
        const double extent = profile->quantileRadius(0.99);
        for (int radius = 3; radius <= 13; ++radius) {
            const Kernel slice = sliceKernel(makeLayers(preset), radius, extent);
            expectWellFormed(slice, 2 * radius + 1);
            const Kernel lineSpread = lineSpreadKernel(*profile, 2 * radius + 1);
            EXPECT_GT(edgeError(slice, *profile, 0, extent), edgeError(lineSpread, *profile, 0, extent)) << name;
        }
    }
}

TEST(SliceKernel, KeepsWhatDoesNotScatterAtTheCentre) {
    const std::vector<Layer> layers{{{0.25, 0.5, 1}, 0}, {{0.75, 0.5, 0}, 1}};
    const Kernel kernel = sliceKernel(layers, 5, 3);
    expectWellFormed(kernel, 11);
    const Kernel scattered = sliceKernel(std::vector<Layer>{{{1, 1, 1}, 1}}, 5, 3);
    EXPECT_DOUBLE_EQ(kernel[4].weight[0], 0.75 * scattered[4].weight[0]);
    EXPECT_DOUBLE_EQ(kernel[5].weight[2], 1);
    EXPECT_THROW(sliceKernel(layers, 0, 3), std::invalid_argument);
    EXPECT_THROW(sliceKernel(layers, 128, 3), std::invalid_argument);
    EXPECT_THROW(sliceKernel(layers, 5, 0), std::invalid_argument);
    EXPECT_THROW(sliceKernel({}, 5, 3), std::invalid_argument);
}

} // namespace
