// The viewer's loop: frames are recorded one after the other while earlier ones are on the device, and add up on two
// sides. It shows them in a window, or draws them without one.
#pragma once

#include "renderer/accumulation.hpp"
#include "renderer/offscreen.hpp"
#include "view/loop/sized_frames.hpp"
#include "view/loop/window_images.hpp"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace nacre::view {

/// What one side of the window shows.
struct SideSettings {
    renderer::EffectSettings effect;
    renderer::SampleLook look;
};

struct LoopSettings {
    std::uint32_t width = 1280; ///< [≥ 1] px of the picture, at rest
    std::uint32_t height = 720;
    std::uint32_t shadowMapSize = 2048;
    std::uint32_t framesInFlight = 2;
    std::uint32_t stillSamples = 64;   ///< [≥ 1] samples that a picture at rest adds up
    bool thickness = true;             ///< ShownImage::Thickness can be shown
    bool shadowMapsEveryFrame = false; ///< as RenderSettings has it
    bool restartEveryFrame = false;    ///< every frame is a picture of its own, as if something always moved
    double tolerableMilliseconds = 50; ///< of a frame while something moves; slower devices then draw fewer pixels
    std::uint32_t lights = 0;          ///< most lights that can be set; never less than the scene's
    std::uint32_t shadowLayers = 0;    ///< likewise, as FrameLimits has it
};

/// What a step did.
enum class Step {
    Drawn,     ///< a frame was submitted
    Busy,      ///< the device or the window is not ready for another one
    Converged, ///< everything that is shown has all its samples
    Hidden     ///< the window has no pixels
};

class PictureLoop {
public:
    /// `scene` must outlive it.
    PictureLoop(renderer::Device& device, const scene::Scene& scene, const LoopSettings& settings);
    ~PictureLoop();

    /// Shows pictures on this surface from now on; with a null handle on none. `windowExtent` says its size in px.
    void setSurface(vk::SurfaceKHR surface, std::function<vk::Extent2D()> windowExtent);
    /// Says that the window has another size: its images are made anew.
    void windowChanged();
    /// The picture's size. Waits for the device.
    void resize(std::uint32_t width, std::uint32_t height);

    // What is drawn. Every change begins the picture anew.
    void setCamera(const scene::Camera& camera);
    void setMaterials(const std::vector<Material>& materials);
    void setSurfaces(std::span<const scene::Surface> surfaces);
    void setLights(std::span<const scene::Light> lights);
    void setEnvironment(float intensity, float rotation);
    void setSide(std::uint32_t side, const SideSettings& settings);
    void setShown(const renderer::ShowLook& look);
    /// What ShownImage::Given shows. Waits for the device.
    void setGiven(const Image& image);
    /// Whether something is being dragged: a slow device then draws fewer pixels.
    void setMoving(bool moving);

    /// Records and submits a frame if one is wanted and can be. Never waits, but where what was set needs more than the
    /// frame was prepared for.
    Step step();
    /// Waits until the device has finished with everything.
    void wait();
    /// Compiles changed shaders (Frame::reloadShaders).
    void reloadShaders();

    std::uint32_t samples(std::uint32_t side) const;
    bool isConverged() const;
    /// Whether pictures are now drawn with fewer pixels.
    bool isCoarse() const;
    vk::Extent2D extent() const { return {settings_.width, settings_.height}; }
    /// The size of the frames that are now drawn.
    vk::Extent2D drawnExtent() const;
    const LoopSettings& settings() const { return settings_; }
    renderer::SidePicture read(std::uint32_t side);
    /// What a window of this size shows: R G B, sRGB encoded. Waits for the device.
    Image readWindow(std::uint32_t width, std::uint32_t height);
    /// The images of the last frame at full size that was drawn for a side, read back. Waits for the device.
    Image readImage(renderer::Output output);

    /// What the last finished frame took, and how many have finished.
    const renderer::FrameReport& report() const { return report_; }
    std::uint64_t framesFinished() const { return framesFinished_; }
    /// Processor time of the last step that drew, ms.
    double stepMilliseconds() const { return stepMilliseconds_; }
    /// How often everything stood still until the device had finished, as no frame has to.
    std::uint64_t waits() const { return waits_; }
    /// Called with the report of every frame that has finished.
    std::function<void(const renderer::FrameReport&)> onFinished;

private:
    struct Slot {
        vk::raii::CommandBuffer commands = nullptr;
        vk::raii::Fence fence = nullptr;
        vk::raii::Semaphore imageFree = nullptr;
        bool inFlight = false;
        SizedFrame* drawn = nullptr;
    };

    void makeSlots();
    void attachAll();
    void makeCoarse();
    SizedFrame& current();
    void restart();
    bool finish(Slot& slot);
    bool finishAll();
    std::optional<std::uint32_t> sideToDraw() const;
    bool prepareWindow();
    std::optional<WindowImages::Image> acquire(Slot& slot);
    void prepareEffect(SizedFrame& sized, const renderer::EffectSettings& effect);
    renderer::SampleLook prepareLook(const renderer::SampleLook& look, std::uint32_t index, std::uint32_t height);
    void recordFrame(Slot& slot, std::uint32_t index, std::uint32_t side);
    void submit(Slot& slot, const std::optional<WindowImages::Image>& image);

    renderer::Gpu& gpu_;
    const scene::Scene& scene_;
    LoopSettings settings_;
    SizedFrames frames_;
    std::unique_ptr<renderer::Accumulation> accumulation_;
    std::optional<WindowImages> windowImages_;
    vk::raii::CommandPool pool_;
    std::vector<Slot> slots_;
    std::uint32_t next_ = 0;
    scene::Camera camera_;
    std::vector<float> radii_; ///< of the materials, mm; made when they are first shown
    std::array<SideSettings, renderer::Accumulation::sideCount> sides_;
    renderer::ShowLook shown_;
    Image given_;
    bool moving_ = false;
    bool showAgain_ = true;
    renderer::FrameReport report_;
    std::uint64_t framesFinished_ = 0;
    double stepMilliseconds_ = 0;
    std::uint64_t waits_ = 0;
};

} // namespace nacre::view
