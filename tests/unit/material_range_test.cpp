// Materials at the ends of every range make every table, and each is finite.
#include "core/fault.hpp"
#include "core/half.hpp"
#include "nacre/bank.hpp"
#include "nacre/gaussian.hpp"
#include "nacre/kernel.hpp"
#include "nacre/material.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace nacre;

namespace {

constexpr double leastFloat = std::numeric_limits<float>::denorm_min();
constexpr double leastDouble = std::numeric_limits<double>::denorm_min();

// Every combination of ends, but for those whose scaled lengths are out of range.
std::vector<Material> materialsAtTheEnds() {
    std::vector<Material> materials;
    const auto add = [&](Material material) {
        for (const double scale : {scaleRange.low, 1.0, scaleRange.high}) {
            material.scale = scale;
            if (findFault(material).empty()) {
                materials.push_back(material);
            }
        }
    };
    const double variances[]{varianceRange.low,        leastDouble,       leastFloat, 1e-12,
                             varianceRange.high / 1e8, varianceRange.high};
    for (const double narrow : variances) {
        for (const double wide : variances) {
            if (wide < narrow) {
                continue;
            }
            for (const double least : {leastFloat, weightRange.high}) {
                Material material;
                material.layers = {{{weightRange.high, least, 1}, narrow}, {{least, weightRange.high, 0}, wide}};
                add(material);
            }
            Material material;
            material.layers.assign(maxLayers, {{1, 1, 1}, narrow});
            material.layers.back().variance = wide;
            add(material);
        }
    }
    for (const double red : {meanFreePathRange.low, 1.0, meanFreePathRange.high}) {
        for (const double blue : {meanFreePathRange.low, 1.0, meanFreePathRange.high}) {
            Material material;
            material.meanFreePath = {red, 1, blue};
            add(material);
            material.meanFreePath = {red, red, blue};
            add(material);
        }
    }
    return materials;
}

std::string describe(const Material& material) {
    std::string text = "scale " + formatNumber(material.scale);
    for (const Layer& layer : material.layers) {
        text += ", variance " + formatNumber(layer.variance);
    }
    for (const double length : material.meanFreePath.value_or(Rgb{})) {
        text += ", " + formatNumber(length);
    }
    return text;
}

void expectSound(const Kernel& kernel) {
    Rgb sum{};
    for (const KernelTap& tap : kernel) {
        ASSERT_TRUE(std::isfinite(tap.offset));
        for (int channel = 0; channel < 3; ++channel) {
            ASSERT_GE(tap.weight[channel], 0);
            sum[channel] += tap.weight[channel];
        }
    }
    for (const double channel : sum) {
        ASSERT_NEAR(channel, 1, 1e-9);
    }
}

void expectSound(const Profile& profile) {
    for (int channel = 0; channel < 3; ++channel) {
        ASSERT_TRUE(std::isfinite(profile.rmsRadius(channel)));
        const double radius = profile.inverseCdf(channel, 0.999);
        ASSERT_TRUE(std::isfinite(radius));
        ASSERT_GE(profile.cdf(channel, radius), 0.999 - 1e-9);
        for (const double r : {0.1 * radius, radius, 10 * radius}) {
            ASSERT_GE(profile.lineSpreadCumulative(channel, r), 0.5);
            ASSERT_LE(profile.lineSpreadCumulative(channel, r), 1 + 1e-9);
            if (r > 0) {
                ASSERT_TRUE(std::isfinite(profile.radial(channel, r)));
                ASSERT_TRUE(std::isfinite(profile.lineSpread(channel, r)));
            }
        }
    }
}

void expectSound(const BankTable& table) {
    for (int bin = 0; bin < BankTable::binCount; ++bin) {
        for (int channel = 0; channel < 3; ++channel) {
            double sum = 0;
            for (int kernel = 0; kernel < bankSize; ++kernel) {
                const double share = fromHalf(table.halves()[bin * BankTable::halvesPerBin + 3 * kernel + channel]);
                ASSERT_GE(share, 0);
                sum += share;
            }
            ASSERT_NEAR(sum, 1, 0.002); // halves
        }
    }
    const BankWeights finest = table.at(1e-30);
    const BankWeights coarsest = table.at(1e30);
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        for (int channel = 0; channel < 3; ++channel) {
            ASSERT_TRUE(std::isfinite(finest[kernel][channel]) && std::isfinite(coarsest[kernel][channel]));
        }
    }
}

TEST(MaterialRange, EveryEndMakesEveryTable) {
    const std::vector<Material> materials = materialsAtTheEnds();
    EXPECT_GT(materials.size(), 150u);
    for (const Material& material : materials) {
        SCOPED_TRACE(describe(material));
        const std::unique_ptr<Profile> profile = makeProfile(material);
        const std::vector<Layer> layers = makeLayers(material);
        ASSERT_NO_FATAL_FAILURE(expectSound(*profile));
        ASSERT_NO_FATAL_FAILURE(expectSound(SumOfGaussiansProfile(layers)));
        for (const int taps : {3, 255}) {
            ASSERT_NO_FATAL_FAILURE(expectSound(lineSpreadKernel(*profile, taps)));
        }
        for (const double extent : {1e-3, 1.0, 1e6}) {
            ASSERT_NO_FATAL_FAILURE(expectSound(sliceKernel(layers, 1, extent)));
            ASSERT_NO_FATAL_FAILURE(expectSound(sliceKernel(layers, 127, extent)));
        }
        ASSERT_NO_FATAL_FAILURE(expectSound(BankTable(*profile)));
        asksForSecondSurfaces(material);
    }
}

} // namespace
