// FLIP and HDR-FLIP: the properties that their papers state, and figures worked by hand from the papers' equations.
#include "image/flip.hpp"
#include "image/flip_parts.hpp"
#include "image/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace nacre;

namespace {

Image plain(const Tristimulus& color, std::uint32_t width = 24, std::uint32_t height = 20) {
    Image image = makeImage(width, height, {"R", "G", "B"});
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<float>(color[i % 3]);
    }
    return image;
}

Image noise(std::uint32_t seed, float scale = 1) {
    Image image = makeImage(40, 30, {"R", "G", "B"});
    std::mt19937 random(seed);
    for (float& value : image.values) {
        value = scale * static_cast<float>(random() % 1000) / 999;
    }
    return image;
}

/// A checkerboard of squares of so many pixels.
Image checkers(std::uint32_t side, std::uint32_t square) {
    Image image = makeImage(side, side, {"R", "G", "B"});
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            std::ranges::fill(image.at(x, y), static_cast<float>((x / square + y / square) % 2));
        }
    }
    return image;
}

double difference(const Tristimulus& a, const Tristimulus& b) {
    return hyab(huntAdjusted(toLab(a)), huntAdjusted(toLab(b)));
}

double sumOf(const Taps& taps) {
    return std::accumulate(taps.begin(), taps.end(), 0.0);
}

} // namespace

// 0.7 m · 3840 / 0.7 m · π / 180.
TEST(Flip, ObserverOfThePapers) {
    EXPECT_NEAR(pixelsPerDegree(0.7, 0.7, 3840), 67.0206, 1e-4);
    EXPECT_NEAR(pixelsPerDegree(0.7, 0.7, 3840), defaultPixelsPerDegree, 1e-9);
    EXPECT_NEAR(pixelsPerDegree(1.4, 0.7, 3840), 2 * defaultPixelsPerDegree, 1e-9);
}

TEST(Flip, ColoursByHand) {
    const Tristimulus green = toLab({0, 1, 0});
    EXPECT_NEAR(green[0], 87.7362, 1e-3);
    EXPECT_NEAR(green[1], -86.1787, 1e-3);
    EXPECT_NEAR(green[2], 83.1826, 1e-3);
    const Tristimulus hunt = huntAdjusted({50, 20, -40});
    EXPECT_NEAR(hunt[1], 10, 1e-12);
    EXPECT_NEAR(hunt[2], -20, 1e-12);
    EXPECT_NEAR(hyab({50, 3, 0}, {40, 0, 4}), 15, 1e-12);
    const Tristimulus opponents = toYCxCz({1, 1, 1});
    EXPECT_NEAR(opponents[0], 100, 1e-9);
    EXPECT_NEAR(opponents[1], 0, 1e-9);
    EXPECT_NEAR(opponents[2], 0, 1e-9);
    for (const Tristimulus& color : {Tristimulus{0.1, 0.7, 0.3}, Tristimulus{0, 0, 0}, Tristimulus{1, 0, 1}}) {
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(fromYCxCz(toYCxCz(color))[i], color[i], 1e-9);
            EXPECT_NEAR(fromLab(toLab(color))[i], color[i], 1e-9);
        }
    }
}

// Green and blue differ most: 203.3017 in HyAB, 41.2761 to the power of 0.7. Two fifths of that are 0.95.
TEST(Flip, RedistributionByHand) {
    EXPECT_NEAR(difference({0, 1, 0}, {0, 0, 1}), 203.3017, 1e-3);
    EXPECT_EQ(flipColorError(0), 0);
    EXPECT_NEAR(flipColorError(1), 0.0575394, 1e-6);
    EXPECT_NEAR(flipColorError(10), 0.2883799, 1e-6);
    EXPECT_NEAR(flipColorError(54.9105), 0.95, 1e-5);
    EXPECT_NEAR(flipColorError(100), 0.9673798, 1e-6);
    EXPECT_NEAR(flipColorError(203.3017), 1, 1e-6);
}

// Radius ⌈3 √(0.04 / 2π²) · 67.02⌉ = ⌈9.05⌉. Weights are those of a₁√(π/b₁)e^(−π²d²/b₁) + a₂√(π/b₂)e^(−π²d²/b₂) over
// their sum in that square.
TEST(Flip, ContrastSensitivityByHand) {
    EXPECT_EQ(contrastRadius(defaultPixelsPerDegree), 10);
    EXPECT_EQ(contrastRadius(defaultPixelsPerDegree / 2), 5);
    const double expected[][3] = {
        {0.1488109, 0.0932397, 0.000341343}, {0.1319644, 0.0871782, 0.000602307}, {0.0200006, 0.0187267, 0.00865408}};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto terms = contrastFilter(static_cast<Opponent>(i), defaultPixelsPerDegree);
        EXPECT_EQ(terms.size(), i == 2 ? 2u : 1u);
        const auto weightAt = [&](std::size_t x, std::size_t y) {
            double weight = 0;
            for (const FilterTerm& term : terms) {
                weight += term.weight * term.taps[10 + x] * term.taps[10 + y];
            }
            return weight;
        };
        EXPECT_NEAR(weightAt(0, 0), expected[i][0], 1e-6);
        EXPECT_NEAR(weightAt(1, 0), expected[i][1], 1e-6);
        EXPECT_NEAR(weightAt(3, 2), expected[i][2], 1e-8);
    }
}

// Standard deviation 0.5 · 0.082° · 67.02 = 2.748 px, radius ⌈8.24⌉.
TEST(Flip, FeatureFiltersByHand) {
    const FeatureFilter filter = featureFilter(defaultPixelsPerDegree);
    ASSERT_EQ(filter.edge.size(), 19u);
    EXPECT_EQ(filter.edge[9], 0);
    EXPECT_NEAR(sumOf(filter.across), 1, 1e-6);
    EXPECT_NEAR(sumOf(filter.edge), 0, 1e-6);
    EXPECT_NEAR(sumOf(filter.point), 0, 1e-6);
    EXPECT_NEAR(std::accumulate(filter.edge.begin(), filter.edge.begin() + 9, 0.0), 1, 1e-6);
    double positive = 0;
    for (std::size_t i = 0; i < 19; ++i) {
        positive += std::max(filter.point[i], 0.0f);
        EXPECT_EQ(filter.point[i] > 0, i <= 6 || i >= 12) << "beyond the standard deviation, " << i;
    }
    EXPECT_NEAR(positive, 1, 1e-6);
    EXPECT_EQ(featureFilter(defaultPixelsPerDegree / 2).edge.size(), 11u);
}

TEST(Flip, IsNoneOfItselfSymmetricAndWithinBounds) {
    const Image a = noise(1);
    const Image b = noise(2);
    EXPECT_EQ(quantile(flip(a, a), 1), 0);
    const Image one = flip(a, b);
    EXPECT_EQ(one, flip(b, a));
    EXPECT_EQ(one.channels, (std::vector<std::string>{"FLIP"}));
    EXPECT_GE(quantile(one, 0), 0);
    EXPECT_LE(quantile(one, 1), 1);
    EXPECT_GT(mean(one), 0.05);
}

// Of pictures of one colour each there are no features, and filters leave the colours: closed form. Black and white are
// half as far apart as green and blue: 0.967, not 1.
TEST(Flip, OfPlainColours) {
    const auto between = [](const Tristimulus& a, const Tristimulus& b) {
        const Image map = flip(plain(a), plain(b));
        EXPECT_NEAR(quantile(map, 0), quantile(map, 1), 1e-4);
        return mean(map);
    };
    EXPECT_NEAR(between({0, 1, 0}, {0, 0, 1}), 1, 1e-5);
    EXPECT_NEAR(between({0, 0, 0}, {1, 1, 1}), 0.9673798, 1e-5);
    EXPECT_NEAR(between({1, 0, 0}, {0, 1, 0}), 0.9866623, 1e-5);
    EXPECT_NEAR(between({0.2, 0.2, 0.2}, {0.3, 0.2, 0.1}), flipColorError(difference({0.2, 0.2, 0.2}, {0.3, 0.2, 0.1})),
                1e-4);
}

// Right of a step from black to white, beside black: the edge filter sees all of its weights of one sign, the point
// filter half of its middle one. The contrast filter sees half the light and half of the middle column's.
TEST(Flip, OfAStepByHand) {
    Image step = plain({0, 0, 0}, 60, 9);
    for (std::uint32_t y = 0; y < step.height; ++y) {
        for (std::uint32_t x = 30; x < step.width; ++x) {
            std::ranges::fill(step.at(x, y), 1.0f);
        }
    }
    const Image map = flip(step, plain({0, 0, 0}, 60, 9));
    const double light = 0.5 + 0.5 * std::sqrt(0.1488109);
    const double color = flipColorError(116 * std::cbrt(light) - 16);
    const double feature = std::sqrt(1 / std::sqrt(2.0));
    EXPECT_NEAR(map.at(30, 4)[0], std::pow(color, 1 - feature), 1e-4);
    EXPECT_NEAR(map.at(55, 4)[0], 0.9673798, 1e-4);
    EXPECT_NEAR(map.at(5, 4)[0], 0, 1e-4);
    EXPECT_GT(map.at(30, 4)[0], flipColorError(116 * std::cbrt(light) - 16)) << "an edge makes a difference larger";
}

// Squares that the observer cannot tell apart look like their mean, grey; from nearer, they do not. In the middle,
// since a border repeats pixels and not squares.
TEST(Flip, FallsWithPixelsPerDegree) {
    const Image grey = plain({0.5, 0.5, 0.5}, 48, 48);
    double last = 1;
    for (const double density : {10.0, 30.0, 50.0, 67.0}) {
        const double now = flip(checkers(48, 1), grey, density).at(24, 24)[0];
        EXPECT_LT(now, last) << density;
        last = now;
    }
    EXPECT_LT(last, 0.02);
}

// A picture twice as large from twice as far.
TEST(Flip, OfTwiceThePixelsPerDegreeIsThatOfHalfThePicture) {
    const double one = mean(flip(checkers(120, 12), plain({0.5, 0.5, 0.5}, 120, 120), 100));
    const double two = mean(flip(checkers(240, 24), plain({0.5, 0.5, 0.5}, 240, 240), 200));
    EXPECT_NEAR(one, two, 0.03 * one);
    EXPECT_GT(std::abs(mean(flip(checkers(240, 24), plain({0.5, 0.5, 0.5}, 240, 240), 100)) - one), 0.03 * one);
}

TEST(Flip, TakesEncodedPicturesAsTheyAreShown) {
    const Image a = noise(1);
    const Image b = noise(2);
    const double linear = mean(flip(a, b));
    EXPECT_NEAR(mean(flip(toEncoding(a, Encoding::Srgb), toEncoding(b, Encoding::Srgb))), linear, 1e-5);
    Image broken = plain({1, 1, 1});
    broken.values[0] = std::numeric_limits<float>::quiet_NaN();
    broken.values[4] = std::numeric_limits<float>::infinity();
    EXPECT_LE(quantile(flip(broken, plain({1, 1, 1})), 1), 1);
    EXPECT_THROW(flip(plain({1, 1, 1}, 4, 4), plain({1, 1, 1}, 4, 5)), std::invalid_argument);
}

// T(x) = 0.85 at x = 2.118872; T(1) = (0.9036 + 0.018) / (0.8748 + 0.354 + 0.14).
TEST(HdrFlip, ToneCurveAndExposuresByHand) {
    EXPECT_NEAR(flipToneCurve(1), 0.9216 / 1.3688, 1e-12);
    EXPECT_NEAR(flipToneCurve(2.1188723), 0.85, 1e-7);
    EXPECT_EQ(flipToneCurve(0), 0);
    EXPECT_EQ(flipToneCurve(1e30), 1);
    Image reference = plain({0.5, 0.5, 0.5});
    std::ranges::fill(reference.at(3, 3), 4.0f);
    const ExposureRange range = flipExposures(reference);
    EXPECT_NEAR(range.start, std::log2(2.1188723 / 4), 1e-6);
    EXPECT_NEAR(range.stop, std::log2(2.1188723 / 0.5), 1e-6);
    EXPECT_EQ(range.count, 3);
}

TEST(HdrFlip, LooksAtWhatIsNotBlack) {
    Image reference = plain({0, 0, 0});
    EXPECT_EQ(flipExposures(reference).count, 1);
    EXPECT_EQ(mean(hdrFlip(reference, reference)), 0);
    for (std::uint32_t x = 0; x < 4; ++x) {
        std::ranges::fill(reference.at(x, 3), 0.5f);
    }
    EXPECT_NEAR(flipExposures(reference).stop, std::log2(2.1188723 / 0.5), 1e-6);
}

TEST(HdrFlip, OfPlainLight) {
    const double end = flipToneCurve(2 * 2.1188723);
    const double expected = flipColorError(difference({end, end, end}, {0.85, 0.85, 0.85}));
    EXPECT_NEAR(mean(hdrFlip(plain({6, 6, 6}), plain({3, 3, 3}))), expected, 1e-4);
}

TEST(HdrFlip, IsNoneOfItselfAndFollowsTheScale) {
    const Image a = noise(1, 50);
    const Image b = noise(2, 50);
    EXPECT_EQ(quantile(hdrFlip(a, a), 1), 0);
    const Image map = hdrFlip(a, b);
    EXPECT_LE(quantile(map, 1), 1);
    const Image scaled = hdrFlip(noise(1, 50 * 64), noise(2, 50 * 64));
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        EXPECT_NEAR(map.values[i], scaled.values[i], 1e-3);
    }
}

TEST(HdrFlip, IsTheLargestOfItsExposures) {
    const Image a = noise(1, 20);
    const Image b = noise(2, 20);
    const ExposureRange range = flipExposures(b);
    const Image map = hdrFlip(a, b);
    for (int i = 0; i < range.count; ++i) {
        const double stops = range.start + i * (range.stop - range.start) / (range.count - 1);
        const Image one = hdrFlip(a, b, {stops, stops, 1});
        for (std::size_t pixel = 0; pixel < map.values.size(); ++pixel) {
            EXPECT_LE(one.values[pixel], map.values[pixel]);
        }
    }
}
