// Metrics of pictures whose errors are known.
#include "image/color.hpp"
#include "image/false_color.hpp"
#include "image/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using namespace nacre;

namespace {

Image plain(std::vector<float> color, std::uint32_t width = 16, std::uint32_t height = 12) {
    std::vector<std::string> names{"R", "G", "B"};
    names.resize(color.size());
    Image image = makeImage(width, height, names);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = color[i % color.size()];
    }
    return image;
}

Image noise(std::uint32_t seed, std::uint32_t width = 33, std::uint32_t height = 21) {
    Image image = makeImage(width, height, {"R", "G", "B"});
    std::mt19937 random(seed);
    for (float& value : image.values) {
        value = static_cast<float>(random() % 1000) / 999;
    }
    return image;
}

} // namespace

TEST(Metrics, OfAConstantDifference) {
    const ErrorSums sums = errors(plain({1.01f, 1.01f, 1.01f}), plain({1, 1, 1}));
    EXPECT_NEAR(sums.psnr(1), 40, 1e-3);
    EXPECT_NEAR(sums.psnr(10), 60, 1e-3);
    EXPECT_NEAR(sums.relMse(), 1e-4 / 1.01, 1e-8);
    EXPECT_NEAR(sums.energyRatio(), 1.01, 1e-6);
}

TEST(Metrics, OfOneChannelEach) {
    const auto sums = channelErrors(plain({1, 2.2f, 0}), plain({1, 2, 0}));
    EXPECT_EQ(sums[0].psnr(1), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(sums[1].energyRatio(), 1.1, 1e-6);
    EXPECT_EQ(sums[2].energyRatio(), 1);
    EXPECT_EQ(sums[2].psnr(0), std::numeric_limits<double>::infinity());
}

TEST(Metrics, CountOnlyWhatTheMaskLeaves) {
    const Image reference{2, 1, {"R", "G", "B"}, {1, 1, 1, 1, 1, 1}};
    const Image image{2, 1, {"R", "G", "B"}, {1, 1, 1, 9, 9, 9}};
    EXPECT_EQ(errors(image, reference, {1, 0}).meanSquaredError(), 0);
    EXPECT_EQ(errors(image, reference, {0, 1}).meanSquaredError(), 64);
    EXPECT_EQ(quantile(image, 1, {1, 0}), 1);
    EXPECT_EQ(quantile(image, 1), 9);
    EXPECT_EQ(mean(image, {0, 1}), 9);
    EXPECT_EQ(countedPixels(image, {0, 1}), 1u);
    EXPECT_THROW(errors(image, reference, {1}), std::invalid_argument);
}

TEST(Metrics, RefuseWhatCannotBeCompared) {
    EXPECT_THROW(errors(plain({1, 1, 1}, 4, 4), plain({1, 1, 1}, 4, 5)), std::invalid_argument);
    EXPECT_THROW(errors(plain({1, 1, 1}), plain({1})), std::invalid_argument);
    EXPECT_THROW(errors({2, 2, {"R"}, {1}}, {2, 2, {"R"}, {1}}), std::invalid_argument);
}

TEST(Metrics, KeepWhatIsNotANumber) {
    const Image image{1, 1, {"R"}, {std::numeric_limits<float>::quiet_NaN()}};
    EXPECT_TRUE(std::isnan(errors(image, {1, 1, {"R"}, {1}}).psnr(1)));
}

TEST(Ssim, IsOneOfItselfAndSymmetric) {
    const Image a = noise(1);
    const Image b = noise(2);
    EXPECT_NEAR(mean(ssimMap(a, a, 1)), 1, 1e-5);
    const Image one = ssimMap(a, b, 1);
    const Image other = ssimMap(b, a, 1);
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        EXPECT_NEAR(one.values[i], other.values[i], 1e-6);
        EXPECT_GE(one.values[i], -1);
        EXPECT_LE(one.values[i], 1);
    }
    EXPECT_LT(mean(one), 0.2);
}

// Of constant pictures only the luminance term is left: (2xy + C₁) / (x² + y² + C₁), C₁ = (0.01·peak)².
TEST(Ssim, OfConstantPicturesIsItsLuminanceTerm) {
    EXPECT_NEAR(mean(ssimMap(plain({0.5f}), plain({0.25f}), 1)), (0.25 + 1e-4) / (0.3125 + 1e-4), 1e-5);
    EXPECT_NEAR(mean(ssimMap(plain({0.5f}), plain({0.25f}), 10)), (0.25 + 1e-2) / (0.3125 + 1e-2), 1e-5);
}

// A contrast that is halved about the mean: structure and mean stay, (2·½σ² + C₂) / (¼σ² + σ² + C₂) → 0.8.
TEST(Ssim, OfHalfTheContrastIsFourFifths) {
    const Image image = noise(3, 64, 64);
    Image half = image;
    for (float& value : half.values) {
        value = 0.5f + 0.5f * (value - 0.5f);
    }
    EXPECT_NEAR(mean(ssimMap(half, image, 1)), 0.8, 0.01);
}

TEST(ImageType, SelectsChannelsByName) {
    const Image image{1, 1, {"Z", "R", "B", "G"}, {4, 1, 3, 2}};
    EXPECT_EQ(toRgb(image).values, (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(toRgb({1, 1, {"Z"}, {4}}).values, (std::vector<float>{4, 4, 4}));
    EXPECT_THROW(toRgb({1, 1, {"R", "G"}, {1, 2}}), std::invalid_argument);
    EXPECT_FALSE(findChannel(image, "A"));
}

TEST(ImageType, ReducesToTheMean) {
    const Image image{4, 2, {"R"}, {1, 3, 0, 0, 5, 7, 0, 8}};
    EXPECT_EQ(reduced(image, 2).values, (std::vector<float>{4, 2}));
    EXPECT_EQ(reduced(image, 1), image);
    EXPECT_THROW(reduced(image, 3), std::invalid_argument);
}

TEST(ImageType, ChangesItsEncodingThereAndBack) {
    const Image image{2, 1, {"R", "A"}, {0.2f, 0.3f, 1.5f, 0.4f}};
    const Image encoded = toEncoding(image, Encoding::Srgb);
    EXPECT_NEAR(encoded.values[0], 0.4845, 1e-4); // 1.055 · 0.2^(1/2.4) − 0.055
    EXPECT_EQ(encoded.values[1], 0.3f);
    EXPECT_EQ(encoded.values[2], 1);
    EXPECT_NEAR(toEncoding(encoded, Encoding::Linear).values[0], 0.2, 1e-6);
}

TEST(HeatMap, HasEvenLightness) {
    for (int i = 0; i <= 100; ++i) {
        const std::array<float, 3> color = heatColor(i / 100.0);
        Tristimulus rgb{};
        std::ranges::transform(color, rgb.begin(), decodeSrgb);
        EXPECT_NEAR(toLab(rgb)[0], i, 0.1);
    }
    EXPECT_EQ(heatColor(-1), heatColor(0));
    EXPECT_EQ(heatColor(2), heatColor(1));
}

TEST(HeatMap, DrawsWhatIsNotFiniteAsTheLargest) {
    const Image map{2, 1, {"FLIP"}, {std::numeric_limits<float>::quiet_NaN(), 0}};
    const Image picture = heatMap(map);
    EXPECT_NEAR(picture.values[0], 1, 1e-3);
    EXPECT_EQ(picture.values[3], 0);
}

TEST(SignedDifference, IsGreyWhereNothingDiffers) {
    const Image picture = signedDifference({1, 1, {"R", "G", "B"}, {1, 2, 3}}, {1, 1, {"R", "G", "B"}, {1, 1, 4}}, 2);
    EXPECT_EQ(picture.values, (std::vector<float>{0.5f, 0.75f, 0.25f}));
}
