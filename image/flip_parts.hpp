// What FLIP is made of; tests work the papers' figures by hand.
#pragma once

#include "image/color.hpp"
#include "image/plane.hpp"

namespace nacre {

/// The channels of YCxCz, each with its own contrast sensitivity.
enum class Opponent { Achromatic, RedGreen, BlueYellow };

/// A term of a filter in two dimensions: weight · taps ⊗ taps, with taps whose sum is 1.
struct FilterTerm {
    double weight = 0;
    Taps taps;
};

/// Radius of the contrast sensitivity's filters, px: three standard deviations of the widest.
int contrastRadius(double pixelsPerDegree);

/// The contrast sensitivity of a channel as a filter; the terms' weights sum to 1.
std::vector<FilterTerm> contrastFilter(Opponent channel, double pixelsPerDegree);

/// Filters that find edges and points, along the axis they look in; `across` smooths along the other.
struct FeatureFilter {
    Taps across;
    Taps edge;  ///< first derivative of a Gaussian; its negative taps sum to −1, its positive ones to 1
    Taps point; ///< second derivative; the same
};
FeatureFilter featureFilter(double pixelsPerDegree);

/// The error of two colours in Hunt-adjusted CIELAB, [0, 1].
double flipColorError(double hyabDistance);

/// FLIP of a pixel from the error of its colours and that of its features, both [0, 1].
double flipError(double colorError, double featureError);

} // namespace nacre
