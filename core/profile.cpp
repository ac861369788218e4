#include "nacre/profile.hpp"

#include <algorithm>

namespace nacre {

double Profile::inverseCdf(int channel, double u) const {
    double low = 0;
    double high = 1;
    while (cdf(channel, high) < u && high < 1e6) {
        high *= 2;
    }
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (cdf(channel, middle) < u ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double Profile::quantileRadius(double share) const {
    return std::max({inverseCdf(0, share), inverseCdf(1, share), inverseCdf(2, share)});
}

} // namespace nacre
