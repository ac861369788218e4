// The deferred renderer: draws a scene, lights it, and calls the effect through include/nacre/nacre.h alone.
#pragma once

#include "nacre/nacre_baselines.h"
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

/// What may change from frame to frame.
struct EffectSettings {
    NacreTechnique technique = NACRE_TECHNIQUE_DEFAULT; ///< how the diffuse light of subsurface materials is spread
    bool scatter = true;
    bool transmit = true;
    std::uint32_t burleySampleBudget = 0; ///< [1 … 256] most samples per pixel; 0 = the effect's default
    NacreBaselineSettings baselines{};    ///< the baked kernel is the first material's, for all
};

struct RenderSettings : EffectSettings {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t shadowMapSize = 2048;
    /// [1 … 4] samples per axis and pixel: n² samples are tone mapped and averaged.
    std::uint32_t samples = 1;
    /// Adds half a bit of noise before rounding to 8 bits, against banding in smooth gradients.
    bool dither = false;
    /// Adds the pass "copy" after the effect: it reads irradiance, depth and material ids, writes as much as a scatter
    /// pass does, and is what no technique can be faster than.
    bool copyFloor = false;
    /// Transmission writes Output::Thickness, which takes 3 us (1920x1080, NVIDIA H100).
    bool thickness = false;
    /// [count] most repetitions that renderEffect may be asked for
    std::uint32_t effectRepetitions = 0;
};

/// What the timestamps of a frame are written around.
enum class Timing {
    Passes, ///< every pass
    Whole   ///< the frame: none in between, which could keep passes from overlapping; the pass "copy" is left out
};

struct PassTime {
    std::string name;
    double microseconds = 0;
};

/// Device memory of one part of the renderer.
struct MemoryUse {
    std::string name;
    std::uint64_t bytes = 0;
};

/// What the last frame did.
struct FrameReport {
    /// In order of execution. The effect's are called "transmit: …" and "scatter: …".
    std::vector<PassTime> passes;
    double totalMicroseconds = 0;     ///< first to last timestamp
    double recordingMicroseconds = 0; ///< processor time to record it
    /// Of renderEffect: of one repetition, or without repetitions the sum of the effect's passes.
    double effectMicroseconds = 0;
    double copyMicroseconds = 0;   ///< of renderEffect: of the pass "copy", repeated alike
    std::uint64_t copyBytes = 0;   ///< what the pass "copy" reads and writes; 0 without RenderSettings::copyFloor
    std::vector<MemoryUse> memory; ///< of the renderer's parts, and of the effect's intermediates and materials
    std::uint32_t scatterDispatches = 0;
    std::uint32_t transmitDispatches = 0;
    std::uint64_t effectBytes = 0; ///< intermediates of the effect
    std::uint64_t triangles = 0;
    std::uint32_t lights = 0;
    std::uint32_t materials = 0;
    double subsurfaceCoverage = 0; ///< [0, 1] share of pixels with a subsurface material
};

/// Pixels of one output: `channels` floats each, row 0 at the top.
struct Pixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::string> channels;
    std::vector<float> values;
};

/// Draws one scene. Throws RendererError (renderer/graphics_device.hpp) with one sentence.
class Renderer {
public:
    Renderer(Device& device, const scene::Scene& scene, const RenderSettings& settings);
    ~Renderer();
    Renderer(Renderer&&) noexcept;

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

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace nacre::renderer
