// The bank technique in double precision on the CPU, pass by pass: what effect/bank/bank_*.comp compute.
#pragma once

#include "nacre/bank.hpp"
#include "tests/support/synthetic_scenes.hpp"

#include <algorithm>
#include <span>

namespace nacre::tests {

/// Switches off one ingredient at a time, to measure what it is worth.
struct TwinSettings {
    bool areaWeights = true;
    bool secondSurfaces = false; ///< as `bank-surfaces` keeps them
    bool smoothTiles = true;
};

/// A texel of the reduced pyramid.
struct ReducedTexel {
    Rgb light{};          ///< Σ area · irradiance / pixels
    double area = 0;      ///< Σ area / pixels, area relative to a surface facing the camera
    double coverage = 0;  ///< [0, 1] share of the texel's pixels that count
    double depth = 0;     ///< mm; 0 where coverage is 0
    bool dropped = false; ///< pixels of another surface were left out, here or further down
    // Of level 1, where its pixels' depths make a step; elsewhere 0:
    double depthVariance = 0; ///< of these depths, texel widths²
    double lightSlope = 0;    ///< by which share of itself light changes with a texel width of depth, a depth weight's
                              ///< variance added to theirs
};

/// A texel of the blurred pyramid.
struct BlurredTexel {
    Rgb light{};             ///< mean irradiance · coverage
    double coverage = 0;     ///< [0, 1] share of the kernel that lies on the surface
    double depth = 0;        ///< mm; 0 where nothing is near
    bool continuous = false; ///< there is a surface, without a step beside it or pixels left out
};

template <typename Texel> struct TwinLevel {
    int width = 0;
    int height = 0;
    std::vector<Texel> texels;

    const Texel* at(int x, int y) const {
        return x >= 0 && y >= 0 && x < width && y < height ? &texels[static_cast<std::size_t>(y) * width + x] : nullptr;
    }
    /// The one that is nearest to a place outside.
    const Texel& nearest(int x, int y) const { return *at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)); }
};

/// A place in the image, px; a pixel's middle is at a half.
struct PixelPlace {
    double x = 0;
    double y = 0;
};

class BankTwin {
public:
    explicit BankTwin(const ScatterScene& scene, const TwinSettings& settings = {});

    /// Pass A. [level 1 … bankLevels]
    const TwinLevel<ReducedTexel>& reduced(int level) const { return reduced_[level]; }
    /// Pass B. [level 2 … bankLevels]
    const TwinLevel<BlurredTexel>& blurred(int level) const { return blurred_[level]; }
    /// Pass C: the scattered irradiance of every pixel.
    const std::vector<Rgb>& result() const { return result_; }
    /// Whether pass C combines the pixel by its smooth pipeline.
    bool isCombinedSmoothly(int x, int y) const { return smooth_[scene_.index(x, y)]; }

private:
    struct Seen;
    /// What is combined together: a smooth region, or an edge region.
    struct Region {
        bool smooth = false;
        unsigned steppedLevels = 0; ///< bit l: some texel of level l in reach is not continuous
    };

    double texelWidth(int level, double depth) const { return (1 << level) * depth / scene_.focalLength; }
    bool hasSeconds(int level) const;
    double separationAt(int level, double nearest) const;
    TwinLevel<ReducedTexel> reduce(const TwinLevel<ReducedTexel>& from, int level) const;
    void reduceLevel(int level);
    void blurLevel(int level);
    bool isUnbroken(int level, int firstX, int firstY) const;
    void blurBlock(int level, int firstX, int firstY);
    bool isStep(int level, int x, int y, int besideX, int besideY) const;
    BlurredTexel blurTexel(int level, int x, int y) const;
    BlurredTexel blurAt(int level, int x, int y, double depth) const;
    BlurredTexel nearerSurface(int level, int x, int y, double depth) const;
    bool hasStep(int quadX, int quadY) const;
    bool isEdgePart(int firstX, int firstY) const;
    void combineRegion(int firstX, int firstY);
    bool goesOn(int level, int x, int y, double depth) const;
    unsigned steppedLevels(int firstX, int firstY, int width, int height) const;
    void combineQuad(int firstX, int firstY, const Region& region);
    bool isMember(int x, int y) const;
    double depthOf(int x, int y, bool smooth) const;
    Seen seenBy(int kernel, int x, int y, const Region& region) const;
    void combinePixel(int x, int y, bool smooth, std::span<const Seen, bankSize> seen);
    Seen pixels(int x, int y) const;
    std::array<double, 2> slopeFalloffs(int x, int y) const;
    Seen finest(int x, int y) const;
    Seen finestOnSlope(int x, int y) const;
    Seen pixelsOnSlope(int x, int y) const;
    Seen bilinearLevel(int level, const PixelPlace& place) const;
    Seen levelSeen(int level, int x, int y, const PixelPlace& place, const Region& region) const;
    Seen levelOfQuad(int level, int x, int y, const Region& region) const;
    double stretch(int x, int y) const;
    double pixelArea(int x, int y) const;
    void weighByArea(int x, int y);
    bool isContinuousQuad(int x, int y) const;
    void shareAreas();
    double quadSlope(int x, int y, int dx, int dy) const;

    const ScatterScene& scene_;
    TwinSettings settings_;
    std::vector<BankTable> tables_;
    std::array<TwinLevel<ReducedTexel>, bankLevels + 1> reduced_;        ///< level 0 is the image
    std::array<TwinLevel<ReducedTexel>, bankLevels + 1> reducedSeconds_; ///< of the levels that keep a second surface
    std::array<TwinLevel<BlurredTexel>, bankLevels + 1> blurred_;
    std::array<TwinLevel<BlurredTexel>, bankLevels + 1> blurredSeconds_; ///< of the same levels; no depth: none
    int tilesX_ = 0;
    int tilesY_ = 0;
    std::vector<Rgb> result_;
    std::vector<bool> smooth_;
};

} // namespace nacre::tests
