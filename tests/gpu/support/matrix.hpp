// The axes of the contract's matrix (formats, projections, parts of images, optional inputs), and one scene in all of
// them: two materials side by side and a background, lit in stripes, on a plane that leans away from the camera.
#pragma once

#include "tests/gpu/support/effect.hpp"

namespace nacre::tests {

/// What is rendered, whatever part of an image it is. Neither side of either extent is a power of two: a software
/// device compiles passes anew for images where one is.
inline constexpr VkExtent2D matrixArea{28, 18};
/// Images that are larger than it.
inline constexpr VkExtent2D matrixLarger{36, 24};

struct MatrixFormats {
    VkFormat light = VK_FORMAT_R32G32B32A32_SFLOAT; ///< irradiance and output
    VkFormat materialId = VK_FORMAT_R16_UINT;
    VkFormat depth = VK_FORMAT_R32_SFLOAT; ///< linear; D32 holds hardware depth
    double step = 2e-3;                    ///< how far the light's format may be off
};
/// Every two formats meet. Images are read one by one, so that three have nothing to do with each other that two have
/// not; and a software device compiles every pass anew for each.
std::vector<MatrixFormats> matrixFormats();

struct MatrixCamera {
    const char* name;
    bool perspective;
    Projection projection; ///< hardware depth: 1 / depth, or 1e-4 · depth of an orthographic camera
};
/// Of the left and the right eye.
std::vector<MatrixCamera> matrixCameras(int eye);

enum class MatrixPart {
    Whole,     ///< all of an image
    Rectangle, ///< a part in the middle of a larger image: a view of several
    Smaller,   ///< the first corner of it: dynamic resolution
    Layers,    ///< two layers of array images, an eye in each: stereo
};
inline constexpr MatrixPart matrixParts[] = {MatrixPart::Whole, MatrixPart::Rectangle, MatrixPart::Smaller,
                                             MatrixPart::Layers};

/// Bits of a combination of optional images.
enum MatrixOptional : unsigned { MatrixNormal = 1, MatrixStrength = 2, MatrixAlbedo = 4, MatrixScatterAll = 8 };
enum MatrixTransmitOptional : unsigned {
    MatrixThickness = 1,
    MatrixTransmitStrength = 2,
    MatrixThicknessOut = 4,
    MatrixTransmitAll = 8
};
inline constexpr Float4 matrixNormal{0.196f, 0, 0.981f, 0};
inline constexpr float matrixStrength = 0.75f;
inline constexpr float matrixThickness = 0.8f; // mm

/// One call of the matrix.
struct MatrixCall {
    std::uint32_t layer; ///< of the inputs
    int eye;
    std::size_t camera; ///< of matrixCameras(eye)
    unsigned optional;
};

/// The scene in some formats and a part, and an output per call.
class MatrixImages {
public:
    /// eye: who looks, unless there are two.
    MatrixImages(Gpu& gpu, const MatrixFormats& formats, MatrixPart part, int eye = 0);

    const std::vector<MatrixCall>& calls() const { return calls_; }
    NacreScatterInfo scatterInfo(std::size_t call) const;
    /// A light behind the plane that shines along +z from z = -600 mm; the map is 100 mm wide, its range 1000 mm.
    NacreTransmitInfo transmitInfo(std::size_t call, const NacreImage& shadowMap) const;
    /// What a call is, for messages.
    std::string description(std::size_t call) const;
    /// matrixArea of every call's output.
    std::vector<std::vector<Float4>> results();
    std::vector<std::vector<float>> thicknesses();

private:
    NacreView view(const MatrixCall& call) const;
    GpuImage createInput(VkFormat format, std::uint32_t layers);
    template <typename T> std::vector<std::vector<T>> cropped(const std::vector<T>& layers) const;

    Gpu& gpu_;
    MatrixFormats formats_;
    MatrixPart part_;
    VkExtent2D extent_;
    VkRect2D area_; ///< zero extent = all
    std::vector<MatrixCall> calls_;
    GpuImage irradiance_, materialId_, normal_, strength_, albedo_, thickness_;
    std::vector<GpuImage> depth_; ///< of every camera
    GpuImage light_, thicknessOut_;
    NacreLight source_{};
};

/// Largest difference of red, green and blue; huge where one is not a number.
double largestDifference(const std::vector<Float4>& a, const std::vector<Float4>& b);

/// Scatters the matrix.
class MatrixTest : public GpuTest {
protected:
    /// The matrix of these formats: within `tolerance` of brute, and of itself in the plainest formats and all of an
    /// image; each plus the format's step.
    void expectFollows(NacreTechnique technique, double tolerance, std::span<const MatrixFormats> allFormats);

private:
    std::unique_ptr<Effect> makeEffect(NacreTechnique technique);
    std::vector<std::vector<Float4>> scatter(Effect& effect, MatrixImages& images, NacreTechnique technique);
    std::vector<std::vector<Float4>> plain(Effect& effect, NacreTechnique technique);
    const std::vector<std::vector<Float4>>& reference();
};

} // namespace nacre::tests
