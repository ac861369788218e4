// Pass C of the bank's twin: every pixel's mixture.
#include "tests/support/bank_twin.hpp"
#include "tests/support/bank_twin_shared.hpp"

namespace nacre::tests {
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

// Between which four texels of a level a place lies.
struct Corner {
    int x = 0; // of the first
    int y = 0;
    double fractionX = 0; // from there to the next
    double fractionY = 0;

    /// The bilinear weight of one of the four, counted row by row.
    double weight(int i) const {
        return (i % 2 == 1 ? fractionX : 1 - fractionX) * (i / 2 == 1 ? fractionY : 1 - fractionY);
    }
};

Corner cornerOf(int level, const PixelPlace& place) {
    const double positionX = place.x / (1 << level) - 0.5;
    const double positionY = place.y / (1 << level) - 0.5;
    const double firstX = std::floor(positionX);
    const double firstY = std::floor(positionY);
    return {static_cast<int>(firstX), static_cast<int>(firstY), positionX - firstX, positionY - firstY};
}

// A blurred texel as it is read: beyond the border the nearest one, with less of its light and coverage.
BlurredTexel texelRead(const TwinLevel<BlurredTexel>& level, int x, int y) {
    BlurredTexel texel = level.nearest(x, y);
    if (level.at(x, y) == nullptr) {
        for (double& value : texel.light) {
            value *= constants::bankBorderShare;
        }
        texel.coverage *= constants::bankBorderShare;
    }
    return texel;
}

} // namespace

// What a kernel sees of a pixel's surface: light times coverage, and coverage.
struct BankTwin::Seen {
    Rgb light{};
    double coverage = 0;
    double present =
        1; // [0, 1] of the kernel, what is at the pixel's depth; edge pixels ask the next finer one for the rest
};

// The pixels of a 2x2 quad. In smooth regions they share its depth, for their weights and their texels' depth weights,
// and a kernel's coverage; and what they see of a coarse level, but for its slopes.
void BankTwin::combineQuad(int firstX, int firstY, const Region& region) {
    const bool smooth = region.smooth;
    if (reduced_[1].at(firstX / 2, firstY / 2)->coverage <= 0) {
        return;
    }
    std::array<std::array<Seen, bankSize>, 4> seen;
    for (int i = 0; i < 4; ++i) {
        const int x = firstX + i % 2;
        const int y = firstY + i / 2;
        if (smooth || isMember(x, y)) {
            for (int kernel = 1; kernel < bankSize; ++kernel) {
                seen[i][kernel] = seenBy(kernel, x, y, region);
            }
        }
    }
    for (int kernel = 1; smooth && kernel <= 2; ++kernel) {
        double coverage = 0;
        for (const auto& pixel : seen) {
            coverage += 0.25 * pixel[kernel].coverage;
        }
        for (auto& pixel : seen) {
            for (double& value : pixel[kernel].light) {
                value *= coverage / std::max<double>(pixel[kernel].coverage, constants::bankLeastWeight);
            }
            pixel[kernel].coverage = coverage;
        }
    }
    for (int i = 0; i < 4; ++i) {
        if (isMember(firstX + i % 2, firstY + i / 2)) {
            combinePixel(firstX + i % 2, firstY + i / 2, smooth, seen[i]);
        }
    }
}

bool BankTwin::isMember(int x, int y) const {
    const ReducedTexel* pixel = reduced_[0].at(x, y);
    return pixel != nullptr && pixel->coverage > 0;
}

// What the weights of a pixel's kernels and of its texels are taken at, mm.
double BankTwin::depthOf(int x, int y, bool smooth) const {
    return smooth ? reduced_[1].at(x / 2, y / 2)->depth : reduced_[0].at(x, y)->depth;
}

BankTwin::Seen BankTwin::seenBy(int kernel, int x, int y, const Region& region) const {
    const bool smooth = region.smooth;
    switch (kernel) {
    case 1:
        return smooth ? pixelsOnSlope(x, y) : pixels(x, y);
    case 2:
        return smooth ? finestOnSlope(x, y) : finest(x, y);
    default:
        return smooth ? levelOfQuad(kernel - 1, x, y, region) : levelSeen(kernel - 1, x, y, {x + 0.5, y + 0.5}, region);
    }
}

// A coarse level as a pixel of a smooth region sees it: from its quad's middle, and on the finer ones of them the
// pixel's own light by how the mean light changes there.
BankTwin::Seen BankTwin::levelOfQuad(int level, int x, int y, const Region& region) const {
    const PixelPlace middle{x / 2 * 2 + 1.0, y / 2 * 2 + 1.0};
    const Seen seen = levelSeen(level, x, y, middle, region);
    if (level > constants::bankSlopeLevels) {
        return seen;
    }
    Seen result = seen;
    for (const PixelPlace& toPixel : {PixelPlace{x + 0.5 - middle.x, 0}, PixelPlace{0, y + 0.5 - middle.y}}) {
        const Seen there = levelSeen(level, x, y, {middle.x + toPixel.x, middle.y + toPixel.y}, region);
        for (int channel = 0; channel < 3; ++channel) {
            const double mean = seen.light[channel] / std::max<double>(seen.coverage, constants::bankLeastWeight);
            result.light[channel] +=
                there.light[channel] - seen.light[channel] - mean * (there.coverage - seen.coverage);
        }
    }
    return result;
}

void BankTwin::combinePixel(int x, int y, bool smooth, std::span<const Seen, bankSize> seen) {
    const std::size_t index = scene_.index(x, y);
    const BankWeights weights =
        tables_[scene_.materialId[index] - 1].at(scene_.focalLength * stretch(x, y) / depthOf(x, y, smooth));
    std::array<bool, bankSize> used{};
    for (int kernel = 1; kernel < bankSize; ++kernel) {
        used[kernel] = kernel == 1 || weights[kernel] != Rgb{};
    }
    for (int channel = 0; channel < 3; ++channel) {
        double total = std::max<double>(weights[0][channel], constants::bankLeastIdentity);
        double light = total * scene_.irradiance[index][channel];
        double passedOn = 0;
        for (int kernel = bankSize - 1; kernel > 0; --kernel) {
            if (!used[kernel]) {
                continue;
            }
            const double weight = weights[kernel][channel] + passedOn;
            light += weight * seen[kernel].light[channel];
            total += weight * seen[kernel].coverage;
            passedOn = smooth ? 0 : weight * (1 - seen[kernel].present);
        }
        if (total > 0) {
            result_[index][channel] = light / total;
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
        const ReducedTexel* from = reduced_[0].at(fromX, fromY);
        const ReducedTexel* to = reduced_[0].at(fromX + dx, fromY + dy);
        if (from != nullptr && to != nullptr && from->coverage > 0 && to->coverage > 0) {
            sum += to->depth - from->depth;
            ++pairs;
        }
    }
    return pairs > 0 ? sum / pairs : 0;
}

// How much a tap beside the middle of a 3x3 weighs, x and y, for one of 1 there, on the slope that the pixel's quad
// stands on.
std::array<double, 2> BankTwin::slopeFalloffs(int x, int y) const {
    const double width = texelWidth(0, depthOf(x, y, true));
    const auto side = [&](double slope) {
        return falloff(slope * slope / (constants::bankPixelDepthVariance * width * width));
    };
    return {side(quadSlope(x, y, 1, 0)), side(quadSlope(x, y, 0, 1))};
}

// As pixels, with the depths of the slope the quad stands on in place of the taps' own: separable.
BankTwin::Seen BankTwin::pixelsOnSlope(int x, int y) const {
    const std::array<double, 2> falloffs = slopeFalloffs(x, y);
    const double total = (1 + falloffs[0]) * (1 + falloffs[1]);
    Seen seen;
    for (int i = 0; i < 9; ++i) {
        const ReducedTexel* tap = reduced_[0].at(x + i % 3 - 1, y + i / 3 - 1);
        if (tap == nullptr || tap->coverage <= 0) {
            continue;
        }
        const double kernel = (i % 3 == 1 ? 1 : 0.5 * falloffs[0]) * (i / 3 == 1 ? 1 : 0.5 * falloffs[1]) / total;
        for (int channel = 0; channel < 3; ++channel) {
            seen.light[channel] += kernel * tap->light[channel] / tap->area;
        }
        seen.coverage += kernel;
    }
    return seen;
}

// The same for level 1.
BankTwin::Seen BankTwin::finestOnSlope(int x, int y) const {
    const std::array<double, 2> falloffs = slopeFalloffs(x, y);
    const auto side = [](double wide) {
        const double narrow = std::pow(wide, constants::bankFinestFalloffPower);
        return narrow / (1 + 2 * narrow);
    };
    const std::array<double, 5> tapsX = finestTaps(side(falloffs[0]), x % 2);
    const std::array<double, 5> tapsY = finestTaps(side(falloffs[1]), y % 2);
    Seen seen;
    for (int i = 0; i < 25; ++i) {
        const ReducedTexel* tap = reduced_[1].at(x / 2 + i % 5 - 2, y / 2 + i / 5 - 2);
        if (tap == nullptr || tap->coverage <= 0) {
            continue;
        }
        const double kernel = tapsX[i % 5] * tapsY[i / 5] * coverageOf(tap->area);
        for (int channel = 0; channel < 3; ++channel) {
            seen.light[channel] += kernel * tap->light[channel] / tap->area;
        }
        seen.coverage += kernel;
    }
    return seen;
}

// Level 1 as a pixel of an edge region sees it.
BankTwin::Seen BankTwin::finest(int x, int y) const {
    const double depth = reduced_[0].at(x, y)->depth;
    const double width = texelWidth(1, depth);
    const std::array<double, 5> tapsX = finestTaps(1 / 3.0, x % 2);
    const std::array<double, 5> tapsY = finestTaps(1 / 3.0, y % 2);
    SurfaceSum surface;
    for (int i = 0; i < 50; ++i) {
        const TwinLevel<ReducedTexel>& texels = i < 25 ? reduced_[1] : reducedSeconds_[1];
        surface.add(texels.at(x / 2 + i % 5 - 2, y / 2 + i / 5 % 5 - 2), tapsX[i % 5] * tapsY[i / 5 % 5], depth,
                    constants::bankPixelDepthVariance, width);
    }
    return {surface.lightOfCoverage(), surface.coverage()};
}

BankTwin::Seen BankTwin::pixels(int x, int y) const {
    constexpr double taps[] = {0.25, 0.5, 0.25};
    const double depth = reduced_[0].at(x, y)->depth;
    const double width = texelWidth(0, depth);
    SurfaceSum surface;
    for (int i = 0; i < 9; ++i) {
        surface.add(reduced_[0].at(x + i % 3 - 1, y + i / 3 - 1), taps[i % 3] * taps[i / 3], depth,
                    constants::bankPixelDepthVariance, width);
    }
    return {surface.lightOfCoverage(), surface.coverage()};
}

// A level read with bilinear weights alone.
BankTwin::Seen BankTwin::bilinearLevel(int level, const PixelPlace& place) const {
    const Corner corner = cornerOf(level, place);
    Seen seen;
    for (int i = 0; i < 4; ++i) {
        const BlurredTexel tap = texelRead(blurred_[level], corner.x + i % 2, corner.y + i / 2);
        const double weight = corner.weight(i);
        for (int channel = 0; channel < 3; ++channel) {
            seen.light[channel] += weight * tap.light[channel];
        }
        seen.coverage += weight * tap.coverage;
    }
    return seen;
}

// Of a blurred texel's two surfaces the one that is closer to a depth.
BlurredTexel BankTwin::nearerSurface(int level, int x, int y, double depth) const {
    const BlurredTexel first = texelRead(blurred_[level], x, y);
    const BlurredTexel second = texelRead(blurredSeconds_[level], x, y);
    return second.depth > 0 && std::abs(second.depth - depth) < std::abs(first.depth - depth) ? second : first;
}

// A coarse level at a place in or beside a pixel, as that pixel or its quad sees it.
BankTwin::Seen BankTwin::levelSeen(int level, int x, int y, const PixelPlace& place, const Region& region) const {
    if ((region.steppedLevels >> level & 1) == 0) {
        return bilinearLevel(level, place);
    }
    const bool smooth = region.smooth;
    const double depth = depthOf(x, y, smooth);
    const double width = texelWidth(level, depth);
    const Corner corner = cornerOf(level, place);
    // What is taken of the level, at: in smooth regions the middle of the quad, which lies between the same texels.
    const Corner middle = smooth ? cornerOf(level, {x / 2 * 2 + 1.0, y / 2 * 2 + 1.0}) : corner;
    Seen seen;
    double total = 0;
    double away = 0; // of the texels' surface from the pixel's, mm
    for (int i = 0; i < 4; ++i) {
        const int tapX = corner.x + i % 2;
        const int tapY = corner.y + i / 2;
        const BlurredTexel tap =
            smooth ? texelRead(blurred_[level], tapX, tapY) : nearerSurface(level, tapX, tapY, depth);
        const double difference = tap.depth - depth;
        const double q = difference * difference / (constants::bankLevelDepthVariance * width * width);
        const double depthWeight = tap.depth > 0 ? falloff(q) : 0;
        const double tapWeight = corner.weight(i) * depthWeight;
        const double middleWeight = middle.weight(i) * depthWeight;
        for (int channel = 0; channel < 3; ++channel) {
            seen.light[channel] += tapWeight * tap.light[channel];
        }
        seen.coverage += tapWeight * tap.coverage;
        total += middleWeight;
        away += middleWeight * difference;
    }
    const double normalization = 1 / std::max<double>(total, constants::bankLeastWeight);
    const double distance = away * normalization / width;
    const double variance =
        settings_.secondSurfaces && !smooth ? constants::bankSecondAwayVariance : constants::bankLevelAwayVariance;
    const double factor = normalization * falloff(distance * distance / variance);
    for (double& value : seen.light) {
        value *= factor;
    }
    seen.coverage *= factor;
    seen.present = factor * total;
    return seen;
}

} // namespace nacre::tests
