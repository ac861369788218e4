#include "bessel.hpp"

#include <cmath>
#include <numbers>

namespace nacre {
namespace {

// The power series converge fast below this, the trapezoidal rule above it.
constexpr double seriesLimit = 2;

// ∫₀^∞ f(cosh t) e^{−x cosh t} dt. The integrand is even and analytic for |Im t| < π/2, so the trapezoidal rule
// converges like e^{−π²/step}: 1e-17 at a quarter.
template <typename Function> double coshIntegral(double x, Function f) {
    constexpr double step = 0.25;
    double sum = 0.5 * f(1.0) * std::exp(-x);
    for (int i = 1;; ++i) {
        const double c = std::cosh(i * step);
        const double term = f(c) * std::exp(-x * c);
        sum += term;
        if (term < 1e-18 * sum || term == 0) {
            return step * sum;
        }
    }
}

} // namespace

// Abramowitz and Stegun 9.6.13 and 9.6.24.
double besselK0(double x) {
    if (x >= seriesLimit) {
        return coshIntegral(x, [](double) { return 1.0; });
    }
    const double q = 0.25 * x * x;
    const double logarithm = -std::log(0.5 * x) - std::numbers::egamma;
    double power = 1; // (x/2)^2k / k!²
    double harmonic = 0;
    double sum = logarithm;
    for (int k = 1; power > 1e-18; ++k) {
        power *= q / (double(k) * k);
        harmonic += 1.0 / k;
        sum += power * (logarithm + harmonic);
    }
    return sum;
}

// Below the limit the series of K₀ term by term; above it π/2 − Ki₁(x) (Abramowitz and Stegun 11.2.8).
double besselK0Integral(double x) {
    if (x <= 0) {
        return 0;
    }
    if (x >= seriesLimit) {
        return 0.5 * std::numbers::pi - coshIntegral(x, [](double c) { return 1 / c; });
    }
    const double q = 0.25 * x * x;
    const double logarithm = -std::log(0.5 * x) - std::numbers::egamma;
    double power = 1;
    double harmonic = 0;
    double sum = logarithm + 1;
    for (int k = 1; power > 1e-18; ++k) {
        power *= q / (double(k) * k);
        harmonic += 1.0 / k;
        const double odd = 2 * k + 1;
        sum += power / odd * (logarithm + harmonic + 1 / odd);
    }
    return x * sum;
}

} // namespace nacre
