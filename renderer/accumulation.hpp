// What a window shows: samples of frames added up on two sides, and its pixels made of them. Internal to whoever drives
// frames in a window.
#pragma once

#include "image/image.hpp"
#include "renderer/frame.hpp"
#include "renderer/vulkan/compute_pass.hpp"

#include <array>
#include <optional>

namespace nacre::renderer {

/// What a side shows of a frame.
enum class ShownImage {
    Picture,
    Diffuse, ///< the picture without specular reflections, black where there is nothing: what a reference has
    Irradiance,
    Scattered,
    Transmitted,
    Specular,
    Albedo,
    Normal,
    Depth,
    Thickness,
    Material,
    Footprint, ///< px that light travels, false colours
    ShadowMap, ///< one layer of the shadow maps: white is near
    Regions,   ///< what technique `bank` combines by its smooth pipeline, blue, and by its edge pipeline, orange
    Given      ///< no frame's, but the picture of setGiven
};

enum class ToneCurve {
    Neutral, ///< the renderer's own, renderer/passes/tone_curve.glsl
    None     ///< cut off at 1
};

/// What a picture has where there is nothing.
enum class Backdrop { Surroundings, Black, Grey, White };

/// How a sample is looked at.
struct SampleLook {
    ShownImage image = ShownImage::Picture;
    ToneCurve curve = ToneCurve::Neutral;
    float exposure = 1;            ///< light is multiplied by it
    glm::vec2 depthRange{0, 1};    ///< scene units, from white to black
    float thicknessRange = 10;     ///< [> 0] mm that are white
    bool givenIsDisplayed = false; ///< the given picture is what a display shows, before its sRGB encoding
    Backdrop backdrop = Backdrop::Surroundings;
    std::uint32_t shadowLayer = 0; ///< of ShownImage::ShadowMap
    /// ShownImage::Footprint: px per mm at a depth of 1 scene unit; negative: at every depth, as a parallel projection
    /// has it. ShownImage::Regions: the width of a pixel there, scene units.
    float pixelScale = 1;
    /// ShownImage::Regions: how many texel widths two surfaces are apart. 6 for `bank`, 2 for `bank-surfaces`.
    float separation = 6;
    bool operator==(const SampleLook&) const = default;
};

enum class ShownSides { First, Both, Difference };

/// A disc on top of the picture, and a line from it, as a light's handle. Places are [0, 1], right and down.
struct PictureMark {
    glm::vec2 place{0};
    glm::vec2 end{0};
    glm::vec3 color{1}; ///< as a display shows it, sRGB encoded
    float radius = 6;   ///< [≥ 2] px
    bool hollow = false;
    bool operator==(const PictureMark&) const = default;
};

/// A window's pixels.
struct ShowLook {
    static constexpr std::size_t mostMarks = 32;

    ShownSides sides = ShownSides::First;
    float divider = 0.5f; ///< [0, 1] where the second side begins
    float differenceGain = 4;
    std::vector<PictureMark> marks; ///< the first mostMarks are drawn
    bool operator==(const ShowLook&) const = default;
};

/// The sums of one side, averaged.
struct SidePicture {
    nacre::Image shown; ///< R G B as a display shows them, linear
    nacre::Image light; ///< R G B
    std::uint32_t samples = 0;
};

class Accumulation {
public:
    static constexpr std::uint32_t sideCount = 2;

    /// For pictures of scenes with `materials` materials, of frames with numbers below `framesInFlight`.
    Accumulation(Gpu& gpu, vk::Extent2D capacity, std::size_t materials, std::uint32_t framesInFlight);

    /// Compiles the pass that reads these images, and returns its number. They must stay until `detachAll`.
    std::size_t attach(const FrameImages& images);
    void detachAll() { passes_.clear(); }
    /// Makes room for a window of this size; what recorded into the old room must have finished where it has to grow.
    bool hasRoomFor(vk::Extent2D window) const;
    void makeRoomFor(vk::Extent2D window);
    /// What ShownImage::Given shows, R G B, resampled to `extent`. The device must have finished with all frames.
    void setGiven(const nacre::Image& image, vk::Extent2D extent);

    /// Forgets what is on a side.
    void restart(std::uint32_t side) { sides_[side].samples = 0; }
    std::uint32_t samples(std::uint32_t side) const { return sides_[side].samples; }

    /// What ShownImage::Footprint shows in frame `frame`: the rms radius of each material's widest channel, mm.
    void setRadii(std::uint32_t frame, std::span<const float> radii);
    /// Adds the images of pass `pass`, of frame `frame`, to a side; a side that had another size begins anew.
    void recordSample(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, std::size_t pass,
                      std::uint32_t side, vk::Extent2D extent, const SampleLook& look, const EffectUse& use);
    /// Draws the window's pixels into `pixels`, and leaves them for copies. `swapped`: B G R A in place of R G B A.
    void recordShow(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, vk::Extent2D window,
                    const ShowLook& look, bool swapped);
    /// The window's pixels as they would be in a window of this size: R G B, sRGB encoded. Waits for the device, which
    /// must have finished with all frames.
    nacre::Image readWindow(vk::Extent2D window, const ShowLook& look);
    vk::Buffer pixels() const { return pixels_.handle(); }
    /// Waits for the device.
    SidePicture read(std::uint32_t side);

private:
    struct Side {
        vk::Extent2D extent{};
        std::uint32_t samples = 0;
    };

    void writeMarks(std::uint32_t frame, std::span<const PictureMark> marks);
    std::uint32_t firstPixel(std::uint32_t side) const { return side * capacity_.width * capacity_.height; }

    Gpu& gpu_;
    vk::Extent2D capacity_;
    vk::raii::Sampler nearest_;
    Buffer given_;
    Buffer sums_;
    Buffer pixels_;
    FrameBuffer radii_;
    FrameBuffer marks_;
    std::vector<ComputePass> passes_;
    ComputePass show_;
    std::array<Side, sideCount> sides_;
};

} // namespace nacre::renderer
