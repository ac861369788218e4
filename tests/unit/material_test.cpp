#include "nacre/burley.hpp"
#include "nacre/gaussian.hpp"
#include "nacre/presets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace nacre;

namespace {

Material valid() {
    Material material;
    material.layers = {{{1, 1, 1}, 1}};
    return material;
}

TEST(Material, MakesTheProfileOfItsLayersOrItsMeanFreePath) {
    Material material = valid();
    material.scale = 3;
    EXPECT_DOUBLE_EQ(makeProfile(material)->rmsRadius(0), 3 * std::sqrt(2.0));
    material.layers.clear();
    material.meanFreePath = {1, 2, 3};
    EXPECT_DOUBLE_EQ(makeProfile(material)->rmsRadius(1), 6 * std::sqrt(14.0));
}

TEST(Material, MakesLayersThatMatchItsProfile) {
    for (Material material : presets()) {
        material.scale = 2;
        const auto profile = makeProfile(material);
        const std::vector<Layer> layers = makeLayers(material);
        const SumOfGaussiansProfile sum(layers);
        const double tolerance = material.meanFreePath ? 0.0075 : 1e-12; // Burley by six Gaussians
        for (int channel = 0; channel < 3; ++channel) {
            double weights = 0;
            for (const Layer& layer : layers) {
                weights += layer.weight[channel];
            }
            EXPECT_NEAR(weights, 1, 1e-12) << material.name;
            for (const double share : {0.1, 0.5, 0.9, 0.99}) {
                const double r = profile->inverseCdf(channel, share);
                EXPECT_NEAR(sum.cdf(channel, r), share, tolerance) << material.name;
            }
        }
    }
}

TEST(Material, NamesTheFirstFaultyFieldAndItsValue) {
    const auto faultOf = [](auto change) {
        Material material = valid();
        change(material);
        return findFault(material);
    };
    EXPECT_EQ(findFault(valid()), "");
    EXPECT_EQ(faultOf([](Material& m) { m.strength = -0.5; }), "strength is -0.5, must be in [0, 1]");
    EXPECT_EQ(faultOf([](Material& m) { m.translucency = 1.5; }), "translucency is 1.5, must be in [0, 1]");
    EXPECT_EQ(faultOf([](Material& m) { m.roughness = NAN; }), "roughness is nan, must be in [0, 1]");
    EXPECT_EQ(faultOf([](Material& m) { m.specular = INFINITY; }), "specular is inf, must be in [0, 1]");
    EXPECT_EQ(faultOf([](Material& m) { m.albedo[2] = 2; }), "albedo[2] is 2, must be in [0, 1]");
    EXPECT_EQ(faultOf([](Material& m) { m.scale = 0; }), "scale is 0, must be in [1e-06, 10000]");
    EXPECT_EQ(faultOf([](Material& m) { m.layers[0].variance = -1; }),
              "layers[0].variance is -1, must be in [0, 4e+09] mm²");
    EXPECT_EQ(faultOf([](Material& m) { m.layers.resize(33, m.layers[0]); }),
              "layers has 33 entries, must have 1 to 32");
    EXPECT_EQ(faultOf([](Material& m) {
                  m.layers[0].weight = {1, 1, 0};
              }),
              "layers: the blue weights sum to 0, must sum to more than 0");
    EXPECT_EQ(faultOf([](Material& m) { m.layers.clear(); }),
              "layers, meanFreePath and slabs are all missing, one must describe the profile");
    EXPECT_EQ(faultOf([](Material& m) {
                  m.meanFreePath = {1, 1, 1};
              }),
              "layers and meanFreePath are both given, only one may describe the profile");
    EXPECT_EQ(faultOf([](Material& m) {
                  m.layers.clear();
                  m.meanFreePath = {1, 1, -3};
              }),
              "meanFreePath[2] is -3, must be in [1e-06, 10000] mm");
    EXPECT_EQ(faultOf([](Material& m) {
                  m.scale = 1e4;
                  m.layers[0].variance = 100;
              }),
              "scale²·variance is 1e+10, must be in [0, 4e+09] mm²");
}

TEST(Material, RefusesAProfileForEveryFaultThatFindFaultFinds) {
    Material material;
    EXPECT_THROW(makeProfile(material), std::invalid_argument);
    EXPECT_THROW(makeLayers(material), std::invalid_argument);
    material.layers = {{{1, 1, 1}, NAN}};
    EXPECT_THROW(makeProfile(material), std::invalid_argument);
    material.layers = {{{0, 1, 1}, 1}};
    EXPECT_THROW(makeLayers(material), std::invalid_argument);
}

TEST(Material, AsksForSecondSurfacesWhereItsLightGoesFar) {
    Material material;
    material.layers = {{{1, 1, 0.5}, 1}, {{0, 0, 0.5}, 8.02}}; // blue: an rms radius of 3.003 mm
    EXPECT_TRUE(asksForSecondSurfaces(material));
    material.scale = 0.99;
    EXPECT_FALSE(asksForSecondSurfaces(material));
    material.secondSurfaces = true;
    EXPECT_TRUE(asksForSecondSurfaces(material));
    material.scale = 10;
    material.secondSurfaces = false;
    EXPECT_FALSE(asksForSecondSurfaces(material));
    for (const auto& [name, asks] : {std::pair{"skin", false},
                                     {"skin-burley", false},
                                     {"marble", false},
                                     {"leaf", false},
                                     {"nacre", false},
                                     {"jade", true},
                                     {"wax", true},
                                     {"whole-milk", true}}) {
        EXPECT_EQ(asksForSecondSurfaces(*findPreset(name)), asks) << name;
    }
}

TEST(Presets, AreWithoutFaultAndHaveDifferentNames) {
    std::set<std::string> names;
    for (const Material& preset : presets()) {
        EXPECT_EQ(findFault(preset), "") << preset.name;
        EXPECT_FALSE(preset.description.empty()) << preset.name;
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
        EXPECT_EQ(findPreset(preset.name), &preset);
    }
    EXPECT_EQ(findPreset("Skin"), nullptr);
    EXPECT_EQ(findPreset(""), nullptr);
}

TEST(Presets, HaveWhatIsPromised) {
    EXPECT_EQ(findPreset("skin")->layers.size(), 6u);
    EXPECT_EQ(findPreset("marble")->layers.size(), 4u);
    EXPECT_EQ(findPreset("nacre")->layers.size(), 10u);
    for (const char* name : {"wax", "jade", "leaf", "nacre"}) {
        EXPECT_NE(findPreset(name)->description.find("chosen by eye"), std::string::npos) << name;
    }
}

TEST(Presets, PublishedColumnsSumToOne) {
    for (const char* name : {"skin", "marble", "nacre"}) {
        Rgb sum{};
        for (const Layer& layer : findPreset(name)->layers) {
            for (int channel = 0; channel < 3; ++channel) {
                sum[channel] += layer.weight[channel];
            }
        }
        for (const double channel : sum) {
            EXPECT_NEAR(channel, 1, 2e-6) << name;
        }
    }
}

} // namespace
