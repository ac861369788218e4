#include "tests/support/scatter_reference.hpp"

#include "image/metrics.hpp"
#include "tests/support/worst.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::tests {
namespace {

constexpr int nearField = 3;  // px within which R is integrated over the pixel
constexpr int subSamples = 6; // per axis and near pixel
constexpr double reachShare = 0.9995;

struct Slope {
    double x = 0; // mm of depth per px
    double y = 0;
};

// The profile in a table over √r, where even Burley's pole at 0 is tame enough for linear interpolation.
class RadialTable {
public:
    explicit RadialTable(const Profile& profile) : reach_(profile.quantileRadius(reachShare)) {
        for (int i = 0; i <= size; ++i) {
            const double root = std::max(i, 1) / static_cast<double>(size);
            for (int channel = 0; channel < 3; ++channel) {
                values_[i][channel] = profile.radial(channel, root * root * reach_);
            }
        }
    }
    double reach() const { return reach_; }
    Rgb at(double squaredDistance) const {
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
    explicit Reference(const ScatterScene& scene) : scene_(scene) {
        for (const auto& profile : scene.profiles) {
            tables_.emplace_back(*profile);
        }
        for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
                slopes_.push_back(slope(x, y));
            }
        }
    }

    Rgb at(int x, int y) const {
        const std::size_t centre = scene_.index(x, y);
        const int material = scene_.materialId[centre] - 1;
        const RadialTable& table = tables_[material];
        const double z = scene_.depth[centre];
        const int radius = static_cast<int>(std::ceil(table.reach() * scene_.focalLength / z)) + 1;
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

    std::array<double, 3> position(double x, double y, double z) const {
        const double scale = z / scene_.focalLength;
        return {(x + 0.5 - 0.5 * scene_.width) * scale, (y + 0.5 - 0.5 * scene_.height) * scale, z};
    }

    // Area of surface a pixel shows, mm²: z² / (f²·|n·ray|).
    double area(std::size_t q) const {
        const int x = static_cast<int>(q % scene_.width);
        const int y = static_cast<int>(q / scene_.width);
        const double perPixel = scene_.depth[q] / scene_.focalLength;
        const Rgb& n = scene_.normal[q];
        const double rayX = (x + 0.5 - 0.5 * scene_.width) / scene_.focalLength;
        const double rayY = (y + 0.5 - 0.5 * scene_.height) / scene_.focalLength;
        return perPixel * perPixel / std::max(std::abs(n[0] * rayX + n[1] * rayY + n[2]), 0.02);
    }

    Rgb share(const RadialTable& table, int x, int y, int qx, int qy) const {
        const std::size_t q = scene_.index(qx, qy);
        const auto from = position(x, y, scene_.depth[scene_.index(x, y)]);
        const bool near = std::max(std::abs(qx - x), std::abs(qy - y)) <= nearField;
        const int steps = near ? subSamples : 1;
        Rgb sum{};
        for (int j = 0; j < steps; ++j) {
            for (int i = 0; i < steps; ++i) {
                const double dx = (i + 0.5) / steps - 0.5;
                const double dy = (j + 0.5) / steps - 0.5;
                const double z = scene_.depth[q] + slopes_[q].x * dx + slopes_[q].y * dy;
                const auto to = position(qx + dx, qy + dy, z);
                double squared = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    squared += (to[axis] - from[axis]) * (to[axis] - from[axis]);
                }
                const Rgb value = table.at(squared);
                for (int channel = 0; channel < 3; ++channel) {
                    sum[channel] += value[channel];
                }
            }
        }
        const double scale = area(q) / (steps * steps);
        return {sum[0] * scale, sum[1] * scale, sum[2] * scale};
    }

    // The pixel's own share, exact for any profile on a tilted plane: the mean of the CDF along the pixel's outline.
    Rgb ownShare(const Profile& profile, std::size_t q) const {
        constexpr int directions = 64;
        const double perPixel = scene_.depth[q] / scene_.focalLength;
        const double half = 0.5;
        Rgb sum{};
        double angleSum = 0;
        // Angles are taken on the surface: a step (u, v) px on the screen is the vector u·t₁ + v·t₂ in space.
        const double t11 = perPixel * perPixel + slopes_[q].x * slopes_[q].x;
        const double t22 = perPixel * perPixel + slopes_[q].y * slopes_[q].y;
        const double t12 = slopes_[q].x * slopes_[q].y;
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
    std::vector<RadialTable> tables_;
    std::vector<Slope> slopes_;
};

} // namespace

std::vector<ReferencePixel> scatterReference(const ScatterScene& scene, int stride) {
    const Reference reference(scene);
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
