// Errors of pictures with known differences, and the materials that the suites make.
#include "bench/suites/image_error.hpp"
#include "bench/suites/suite_materials.hpp"
#include "nacre/kernel.hpp"
#include "nacre/presets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace nacre;
using namespace nacre::bench;

namespace {

// A row of pixels.
IdentifiedPicture rowOf(std::vector<float> pixels, std::vector<float> ids) {
    return {{static_cast<std::uint32_t>(ids.size()), 1, {"R", "G", "B"}, std::move(pixels)}, std::move(ids)};
}

// Of one colour, all with a material.
IdentifiedPicture plain(float value) {
    return rowOf(std::vector<float>(300, value), std::vector<float>(100, 1.0f));
}

} // namespace

TEST(ImageError, OfAConstantDifferenceIsItsPsnr) {
    const ImageError error = ReferencePicture(plain(1)).compare(plain(1.01f));
    EXPECT_NEAR(error.psnr, 40, 1e-3);
    EXPECT_NEAR(error.relMse, 1e-4 / 1.01, 1e-8);
    EXPECT_NEAR(error.energyRatio, 1.01, 1e-6);
}

TEST(ImageError, PeakFollowsTheReference) {
    EXPECT_NEAR(ReferencePicture(plain(10)).compare(plain(10.1f)).psnr, 40, 1e-3);
}

TEST(ImageError, CountsPixelsWithAMaterialOnly) {
    const auto errorWith = [](const std::vector<float>& ids) {
        return ReferencePicture(rowOf({1, 1, 1, 1, 1, 1}, ids)).compare(rowOf({1, 1, 1, 9, 9, 9}, ids));
    };
    EXPECT_EQ(errorWith({1, 0}).psnr, maxPsnr);
    EXPECT_LT(errorWith({0, 1}).psnr, 1);
    EXPECT_THROW(errorWith({0, 0}), std::invalid_argument);
    EXPECT_THROW(errorWith({1}), std::invalid_argument);
}

TEST(ImageError, TakesNaNForBlack) {
    const IdentifiedPicture picture = rowOf({1, std::numeric_limits<float>::quiet_NaN(), 1}, {1});
    EXPECT_NEAR(ReferencePicture(rowOf({1, 1, 1}, {1})).compare(picture).energyRatio, 2.0 / 3, 1e-12);
}

TEST(ImageError, EnlargesBetweenPixelsOfTheSameMaterial) {
    const IdentifiedPicture small = rowOf({0, 0, 0, 4, 4, 4, 100, 100, 100}, {1, 1, 2});
    const IdentifiedPicture large = rowOf(std::vector<float>(18), {1, 1, 1, 1, 2, 3});
    std::vector<float> red;
    const std::vector<float> enlarged = enlarge(small, large);
    for (std::size_t i = 0; i < enlarged.size(); i += 3) {
        red.push_back(enlarged[i]);
    }
    EXPECT_EQ(red, (std::vector<float>{0, 1, 3, 4, 100, 100}));
}

TEST(ImageError, EnlargesNaNToWhereItIsTheNeighbourAndNoFurther) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const IdentifiedPicture small = rowOf({4, 4, 4, 4, 4, 4, nan, nan, nan}, {1, 1, 1});
    const IdentifiedPicture large = rowOf(std::vector<float>(18), {1, 1, 1, 1, 1, 1});
    const std::vector<float> enlarged = enlarge(small, large);
    std::vector<float> red;
    for (std::size_t i = 0; i < enlarged.size(); i += 3) {
        red.push_back(enlarged[i]);
    }
    EXPECT_EQ(red, (std::vector<float>{4, 4, 4, 3, 1, 0}));
}

TEST(ImageError, OfALinearPictureEnlargedIsNone) {
    IdentifiedPicture small{{8, 8, {"R", "G", "B"}, {}}, std::vector<float>(64, 1.0f)};
    IdentifiedPicture large{{16, 16, {"R", "G", "B"}, {}}, std::vector<float>(256, 1.0f)};
    for (IdentifiedPicture* picture : {&small, &large}) {
        const float side = static_cast<float>(picture->image.width);
        for (std::uint32_t i = 0; i < picture->image.pixelCount(); ++i) {
            // The outermost pixels have no neighbour beyond them: flat there.
            const float x = std::clamp((float(i % picture->image.width) + 0.5f) / side, 1 / 16.0f, 15 / 16.0f);
            picture->image.values.insert(picture->image.values.end(), 3, x);
        }
    }
    EXPECT_GT(ReferencePicture(large).compare(small).psnr, 120);
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
