// Accuracy results as a page with pictures.
#pragma once

#include "bench/accuracy/accuracy_results.hpp"

namespace nacre::bench {

/// "head-front-walk.png", of a reference or a technique.
std::string accuracyPicture(const std::string& view, const std::string& shown);
/// "head-front-bank-walk.png": a technique's picture minus a reference.
std::string accuracyDifference(const std::string& view, const std::string& technique, const std::string& method);

/// The page; its pictures are those of AccuracyPictures, in the folder of this name beside it.
std::string formatAccuracyHtml(const AccuracyResults& results, const std::string& pictureFolder);

} // namespace nacre::bench
