// Properties every profile has, whatever it is made of.
#include "nacre/burley.hpp"
#include "nacre/gaussian.hpp"
#include "nacre/media.hpp"
#include "nacre/presets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace nacre;

namespace {

struct NamedProfile {
    std::string name;
    std::unique_ptr<Profile> profile;
    double tolerance; // of integrals; the radial profile is exact to its rings
};

std::vector<NamedProfile> profiles() {
    std::vector<NamedProfile> result;
    for (const char* name : {"skin", "marble", "leaf", "nacre"}) {
        result.push_back({name, makeProfile(*findPreset(name)), 1e-6});
    }
    result.push_back({"Burley", std::make_unique<BurleyProfile>(Rgb{1, 0.4, 0.2}), 1e-6});
    const BurleyProfile burley({1, 0.4, 0.2});
    const auto radial = [burley](int channel, double r) { return 7 * burley.radial(channel, r); };
    result.push_back({"radial Burley", std::make_unique<RadialProfile>(radial, 60), 2e-5});
    result.push_back({"dipole", std::make_unique<RadialProfile>(dipoleProfile(jensenMedia()[8].medium)), 2e-5});
    return result;
}

// Simpson's rule after x = u³, which tames what is infinite at 0.
template <typename Function> double integrate(double from, double to, Function f) {
    constexpr int steps = 3000;
    const double low = std::cbrt(from);
    const double width = (std::cbrt(to) - low) / steps;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
        const double u = low + i * width;
        const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += u > 0 ? weight * 3 * u * u * f(u * u * u) : 0;
    }
    return sum * width / 3;
}

TEST(Profile, CdfIsTheIntegralOfTheRadialDensityAndReachesOne) {
    for (const auto& [name, profile, tolerance] : profiles()) {
        for (int channel = 0; channel < 3; ++channel) {
            for (const double share : {0.1, 0.5, 0.9, 0.999}) {
                const double r = profile->inverseCdf(channel, share);
                const double integral = integrate(0, r, [&, &profile = profile](double x) {
                    return 2 * std::numbers::pi * x * profile->radial(channel, x);
                });
                EXPECT_NEAR(integral, share, tolerance) << name << " channel " << channel;
            }
            EXPECT_EQ(profile->cdf(channel, 0), 0) << name;
            EXPECT_NEAR(profile->cdf(channel, 1e4), 1, 1e-12) << name;
        }
    }
}

TEST(Profile, InverseCdfIsTheInverse) {
    for (const auto& [name, profile, tolerance] : profiles()) {
        for (int channel = 0; channel < 3; ++channel) {
            for (double share = 0.001; share < 1; share += 0.0111) {
                const double r = profile->inverseCdf(channel, share);
                EXPECT_NEAR(profile->cdf(channel, r), share, 1e-12) << name;
                EXPECT_NEAR(profile->slabTransmittance(channel, r), 1 - share, 1e-12) << name;
            }
        }
        const Rgb radius{profile->inverseCdf(0, 0.9), profile->inverseCdf(1, 0.9), profile->inverseCdf(2, 0.9)};
        EXPECT_EQ(profile->quantileRadius(0.9), *std::max_element(radius.begin(), radius.end()));
    }
}

TEST(Profile, LineSpreadIsTheProjectionOfTheRadialProfile) {
    for (const auto& [name, profile, tolerance] : profiles()) {
        for (int channel = 0; channel < 3; ++channel) {
            for (const double share : {0.3, 0.7, 0.95}) {
                const double x = profile->inverseCdf(channel, share);
                const double end = std::min(60.0, 40 * profile->rmsRadius(channel));
                const double projection = 2 * integrate(0, end, [&, &profile = profile](double y) {
                                              return profile->radial(channel, std::hypot(x, y));
                                          });
                // A radial profile is even within its rings, so its density is a few tenths of a per cent off.
                const double relative = tolerance > 1e-6 ? 5e-3 : 1e-5;
                EXPECT_NEAR(profile->lineSpread(channel, x), projection, relative * projection) << name;
                EXPECT_EQ(profile->lineSpread(channel, -x), profile->lineSpread(channel, x)) << name;
            }
        }
    }
}

TEST(Profile, EdgeResponseIsTheIntegralOfTheLineSpread) {
    for (const auto& [name, profile, tolerance] : profiles()) {
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_DOUBLE_EQ(profile->lineSpreadCumulative(channel, 0), 0.5) << name;
            EXPECT_NEAR(profile->lineSpreadCumulative(channel, 1e4), 1, 1e-12) << name;
            EXPECT_NEAR(profile->lineSpreadCumulative(channel, -1e4), 0, 1e-12) << name;
            for (const double share : {0.01, 0.3, 0.7, 0.99}) {
                const double x = profile->inverseCdf(channel, share);
                const double integral =
                    integrate(0, x, [&, &profile = profile](double y) { return profile->lineSpread(channel, y); });
                const double cumulative = profile->lineSpreadCumulative(channel, x);
                EXPECT_NEAR(cumulative - 0.5, integral, std::max(5e-6, tolerance)) << name;
                EXPECT_NEAR(profile->lineSpreadCumulative(channel, -x), 1 - cumulative, 1e-12) << name;
            }
        }
    }
}

TEST(Profile, RmsRadiusIsTheSecondMoment) {
    for (const auto& [name, profile, tolerance] : profiles()) {
        for (int channel = 0; channel < 3; ++channel) {
            // ⟨r²⟩ = ∫ 2r (1 − CDF) dr
            const double end = std::min(60.0, 40 * profile->rmsRadius(channel));
            const double moment =
                integrate(0, end, [&, &profile = profile](double r) { return 2 * r * (1 - profile->cdf(channel, r)); });
            EXPECT_NEAR(std::sqrt(moment), profile->rmsRadius(channel), 1e-3 * profile->rmsRadius(channel)) << name;
        }
    }
}

TEST(SumOfGaussians, HasTheClosedForms) {
    const double v = 0.7;
    const SumOfGaussiansProfile profile(std::vector<Layer>{{{2, 2, 2}, v}});
    EXPECT_DOUBLE_EQ(profile.radial(0, 1.1), std::exp(-1.21 / (2 * v)) / (2 * std::numbers::pi * v));
    EXPECT_DOUBLE_EQ(profile.slabTransmittance(1, 0.9), std::exp(-0.81 / (2 * v)));
    EXPECT_DOUBLE_EQ(profile.lineSpread(2, 0.4), std::exp(-0.16 / (2 * v)) / std::sqrt(2 * std::numbers::pi * v));
    EXPECT_DOUBLE_EQ(profile.lineSpreadCumulative(0, 0.4), 0.5 * (1 + std::erf(0.4 / std::sqrt(2 * v))));
    EXPECT_DOUBLE_EQ(profile.rmsRadius(0), std::sqrt(2 * v));
    EXPECT_EQ(profile.layers()[0].weight, (Rgb{1, 1, 1}));
}

TEST(SumOfGaussians, KnowsTheSkinOfDEonAndLuebke) {
    const auto skin = makeProfile(*findPreset("skin"));
    EXPECT_NEAR(skin->rmsRadius(0), 1.66, 0.005);
    EXPECT_NEAR(skin->rmsRadius(1), 0.37, 0.005);
    EXPECT_NEAR(skin->rmsRadius(2), 0.22, 0.005);
    EXPECT_NEAR(skin->quantileRadius(0.997), 6.95, 0.01); // of the red Gaussians: 0.078·exp(−r²/14.82) + … = 0.003
}

TEST(SumOfGaussians, TakesAVarianceOfZeroAsAPointMass) {
    for (const double variance : {0.0, 1e-300}) {
        const SumOfGaussiansProfile profile(std::vector<Layer>{{{1, 1, 1}, variance}, {{3, 1, 0}, 1}});
        EXPECT_DOUBLE_EQ(profile.cdf(0, 0), 0.25);
        EXPECT_DOUBLE_EQ(profile.lineSpreadCumulative(0, 1e-9) - profile.lineSpreadCumulative(0, -1e-9),
                         0.25 + 0.75 * 2e-9 / std::sqrt(2 * std::numbers::pi));
        EXPECT_EQ(profile.cdf(2, 0), 1);
        EXPECT_EQ(profile.radial(2, 0), 0);
        EXPECT_EQ(profile.inverseCdf(0, 0.1) < 1e-9, true);
    }
}

TEST(SumOfGaussians, RefusesWhatIsNoProfile) {
    const auto fault = [](const std::vector<Layer>& layers) { return findLayerFault(layers); };
    EXPECT_EQ(fault({}), "layers has 0 entries, must have 1 to 32");
    EXPECT_EQ(fault({{{1, 1, 1}, 1}, {{1, 1, 1}, -1}}), "layers[1].variance is -1, must be in [0, 4e+09] mm²");
    EXPECT_EQ(fault({{{1, 1, 1}, NAN}}), "layers[0].variance is nan, must be in [0, 4e+09] mm²");
    EXPECT_EQ(fault({{{1, INFINITY, 1}, 1}}), "layers[0].weight[1] is inf, must be in [0, 1000000]");
    EXPECT_THROW(SumOfGaussiansProfile(std::vector<Layer>(33, {{1, 1, 1}, 1})), std::invalid_argument);
}

TEST(Radial, ReadsATable) {
    // R = 1 within 2 mm, falling to 0 at 3 mm.
    const std::vector<double> radii{0, 2, 3};
    const std::vector<Rgb> values{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}};
    const RadialProfile profile(radii, values);
    const double outer = 2 * (3 * 2.5 - 19.0 / 3); // ∫₂³ 2r(3 − r) dr
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(profile.cdf(channel, 2), 4 / (4 + outer), 1e-5);
        EXPECT_NEAR(profile.cdf(channel, 1), 1 / (4 + outer), 1e-5);
        EXPECT_EQ(profile.cdf(channel, 3), 1);
        EXPECT_EQ(profile.radial(channel, 3.5), 0);
    }
}

TEST(Radial, ComesWithinTheStatedErrors) {
    const BurleyProfile burley({1, 0.4, 0.1});
    const SumOfGaussiansProfile skin(findPreset("skin")->layers);
    for (const Profile* exact : {static_cast<const Profile*>(&burley), static_cast<const Profile*>(&skin)}) {
        const double support = exact->quantileRadius(0.99999999);
        const RadialProfile profile([&](int channel, double r) { return exact->radial(channel, r); }, support);
        for (int channel = 0; channel < 3; ++channel) {
            for (double r = 1e-5 * support; r < support; r *= 1.01) {
                ASSERT_NEAR(profile.cdf(channel, r), exact->cdf(channel, r), 3e-5) << r;
                ASSERT_NEAR(profile.lineSpreadCumulative(channel, r), exact->lineSpreadCumulative(channel, r), 6e-6)
                    << r;
            }
        }
    }
}

TEST(Radial, RefusesWhatIsNoProfile) {
    EXPECT_THROW(RadialProfile([](int, double) { return 1.0; }, 0), std::invalid_argument);
    EXPECT_THROW(RadialProfile([](int, double) { return 0.0; }, 1), std::invalid_argument);
    EXPECT_THROW(RadialProfile([](int, double) { return -1.0; }, 1), std::invalid_argument);
    EXPECT_THROW(RadialProfile([](int, double r) { return std::log(r); }, 1), std::invalid_argument);
    EXPECT_THROW(RadialProfile([](int, double) { return std::numeric_limits<double>::infinity(); }, 1),
                 std::invalid_argument);
    const std::vector<Rgb> values{{1, 1, 1}, {1, 1, 1}};
    EXPECT_THROW(RadialProfile(std::vector<double>{1}, std::span(values).first(1)), std::invalid_argument);
    EXPECT_THROW(RadialProfile(std::vector<double>{2, 1}, values), std::invalid_argument);
    EXPECT_THROW(RadialProfile(std::vector<double>{-1, 1}, values), std::invalid_argument);
}

} // namespace
