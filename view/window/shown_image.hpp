// Images as Qt has them.
#pragma once

#include "image/image.hpp"

#include <QImage>

namespace nacre::view {

/// An image of R G B, sRGB encoded.
QImage toQImage(const Image& encoded);

} // namespace nacre::view
