#include "tests/support/scatter_reference.hpp"

#include "image/metrics.hpp"
#include "tests/support/worst.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace nacre::tests {
namespace {

constexpr double leastFacing = 0.02; // cosine between ray and normal: at most 50 times a facing pixel's area

struct Slope {
    double x = 0; // mm of depth per px
    double y = 0;
};

// What a pixel shows of its surface.
struct Patch {
    Vector3<double> middle{};
    Vector3<double> stepX{}; // how the point that its ray meets moves from one pixel to the next, mm
    Vector3<double> stepY{};
    double area = 0; // mm²
};

// The profile in a table over √r, where even Burley's pole at 0 is tame enough for linear interpolation.
class RadialTable {
public:
    RadialTable(const Profile& profile, double reach) : reach_(reach) {
        for (int i = 0; i <= size; ++i) {
            const double root = std::max(i, 1) / static_cast<double>(size);
            for (int channel = 0; channel < 3; ++channel) {
                values_[i][channel] = profile.radial(channel, root * root * reach_);
            }
        }
    }
    double reach() const { return reach_; }
    Rgb at(double squaredDistance) const {
        if (squaredDistance >= reach_ * reach_) { // without a root: most of what is asked for lies outside
            return {};
        }
        const double position = std::sqrt(std::sqrt(squaredDistance) / reach_) * size;
        const int i = static_cast<int>(position);
        if (i >= size) {
            return {};
        }
        const double fraction = position - i;
        Rgb result;
        for (int channel = 0; channel < 3; ++channel) {
            result[channel] = values_[i][channel] + fraction * (values_[i + 1][channel] - values_[i][channel]);
        }
        return result;
    }

private:
    static constexpr int size = 4096;
    double reach_;
    std::vector<Rgb> values_ = std::vector<Rgb>(size + 1);
};

class Reference {
public:
    Reference(const ScatterScene& scene, const ScatterReferenceSettings& settings)
        : scene_(scene), settings_(settings) {
        for (const auto& profile : scene.profiles) {
            tables_.emplace_back(*profile, profile->quantileRadius(settings.reachShare));
        }
        for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
                patches_.push_back(patch(x, y, settings.patchesOfBrute ? patchSlope(x, y) : slope(x, y)));
            }
        }
    }

    Rgb at(int x, int y) const {
        const std::size_t centre = scene_.index(x, y);
        const int material = scene_.materialId[centre] - 1;
        const RadialTable& table = tables_[material];
        const double z = scene_.depth[centre];
        // Pixels per radius where the surface is nearest to the camera within it.
        const double nearest = std::max(z - table.reach(), 0.5 * z);
        const int radius = static_cast<int>(std::ceil(table.reach() * scene_.focalLength / nearest)) + 1;
        Rgb sum{};
        Rgb weightSum{};
        for (int dy = -radius; dy <= radius; ++dy) {
            for (int dx = -radius; dx <= radius; ++dx) {
                if (!scene_.inside(x + dx, y + dy)) {
                    continue;
                }
                const std::size_t q = scene_.index(x + dx, y + dy);
                if (scene_.materialId[q] == 0) {
                    continue;
                }
                const Rgb weight = dx == 0 && dy == 0 ? ownShare(*scene_.profiles[material], centre)
                                                      : share(table, x, y, x + dx, y + dy);
                for (int channel = 0; channel < 3; ++channel) {
                    sum[channel] += weight[channel] * scene_.irradiance[q][channel];
                    weightSum[channel] += weight[channel];
                }
            }
        }
        for (int channel = 0; channel < 3; ++channel) {
            sum[channel] /= weightSum[channel];
        }
        return sum;
    }

private:
    // Depth along a pixel's ray (x/f, y/f, 1) to the tangent plane is n·P / n·ray; its derivative in x and y.
    Slope slope(int x, int y) const {
        const std::size_t i = scene_.index(x, y);
        const Rgb& n = scene_.normal[i];
        const double rayX = (x + 0.5 - 0.5 * scene_.width) / scene_.focalLength;
        const double rayY = (y + 0.5 - 0.5 * scene_.height) / scene_.focalLength;
        const double scale = -scene_.depth[i] / (scene_.focalLength * (n[0] * rayX + n[1] * rayY + n[2]));
        return {n[0] * scale, n[1] * scale};
    }

    // How z changes towards a neighbour, per step along the axis; nothing where there is no surface.
    std::optional<double> depthDifference(int x, int y, int stepX, int stepY) const {
        if (!scene_.inside(x + stepX, y + stepY) || scene_.materialId[scene_.index(x + stepX, y + stepY)] == 0) {
            return std::nullopt;
        }
        return (stepX + stepY) * (scene_.depth[scene_.index(x + stepX, y + stepY)] - scene_.depth[scene_.index(x, y)]);
    }

    // The rules of effect/interface/tangent_plane.glsl, from the statements in its comments.
    double patchStep(int x, int y, int stepX, int stepY, double normalStep) const {
        const std::optional<double> before = depthDifference(x, y, -stepX, -stepY);
        const std::optional<double> after = depthDifference(x, y, stepX, stepY);
        if (!before || !after) {
            return before.value_or(0) + after.value_or(0);
        }
        const double size = scene_.depth[scene_.index(x, y)] / scene_.focalLength;
        const auto [smaller, larger] = std::minmax({std::abs(*before), std::abs(*after)});
        if (larger > 2 * std::max(smaller, size)) {
            return std::abs(*before) < std::abs(*after) ? *before : *after;
        }
        return std::clamp(normalStep, std::min(*before, *after), std::max(*before, *after));
    }

    Slope patchSlope(int x, int y) const {
        constexpr double maxStretch = 20;
        const Slope ofNormal = slope(x, y);
        const Slope patch{patchStep(x, y, 1, 0, ofNormal.x), patchStep(x, y, 0, 1, ofNormal.y)};
        const double steepness = std::hypot(patch.x, patch.y) * scene_.focalLength / scene_.depth[scene_.index(x, y)];
        const double scale = std::min(1.0, maxStretch / std::max(steepness, 1e-6));
        return {scale * patch.x, scale * patch.y};
    }

    Vector3<double> position(double x, double y, double z) const {
        const double scale = z / scene_.focalLength;
        return {(x + 0.5 - 0.5 * scene_.width) * scale, (y + 0.5 - 0.5 * scene_.height) * scale, z};
    }

    Patch patch(int x, int y, const Slope& slope) const {
        const double z = scene_.depth[scene_.index(x, y)];
        const double perPixel = z / scene_.focalLength;
        const double rayX = (x + 0.5 - 0.5 * scene_.width) / scene_.focalLength;
        const double rayY = (y + 0.5 - 0.5 * scene_.height) / scene_.focalLength;
        Patch patch{.middle = position(x, y, z),
                    .stepX = {perPixel + rayX * slope.x, rayY * slope.x, slope.x},
                    .stepY = {rayX * slope.y, perPixel + rayY * slope.y, slope.y}};
        // Of the parallelogram between the steps.
        const Vector3<double> normal = cross(patch.stepX, patch.stepY);
        patch.area = std::min(std::sqrt(dot(normal, normal)), perPixel * perPixel / leastFacing);
        return patch;
    }

    // Points along one side of a pixel's patch: more where it is longer than a pixel is wide.
    int pointsAlong(const Vector3<double>& side, std::size_t q) const {
        const double perPixel = scene_.depth[q] / scene_.focalLength;
        return settings_.subSamples * static_cast<int>(std::ceil(std::min(std::sqrt(dot(side, side)) / perPixel, 8.0)));
    }

    Rgb share(const RadialTable& table, int x, int y, int qx, int qy) const {
        const std::size_t q = scene_.index(qx, qy);
        const Vector3<double>& from = patches_[scene_.index(x, y)].middle;
        const Patch& patch = patches_[q];
        const bool near = std::max(std::abs(qx - x), std::abs(qy - y)) <= settings_.nearField;
        const int countX = near ? pointsAlong(patch.stepX, q) : 1;
        const int countY = near ? pointsAlong(patch.stepY, q) : 1;
        Rgb sum{};
        for (int j = 0; j < countY; ++j) {
            for (int i = 0; i < countX; ++i) {
                const double dx = (i + 0.5) / countX - 0.5;
                const double dy = (j + 0.5) / countY - 0.5;
                double squared = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    const double offset =
                        patch.middle[axis] + dx * patch.stepX[axis] + dy * patch.stepY[axis] - from[axis];
                    squared += offset * offset;
                }
                const Rgb value = table.at(squared);
                for (int channel = 0; channel < 3; ++channel) {
                    sum[channel] += value[channel];
                }
            }
        }
        const double scale = patch.area / (countX * countY);
        return {sum[0] * scale, sum[1] * scale, sum[2] * scale};
    }

    // The pixel's own share, exact for any profile on a tilted plane: the mean of the CDF along the pixel's outline.
    Rgb ownShare(const Profile& profile, std::size_t q) const {
        constexpr int directions = 256;
        const double half = 0.5;
        Rgb sum{};
        double angleSum = 0;
        // Angles are taken on the surface: a step (u, v) px on the screen is the vector u·t₁ + v·t₂ in space.
        const Vector3<double>& stepX = patches_[q].stepX;
        const Vector3<double>& stepY = patches_[q].stepY;
        const double t11 = dot(stepX, stepX);
        const double t22 = dot(stepY, stepY);
        const double t12 = dot(stepX, stepY);
        const double determinant = std::sqrt(std::max(t11 * t22 - t12 * t12, 0.0));
        for (int i = 0; i < directions; ++i) {
            const double angle = (i + 0.5) * 2 * std::numbers::pi / directions;
            const double u = std::cos(angle);
            const double v = std::sin(angle);
            const double squaredLength = t11 * u * u + 2 * t12 * u * v + t22 * v * v;
            const double dAngle = determinant / squaredLength; // dφ on the surface per dφ on the screen
            const double edge = half / std::max(std::abs(u), std::abs(v)) * std::sqrt(squaredLength);
            angleSum += dAngle;
            for (int channel = 0; channel < 3; ++channel) {
                sum[channel] += dAngle * profile.cdf(channel, edge);
            }
        }
        return {sum[0] / angleSum, sum[1] / angleSum, sum[2] / angleSum};
    }

    const ScatterScene& scene_;
    const ScatterReferenceSettings& settings_;
    std::vector<RadialTable> tables_;
    std::vector<Patch> patches_;
};

} // namespace

std::vector<ReferencePixel> scatterReference(const ScatterScene& scene, int stride,
                                             const ScatterReferenceSettings& settings) {
    const Reference reference(scene, settings);
    std::vector<ReferencePixel> pixels;
    for (int y = 0; y < scene.height; y += stride) {
        for (int x = (y / stride) % stride; x < scene.width; x += stride) {
            if (scene.materialId[scene.index(x, y)] != 0) {
                pixels.push_back({x, y, reference.at(x, y)});
            }
        }
    }
    return pixels;
}

double psnr(const ScatterScene& scene, std::span<const ReferencePixel> reference, std::span<const Rgb> image) {
    ErrorSums sums;
    for (const ReferencePixel& pixel : reference) {
        for (int channel = 0; channel < 3; ++channel) {
            sums.add(image[scene.index(pixel.x, pixel.y)][channel], pixel.value[channel]);
        }
    }
    return sums.psnr(1);
}

double largestError(const ScatterScene& scene, std::span<const ReferencePixel> reference, std::span<const Rgb> image) {
    double largest = 0;
    for (const ReferencePixel& pixel : reference) {
        for (int channel = 0; channel < 3; ++channel) {
            largest = larger(largest, std::abs(image[scene.index(pixel.x, pixel.y)][channel] - pixel.value[channel]));
        }
    }
    return largest;
}

} // namespace nacre::tests
