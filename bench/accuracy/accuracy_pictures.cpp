#include "bench/accuracy/accuracy_pictures.hpp"

#include "bench/accuracy/accuracy_html.hpp"
#include "image/false_color.hpp"
#include "image/image_file.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <utility>

namespace nacre::bench {
namespace {

constexpr double whiteShare = 0.999;

/// Over the pixels that are not black.
double whiteOf(const Image& picture) {
    Mask mask(picture.pixelCount());
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        mask[i / 3] = mask[i / 3] != 0 || picture.values[i] != 0 ? 1 : 0;
    }
    return std::max(quantile(picture, whiteShare, mask), 1e-6);
}

} // namespace

AccuracyPictures::AccuracyPictures(std::filesystem::path folder, std::string view)
    : folder_(std::move(folder)), view_(std::move(view)) {}

void AccuracyPictures::write(const std::string& shown, Image picture) const {
    for (float& value : picture.values) {
        value = static_cast<float>(value / white_);
    }
    writePng(folder_ / accuracyPicture(view_, shown), picture);
}

void AccuracyPictures::addReference(const std::string& method, const Image& picture) {
    if (!folder_.empty()) {
        white_ = white_ > 0 ? white_ : whiteOf(picture);
        write(method, picture);
    }
}

void AccuracyPictures::addTechnique(const std::string& technique, const Image& picture) {
    if (!folder_.empty()) {
        write(technique, picture);
    }
}

void AccuracyPictures::addDifference(const std::string& technique, const std::string& method, const Image& picture,
                                     const Image& reference) {
    if (!folder_.empty()) {
        writePng(folder_ / accuracyDifference(view_, technique, method),
                 signedDifference(picture, reference, differenceShare * white_));
    }
}

} // namespace nacre::bench
