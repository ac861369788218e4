#include "tests/support/bank_twin.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::tests {
namespace {

namespace constants {
#include "effect/shaders/bank_constants.h"
} // namespace constants
static_assert(constants::bankLevels == bankLevels && constants::bankSize == bankSize);
static_assert(constants::bankBinsPerOctave == BankTable::binsPerOctave &&
              constants::bankBinCount == BankTable::binCount);

constexpr int tileSize = 32;
constexpr int regionHeight = 16; // of pass C's workgroups, which are as wide as a tile, px

double falloff(double q) {
    return std::pow(std::max(0.0, 1 - q / 4), 4);
}

// What a 2x2 block of texels becomes: those of one surface. Levels that keep a second surface have up to eight.
struct Block {
    std::vector<const RawTexel*> texels;
    double nearest = 1e300;
    double farthest = 0;

    void add(const RawTexel* texel) {
        if (texel != nullptr && texel->mass > 0) {
            texels.push_back(texel);
            nearest = std::min(nearest, texel->depth);
            farthest = std::max(farthest, texel->depth);
        }
    }

    template <typename Keep> RawTexel sum(Keep keep) const {
        RawTexel result;
        double depth = 0;
        for (const RawTexel* texel : texels) {
            if (!keep(*texel)) {
                result.dropped = true;
                continue;
            }
            for (int channel = 0; channel < 3; ++channel) {
                result.light[channel] += texel->light[channel] / 4;
            }
            result.area += texel->area / 4;
            result.mass += texel->mass / 4;
            result.dropped |= texel->dropped;
            depth += texel->mass / 4 * texel->depth;
        }
        result.depth = result.mass > 0 ? depth / result.mass : 0;
        return result;
    }

    bool isNear(const RawTexel& texel) const { return texel.depth - nearest <= farthest - texel.depth; }
};

// What a kernel's share of a pixel is multiplied by: Σ kernel · depth weight · area, which is 1 on a plane of any
// slope.
double massOf(double area) {
    return std::min(area, 1.0);
}

// Depth step to the next pixel along one axis, mm: the mean of both sides or, where one is a step to another surface,
// the smaller. A side without a surface is null.
double pixelStep(const RawTexel* before, const RawTexel& pixel, const RawTexel* after, double width) {
    const double stepBefore = before != nullptr ? pixel.depth - before->depth : 0;
    const double stepAfter = after != nullptr ? after->depth - pixel.depth : 0;
    if (before == nullptr || after == nullptr) {
        return stepBefore + stepAfter;
    }
    const double smaller = std::min(std::abs(stepBefore), std::abs(stepAfter));
    const double larger = std::max(std::abs(stepBefore), std::abs(stepAfter));
    return larger <= 2 * std::max(smaller, width) ? 0.5 * (stepBefore + stepAfter) : smaller;
}

} // namespace

// Length of a pixel's ray where its depth along the view direction changes by 1.
double BankTwin::stretch(int x, int y) const {
    return std::hypot(1, (x + 0.5 - 0.5 * scene_.width) / scene_.focalLength,
                      (y + 0.5 - 0.5 * scene_.height) / scene_.focalLength);
}

// Area of a pixel's surface relative to one that faces the camera.
double BankTwin::pixelArea(int x, int y) const {
    const auto neighbor = [&](int dx, int dy) -> const RawTexel* {
        const RawTexel* pixel = raw_[0].at(x + dx, y + dy);
        return pixel != nullptr && pixel->mass > 0 ? pixel : nullptr;
    };
    const RawTexel& pixel = *raw_[0].at(x, y);
    const double width = texelWidth(0, pixel.depth);
    const double stepX = pixelStep(neighbor(-1, 0), pixel, neighbor(1, 0), width);
    const double stepY = pixelStep(neighbor(0, -1), pixel, neighbor(0, 1), width);
    return std::min<double>(std::hypot(1, stepX / width, stepY / width), constants::bankLargestArea);
}

// Numerator and denominator of the result, per channel.
struct BankTwin::Accumulator {
    Rgb light{};
    Rgb mass{};

    void add(const Rgb& weight, const Rgb& kernelLight, double kernelMass) {
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += weight[channel] * kernelLight[channel];
            mass[channel] += weight[channel] * kernelMass;
        }
    }

    // Light and area, summed with depth weights over the surface within a kernel's reach.
    void addSurface(const Rgb& weight, Rgb kernelLight, double area) {
        for (double& value : kernelLight) {
            value *= massOf(area) / std::max<double>(area, constants::bankLeastWeight);
        }
        add(weight, kernelLight, massOf(area));
    }
};

BankTwin::BankTwin(const ScatterScene& scene, const TwinSettings& settings) : scene_(scene), settings_(settings) {
    for (const auto& profile : scene.profiles) {
        tables_.emplace_back(*profile);
    }
    tilesX_ = (scene.width + tileSize - 1) / tileSize;
    tilesY_ = (scene.height + tileSize - 1) / tileSize;
    raw_[0].width = scene.width;
    raw_[0].height = scene.height;
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            const std::size_t i = scene.index(x, y);
            const bool scatters = scene.materialId[i] != 0;
            raw_[0].texels.push_back(scatters ? RawTexel{scene.irradiance[i], 1, 1, scene.depth[i] * stretch(x, y)}
                                              : RawTexel{});
        }
    }
    for (int y = 0; settings.areaWeights && y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            weighByArea(x, y);
        }
    }
    for (int level = 1; level <= bankLevels; ++level) {
        reduceLevel(level);
    }
    for (int level = 2; level <= bankLevels; ++level) {
        blurLevel(level);
    }
    for (int tileY = 0; tileY < tilesY_; ++tileY) {
        for (int tileX = 0; tileX < tilesX_; ++tileX) {
            const bool empty = raw_[5].at(tileX, tileY)->mass <= 0;
            for (const int half : {0, 1}) {
                regionKinds_.push_back(empty ? 0 : isSmooth(tileX, tileY, half) ? 1 : 2);
            }
        }
    }
    result_ = scene.irradiance;
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            const int tile = y / tileSize * tilesX_ + x / tileSize;
            if (raw_[0].at(x, y)->mass > 0) {
                combinePixel(x, y, regionKinds_[2 * tile + y / regionHeight % 2] == 1);
            }
        }
    }
}

void BankTwin::weighByArea(int x, int y) {
    RawTexel& pixel = raw_[0].texels[scene_.index(x, y)];
    if (pixel.mass <= 0) {
        return;
    }
    pixel.area = pixelArea(x, y);
    for (double& value : pixel.light) {
        value *= pixel.area;
    }
}

double BankTwin::smoothShare() const {
    const auto smooth = std::count(regionKinds_.begin(), regionKinds_.end(), 1);
    const auto edge = std::count(regionKinds_.begin(), regionKinds_.end(), 2);
    return static_cast<double>(smooth) / static_cast<double>(std::max<std::ptrdiff_t>(smooth + edge, 1));
}

bool BankTwin::hasSeconds(int level) const {
    return settings_.secondSurfaces && level >= 1 && level <= constants::bankSecondLevels;
}

void BankTwin::reduceLevel(int level) {
    const TwinLevel<RawTexel>& from = raw_[level - 1];
    TwinLevel<RawTexel>& to = raw_[level];
    TwinLevel<RawTexel>& seconds = rawSeconds_[level];
    // Whole tiles: what lies outside the image is empty.
    to.width = level == 1 ? tilesX_ * tileSize / 2 : (from.width + 1) / 2;
    to.height = level == 1 ? tilesY_ * tileSize / 2 : (from.height + 1) / 2;
    seconds.width = to.width;
    seconds.height = to.height;
    const bool finest = level == 1 && settings_.secondSurfaces;
    const double separation = finest ? constants::bankFinestSeparation : constants::bankSurfaceSeparation;
    for (int i = 0; i < to.width * to.height; ++i) {
        Block block;
        for (int child = 0; child < 4; ++child) {
            const int x = 2 * (i % to.width) + (child & 1);
            const int y = 2 * (i / to.width) + (child >> 1);
            block.add(from.at(x, y));
            if (hasSeconds(level - 1) && hasSeconds(level)) {
                block.add(rawSeconds_[level - 1].at(x, y));
            }
        }
        const double limit = separation * texelWidth(level, block.nearest);
        RawTexel texel = block.sum([](const RawTexel&) { return true; });
        RawTexel second;
        if (block.farthest - block.nearest > limit && hasSeconds(level)) {
            texel = block.sum([&](const RawTexel& t) { return block.isNear(t); });
            second = block.sum([&](const RawTexel& t) { return !block.isNear(t); });
            if (texel.mass < second.mass) {
                std::swap(texel, second);
            }
        } else if (block.farthest - block.nearest > limit) {
            const RawTexel front = block.sum([&](const RawTexel& t) { return t.depth - block.nearest <= limit; });
            const RawTexel back = block.sum([&](const RawTexel& t) { return block.farthest - t.depth <= limit; });
            texel = front.mass >= back.mass ? front : back;
        }
        to.texels.push_back(texel);
        seconds.texels.push_back(second);
    }
}

void BankTwin::blurLevel(int level) {
    TwinLevel<BlurredTexel>& to = blurred_[level];
    TwinLevel<BlurredTexel>& seconds = blurredSeconds_[level];
    seconds.width = to.width = raw_[level].width;
    seconds.height = to.height = raw_[level].height;
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            const RawTexel& second = *rawSeconds_[level].at(x, y);
            to.texels.push_back(blurTexel(level, x, y));
            seconds.texels.push_back(second.mass > 0 ? blurAt(level, x, y, second.depth) : BlurredTexel{});
        }
    }
}

BlurredTexel BankTwin::blurTexel(int level, int x, int y) const {
    const TwinLevel<RawTexel>& raw = raw_[level];
    if (raw.at(x, y)->mass > 0) {
        return blurAt(level, x, y, raw.at(x, y)->depth);
    }
    // An empty texel stands on the surface its neighbours are on.
    double mass = 0;
    double sum = 0;
    for (int i = 0; i < 9; ++i) {
        const RawTexel* tap = raw.at(x + i % 3 - 1, y + i / 3 - 1);
        mass += tap != nullptr ? tap->mass : 0;
        sum += tap != nullptr ? tap->mass * tap->depth : 0;
    }
    return mass > 0 ? blurAt(level, x, y, sum / mass) : BlurredTexel{};
}

// A texel's kernel where it stands on a surface at this depth.
BlurredTexel BankTwin::blurAt(int level, int x, int y, double depth) const {
    constexpr double binomial[] = {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};
    const double width = texelWidth(level, depth);
    Rgb light{};
    double area = 0;
    for (int i = 0; i < 50; ++i) {
        const TwinLevel<RawTexel>& raw = i < 25 ? raw_[level] : rawSeconds_[level];
        const double kernel = binomial[i % 5] * binomial[i / 5 % 5];
        const RawTexel* tap = raw.at(x + i % 5 - 2, y + i / 5 % 5 - 2);
        if (tap == nullptr || tap->mass <= 0) {
            continue;
        }
        const double difference = tap->depth - depth;
        const double weight =
            kernel * falloff(difference * difference / (constants::bankBlurDepthVariance * width * width));
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += weight * tap->light[channel];
        }
        area += weight * tap->area;
    }
    BlurredTexel result;
    result.depth = depth;
    result.mass = massOf(area);
    for (int channel = 0; channel < 3; ++channel) {
        result.light[channel] = light[channel] / std::max<double>(area, constants::bankLeastWeight) * result.mass;
    }
    return result;
}

// Whether a 2x2 block of pixels, with those beside it, has a depth step or left something out.
bool BankTwin::isRough(int blockX, int blockY) const {
    double longest = 0;
    double farthest = 0;
    bool besideHole = false;
    const auto depthAt = [&](int x, int y) {
        const RawTexel* pixel = raw_[0].at(x, y);
        return pixel != nullptr ? pixel->depth : 0;
    };
    for (int i = 0; i < 4; ++i) {
        const int x = 2 * blockX + i % 2;
        const int y = 2 * blockY + i / 2;
        const double depth = depthAt(x, y);
        farthest = std::max(farthest, depth);
        besideHole |= depth == 0;
        for (const double beside : {depthAt(x - 1, y), depthAt(x + 1, y), depthAt(x, y - 1), depthAt(x, y + 1)}) {
            besideHole |= beside == 0;
            longest = std::max(longest, std::min(depth, beside) > 0 ? std::abs(depth - beside) : 0);
        }
    }
    const double limit = besideHole ? constants::bankSmoothHoleDepth : constants::bankSmoothDepth;
    return raw_[1].at(blockX, blockY)->dropped || longest > limit * texelWidth(0, farthest);
}

// No block of a tile's upper or lower half, or beside it, is rough.
bool BankTwin::isSmooth(int tileX, int tileY, int half) const {
    const int width = tileSize / 2;
    const int height = regionHeight / 2;
    const int firstX = tileX * width;
    const int firstY = (2 * tileY + half) * height;
    for (int y = firstY - 1; y <= firstY + height; ++y) {
        for (int x = firstX - 1; x <= firstX + width; ++x) {
            if (raw_[1].at(x, y) != nullptr && isRough(x, y)) {
                return false;
            }
        }
    }
    return settings_.smoothTiles;
}

// In smooth regions the pixels of a 2x2 quad share its depth for their weights and for their texels' depth weights.
void BankTwin::combinePixel(int x, int y, bool smooth) {
    const std::size_t index = scene_.index(x, y);
    const double depth = smooth ? raw_[1].at(x / 2, y / 2)->depth : raw_[0].at(x, y)->depth;
    const BankWeights weights = tables_[scene_.materialId[index] - 1].at(scene_.focalLength * stretch(x, y) / depth);
    Rgb identity = weights[0];
    for (double& share : identity) {
        share = std::max<double>(share, constants::bankLeastIdentity);
    }
    Accumulator sum;
    sum.add(identity, scene_.irradiance[index], 1);
    if (smooth) {
        addPixelsOnSlope(sum, weights[1], x, y);
        addFinestOnSlope(sum, weights[2], x, y);
    } else {
        addPixels(sum, weights[1], x, y);
        addFinest(sum, weights[2], x, y);
    }
    for (int level = 2; level <= bankLevels; ++level) {
        addLevel(sum, weights[level + 1], level, x, y, {depth, smooth});
    }
    for (int channel = 0; channel < 3; ++channel) {
        if (sum.mass[channel] > 0) {
            result_[index][channel] = sum.light[channel] / sum.mass[channel];
        }
    }
}

// Depth step along one axis within the pixel's quad, the mean of the pairs that both scatter.
double BankTwin::quadSlope(int x, int y, int dx, int dy) const {
    double sum = 0;
    int pairs = 0;
    for (int i = 0; i < 2; ++i) {
        const int fromX = (x & ~1) + (dy != 0 ? i : 0);
        const int fromY = (y & ~1) + (dx != 0 ? i : 0);
        const RawTexel* from = raw_[0].at(fromX, fromY);
        const RawTexel* to = raw_[0].at(fromX + dx, fromY + dy);
        if (from != nullptr && to != nullptr && from->mass > 0 && to->mass > 0) {
            sum += to->depth - from->depth;
            ++pairs;
        }
    }
    return pairs > 0 ? sum / pairs : 0;
}

// How much a tap beside the middle of a 3x3 weighs, x and y, for one of 1 there, on the slope that the pixel's quad
// stands on.
std::array<double, 2> BankTwin::slopeFalloffs(int x, int y) const {
    const double width = texelWidth(0, raw_[0].at(x, y)->depth);
    const auto side = [&](double slope) {
        return falloff(slope * slope / (constants::bankPixelDepthVariance * width * width));
    };
    return {side(quadSlope(x, y, 1, 0)), side(quadSlope(x, y, 0, 1))};
}

// As addPixels, with the depths of the slope the quad stands on in place of the taps' own: separable.
void BankTwin::addPixelsOnSlope(Accumulator& sum, const Rgb& weight, int x, int y) const {
    const std::array<double, 2> falloffs = slopeFalloffs(x, y);
    const double total = (1 + falloffs[0]) * (1 + falloffs[1]);
    Rgb light{};
    double mass = 0;
    for (int i = 0; i < 9; ++i) {
        const RawTexel* tap = raw_[0].at(x + i % 3 - 1, y + i / 3 - 1);
        if (tap == nullptr || tap->mass <= 0) {
            continue;
        }
        const double kernel = (i % 3 == 1 ? 1 : 0.5 * falloffs[0]) * (i / 3 == 1 ? 1 : 0.5 * falloffs[1]) / total;
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += kernel * tap->light[channel] / tap->area;
        }
        mass += kernel;
    }
    sum.add(weight, light, mass);
}

namespace {

// The kernel along an axis that level 1's 3x3 mean and the bilinear reading of it are together, from two texels before
// the pixel's own on. `side`: share of the mean's taps beside its middle.
std::array<double, 5> finestTaps(double side, int odd) {
    const double mean[] = {side, 1 - 2 * side, side};
    std::array<double, 5> result{};
    for (int i = 0; i < 3; ++i) {
        result[i + 1] += 0.75 * mean[i];
        result[i + 2 * odd] += 0.25 * mean[i];
    }
    return result;
}

} // namespace

// The same for level 1.
void BankTwin::addFinestOnSlope(Accumulator& sum, const Rgb& weight, int x, int y) const {
    const std::array<double, 2> falloffs = slopeFalloffs(x, y);
    const auto side = [](double wide) { return std::pow(wide, 1.5) / (1 + 2 * std::pow(wide, 1.5)); };
    const std::array<double, 5> tapsX = finestTaps(side(falloffs[0]), x % 2);
    const std::array<double, 5> tapsY = finestTaps(side(falloffs[1]), y % 2);
    Rgb light{};
    double mass = 0;
    for (int i = 0; i < 25; ++i) {
        const RawTexel* tap = raw_[1].at(x / 2 + i % 5 - 2, y / 2 + i / 5 - 2);
        if (tap == nullptr || tap->mass <= 0) {
            continue;
        }
        const double kernel = tapsX[i % 5] * tapsY[i / 5] * massOf(tap->area);
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += kernel * tap->light[channel] / tap->area;
        }
        mass += kernel;
    }
    sum.add(weight, light, mass);
}

// Level 1 as a pixel of an edge region sees it.
void BankTwin::addFinest(Accumulator& sum, const Rgb& weight, int x, int y) const {
    const double depth = raw_[0].at(x, y)->depth;
    const double width = texelWidth(1, depth);
    const std::array<double, 5> tapsX = finestTaps(1 / 3.0, x % 2);
    const std::array<double, 5> tapsY = finestTaps(1 / 3.0, y % 2);
    Rgb light{};
    double area = 0;
    for (int i = 0; i < 50; ++i) {
        const TwinLevel<RawTexel>& raw = i < 25 ? raw_[1] : rawSeconds_[1];
        const RawTexel* tap = raw.at(x / 2 + i % 5 - 2, y / 2 + i / 5 % 5 - 2);
        if (tap == nullptr || tap->mass <= 0) {
            continue;
        }
        const double difference = tap->depth - depth;
        const double kernel = tapsX[i % 5] * tapsY[i / 5 % 5] *
                              falloff(difference * difference / (constants::bankPixelDepthVariance * width * width));
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += kernel * tap->light[channel];
        }
        area += kernel * tap->area;
    }
    sum.addSurface(weight, light, area);
}

void BankTwin::addPixels(Accumulator& sum, const Rgb& weight, int x, int y) const {
    constexpr double binomial[] = {0.25, 0.5, 0.25};
    double area = 0;
    const double depth = raw_[0].at(x, y)->depth;
    const double width = texelWidth(0, depth);
    Rgb light{};
    for (int i = 0; i < 9; ++i) {
        const double kernel = binomial[i % 3] * binomial[i / 3];
        const RawTexel* tap = raw_[0].at(x + i % 3 - 1, y + i / 3 - 1);
        if (tap == nullptr || tap->mass <= 0) {
            continue;
        }
        const double difference = tap->depth - depth;
        const double tapWeight =
            kernel * falloff(difference * difference / (constants::bankPixelDepthVariance * width * width));
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += tapWeight * tap->light[channel];
        }
        area += tapWeight * tap->area;
    }
    sum.addSurface(weight, light, area);
}

void BankTwin::addLevel(Accumulator& sum, const Rgb& weight, int level, int x, int y, const Standpoint& from) const {
    const TwinLevel<BlurredTexel>& blurred = blurred_[level];
    const double width = texelWidth(level, from.depth);
    const double depthVariance =
        settings_.secondSurfaces ? constants::bankSurfacesLevelDepthVariance : constants::bankLevelDepthVariance;
    const double awayVariance =
        settings_.secondSurfaces ? constants::bankSurfacesLevelAwayVariance : constants::bankLevelAwayVariance;
    const double positionX = (x + 0.5) / (1 << level) - 0.5;
    const double positionY = (y + 0.5) / (1 << level) - 0.5;
    const int firstX = static_cast<int>(std::floor(positionX));
    const int firstY = static_cast<int>(std::floor(positionY));
    const double fractionX = positionX - firstX;
    const double fractionY = positionY - firstY;
    Rgb light{};
    double mass = 0;
    double total = 0;
    double away = 0; // of the texels' surface from the pixel's, mm
    for (int i = 0; i < (from.smooth ? 4 : 8); ++i) {
        const int tapX = std::clamp(firstX + i % 2, 0, blurred.width - 1);
        const int tapY = std::clamp(firstY + i / 2 % 2, 0, blurred.height - 1);
        const BlurredTexel& tap = *(i < 4 ? blurred : blurredSeconds_[level]).at(tapX, tapY);
        double tapWeight = (i % 2 == 1 ? fractionX : 1 - fractionX) * (i / 2 % 2 == 1 ? fractionY : 1 - fractionY);
        const double difference = tap.depth - from.depth;
        const double q = difference * difference / (depthVariance * width * width);
        tapWeight *= tap.depth > 0 ? falloff(q) : 0;
        for (int channel = 0; channel < 3; ++channel) {
            light[channel] += tapWeight * tap.light[channel];
        }
        mass += tapWeight * tap.mass;
        total += tapWeight;
        away += tapWeight * difference;
    }
    total = std::max<double>(total, constants::bankLeastWeight);
    const double distance = away / total / width;
    const double share = falloff(distance * distance / awayVariance);
    for (double& value : light) {
        value *= share / total;
    }
    sum.add(weight, light, share * mass / total);
}

} // namespace nacre::tests
