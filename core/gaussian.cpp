#include "nacre/gaussian.hpp"

#include "fault.hpp"

#include <cmath>
#include <numbers>

namespace nacre {
namespace {

// mm²; a Gaussian a nanometre wide is a point mass, and its density would overflow.
constexpr double smallestVariance = 1e-12;

} // namespace

SumOfGaussiansProfile::SumOfGaussiansProfile(std::span<const Layer> layers) {
    requireNoFault(findLayerFault(layers));
    layers_ = normalized(layers);
    for (Layer& layer : layers_) {
        layer.variance = layer.variance < smallestVariance ? 0 : layer.variance;
    }
}

double SumOfGaussiansProfile::radial(int channel, double r) const {
    double sum = 0;
    for (const Layer& layer : layers_) {
        if (layer.variance > 0) {
            const double density = std::exp(-r * r / (2 * layer.variance)) / (2 * std::numbers::pi * layer.variance);
            sum += layer.weight[channel] * density;
        }
    }
    return sum;
}

double SumOfGaussiansProfile::cdf(int channel, double r) const {
    double sum = 0;
    for (const Layer& layer : layers_) {
        const double within = layer.variance > 0 ? -std::expm1(-r * r / (2 * layer.variance)) : 1;
        sum += layer.weight[channel] * within;
    }
    return sum;
}

double SumOfGaussiansProfile::lineSpread(int channel, double x) const {
    double sum = 0;
    for (const Layer& layer : layers_) {
        if (layer.variance > 0) {
            const double density =
                std::exp(-x * x / (2 * layer.variance)) / std::sqrt(2 * std::numbers::pi * layer.variance);
            sum += layer.weight[channel] * density;
        }
    }
    return sum;
}

double SumOfGaussiansProfile::lineSpreadCumulative(int channel, double x) const {
    double sum = 0;
    for (const Layer& layer : layers_) {
        const double share = layer.variance > 0 ? 0.5 * std::erfc(-x / std::sqrt(2 * layer.variance))
                             : x > 0            ? 1
                             : x < 0            ? 0
                                                : 0.5;
        sum += layer.weight[channel] * share;
    }
    return sum;
}

double SumOfGaussiansProfile::rmsRadius(int channel) const {
    double sum = 0;
    for (const Layer& layer : layers_) {
        sum += layer.weight[channel] * layer.variance;
    }
    return std::sqrt(2 * sum);
}

std::string findLayerFault(std::span<const Layer> layers) {
    if (layers.empty() || layers.size() > maxLayers) {
        return "layers has " + std::to_string(layers.size()) + " entries, must have 1 to " + std::to_string(maxLayers);
    }
    Rgb sum{};
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const std::string field = indexed("layers", i);
        if (auto fault = findFault(field + ".weight", layers[i].weight, weightRange); !fault.empty()) {
            return fault;
        }
        for (int channel = 0; channel < 3; ++channel) {
            sum[channel] += layers[i].weight[channel];
        }
        if (auto fault = findFault(field + ".variance", layers[i].variance, varianceRange); !fault.empty()) {
            return fault;
        }
    }
    for (int channel = 0; channel < 3; ++channel) {
        if (!(sum[channel] > 1e-12)) {
            return std::string("layers: the ") + channelNames[channel] + " weights sum to " +
                   formatNumber(sum[channel]) + ", must sum to more than 0";
        }
    }
    return {};
}

std::vector<Layer> normalized(std::span<const Layer> layers) {
    Rgb sum{};
    for (const Layer& layer : layers) {
        for (int channel = 0; channel < 3; ++channel) {
            sum[channel] += layer.weight[channel];
        }
    }
    std::vector<Layer> result(layers.begin(), layers.end());
    for (Layer& layer : result) {
        for (int channel = 0; channel < 3; ++channel) {
            layer.weight[channel] /= sum[channel];
        }
    }
    return result;
}

std::vector<Layer> scaled(std::span<const Layer> layers, double scale) {
    std::vector<Layer> result(layers.begin(), layers.end());
    for (Layer& layer : result) {
        layer.variance *= scale * scale;
    }
    return result;
}

} // namespace nacre
