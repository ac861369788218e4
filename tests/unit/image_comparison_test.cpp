// All metrics of one comparison, and whether differences are those of chance.
#include "image/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using namespace nacre;

namespace {

Image plain(float value, Encoding encoding = Encoding::Linear, std::uint32_t side = 12) {
    Image image = makeImage(side, side, {"R", "G", "B"}, encoding);
    std::ranges::fill(image.values, value);
    return image;
}

/// The reference with normal errors of these variances.
Image disturbed(const Image& reference, const Image& variance) {
    Image image = reference;
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] += static_cast<float>(normal(random) * std::sqrt(variance.values[i]));
    }
    return image;
}

Image variances(std::uint32_t side) {
    Image variance = makeImage(side, side, {"R", "G", "B"});
    for (std::size_t i = 0; i < variance.values.size(); ++i) {
        variance.values[i] = 0.001f * static_cast<float>(1 + i % 17);
    }
    return variance;
}

} // namespace

TEST(Comparison, OfShownPicturesHasPeakOneAndLinearEnergy) {
    const Comparison comparison = compareImages(plain(0.5f, Encoding::Srgb), plain(0.6f, Encoding::Srgb), {});
    EXPECT_EQ(comparison.peak, 1);
    EXPECT_NEAR(comparison.psnr, 20, 1e-5);
    EXPECT_NEAR(comparison.energyRatio[1], 0.214041 / 0.318547, 1e-5); // ((v + 0.055) / 1.055)^2.4
    EXPECT_EQ(comparison.pixels, 144u);
    EXPECT_FALSE(comparison.chance);
}

TEST(Comparison, OfLightHasThePeakOfItsReference) {
    Image reference = plain(2, Encoding::Linear, 40);
    reference.values[0] = 1000; // a glint is not what full is
    ComparisonSettings settings{.flip = FlipKind::Hdr};
    const Comparison comparison = compareImages(reference, reference, settings);
    EXPECT_EQ(comparison.peak, 2);
    EXPECT_EQ(comparison.flip.largest, 0);
    EXPECT_NEAR(comparison.ssim, 1, 1e-6);
    settings.peak = 5;
    EXPECT_EQ(compareImages(reference, reference, settings).peak, 5);
}

TEST(Comparison, CountsTheMaskAlone) {
    const Image reference = plain(0.5f);
    Image test = reference;
    test.values[0] = 0;
    ComparisonSettings settings{.mask = Mask(144, 1)};
    settings.mask[0] = 0;
    EXPECT_EQ(compareImages(test, reference, settings).relMse, 0);
    EXPECT_EQ(compareImages(test, reference, settings).pixels, 143u);
    settings.mask = Mask(144, 0);
    EXPECT_THROW(compareImages(test, reference, settings), std::invalid_argument);
}

TEST(Comparison, CountsWhatIsNotFinite) {
    Image test = plain(0.5f);
    test.values[4] = std::numeric_limits<float>::quiet_NaN();
    test.values[9] = std::numeric_limits<float>::infinity();
    const Comparison comparison = compareImages(test, plain(0.5f), {});
    EXPECT_EQ(comparison.notFinite, 2u);
    EXPECT_EQ(comparison.referenceNotFinite, 0u);
    EXPECT_NEAR(comparison.relMse, 2 * 0.25 / 0.26 / (3 * 144), 1e-9);
}

TEST(Comparison, RefusesAPictureAgainstLight) {
    EXPECT_THROW(compareImages(plain(0.5f, Encoding::Srgb), plain(0.5f), {}), std::invalid_argument);
}

TEST(Chance, OfNormalErrorsIsChance) {
    const Image reference = plain(0.5f, Encoding::Linear, 200);
    const Image variance = variances(200);
    const ChanceTest test = testChance(disturbed(reference, variance), reference, variance);
    EXPECT_EQ(test.count, 120000u);
    EXPECT_NEAR(test.chiSquared, 1, 0.02);                  // its standard error is √(2 / 120000) = 0.0041
    EXPECT_NEAR(test.beyondShare, normalBeyondShare, 8e-4); // 0.00015
}

TEST(Chance, SeesABiasOfOneStandardError) {
    const Image reference = plain(0.5f, Encoding::Linear, 200);
    const Image variance = variances(200);
    Image image = disturbed(reference, variance);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] += std::sqrt(variance.values[i]);
    }
    EXPECT_NEAR(testChance(image, reference, variance).chiSquared, 2, 0.04); // E (z + 1)²
}

TEST(Chance, LeavesOutWhatHasNoVariance) {
    Image variance = plain(0.01f);
    std::fill(variance.values.begin() + 3, variance.values.end(), 0.0f);
    Image image = plain(0.5f);
    image.values[0] += 0.4f; // z = 4
    const ChanceTest test = testChance(image, plain(0.5f), variance);
    EXPECT_EQ(test.count, 3u);
    EXPECT_NEAR(test.beyondShare, 1 / 3.0, 1e-12);
    EXPECT_NEAR(test.chiSquared, 16 / 3.0, 1e-4);
    EXPECT_EQ(testChance(image, plain(0.5f), variance, Mask(144, 0)).count, 0u);
}
