#include "bench/report/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nacre::bench {
namespace {

std::vector<std::string> distinct(const Results& results, std::string Measurement::*member) {
    std::vector<std::string> values;
    for (const Measurement& measurement : results.measurements) {
        if (std::find(values.begin(), values.end(), measurement.*member) == values.end()) {
            values.push_back(measurement.*member);
        }
    }
    return values;
}

// "texels" → "texel"
std::string singular(std::string unit) {
    if (unit.size() > 1 && unit.back() == 's') {
        unit.pop_back();
    }
    return unit;
}

// So many that `digits` digits of the value are told.
int decimalsFor(double value, int digits) {
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
    return std::clamp(digits - 1 - magnitude, 0, 12);
}

std::string formatDecimals(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

// As many decimals as two digits of the margin have, so that no digit is told that nobody knows.
std::string formatWithMargin(double value, double margin) {
    if (!(margin > 0) || !std::isfinite(margin)) {
        return formatNumber(value) + " ± " + formatNumber(margin);
    }
    const int decimals = decimalsFor(margin, 2);
    const std::string text = formatDecimals(value, decimals);
    const bool isZero = text.find_first_of("123456789") == std::string::npos;
    return (isZero ? formatDecimals(0, decimals) : text) + " ± " + formatDecimals(margin, decimals);
}

} // namespace

std::string formatNumber(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) {
        return value == 0 ? "0" : "∞";
    }
    const int decimals = decimalsFor(value, digits);
    std::string result = formatDecimals(value, decimals);
    if (decimals > 0) {
        result.erase(result.find_last_not_of('0') + 1);
        if (result.back() == '.') {
            result.pop_back();
        }
    }
    return result == "-0" ? "0" : result;
}

std::string formatTime(double microseconds) {
    return std::abs(microseconds) < 10'000 ? formatNumber(microseconds) + " µs"
                                           : formatNumber(microseconds / 1000) + " ms";
}

std::string formatShare(double share, int digits) {
    return formatNumber(100 * share, digits) + " %";
}

std::string formatCount(std::uint64_t count) {
    std::string text = std::to_string(count);
    for (std::size_t position = text.size(); position > 3;) {
        position -= 3;
        text.insert(position, 1, ',');
    }
    return text;
}

std::string formatSize(std::uint32_t width, std::uint32_t height) {
    return width == 0 ? "" : std::to_string(width) + "x" + std::to_string(height);
}

std::string formatSlope(const Fit& fit) {
    const double margin = (fit.line.slopeHigh - fit.line.slopeLow) / 2;
    const std::string per = " per " + (fit.unit.empty() ? singular(fit.variable) : singular(fit.unit));
    const bool milliseconds = std::max(std::abs(fit.line.slope), margin) >= 10'000;
    const double factor = milliseconds ? 1e-3 : 1;
    return formatWithMargin(factor * fit.line.slope, factor * margin) + (milliseconds ? " ms" : " µs") + per;
}

std::string formatSetting(const Measurement& measurement) {
    return formatNumber(measurement.value) + (measurement.unit.empty() ? "" : " " + measurement.unit);
}

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += i == 0 ? "" : i + 1 == words.size() ? " and " : ", ";
        text += words[i];
    }
    return text;
}

std::string escapeHtml(std::string_view text) {
    std::string escaped;
    for (const char character : text) {
        switch (character) {
        case '&':
            escaped += "&amp;";
            break;
        case '<':
            escaped += "&lt;";
            break;
        case '>':
            escaped += "&gt;";
            break;
        case '"':
            escaped += "&quot;";
            break;
        default:
            escaped += character;
        }
    }
    return escaped;
}

std::string formatPassShares(const Results& results) {
    std::vector<double> shares;
    for (const Measurement& measurement : results.measurements) {
        shares.push_back(measurement.passShare);
    }
    std::sort(shares.begin(), shares.end());
    return formatNumber(100 * shares.front(), 4) + " to " + formatShare(shares.back(), 4) + " (median " +
           formatShare(percentile(shares, 0.5), 4) + ")";
}

std::vector<std::string> seriesOf(const Results& results) {
    return distinct(results, &Measurement::series);
}

std::vector<std::string> techniquesOf(const Results& results) {
    return distinct(results, &Measurement::technique);
}

} // namespace nacre::bench
