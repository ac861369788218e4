#include "trace/surroundings.hpp"

#include "scene/sky.hpp"
#include "trace/orthonormal_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::trace {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double unevenness = 4; ///< of the brightest pixel over the mean, from which the image itself is sampled

std::size_t findCumulative(std::span<const double> cumulative, double target) {
    const auto found = std::ranges::upper_bound(cumulative, target);
    return std::min(static_cast<std::size_t>(found - cumulative.begin()), cumulative.size() - 1);
}

double share(std::span<const double> cumulative, std::size_t index) {
    return (cumulative[index] - (index > 0 ? cumulative[index - 1] : 0)) / cumulative.back();
}

} // namespace

Surroundings::Surroundings(const scene::Environment& environment)
    : image_(environment.image ? *environment.image : scene::makeSky(environment)),
      intensity_(environment.intensity),
      cosine_(std::cos(static_cast<double>(environment.rotation))),
      sine_(std::sin(static_cast<double>(environment.rotation))) {
    if (image_.width == 0 || image_.values.size() != std::size_t{image_.width} * image_.height * 4) {
        throw scene::SceneError("the environment image has " + std::to_string(image_.values.size()) +
                                " values for its " + std::to_string(image_.width) + "x" +
                                std::to_string(image_.height) + " pixels");
    }
    double brightest = 0;
    double sum = 0;
    double solidAngles = 0;
    const std::vector<double> brightness = meanBrightness();
    for (std::uint32_t row = 0; row < image_.height; ++row) {
        const double solidAngle = std::sin(pi * (row + 0.5) / image_.height);
        double inRow = 0;
        for (std::uint32_t column = 0; column < image_.width; ++column) {
            const double here = brightness[std::size_t{row} * image_.width + column];
            brightest = std::max(brightest, here);
            inRow += here;
            columns_.push_back(inRow);
        }
        sum += inRow * solidAngle;
        solidAngles += solidAngle * image_.width;
        rows_.push_back(sum);
    }
    isLit_ = sum > 0 && intensity_ > 0;
    imageShare_ = isLit_ && brightest > unevenness * sum / solidAngles ? 0.5 : 0;
}

std::vector<double> Surroundings::meanBrightness() const {
    // Over a pixel, linear interpolation weighs its neighbours on either side with 1/8.
    const std::size_t width = image_.width;
    const auto at = [&](const std::vector<double>& values, std::int64_t column, std::int64_t row) {
        const auto wrapped = static_cast<std::size_t>((column + image_.width) % image_.width);
        const auto clamped = static_cast<std::size_t>(std::clamp<std::int64_t>(row, 0, image_.height - 1));
        return values[clamped * width + wrapped];
    };
    std::vector<double> single(width * image_.height);
    std::vector<double> along(single.size());
    std::vector<double> both(single.size());
    for (std::size_t i = 0; i < single.size(); ++i) {
        const glm::dvec3 color = pixel(static_cast<std::int64_t>(i % width), static_cast<std::int64_t>(i / width));
        single[i] = std::max({color.r, color.g, color.b});
    }
    for (std::size_t i = 0; i < single.size(); ++i) {
        const auto x = static_cast<std::int64_t>(i % width);
        const auto y = static_cast<std::int64_t>(i / width);
        along[i] = 0.75 * single[i] + 0.125 * (at(single, x - 1, y) + at(single, x + 1, y));
    }
    for (std::size_t i = 0; i < single.size(); ++i) {
        const auto x = static_cast<std::int64_t>(i % width);
        const auto y = static_cast<std::int64_t>(i / width);
        both[i] = 0.75 * along[i] + 0.125 * (at(along, x, y - 1) + at(along, x, y + 1));
    }
    return both;
}

glm::dvec3 Surroundings::pixel(std::int64_t column, std::int64_t row) const {
    const std::int64_t width = image_.width;
    column = ((column % width) + width) % width;
    row = std::clamp<std::int64_t>(row, 0, image_.height - 1);
    const float* value = &image_.values[static_cast<std::size_t>(row * width + column) * 4];
    return glm::max(glm::dvec3(value[0], value[1], value[2]), 0.0);
}

glm::dvec3 Surroundings::radiance(const glm::dvec3& direction) const {
    const glm::dvec3 d(cosine_ * direction.x - sine_ * direction.z, direction.y,
                       sine_ * direction.x + cosine_ * direction.z);
    const double x = (std::atan2(d.x, -d.z) / (2 * pi) + 0.5) * image_.width - 0.5;
    const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * image_.height - 0.5;
    const double floorX = std::floor(x);
    const double floorY = std::floor(y);
    const auto column = static_cast<std::int64_t>(floorX);
    const auto row = static_cast<std::int64_t>(floorY);
    const glm::dvec3 above = glm::mix(pixel(column, row), pixel(column + 1, row), x - floorX);
    const glm::dvec3 below = glm::mix(pixel(column, row + 1), pixel(column + 1, row + 1), x - floorX);
    return glm::mix(above, below, y - floorY) * intensity_;
}

double Surroundings::imageDensity(const glm::dvec3& direction) const {
    const glm::dvec3 d(cosine_ * direction.x - sine_ * direction.z, direction.y,
                       sine_ * direction.x + cosine_ * direction.z);
    const double u = std::atan2(d.x, -d.z) / (2 * pi) + 0.5;
    const double theta = std::acos(std::clamp(d.y, -1.0, 1.0));
    const auto column = std::min(static_cast<std::size_t>(u * image_.width), std::size_t{image_.width} - 1);
    const auto row = std::min(static_cast<std::size_t>(theta / pi * image_.height), std::size_t{image_.height} - 1);
    const std::span<const double> columns = std::span(columns_).subspan(row * image_.width, image_.width);
    if (!(columns.back() > 0)) {
        return 0;
    }
    const double density = share(rows_, row) * image_.height * share(columns, column) * image_.width;
    return density / (2 * pi * pi * std::max(std::sin(theta), 1e-12));
}

glm::dvec3 Surroundings::sampleImage(Random& random) const {
    const std::size_t row = findCumulative(rows_, random.uniform() * rows_.back());
    const std::span<const double> columns = std::span(columns_).subspan(row * image_.width, image_.width);
    const std::size_t column = findCumulative(columns, random.uniform() * columns.back());
    const double theta = pi * (static_cast<double>(row) + random.uniform()) / image_.height;
    const double phi = 2 * pi * ((static_cast<double>(column) + random.uniform()) / image_.width - 0.5);
    const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
    return {cosine_ * d.x + sine_ * d.z, d.y, -sine_ * d.x + cosine_ * d.z};
}

Surroundings::Sample Surroundings::sample(const glm::dvec3& normal, Random& random) const {
    if (imageShare_ == 0) {
        const glm::dvec3 direction = cosineDirection(normal, random);
        return {direction, glm::dot(direction, normal) / pi};
    }
    const glm::dvec3 direction = random.uniform() < imageShare_ ? sampleImage(random) : cosineDirection(normal, random);
    const double cosine = std::max(glm::dot(direction, normal), 0.0);
    return {direction, imageShare_ * imageDensity(direction) + (1 - imageShare_) * cosine / pi};
}

} // namespace nacre::trace
