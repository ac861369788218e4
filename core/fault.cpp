#include "fault.hpp"

#include <cstdio>

namespace nacre {

std::string formatNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value);
    return text;
}

std::string indexed(std::string_view field, std::size_t index) {
    return std::string(field).append("[").append(std::to_string(index)).append("]");
}

std::string findFault(std::string_view field, double value, const Range& range) {
    const bool aboveLow = range.lowIncluded ? value >= range.low : value > range.low;
    if (aboveLow && value <= range.high) {
        return {};
    }
    return std::string(field) + " is " + formatNumber(value) + ", must be in " + (range.lowIncluded ? "[" : "(") +
           formatNumber(range.low) + ", " + formatNumber(range.high) + "]" + range.unit;
}

std::string findFault(std::string_view field, const Rgb& value, const Range& range) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        if (auto fault = findFault(indexed(field, channel), value[channel], range); !fault.empty()) {
            return fault;
        }
    }
    return {};
}

} // namespace nacre
