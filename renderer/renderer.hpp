// The deferred renderer: draws a scene, lights it, and calls the effect through include/nacre/nacre.h alone.
#pragma once

#include "renderer/device.hpp"
#include "scene/scene.hpp"

#include <memory>
#include <string>
#include <vector>

namespace nacre::renderer {

/// How the diffuse light of subsurface materials is spread.
enum class Technique { Default, Separable, Brute };

/// Images that can be read back. Radiance is the picture before exposure and tone map, linear.
enum class Output {
    Color,
    Irradiance,
    Scattered,
    Transmitted,
    Depth,
    Normal,
    Material,
    Thickness,
    Albedo,
    Specular,
    Radiance
};

struct RenderSettings {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t shadowMapSize = 2048;
    Technique technique = Technique::Default;
    bool scatter = true;
    bool transmit = true;
};

struct PassTime {
    std::string name;
    double microseconds = 0;
};

/// What the last frame did.
struct FrameReport {
    std::vector<PassTime> passes; ///< in order of execution, the effect's passes included
    double totalMicroseconds = 0; ///< first to last timestamp
    std::uint32_t scatterDispatches = 0;
    std::uint32_t transmitDispatches = 0;
    std::uint64_t effectBytes = 0; ///< intermediates of the effect
    std::uint64_t triangles = 0;
    std::uint32_t lights = 0;
    std::uint32_t materials = 0;
    double subsurfaceCoverage = 0; ///< [0, 1] share of pixels with a subsurface material
};

/// Pixels of one output: `channels` floats each, row 0 at the top. Color is 8-bit sRGB values / 255.
struct Pixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::string> channels;
    std::vector<float> values;
};

/// Draws one scene. Throws RendererError (renderer/device.hpp) with one sentence.
class Renderer {
public:
    Renderer(Device& device, const scene::Scene& scene, const RenderSettings& settings);
    ~Renderer();
    Renderer(Renderer&&) noexcept;

    /// Draws one frame from `camera` and waits for it.
    void render(const scene::Camera& camera);
    /// The last frame's pixels.
    Pixels read(Output output) const;
    const FrameReport& report() const;
    /// Changes what does not need new images: technique, scatter, transmit.
    void setEffect(Technique technique, bool scatter, bool transmit);
    /// Replaces the scene's subsurface materials (same count) without rebuilding anything else.
    void setMaterials(const std::vector<Material>& materials);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace nacre::renderer
