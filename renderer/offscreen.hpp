// Draws single pictures without a window: submits a frame, waits for it and reads its images back.
#pragma once

#include "image/image.hpp"
#include "renderer/frame_report.hpp"
#include "renderer/frame_settings.hpp"
#include "renderer/graphics_device.hpp"
#include "scene/scene.hpp"

#include <memory>
#include <string>
#include <vector>

namespace nacre::renderer {

/// Images that can be read back. All but Color are `samples` times as wide and as high as the picture.
enum class Output {
    Color,       ///< R G B, the picture: 8-bit sRGB values / 255
    Irradiance,  ///< R G B, diffuse light without albedo and specular
    Scattered,   ///< R G B, irradiance after scattering (the effect's output, without albedo)
    Transmitted, ///< R G B, light that came through, as irradiance, the material's translucency in it
    Depth,       ///< Z, distance along the view direction in scene units; infinite where there is nothing
    Normal,      ///< X Y Z, shading normal in world space; zero where there is nothing
    Material,    ///< ID, index into Scene::materials + 1; 0 = no subsurface scattering
    Thickness,   ///< MM, the thickness that transmission used; 0 = none. Needs RenderSettings::thickness
    Albedo,      ///< R G B, diffuse albedo
    Specular,    ///< R G B, radiance of specular reflections
    Radiance     ///< R G B, the picture in linear light, before exposure and tone curve
};

/// One output: linear, but for the sRGB encoded Color.
using Pixels = nacre::Image; // not the GPU's, renderer::Image

/// Draws one scene. Throws RendererError (renderer/graphics_device.hpp) with one sentence.
class Offscreen {
public:
    Offscreen(Device& device, const scene::Scene& scene, const RenderSettings& settings);
    ~Offscreen();
    Offscreen(Offscreen&&) noexcept;

    /// Draws one frame from `camera` and waits for it.
    void render(const scene::Camera& camera, Timing timing = Timing::Passes);
    /// Does the last frame's effect (and copy) again on its images, and waits for it: once with a timestamp after every
    /// pass, then `repetitions` [0, RenderSettings::effectRepetitions] times one after the other with none in between,
    /// which could keep passes from overlapping. The report then has only those passes.
    void renderEffect(std::uint32_t repetitions = 0);
    /// The last frame's pixels.
    Pixels read(Output output) const;
    const FrameReport& report() const;
    /// From the next frame on.
    void setEffect(const EffectSettings& settings);
    /// Replaces the scene's subsurface materials (same count) without rebuilding anything else.
    void setMaterials(const std::vector<Material>& materials);
    /// Frame::reloadShaders, and prepares what that asks for.
    void reloadShaders();

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace nacre::renderer
