#include "nacre/fit.hpp"
#include "nacre/gaussian.hpp"
#include "nacre/media.hpp"
#include "nacre/presets.hpp"
#include "tests/support/worst.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace nacre;

namespace {

double maxCdfError(const Profile& a, const Profile& b, int channel) {
    double worst = 0;
    for (double share = 0.002; share < 0.9999; share += 0.002) {
        const double r = b.inverseCdf(channel, share);
        worst = tests::larger(worst, std::abs(a.cdf(channel, r) - b.cdf(channel, r)));
    }
    return worst;
}

TEST(Media, DipoleReflectsWhatJensenPublishes) {
    ASSERT_EQ(jensenMedia().size(), 12u);
    for (const MeasuredMedium& measured : jensenMedia()) {
        const Rgb computed = diffuseReflectance(measured.medium);
        for (int channel = 0; channel < 3; ++channel) {
            const bool outlier = measured.medium.name == "Chicken1" && channel == 2;
            EXPECT_NEAR(computed[channel], measured.diffuseReflectance[channel], outlier ? 0.0265 : 0.00775)
                << measured.medium.name << " channel " << channel;
        }
    }
}

// Jensen et al. 2001, equation for the total: (α′/2)(1 + e^{−(4/3)A√(3(1−α′))})·e^{−√(3(1−α′))}.
TEST(Media, DipoleReflectanceHasItsClosedForm) {
    for (const MeasuredMedium& measured : jensenMedia()) {
        const Medium& medium = measured.medium;
        for (int channel = 0; channel < 3; ++channel) {
            const double albedo =
                medium.reducedScattering[channel] / (medium.reducedScattering[channel] + medium.absorption[channel]);
            const double root = std::sqrt(3 * (1 - albedo));
            const double factor = 1 + std::exp(-4.0 / 3 * boundaryFactor(medium.refractiveIndex) * root);
            EXPECT_NEAR(diffuseReflectance(medium)[channel], 0.5 * albedo * factor * std::exp(-root), 1e-12);
        }
    }
}

TEST(Media, DipoleProfileFollowsTheClosedFormCdf) {
    for (const MeasuredMedium& measured : jensenMedia()) {
        const RadialProfile profile = dipoleProfile(measured.medium);
        // Without absorption the tail falls like 1/r, and the profile ends at 1000 mean free paths.
        const double tolerance = measured.medium.absorption[0] > 0 ? 2e-5 : 4e-3;
        for (int channel = 0; channel < 3; ++channel) {
            for (const double share : {0.1, 0.5, 0.9, 0.99}) {
                const double r = profile.inverseCdf(channel, share);
                EXPECT_NEAR(dipoleCdf(measured.medium, channel, r), share, tolerance) << measured.medium.name;
            }
        }
    }
}

TEST(Media, AlbedoAndItsInverseRoundTrip) {
    for (const double anisotropy : {-0.5, 0.0, 0.8}) {
        for (double albedo = 0.1; albedo < 0.9995; albedo += 0.01) {
            const double reflected = diffuseAlbedo(albedo, anisotropy);
            EXPECT_NEAR(singleScatteringAlbedo(reflected, anisotropy), albedo, 0.006) << anisotropy;
        }
        EXPECT_EQ(diffuseAlbedo(1, anisotropy), 1);
        EXPECT_EQ(diffuseAlbedo(0, anisotropy), 0);
        EXPECT_NEAR(singleScatteringAlbedo(1, anisotropy), 1, 1e-6);
        EXPECT_NEAR(singleScatteringAlbedo(0, anisotropy), 0, 1e-4);
    }
    for (double reflected = 0.05; reflected < 0.95; reflected += 0.05) {
        EXPECT_NEAR(chiangSingleScatteringAlbedo(reflected), singleScatteringAlbedo(reflected, 0), 0.013);
    }
}

TEST(Media, SimilarMediaReflectAlike) {
    const double albedo = 0.97;
    for (const double anisotropy : {-0.7, 0.3, 0.9}) {
        const double reduced = reducedAlbedo(albedo, anisotropy);
        EXPECT_NEAR(1 - reduced, (1 - albedo) / (1 - albedo * anisotropy), 1e-15);
        EXPECT_NEAR(diffuseAlbedo(albedo, anisotropy), diffuseAlbedo(reduced, 0), 1e-12);
        // σs′ = (1 − g)σs and σa stay: σt′ = 1/ℓ′.
        const double reducedExtinction = 1 / reducedMeanFreePath(2, albedo, anisotropy);
        EXPECT_NEAR(reducedExtinction, 0.5 * ((1 - anisotropy) * albedo + 1 - albedo), 1e-12);
    }
    EXPECT_EQ(reducedAlbedo(1, 1), 1);
}

TEST(Media, BurleyShapesHaveTheStatedValues) {
    EXPECT_DOUBLE_EQ(burleyShape(0.8, BurleyEntry::Searchlight), 1.05);
    EXPECT_DOUBLE_EQ(burleyShape(0.8, BurleyEntry::Diffuse), 1.1);
    EXPECT_DOUBLE_EQ(burleyShape(0.33, BurleyEntry::SearchlightDiffuseMeanFreePath), 3.5);
    EXPECT_NEAR(burleyShape(0.91058, BurleyEntry::SearchlightDiffuseMeanFreePath), 14.9, 0.1);

    // Jensen's Skin1 through the searchlight fit gives the widths of the preset.
    const MeasuredMedium& skin = jensenMedia()[8];
    const Rgb preset = *findPreset("skin-burley")->meanFreePath;
    for (int channel = 0; channel < 3; ++channel) {
        const double meanFreePath = 1 / (skin.medium.reducedScattering[channel] + skin.medium.absorption[channel]);
        const double shape = burleyShape(skin.diffuseReflectance[channel], BurleyEntry::Searchlight);
        EXPECT_NEAR(meanFreePath / shape, preset[channel], 0.002);
    }
}

TEST(Media, BurleyMeanFreePathGrowsWithAnisotropyAndShrinksTheShape) {
    const Rgb isotropic = burleyMeanFreePath({0.8, 0.5, 0.2}, {1, 2, 3});
    EXPECT_DOUBLE_EQ(isotropic[0], 1 / 1.1);
    const Rgb forward = burleyMeanFreePath({0.8, 0.5, 0.2}, {1, 2, 3}, 0.8);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_GT(forward[channel], isotropic[channel]);
    }
    EXPECT_THROW(burleyMeanFreePath({1.1, 0, 0}, {1, 1, 1}), std::invalid_argument);
    EXPECT_THROW(burleyMeanFreePath({1, 0, 0}, {1, 0, 1}), std::invalid_argument);
    EXPECT_THROW(burleyMeanFreePath({1, 0, 0}, {1, 1, 1}, 1), std::invalid_argument);
}

TEST(Media, NameTheirFaults) {
    EXPECT_EQ(findFault(Medium{"", {1, 1, 1}, {0, -1, 0}, 1.3}), "absorption[1] is -1, must be in [0, 1000000] 1/mm");
    EXPECT_EQ(findFault(Medium{"", {1, 0, 1}, {0, 0, 0}, 1.3}),
              "reducedScattering[1] is 0, must be in [0.0001, 1000000] 1/mm");
    EXPECT_EQ(findFault(Medium{"", {1, 1, 1}, {0, 0, 0}, 0.5}), "refractiveIndex is 0.5, must be in [1, 3]");
    EXPECT_THROW(dipoleProfile(Medium{}), std::invalid_argument);
}

TEST(Fit, RecoversGaussians) {
    const std::vector<Layer> layers{{{0.5, 0.1, 0.3}, 0.05}, {{0.3, 0.2, 0.7}, 0.8}, {{0.2, 0.7, 0}, 9}};
    const LayerFit fitted = fitLayers(SumOfGaussiansProfile(layers), 3);
    ASSERT_EQ(fitted.layers.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(fitted.layers[i].variance / layers[i].variance, 1, 0.02);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(fitted.layers[i].weight[channel], layers[i].weight[channel], 0.005);
        }
    }
    EXPECT_LT(*std::max_element(fitted.maxError.begin(), fitted.maxError.end()), 1e-3);
}

TEST(Fit, ImprovesWithLayersAndReportsItsError) {
    const RadialProfile profile = dipoleProfile(jensenMedia()[5].medium);
    double last = 1;
    for (const int layerCount : {1, 2, 4, 8}) {
        const LayerFit fitted = fitLayers(profile, layerCount);
        const SumOfGaussiansProfile sum(fitted.layers);
        double worst = 0;
        for (int channel = 0; channel < 3; ++channel) {
            double weights = 0;
            for (const Layer& layer : fitted.layers) {
                EXPECT_GE(layer.weight[channel], 0);
                weights += layer.weight[channel];
            }
            EXPECT_NEAR(weights, 1, 1e-5);
            EXPECT_NEAR(maxCdfError(sum, profile, channel), fitted.maxError[channel],
                        0.1 * fitted.maxError[channel] + 1e-4);
            worst = tests::larger(worst, fitted.maxError[channel]);
        }
        EXPECT_LT(worst, 0.5 * last);
        last = worst;
    }
    EXPECT_LT(last, 1e-3);
    EXPECT_THROW(fitLayers(profile, 0), std::invalid_argument);
    EXPECT_THROW(fitLayers(profile, 33), std::invalid_argument);
}

TEST(Fit, OfASpectrumFindsTheGaussiansOfTheProfile) {
    const std::vector<Layer> layers{{{0.6, 0.6, 0.2}, 0.1}, {{0.4, 0.4, 0.8}, 4}};
    const auto spectrum = [&](int channel, double k) {
        return layers[0].weight[channel] * std::exp(-0.05 * k * k) + layers[1].weight[channel] * std::exp(-2 * k * k);
    };
    std::vector<double> frequencies;
    for (double k = 0.05; k < 10; k *= 1.05) {
        frequencies.push_back(k);
    }
    const LayerFit fitted = fitLayersToSpectrum(spectrum, frequencies, 2);
    ASSERT_EQ(fitted.layers.size(), 2u);
    EXPECT_NEAR(fitted.layers[0].variance, 0.1, 0.002);
    EXPECT_NEAR(fitted.layers[1].variance, 4, 0.08);
    EXPECT_NEAR(fitted.layers[0].weight[2], 0.2, 0.002);
    EXPECT_THROW(fitLayersToSpectrum(spectrum, {}, 2), std::invalid_argument);
    EXPECT_THROW(fitLayersToSpectrum(spectrum, std::vector<double>{0, 1}, 2), std::invalid_argument);
}

// The layers that the presets keep are those of the fit.
TEST(Presets, OfJensensMediaFollowTheirDipoles) {
    for (const MeasuredMedium& measured : jensenMedia()) {
        std::string name = measured.medium.name == "Marble" ? "marble-measured" : measured.medium.name;
        std::transform(name.begin(), name.end(), name.begin(),
                       [](char c) { return c == ' ' ? '-' : static_cast<char>(std::tolower(c)); });
        const Material* preset = findPreset(name);
        ASSERT_NE(preset, nullptr) << name;
        EXPECT_EQ(preset->albedo, measured.diffuseReflectance);
        const auto kept = makeProfile(*preset);
        const RadialProfile profile = dipoleProfile(measured.medium);
        const LayerFit fitted = fitLayers(profile, static_cast<int>(preset->layers.size()));
        for (int channel = 0; channel < 3; ++channel) {
            const double error = maxCdfError(*kept, profile, channel);
            EXPECT_LT(error, name == "spectralon" ? 0.0021 : 0.001) << name;
            EXPECT_LT(error, 1.2 * fitted.maxError[channel] + 1e-4) << name;
        }
    }
}

} // namespace
