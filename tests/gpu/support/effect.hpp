// Runs the effect on images made on the CPU. Lengths in millimetres: views have metersPerUnit 1e-3.
#pragma once

#include "nacre/material.hpp"
#include "tests/gpu/support/headless_gpu.hpp"

#include <array>
#include <functional>
#include <optional>

namespace nacre::tests {

using Float4 = std::array<float, 4>;

/// Column-major projections for a camera that looks along -Z, Vulkan clip space.
struct Projection {
    std::array<float, 16> clipFromView{};
    /// Perspective with a focal length in px and the principal point at `center` px; reversed and infinite:
    /// clip z = near.
    static Projection perspective(double width, double height, double focalLength, double centerX, double centerY);
    /// Perspective whose middle is the image's.
    static Projection perspective(double width, double height, double focalLength);
    /// Orthographic with this many px per mm; depth 0 … 1 over [near, far].
    static Projection orthographic(double width, double height, double pixelsPerMillimetre);
};

/// A view of the whole image with an identity camera, linear depth and millimetres.
NacreView makeView(const Projection& projection);

/// Fills an image of one of the irradiance's formats; reads back one of them, or of one channel.
void uploadLight(Gpu& gpu, GpuImage& image, const std::vector<Float4>& light);
std::vector<Float4> downloadLight(Gpu& gpu, const GpuImage& image);
/// The same for ids.
void uploadIds(Gpu& gpu, GpuImage& image, const std::vector<std::uint16_t>& ids);

/// The images of one scatter call, tightly packed, row 0 at the top. Optional ones are empty.
struct ScatterInput {
    VkExtent2D extent{};
    NacreView view{};
    std::vector<Float4> irradiance;
    std::vector<float> depth;
    std::vector<std::uint16_t> materialId;
    std::vector<Float4> normal; ///< world space, unit length
    std::vector<float> strength;
    std::vector<float> scale;
    std::vector<Float4> albedo;

    /// Everything sized and set: a plane of material 1 that faces the camera, lit evenly by 1.
    static ScatterInput plane(std::uint32_t width, std::uint32_t height, const Projection& projection, float depth);
    std::size_t index(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * extent.width + x; }
};

/// Formats other than the default ones.
struct ScatterFormats {
    VkFormat irradiance = VK_FORMAT_R32G32B32A32_SFLOAT;
    VkFormat materialId = VK_FORMAT_R16_UINT;
    VkFormat depth = VK_FORMAT_R32_SFLOAT;
    VkFormat scattered = VK_FORMAT_R32G32B32A32_SFLOAT;
    VkFormat albedo = VK_FORMAT_R32G32B32A32_SFLOAT;
};

/// The input's images on the device, and the struct that names them.
struct ScatterImages {
    ScatterImages(Gpu& gpu, const ScatterInput& input, const ScatterFormats& formats = {});
    /// Arguments of nacreCmdTransmit with these images; the output takes the place of the scattered light.
    NacreTransmitInfo transmitInfo(std::span<const NacreLight> lights = {},
                                   std::span<const NacreImage> shadowMaps = {}) const;
    std::vector<GpuImage> images;
    GpuImage scattered;
    NacreScatterInfo info{};
};

/// The C API's material of core's; the layers belong to `material`'s copy in `storage`.
NacreMaterial toNacre(const Material& material, std::vector<NacreLayer>& storage);

/// A context, with the messages it gave.
class Effect {
public:
    /// Throws std::runtime_error when the context cannot be made.
    Effect(Gpu& gpu, NacreContextInfo info);
    ~Effect() { nacreDestroyContext(context); }
    Effect(const Effect&) = delete;

    /// Sets materials 1, 2, …
    void setMaterials(std::span<const Material> materials);
    /// Begins frame 0, scatters, and reads the result back as floats. Throws std::runtime_error with the message.
    std::vector<Float4> scatter(const ScatterInput& input, NacreTechnique technique,
                                const ScatterFormats& formats = {});
    /// The same with more than the technique set.
    std::vector<Float4> scatter(const ScatterInput& input, const std::function<void(NacreScatterInfo&)>& set,
                                const ScatterFormats& formats = {});

    Gpu& gpu;
    NacreContext context = nullptr;
    std::vector<std::string> messages;
};

/// Materials of the tests: skin (d'Eon and Luebke 2007), marble (Jimenez 2009), Burley.
Material skin();
Material marble();
Material burley();

/// dB, peak 1, over the pixels with a material.
double psnr(std::span<const Float4> image, std::span<const Float4> reference, std::span<const std::uint16_t> ids);

} // namespace nacre::tests
