// Light from all around: an equirectangular image (-Z at its centre, +X a quarter to the right, +Y at the top) or the
// built-in sky, looked up and sampled.
#pragma once

#include "scene/scene.hpp"
#include "trace/random.hpp"

#include <vector>

namespace nacre::trace {

class Surroundings {
public:
    explicit Surroundings(const scene::Environment& environment);

    /// Whether any light comes from there.
    bool isLit() const { return isLit_; }

    /// Radiance from `direction` (unit, towards the surroundings), bilinear.
    glm::dvec3 radiance(const glm::dvec3& direction) const;

    /// A direction in which a surface of this normal is lit, and its density over the solid angle: half of the time by
    /// the cosine, half by the image's brightness; by the cosine alone where no part of the image is four times as
    /// bright as its mean.
    struct Sample {
        glm::dvec3 direction{0};
        double density = 0;
    };
    Sample sample(const glm::dvec3& normal, Random& random) const;

private:
    /// Per pixel, the mean of the interpolated image's brightest channel, nearly.
    std::vector<double> meanBrightness() const;
    double imageDensity(const glm::dvec3& direction) const;
    glm::dvec3 sampleImage(Random& random) const;
    glm::dvec3 pixel(std::int64_t column, std::int64_t row) const;

    nacre::Image image_;
    double intensity_ = 1;
    double cosine_ = 1; ///< of the turn about +Y
    double sine_ = 0;
    bool isLit_ = false;
    double imageShare_ = 0;       ///< of the samples that follow the image
    std::vector<double> rows_;    ///< cumulative weight of rows
    std::vector<double> columns_; ///< cumulative weight within each row
};

} // namespace nacre::trace
