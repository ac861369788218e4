// Passes A and B of the bank's twin: the pyramid.
#include "tests/support/bank_twin.hpp"
#include "tests/support/bank_twin_shared.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::tests {
namespace {

constexpr int tileSize = 32;  // px, as in effect/bank/bank_technique.cpp
constexpr int partWidth = 16; // of pass C's edge regions, px; its smooth ones are 2x2 of them
constexpr int partHeight = 8;

// Of pass B, texels.
struct BlockSize {
    int width, height;
};

BlockSize blockSizeOf(int level) {
    return level == bankLevels ? BlockSize{6, 2} : BlockSize{16, 8};
}

// The 2x2 texels that one of the next level is made of. Levels that keep a second surface have up to eight.
struct Children {
    std::vector<const ReducedTexel*> texels;
    double nearest = 1e300;
    double farthest = 0;

    void add(const ReducedTexel* texel) {
        if (texel != nullptr && texel->coverage > 0) {
            texels.push_back(texel);
            nearest = std::min(nearest, texel->depth);
            farthest = std::max(farthest, texel->depth);
        }
    }

    // The 2x2 of a level that are a texel of the next.
    void addFour(const TwinLevel<ReducedTexel>& level, int x, int y) {
        for (int child = 0; child < 4; ++child) {
            add(level.at(2 * x + (child & 1), 2 * y + (child >> 1)));
        }
    }

    template <typename Keep> ReducedTexel sum(Keep keep) const {
        ReducedTexel result;
        double depth = 0;
        for (const ReducedTexel* texel : texels) {
            if (!keep(*texel)) {
                result.dropped = true;
                continue;
            }
            for (int channel = 0; channel < 3; ++channel) {
                result.light[channel] += texel->light[channel] / 4;
            }
            result.area += texel->area / 4;
            result.coverage += texel->coverage / 4;
            result.dropped |= texel->dropped;
            depth += texel->coverage / 4 * texel->depth;
        }
        result.depth = result.coverage > 0 ? depth / result.coverage : 0;
        noteDepths(result, keep);
        return result;
    }

    // The variance of depths, mm², and how much farther the middle of the light, its channels' sum, is than theirs, mm.
    template <typename Keep> void noteDepths(ReducedTexel& result, Keep keep) const {
        double sum = 0;
        for (const ReducedTexel* texel : texels) {
            const double part = keep(*texel) ? texel->coverage / 4 / result.coverage : 0;
            const double away = texel->depth - result.depth;
            const double light = part / texel->area * (texel->light[0] + texel->light[1] + texel->light[2]);
            sum += light;
            result.depthVariance += part * away * away;
            result.lightSlope += light * away;
        }
        result.lightSlope /= std::max(sum, 1e-20);
    }

    bool isNear(const ReducedTexel& texel) const { return texel.depth - nearest <= farthest - texel.depth; }
};

// Whether depth goes on from pixel to pixel in a row or column: no step is longer than `limit`, or it rises or falls.
bool isSmooth(std::span<const double, 4> depths, double limit) {
    const std::array steps{depths[1] - depths[0], depths[2] - depths[1], depths[3] - depths[2]};
    const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
    return std::max(*most, -*least) <= limit || *most <= constants::bankContinuedStep * *least ||
           *least >= constants::bankContinuedStep * *most;
}

} // namespace

// Length of a pixel's ray where its depth along the view direction changes by 1.
double BankTwin::stretch(int x, int y) const {
    return std::hypot(1, (x + 0.5 - 0.5 * scene_.width) / scene_.focalLength,
                      (y + 0.5 - 0.5 * scene_.height) / scene_.focalLength);
}

// Area of a pixel's surface relative to one that faces the camera.
double BankTwin::pixelArea(int x, int y) const {
    const auto neighbor = [&](int dx, int dy) -> const ReducedTexel* {
        const ReducedTexel* pixel = reduced_[0].at(x + dx, y + dy);
        return pixel != nullptr && pixel->coverage > 0 ? pixel : nullptr;
    };
    const ReducedTexel& pixel = *reduced_[0].at(x, y);
    const double width = texelWidth(0, pixel.depth);
    const double stepX = pixelStep(neighbor(-1, 0), pixel, neighbor(1, 0), width);
    const double stepY = pixelStep(neighbor(0, -1), pixel, neighbor(0, 1), width);
    return std::min<double>(std::hypot(1, stepX / width, stepY / width), constants::bankLargestArea);
}

BankTwin::BankTwin(const ScatterScene& scene, const TwinSettings& settings) : scene_(scene), settings_(settings) {
    for (const auto& profile : scene.profiles) {
        tables_.emplace_back(*profile);
    }
    tilesX_ = (scene.width + tileSize - 1) / tileSize;
    tilesY_ = (scene.height + tileSize - 1) / tileSize;
    reduced_[0].width = scene.width;
    reduced_[0].height = scene.height;
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            const std::size_t i = scene.index(x, y);
            const bool scatters = scene.materialId[i] != 0;
            reduced_[0].texels.push_back(
                scatters ? ReducedTexel{scene.irradiance[i], 1, 1, scene.depth[i] * stretch(x, y)} : ReducedTexel{});
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
    shareAreas();
    for (int level = 2; level <= bankLevels; ++level) {
        blurLevel(level);
    }
    result_ = scene.irradiance;
    smooth_.resize(result_.size());
    for (int y = 0; y < scene.height; y += 2 * partHeight) {
        for (int x = 0; x < scene.width; x += 2 * partWidth) {
            combineRegion(x, y);
        }
    }
}

void BankTwin::weighByArea(int x, int y) {
    ReducedTexel& pixel = reduced_[0].texels[scene_.index(x, y)];
    if (pixel.coverage <= 0) {
        return;
    }
    pixel.area = pixelArea(x, y);
    for (double& value : pixel.light) {
        value *= pixel.area;
    }
}

// Whether a texel of level 1 is a continuous quad: its pixels and those beside them all scatter, and no step between
// them is long.
bool BankTwin::isContinuousQuad(int x, int y) const {
    const auto longestStep = [&](int first, int line, bool inRow) {
        double longest = 0;
        const ReducedTexel* before = nullptr;
        for (int i = first - 1; i <= first + 2; ++i) {
            const ReducedTexel* pixel = inRow ? reduced_[0].at(i, line) : reduced_[0].at(line, i);
            if (pixel == nullptr || pixel->coverage <= 0) {
                return 1e300;
            }
            longest = before != nullptr ? std::max(longest, std::abs(pixel->depth - before->depth)) : 0;
            before = pixel;
        }
        return longest;
    };
    double longest = 0;
    for (int i = 0; i < 2; ++i) {
        longest = std::max({longest, longestStep(2 * x, 2 * y + i, true), longestStep(2 * y, 2 * x + i, false)});
    }
    const ReducedTexel* first = reduced_[0].at(2 * x, 2 * y);
    return first != nullptr && longest <= constants::bankContinuedStep * texelWidth(0, first->depth);
}

// The pixels of continuous quads have their mean area where it hardly varies.
void BankTwin::shareAreas() {
    for (int quad = 0; quad < reduced_[1].width * reduced_[1].height; ++quad) {
        const int x = quad % reduced_[1].width;
        const int y = quad / reduced_[1].width;
        if (!isContinuousQuad(x, y)) {
            continue;
        }
        std::array<ReducedTexel*, 4> pixels;
        double mean = 0;
        double square = 0;
        for (int i = 0; i < 4; ++i) {
            pixels[i] = &reduced_[0].texels[scene_.index(2 * x + i % 2, 2 * y + i / 2)];
            mean += pixels[i]->area / 4;
            square += pixels[i]->area * pixels[i]->area / 4;
        }
        if (square > (1 + constants::bankSharedAreaVariance) * mean * mean) {
            continue;
        }
        for (ReducedTexel* pixel : pixels) {
            for (double& value : pixel->light) {
                value *= mean / pixel->area;
            }
            pixel->area = mean;
        }
    }
}

bool BankTwin::hasSeconds(int level) const {
    return settings_.secondSurfaces && level >= 1 && level <= constants::bankSecondLevels;
}

// Depths further apart than this, in mm, are two surfaces of a texel whose nearest depth this is.
double BankTwin::separationAt(int level, double nearest) const {
    return (hasSeconds(level) ? constants::bankSecondSeparation : constants::bankSurfaceSeparation) *
           texelWidth(level, nearest);
}

// The next level's texels, of one surface each.
TwinLevel<ReducedTexel> BankTwin::reduce(const TwinLevel<ReducedTexel>& from, int level) const {
    TwinLevel<ReducedTexel> to;
    // Whole tiles: what lies outside the image is empty.
    to.width = level == 1 ? tilesX_ * tileSize / 2 : (from.width + 1) / 2;
    to.height = level == 1 ? tilesY_ * tileSize / 2 : (from.height + 1) / 2;
    for (int i = 0; i < to.width * to.height; ++i) {
        Children children;
        children.addFour(from, i % to.width, i / to.width);
        const double limit = constants::bankSurfaceSeparation * texelWidth(level, children.nearest);
        const ReducedTexel front =
            children.sum([&](const ReducedTexel& t) { return t.depth - children.nearest <= limit; });
        const ReducedTexel back =
            children.sum([&](const ReducedTexel& t) { return children.farthest - t.depth <= limit; });
        to.texels.push_back(front.coverage >= back.coverage ? front : back);
    }
    return to;
}

void BankTwin::reduceLevel(int level) {
    TwinLevel<ReducedTexel>& to = reduced_[level];
    // The coarsest level is made of first surfaces alone.
    const bool isLast = level == constants::bankSecondLevels + 1;
    to = reduce(settings_.secondSurfaces && isLast ? reduce(reduced_[level - 2], level - 1) : reduced_[level - 1],
                level);
    TwinLevel<ReducedTexel>& seconds = reducedSeconds_[level];
    seconds = to;
    std::fill(seconds.texels.begin(), seconds.texels.end(), ReducedTexel{});
    for (std::size_t i = 0; hasSeconds(level) && i < to.texels.size(); ++i) {
        Children children;
        const int x = static_cast<int>(i) % to.width;
        const int y = static_cast<int>(i) / to.width;
        children.addFour(reduced_[level - 1], x, y);
        if (hasSeconds(level - 1)) {
            children.addFour(reducedSeconds_[level - 1], x, y);
        }
        ReducedTexel& texel = to.texels[i];
        texel = children.sum([](const ReducedTexel&) { return true; });
        const bool isContinuous = level == 1 && isContinuousQuad(x, y);
        if (!isContinuous && children.farthest - children.nearest > separationAt(level, children.nearest)) {
            texel = children.sum([&](const ReducedTexel& t) { return children.isNear(t); });
            seconds.texels[i] = children.sum([&](const ReducedTexel& t) { return !children.isNear(t); });
        }
        if (texel.coverage < seconds.texels[i].coverage) {
            std::swap(texel, seconds.texels[i]);
        }
    }
    for (std::size_t i = 0; i < to.texels.size(); ++i) {
        ReducedTexel& texel = to.texels[i];
        const bool noted = level == 1 && hasStep(static_cast<int>(i) % to.width, static_cast<int>(i) / to.width);
        const double width = texelWidth(level, texel.depth);
        texel.depthVariance *= noted ? 1 / (width * width) : 0;
        texel.lightSlope *= noted ? 1 / (width * (0.5 * constants::bankPixelDepthVariance + texel.depthVariance)) : 0;
        texel.depthVariance = std::min(texel.depthVariance, std::pow(0.5 * constants::bankSurfaceSeparation, 2));
        seconds.texels[i].depthVariance = seconds.texels[i].lightSlope = 0;
    }
}

void BankTwin::blurLevel(int level) {
    TwinLevel<BlurredTexel>& to = blurred_[level];
    to.width = reduced_[level].width;
    to.height = reduced_[level].height;
    to.texels.resize(reduced_[level].texels.size());
    blurredSeconds_[level] = to;
    const BlockSize block = blockSizeOf(level);
    for (int y = 0; y < to.height; y += block.height) {
        for (int x = 0; x < to.width; x += block.width) {
            blurBlock(level, x, y);
        }
    }
}

// Whether every texel within reach of a block is full, with nothing left out and no step between two of them.
bool BankTwin::isUnbroken(int level, int firstX, int firstY) const {
    const BlockSize block = blockSizeOf(level);
    const int endX = firstX + block.width + 2;
    const int endY = firstY + block.height + 2;
    for (int y = firstY - 2; y < endY; ++y) {
        for (int x = firstX - 2; x < endX; ++x) {
            const ReducedTexel* texel = reduced_[level].at(x, y);
            if (texel == nullptr || texel->coverage != 1 || texel->dropped) {
                return false;
            }
        }
    }
    for (int y = firstY - 2; y < endY; ++y) {
        for (int x = firstX - 2; x < endX; ++x) {
            if ((x + 1 < endX && isStep(level, x, y, x + 1, y)) || (y + 1 < endY && isStep(level, x, y, x, y + 1))) {
                return false;
            }
        }
    }
    return true;
}

// In an unbroken block nothing is missing of a kernel, however steep it stands.
void BankTwin::blurBlock(int level, int firstX, int firstY) {
    TwinLevel<BlurredTexel>& to = blurred_[level];
    const BlockSize block = blockSizeOf(level);
    const bool unbroken = isUnbroken(level, firstX, firstY);
    for (int y = firstY; y < std::min(firstY + block.height, to.height); ++y) {
        for (int x = firstX; x < std::min(firstX + block.width, to.width); ++x) {
            BlurredTexel& texel = to.texels[static_cast<std::size_t>(y) * to.width + x];
            texel = blurTexel(level, x, y);
            if (unbroken) {
                for (double& value : texel.light) {
                    value /= texel.coverage;
                }
                texel.coverage = 1;
            }
            const ReducedTexel* second = reducedSeconds_[level].at(x, y);
            if (second->coverage > 0) {
                blurredSeconds_[level].texels[static_cast<std::size_t>(y) * to.width + x] =
                    blurAt(level, x, y, second->depth);
            }
        }
    }
}

// Whether two full texels beside each other are on different surfaces, or on a steep one.
bool BankTwin::isStep(int level, int x, int y, int besideX, int besideY) const {
    const double depth = reduced_[level].at(x, y)->depth;
    const double difference = std::abs(reduced_[level].at(besideX, besideY)->depth - depth);
    return difference > constants::bankSmoothDepth * texelWidth(level, depth);
}

BlurredTexel BankTwin::blurTexel(int level, int x, int y) const {
    const TwinLevel<ReducedTexel>& texels = reduced_[level];
    const ReducedTexel& own = *texels.at(x, y);
    if (own.coverage > 0) {
        BlurredTexel texel = blurAt(level, x, y, own.depth);
        texel.continuous = !own.dropped && goesOn(level, x, y, own.depth);
        return texel;
    }
    // An empty texel stands on the surface its neighbours are on.
    double coverage = 0;
    double sum = 0;
    for (int i = 0; i < 9; ++i) {
        const ReducedTexel* tap = texels.at(x + i % 3 - 1, y + i / 3 - 1);
        coverage += tap != nullptr ? tap->coverage : 0;
        sum += tap != nullptr ? tap->coverage * tap->depth : 0;
    }
    if (coverage <= 0) {
        return {};
    }
    BlurredTexel texel = blurAt(level, x, y, sum / coverage);
    texel.continuous = goesOn(level, x, y, sum / coverage);
    return texel;
}

// Whether no texel beside one is on another surface, or on this one's steep side.
bool BankTwin::goesOn(int level, int x, int y, double depth) const {
    const double limit = constants::bankSmoothDepth * texelWidth(level, depth);
    for (int i = 1; i < 9; i += 2) {
        const ReducedTexel* beside = reduced_[level].at(x + i % 3 - 1, y + i / 3 - 1);
        if (beside != nullptr && beside->coverage > 0 && std::abs(beside->depth - depth) > limit) {
            return false;
        }
    }
    return true;
}

// A texel's kernel where it stands on a surface at this depth.
BlurredTexel BankTwin::blurAt(int level, int x, int y, double depth) const {
    const double width = texelWidth(level, depth);
    const double variance =
        settings_.secondSurfaces ? constants::bankSecondBlurDepthVariance : constants::bankBlurDepthVariance;
    SurfaceSum sum;
    for (int i = 0; i < 50; ++i) {
        const TwinLevel<ReducedTexel>& texels = i < 25 ? reduced_[level] : reducedSeconds_[level];
        sum.add(texels.at(x + i % 5 - 2, y + i / 5 % 5 - 2), binomial[i % 5] * binomial[i / 5 % 5], depth, variance,
                width);
    }
    return {sum.lightOfCoverage(), sum.coverage(), depth, false};
}

// Whether a quad, with those beside it, has a step to another surface or left something out.
bool BankTwin::hasStep(int quadX, int quadY) const {
    const auto depthAt = [&](int x, int y) {
        const ReducedTexel* pixel = reduced_[0].at(x, y);
        return pixel != nullptr ? pixel->depth : 0;
    };
    const int x = 2 * quadX;
    const int y = 2 * quadY;
    std::array<std::array<double, 4>, 4> lines; // the quad's rows, its columns, with a pixel beside at either end
    for (int i = 0; i < 4; ++i) {
        lines[0][i] = depthAt(x - 1 + i, y);
        lines[1][i] = depthAt(x - 1 + i, y + 1);
        lines[2][i] = depthAt(x, y - 1 + i);
        lines[3][i] = depthAt(x + 1, y - 1 + i);
    }
    double longest = 0;
    double farthest = 0;
    bool hasHole = false;
    for (const std::array<double, 4>& line : lines) {
        for (int i = 0; i < 4; ++i) {
            hasHole |= line[i] == 0;
            farthest = i == 1 || i == 2 ? std::max(farthest, line[i]) : farthest;
            const bool isStep = i > 0 && std::min(line[i], line[i - 1]) > 0;
            longest = std::max(longest, isStep ? std::abs(line[i] - line[i - 1]) : 0);
        }
    }
    const double limit =
        (hasHole ? constants::bankSmoothHoleDepth : constants::bankSmoothDepth) * texelWidth(0, farthest);
    const auto smooth = [&](const std::array<double, 4>& line) { return isSmooth(line, limit); };
    return reduced_[1].at(quadX, quadY)->dropped ||
           (longest > limit &&
            (hasHole || longest > separationAt(1, farthest) || !std::all_of(lines.begin(), lines.end(), smooth)));
}

// Whether a quad of a part, or one beside it, has a step.
bool BankTwin::isEdgePart(int firstX, int firstY) const {
    for (int y = firstY / 2 - 1; y <= (firstY + partHeight) / 2; ++y) {
        for (int x = firstX / 2 - 1; x <= (firstX + partWidth) / 2; ++x) {
            if (reduced_[1].at(x, y) != nullptr && hasStep(x, y)) {
                return true;
            }
        }
    }
    return !settings_.smoothTiles;
}

// Levels of which a region loads a texel that is not continuous.
unsigned BankTwin::steppedLevels(int firstX, int firstY, int width, int height) const {
    unsigned stepped = 0;
    for (int level = 2; level <= bankLevels; ++level) {
        const int texel = 1 << level;
        const int columns = width / texel + 2;
        const int rows = height / texel + 2;
        for (int i = 0; i < columns * rows; ++i) {
            const int x = ((firstX - texel / 2) >> level) + i % columns;
            const int y = ((firstY - texel / 2) >> level) + i / columns;
            stepped |= blurred_[level].nearest(x, y).continuous ? 0u : 1u << level;
        }
    }
    return stepped;
}

// Combines the pixels of a smooth region, and of its parts that are edge regions.
void BankTwin::combineRegion(int firstX, int firstY) {
    std::array<bool, 4> edges{};
    std::array<Region, 4> edgeRegions;
    for (int part = 0; part < 4; ++part) {
        const int x = firstX + part % 2 * partWidth;
        const int y = firstY + part / 2 * partHeight;
        edges[part] = isEdgePart(x, y);
        edgeRegions[part] = {false, steppedLevels(x, y, partWidth, partHeight)};
    }
    const Region smooth{true, steppedLevels(firstX, firstY, 2 * partWidth, 2 * partHeight)};
    const bool noneSmooth = std::count(edges.begin(), edges.end(), true) > constants::bankMostEdgeParts;
    for (int y = firstY; y < std::min(firstY + 2 * partHeight, scene_.height); y += 2) {
        for (int x = firstX; x < std::min(firstX + 2 * partWidth, scene_.width); x += 2) {
            const int part = (x - firstX) / partWidth + 2 * ((y - firstY) / partHeight);
            const Region& region = noneSmooth || edges[part] ? edgeRegions[part] : smooth;
            combineQuad(x, y, region);
            for (int i = 0; i < 4; ++i) {
                if (x + i % 2 < scene_.width && y + i / 2 < scene_.height) {
                    smooth_[scene_.index(x + i % 2, y + i / 2)] = region.smooth;
                }
            }
        }
    }
}

} // namespace nacre::tests
