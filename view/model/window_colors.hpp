// The window's colours, and how well they are told apart.
#pragma once

#include <array>
#include <cstdint>

namespace nacre::view {

/// R, G and B as a display shows them, [0, 255].
using ShownColor = std::array<std::uint8_t, 3>;

struct WindowColors {
    ShownColor window;
    ShownColor base; ///< of lists and fields
    ShownColor alternateBase;
    ShownColor button;
    ShownColor toolTip;
    ShownColor text;  ///< on all of them
    ShownColor faint; ///< text that is disabled or stands for a missing one
    ShownColor highlight;
    ShownColor highlightedText;
    ShownColor link;
};

extern const WindowColors darkColors;
extern const WindowColors lightColors;

/// Of two colours, (L₁ + 0.05) / (L₂ + 0.05) of their relative luminances, [1, 21] (WCAG 2.1, "contrast ratio"). Text
/// needs 4.5 by its level AA; what is disabled needs nothing, and gets 3 here.
double contrast(const ShownColor& one, const ShownColor& other);

} // namespace nacre::view
