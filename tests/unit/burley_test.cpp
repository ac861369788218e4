#include "core/bessel.hpp"
#include "nacre/burley.hpp"
#include "nacre/gaussian.hpp"
#include "tests/support/worst.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace nacre;

namespace {

// Abramowitz and Stegun, tables 9.8 and 9.11 (K₀) and the defining integral, to their digits.
TEST(Bessel, HasTheTabulatedValues) {
    EXPECT_NEAR(besselK0(0.1), 2.4270690247, 1e-10);
    EXPECT_NEAR(besselK0(1), 0.4210244382, 1e-10);
    EXPECT_NEAR(besselK0(2), 0.1138938728, 1e-10);
    EXPECT_NEAR(besselK0(5), 0.0036910983, 1e-10);
    EXPECT_NEAR(besselK0(20) / 5.741237815e-10, 1, 1e-9);
}

TEST(Bessel, IntegralDifferentiatesToK0) {
    EXPECT_EQ(besselK0Integral(0), 0);
    EXPECT_NEAR(besselK0Integral(700), 0.5 * std::numbers::pi, 1e-15);
    EXPECT_NEAR(besselK0Integral(2) - besselK0Integral(std::nextafter(2, 0)), 0, 1e-14);
    for (double x = 0.05; x < 30; x *= 1.3) {
        const double h = 1e-4 * x;
        const double slope = (besselK0Integral(x + h) - besselK0Integral(x - h)) / (2 * h);
        EXPECT_NEAR(slope, besselK0(x), 1e-6 * besselK0(x) + 1e-11) << x;
    }
}

TEST(Burley, HasTheStatedQuantilesAndMoments) {
    const BurleyProfile profile({1, 2, 0.5});
    const std::pair<double, double> quantiles[] = {{0.5, 1.552},  {0.9, 6.06},    {0.95, 8.13},
                                                   {0.99, 12.95}, {0.997, 16.56}, {0.999, 19.86}};
    for (const auto& [share, radius] : quantiles) {
        EXPECT_NEAR(profile.inverseCdf(0, share), radius, 0.006);
        EXPECT_NEAR(profile.inverseCdf(1, share), 2 * radius, 0.012);
    }
    EXPECT_NEAR(1 - profile.cdf(0, 3), 0.288, 5e-4); // what truncation at 3 d drops
    EXPECT_DOUBLE_EQ(profile.rmsRadius(2), 0.5 * std::sqrt(14.0));
}

TEST(Burley, InverseCdfRoundTrips) {
    const BurleyProfile profile({1, 2, 0.5});
    EXPECT_EQ(profile.inverseCdf(0, 0), 0);
    for (double share = 1e-6; share < 1; share = 1.1 * share + 1e-4) {
        EXPECT_NEAR(profile.cdf(0, profile.inverseCdf(0, share)), share, 2e-15) << share;
    }
}

TEST(Burley, IsFiniteWhereItCanBe) {
    const BurleyProfile profile({1, 1, 1});
    EXPECT_TRUE(std::isinf(profile.radial(0, 0)));
    EXPECT_TRUE(std::isinf(profile.lineSpread(0, 0)));
    EXPECT_EQ(profile.cdf(0, 0), 0);
    EXPECT_EQ(profile.lineSpreadCumulative(0, 0), 0.5);
    // 2πrR tends to 1/(2d).
    EXPECT_NEAR(2 * std::numbers::pi * 1e-9 * profile.radial(0, 1e-9), 0.5, 1e-8);
}

TEST(Burley, SlabTransmittanceIsTheIntegralOverTheFarPlane) {
    const BurleyProfile profile({1.3, 1, 1});
    // ∫ 2πρ R(√(ρ² + t²)) dρ = ∫ 2πr R(r) dr from t on.
    const double t = 0.8;
    double sum = 0;
    constexpr int steps = 400'000;
    for (int i = 0; i < steps; ++i) {
        const double rho = 60 * (i + 0.5) / steps;
        sum += 2 * std::numbers::pi * rho * profile.radial(0, std::hypot(rho, t)) * 60 / steps;
    }
    EXPECT_NEAR(profile.slabTransmittance(0, t), sum, 1e-6);
    EXPECT_DOUBLE_EQ(profile.slabTransmittance(0, t), 0.25 * std::exp(-t / 1.3) + 0.75 * std::exp(-t / 3.9));
}

TEST(Burley, LayersComeWithinTheStatedErrors) {
    const double errors[] = {0.2125, 0.0845, 0.0407, 0.0217, 0.0123, 0.0073};
    const BurleyProfile profile({0.7, 0.7, 0.7});
    for (int terms = 1; terms <= maxBurleyTerms; ++terms) {
        const std::vector<Layer> layers = burleyLayers({0.7, 0.7, 0.7}, terms);
        EXPECT_EQ(layers.size(), static_cast<std::size_t>(terms)); // equal channels share layers
        const SumOfGaussiansProfile sum(layers);
        double worst = 0;
        for (double r = 1e-4; r < 30; r *= 1.02) {
            worst = tests::larger(worst, std::abs(sum.cdf(0, r) - profile.cdf(0, r)));
        }
        EXPECT_NEAR(worst, errors[terms - 1], 0.01 * errors[terms - 1]) << terms;
    }
}

TEST(Burley, LayersKeepChannelsApart) {
    const std::vector<Layer> layers = burleyLayers({1, 0.5, 1});
    EXPECT_EQ(layers.size(), 12u);
    const SumOfGaussiansProfile both(layers);
    const SumOfGaussiansProfile red(burleyLayers({1, 1, 1}));
    const SumOfGaussiansProfile green(burleyLayers({0.5, 0.5, 0.5}));
    for (const double r : {0.1, 0.5, 2.0}) {
        EXPECT_DOUBLE_EQ(both.cdf(0, r), red.cdf(0, r));
        EXPECT_DOUBLE_EQ(both.cdf(1, r), green.cdf(1, r));
        EXPECT_DOUBLE_EQ(both.cdf(2, r), red.cdf(2, r));
    }
}

TEST(Burley, RefusesWhatIsOutOfRange) {
    for (const double bad : {0.0, -1.0, double(NAN), double(INFINITY), 1e5}) {
        EXPECT_THROW(BurleyProfile({1, bad, 1}), std::invalid_argument) << bad;
        EXPECT_THROW(burleyLayers({1, 1, bad}), std::invalid_argument) << bad;
    }
    EXPECT_THROW(burleyLayers({1, 1, 1}, 0), std::invalid_argument);
    EXPECT_THROW(burleyLayers({1, 1, 1}, 7), std::invalid_argument);
}

} // namespace
