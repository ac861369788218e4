#include "view/window/shown_image.hpp"

namespace nacre::view {

QImage toQImage(const Image& encoded) {
    QImage result(static_cast<int>(encoded.width), static_cast<int>(encoded.height), QImage::Format_RGB32);
    for (int y = 0; y < result.height(); ++y) {
        for (int x = 0; x < result.width(); ++x) {
            const std::span<const float> pixel =
                encoded.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
            const auto byte = [&](std::size_t channel) { return static_cast<int>(255 * pixel[channel] + 0.5f); };
            result.setPixel(x, y, qRgb(byte(0), byte(1), byte(2)));
        }
    }
    return result;
}

} // namespace nacre::view
