// One-sentence descriptions of values out of range; shared by everything in core that checks its input.
#pragma once

#include "nacre/profile.hpp"

#include <stdexcept>
#include <string>
#include <string_view>

namespace nacre {

/// A closed or half-open range of allowed values.
struct Range {
    double low = 0;
    double high = 0;
    const char* unit = "";
    bool lowIncluded = true;
};

/// The shortest usual form of a number, e.g. "0.5", "-1", "nan".
std::string formatNumber(double value);

/// "<field>[<index>]".
std::string indexed(std::string_view field, std::size_t index);

/// "<field> is <value>, must be in <range>", or empty when the value lies in the range. NaN never does.
std::string findFault(std::string_view field, double value, const Range& range);

/// The same for each channel of an RGB value, called "<field>[0]" to "<field>[2]".
std::string findFault(std::string_view field, const Rgb& value, const Range& range);

/// Throws std::invalid_argument(fault) unless it is empty.
inline void requireNoFault(const std::string& fault) {
    if (!fault.empty()) {
        throw std::invalid_argument(fault);
    }
}

inline constexpr const char* channelNames[3] = {"red", "green", "blue"};

/// Ranges of the material model, the same in every check, in the material files and in their schema.
/// Lower ends are those of a float, so that a value that came through one stays in its range.
inline constexpr Range weightRange{0, 1e6, ""};
/// Up to what the widest of the Gaussians has that stand for Burley's profile at the longest mean free path.
inline constexpr Range varianceRange{0, 4e9, " mm²"};
inline constexpr Range meanFreePathRange{1e-6f, 1e4, " mm"};
inline constexpr Range scaleRange{1e-6f, 1e4, ""};
inline constexpr Range unitRange{0, 1, ""};
inline constexpr Range lobeRoughnessRange{0, 4, ""};

} // namespace nacre
