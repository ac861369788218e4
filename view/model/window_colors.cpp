#include "view/model/window_colors.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

/// Relative luminance of WCAG 2.1, which has 0.03928 where sRGB has 0.04045.
double luminance(const ShownColor& color) {
    constexpr std::array weights{0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (std::size_t i = 0; i < color.size(); ++i) {
        const double value = color[i] / 255.0;
        sum += weights[i] * (value <= 0.03928 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return sum;
}

} // namespace

const WindowColors darkColors{.window = {45, 45, 48},
                              .base = {30, 30, 32},
                              .alternateBase = {38, 38, 41},
                              .button = {58, 58, 62},
                              .toolTip = {70, 70, 74},
                              .text = {228, 228, 228},
                              .faint = {150, 150, 150},
                              .highlight = {50, 98, 168},
                              .highlightedText = {255, 255, 255},
                              .link = {120, 170, 240}};
const WindowColors lightColors{.window = {239, 239, 239},
                               .base = {255, 255, 255},
                               .alternateBase = {246, 246, 246},
                               .button = {230, 230, 230},
                               .toolTip = {255, 255, 230},
                               .text = {25, 25, 25},
                               .faint = {118, 118, 118},
                               .highlight = {40, 96, 176},
                               .highlightedText = {255, 255, 255},
                               .link = {20, 80, 170}};

double contrast(const ShownColor& one, const ShownColor& other) {
    const auto [darker, brighter] = std::minmax({luminance(one), luminance(other)});
    return (brighter + 0.05) / (darker + 0.05);
}

} // namespace nacre::view
