// FLIP: how large the difference between two pictures looks to somebody who flips between them.
//   LDR  Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for Alternating
//        Images, HPG 2020.
//   HDR  Andersson, Nilsson, Shirley, Akenine-Möller: Visualizing Errors in Rendered High Dynamic Range Images,
//        Eurographics 2021.
#pragma once

#include "image/image.hpp"

namespace nacre {

/// Pixels that one degree of the view covers, in the middle of a monitor: distance · (pixels / width) · π / 180 (2020).
double pixelsPerDegree(double distanceMeters, double widthMeters, double widthPixels);

/// The papers' observer: 0.7 m from a monitor that is 0.7 m and 3840 pixels wide.
inline constexpr double defaultPixelsPerDegree = 67.02064327658226;

/// FLIP of every pixel, 1 channel "FLIP" in [0, 1]: 0 no difference, 1 the largest. Symmetric in its pictures. Colours
/// are R, G and B as a display shows them: linear values are cut off at 1. Values that are not finite count as 0.
/// Throws std::invalid_argument where sizes differ or a colour is missing.
Image flip(const Image& image, const Image& reference, double pixelsPerDegree = defaultPixelsPerDegree);

/// The exposures at which HDR-FLIP looks.
struct ExposureRange {
    double start = 0; ///< [stops] at which the brightest pixel is nearly white
    double stop = 0;  ///< [stops] at which the median pixel is
    int count = 1;    ///< exposures from start to stop, at equal distances: as many as there are stops, 2 at least
};

/// The papers' range for a reference: from the exposure that takes its largest luminance to 0.85 of the tone curve, to
/// the one that takes its median there. Where more than half of the picture is black, the median of what is not; 1
/// exposure of 0 stops where all is.
ExposureRange flipExposures(const Image& reference);

/// The tone curve of HDR-FLIP: Narkowicz' fit of ACES without its exposure of 0.6, [0, 1].
double flipToneCurve(double value);

/// HDR-FLIP of every pixel: the largest FLIP at any of the exposures, of the pictures after the tone curve. The
/// exposures depend on the reference, so that this is not symmetric. Values that are negative or not finite count as 0.
/// Throws like flip.
Image hdrFlip(const Image& image, const Image& reference, const ExposureRange& exposures,
              double pixelsPerDegree = defaultPixelsPerDegree);
Image hdrFlip(const Image& image, const Image& reference, double pixelsPerDegree = defaultPixelsPerDegree);

} // namespace nacre
