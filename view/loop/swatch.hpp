// A material on three small bodies, as large as they are.
#pragma once

#include "view/loop/picture_loop.hpp"

#include <array>
#include <memory>

namespace nacre::view {

/// Draws the edge of a shadow on a plate, a wedge of 0.2 to 12 mm lit from behind, and a ball of 20 mm with a light on
/// either side: squares of swatchMillimeters beside each other.
class Swatch {
public:
    static constexpr double swatchMillimeters = 25;

    /// `pixelsPerMillimeter` [> 0] is the screen's. Compiles a frame's passes.
    Swatch(renderer::Device& device, double pixelsPerMillimeter);
    ~Swatch();

    /// Begins anew with this material.
    void setMaterial(const Material& material);
    /// Submits what can be drawn now. True once all is drawn, which `picture` has then.
    bool step();
    /// R G B, sRGB encoded.
    const Image& picture() const { return picture_; }

private:
    void aim();

    scene::Scene scene_;
    std::unique_ptr<PictureLoop> loop_;
    std::size_t body_ = 0; ///< that is being drawn
    Image picture_;
};

} // namespace nacre::view
