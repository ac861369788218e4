// Colours of one pixel: sRGB, and the spaces in which differences are measured.
#pragma once

#include <array>

namespace nacre {

/// Three numbers of a colour; the functions say which.
using Tristimulus = std::array<double, 3>;

/// A linear value for a display, by the transfer function of IEC 61966-2-1; cut off at 0 and 1, NaN is 0.
float encodeSrgb(float linear);
/// The linear value of an encoded one.
float decodeSrgb(float encoded);

/// CIE 1931 XYZ of linear RGB with the primaries of Rec.709 and white D65 (IEC 61966-2-1). White has Y = 1.
Tristimulus toXyz(const Tristimulus& rgb);
Tristimulus fromXyz(const Tristimulus& xyz);
/// Relative luminance Y of linear RGB.
double luminance(const Tristimulus& rgb);

/// CIELAB with white D65 (CIE 15): L* [0, 100], a*, b*.
Tristimulus toLab(const Tristimulus& rgb);
Tristimulus fromLab(const Tristimulus& lab);

/// The linearised CIELAB of Flohr et al. 1993, which FLIP filters in (Andersson et al. 2020, section 4.1):
/// Yy = 116 Y/Yn − 16, Cx = 500 (X/Xn − Y/Yn), Cz = 200 (Y/Yn − Z/Zn).
Tristimulus toYCxCz(const Tristimulus& rgb);
Tristimulus fromYCxCz(const Tristimulus& yCxCz);

/// CIELAB whose chroma shrinks with lightness as that of dim colours does (Hunt 1952): (L, 0.01·L·a, 0.01·L·b).
Tristimulus huntAdjusted(const Tristimulus& lab);

/// The HyAB distance (Abasi et al. 2020): |ΔL| + √(Δa² + Δb²), which stays meaningful for large differences.
double hyab(const Tristimulus& lab, const Tristimulus& other);

} // namespace nacre
