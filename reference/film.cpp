#include "reference/film.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace nacre::reference {

glm::dvec3 PixelSum::variance() const {
    if (count < 2) {
        return glm::dvec3(std::numeric_limits<double>::infinity());
    }
    const double n = count;
    return glm::max(squares - sum * sum / n, 0.0) / (n * (n - 1));
}

bool Part::has(std::uint32_t pixel) const {
    // The finaliser of splitmix64 (Steele, Lea and Flood 2014).
    std::uint64_t hash = (pixel + 1) * 0x9E3779B97F4A7C15ULL;
    hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9ULL;
    hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBULL;
    return (hash ^ (hash >> 31)) % count == index - 1;
}

Film::Film(std::uint32_t filmWidth, std::uint32_t filmHeight)
    : width(filmWidth),
      height(filmHeight),
      pixels(std::size_t{filmWidth} * filmHeight),
      materials(pixels.size()),
      coverage(pixels.size()) {}

double Film::noise() const {
    double variance = 0;
    double radiance = 0;
    std::size_t values = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (materials[i] != 0 && pixels[i].count > 0) {
            const glm::dvec3 ofPixel = pixels[i].variance();
            const glm::dvec3 mean = pixels[i].mean();
            variance += ofPixel.r + ofPixel.g + ofPixel.b;
            radiance += mean.r + mean.g + mean.b;
            values += 3;
        }
    }
    if (values == 0 || variance == 0) {
        return 0;
    }
    const double count = static_cast<double>(values);
    return radiance > 0 ? std::sqrt(variance / count) / (radiance / count) : std::numeric_limits<double>::infinity();
}

std::uint64_t Film::sampleCount() const {
    std::uint64_t count = 0;
    for (const PixelSum& pixel : pixels) {
        count += pixel.count;
    }
    return count;
}

std::vector<std::string> channelNames() {
    return {"R", "G", "B", "A", "variance.R", "variance.G", "variance.B", "material.ID", "samples.N"};
}

std::vector<float> channelValues(const Film& film) {
    std::vector<float> values;
    values.reserve(film.pixels.size() * channelNames().size());
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const PixelSum& pixel = film.pixels[i];
        const glm::vec3 mean(pixel.mean());
        const glm::vec3 variance(pixel.count > 0 ? pixel.variance() : glm::dvec3(0));
        values.insert(values.end(), {mean.r, mean.g, mean.b, film.coverage[i], variance.r, variance.g, variance.b,
                                     static_cast<float>(film.materials[i]), static_cast<float>(pixel.count)});
    }
    return values;
}

} // namespace nacre::reference
