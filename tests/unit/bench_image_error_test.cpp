// Errors of pictures with known differences, and the materials that the suites make.
#include "app/bench/image_error.hpp"
#include "app/bench/materials.hpp"
#include "nacre/kernel.hpp"
#include "nacre/presets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace nacre;
using namespace nacre::bench;

TEST(ImageError, OfAConstantDifferenceIsItsPsnr) {
    const std::vector<float> reference(300, 1.0f);
    const std::vector<float> picture(300, 1.01f);
    const std::vector<float> ids(100, 1.0f);
    const ImageError error = compareImages(picture, reference, ids);
    EXPECT_NEAR(error.psnr, 40, 1e-3);
    EXPECT_NEAR(error.relMse, 1e-4 / 1.01, 1e-8);
    EXPECT_NEAR(error.energyRatio, 1.01, 1e-6);
}

TEST(ImageError, PeakFollowsTheReference) {
    const std::vector<float> ids(100, 1.0f);
    const ImageError error = compareImages(std::vector<float>(300, 10.1f), std::vector<float>(300, 10.0f), ids);
    EXPECT_NEAR(error.psnr, 40, 1e-3);
}

TEST(ImageError, CountsPixelsWithAMaterialOnly) {
    const std::vector<float> reference(6, 1.0f);
    const std::vector<float> picture{1, 1, 1, 9, 9, 9};
    EXPECT_EQ(compareImages(picture, reference, std::vector{1.0f, 0.0f}).psnr, maxPsnr);
    EXPECT_LT(compareImages(picture, reference, std::vector{0.0f, 1.0f}).psnr, 1);
    EXPECT_THROW(compareImages(picture, reference, std::vector{0.0f, 0.0f}), std::invalid_argument);
    EXPECT_THROW(compareImages(picture, reference, std::vector{1.0f}), std::invalid_argument);
}

TEST(ImageError, TakesNaNForBlack) {
    const std::vector<float> reference(3, 1.0f);
    const std::vector<float> picture{1, std::numeric_limits<float>::quiet_NaN(), 1};
    EXPECT_NEAR(compareImages(picture, reference, std::vector{1.0f}).energyRatio, 2.0 / 3, 1e-12);
}

TEST(Materials, HaveTheLayersAskedForAndStayValid) {
    for (const Material& preset : presets()) {
        const double width = makeProfile(preset)->rmsRadius(0);
        for (const std::size_t count : {1u, 3u, 6u, 10u, 11u, 32u}) {
            const Material material = withLayers(preset, count);
            EXPECT_EQ(material.layers.size(), count) << preset.name;
            EXPECT_EQ(findFault(material), "") << preset.name;
            EXPECT_NEAR(makeProfile(material)->rmsRadius(0) / width, 1, 0.6) << preset.name << ' ' << count;
        }
    }
}

TEST(Materials, HaveTheWidthAskedFor) {
    const Material& skin = *findPreset("skin");
    EXPECT_NEAR(makeProfile(withKernelRadius(skin, 7))->quantileRadius(defaultKernelShare), 7, 1e-6);
    EXPECT_NEAR(makeProfile(withRmsRadius(skin, 3))->rmsRadius(0), 3, 1e-9);
}
