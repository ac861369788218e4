// The pictures of the accuracy report, by the names of accuracy_html.hpp.
#pragma once

#include "image/image.hpp"

#include <filesystem>
#include <string>

namespace nacre::bench {

/// Writes the pictures of one view into a folder, all at one exposure: that at which the 99.9th percentile of the first
/// reference's brightest channel is white. Differences are grey where there is none; white is differenceShare of that
/// much more, black that much less.
class AccuracyPictures {
public:
    static constexpr double differenceShare = 0.25;

    /// No folder: nothing is written.
    AccuracyPictures(std::filesystem::path folder, std::string view);

    /// `picture` is linear, black where nothing counts. The first sets the exposure.
    void addReference(const std::string& method, const Image& picture);
    void addTechnique(const std::string& technique, const Image& picture);
    void addDifference(const std::string& technique, const std::string& method, const Image& picture,
                       const Image& reference);

private:
    void write(const std::string& shown, Image picture) const;

    std::filesystem::path folder_;
    std::string view_;
    double white_ = 0;
};

} // namespace nacre::bench
