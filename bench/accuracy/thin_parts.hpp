// Where a view shows thin parts.
#pragma once

#include "bench/accuracy/accuracy_view.hpp"
#include "image/metrics.hpp"

namespace nacre::bench {

/// Share of the light, of the channel whose light goes furthest, that comes through what counts as thin.
inline constexpr double thinTransmittance = 0.1;

/// The pixels in whose middle a subsurface body is so thin that more than thinTransmittance of the light would come
/// through a slab of that thickness (Profile::slabTransmittance). Thickness is measured straight against the triangle's
/// normal, to where the ray leaves the body. Where the body has no other side nothing is thin.
Mask thinParts(const AccuracyView& view, const Size& size);

} // namespace nacre::bench
