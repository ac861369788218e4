#include "bench/suites/suite_materials.hpp"

#include "nacre/kernel.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::bench {
namespace {

// How much wider a repeated layer is than the one it repeats.
constexpr double repeatedVariance = 1.1;

Material unscaled(const Material& material) {
    Material result = material;
    result.scale = 1;
    return result;
}

// One layer with the weights of all and their mean variance.
Layer merged(std::span<const Layer> layers) {
    Layer result;
    double weightSum = 0;
    for (const Layer& layer : layers) {
        const double weight = layer.weight[0] + layer.weight[1] + layer.weight[2];
        for (std::size_t channel = 0; channel < 3; ++channel) {
            result.weight[channel] += layer.weight[channel];
        }
        result.variance += weight * layer.variance;
        weightSum += weight;
    }
    result.variance /= weightSum > 0 ? weightSum : 1;
    return result;
}

// `count` layers of at least as many: neighbours in variance become one.
std::vector<Layer> fewerLayers(std::span<const Layer> layers, std::size_t count) {
    std::vector<Layer> result;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = i * layers.size() / count;
        const std::size_t last = (i + 1) * layers.size() / count;
        result.push_back(merged(layers.subspan(first, last - first)));
    }
    return result;
}

// `count` layers of fewer: they repeat, each time a little wider.
std::vector<Layer> moreLayers(std::span<const Layer> layers, std::size_t count) {
    std::vector<Layer> result;
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back(layers[i % layers.size()]);
        const std::size_t repetition = i / layers.size();
        result.back().variance *= std::pow(repeatedVariance, static_cast<double>(repetition));
    }
    return result;
}

} // namespace

Material withLayers(const Material& material, std::size_t count) {
    std::vector<Layer> layers = makeLayers(unscaled(material));
    std::sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) { return a.variance < b.variance; });
    Material result = material;
    result.meanFreePath.reset();
    result.layers = count < layers.size() ? fewerLayers(layers, count) : moreLayers(layers, count);
    return result;
}

Material withKernelRadius(const Material& material, double radius) {
    Material result = unscaled(material);
    result.scale = radius / makeProfile(result)->quantileRadius(defaultKernelShare);
    return result;
}

Material withRmsRadius(const Material& material, double radius) {
    Material result = unscaled(material);
    const auto profile = makeProfile(result);
    result.scale = radius / std::max({profile->rmsRadius(0), profile->rmsRadius(1), profile->rmsRadius(2)});
    return result;
}

} // namespace nacre::bench
