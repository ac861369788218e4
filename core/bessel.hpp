// The modified Bessel function K₀ and its integral, which Burley's line-spread is made of.
#pragma once

namespace nacre {

/// K₀(x), x > 0; relative error below 1e-13.
double besselK0(double x);

/// ∫₀ˣ K₀(t) dt, x ≥ 0; π/2 at infinity; absolute error below 1e-14.
double besselK0Integral(double x);

} // namespace nacre
