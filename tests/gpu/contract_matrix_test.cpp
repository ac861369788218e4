// Every combination of optional inputs, formats, projections and parts of the image: the techniques against brute, and
// every format and encoding against the plainest one.
#include "tests/gpu/support/effect.hpp"

#include <cmath>
#include <cstdio>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr std::uint32_t width = 40;
constexpr std::uint32_t height = 28;
constexpr VkRect2D part{{6, 4}, {32, 22}};

struct Camera {
    const char* name;
    Projection projection; ///< of an area of the part's size
    double hardwareScale;  ///< hardware depth = scale / depth, or, of an orthographic camera, scale · depth
    bool perspective;
};

const Camera cameras[] = {
    {"perspective", Projection::perspective(32, 22, 600), 1, true},
    {"off-centre", Projection::perspective(32, 22, 600, 20, 3), 1, true},
    {"orthographic", Projection::orthographic(32, 22, 2), 1e-4, false},
};

/// Two materials side by side, lit in stripes, on a plane that leans away from the camera, with a background.
ScatterInput scene(const Camera& camera, bool wholeImage, bool hardwareDepth) {
    const VkExtent2D extent = wholeImage ? part.extent : VkExtent2D{width, height};
    const VkOffset2D offset = wholeImage ? VkOffset2D{0, 0} : part.offset;
    ScatterInput input = ScatterInput::plane(extent.width, extent.height, camera.projection, 300);
    if (!wholeImage) {
        input.view.renderArea = part;
    }
    input.view.depthEncoding = hardwareDepth ? NACRE_DEPTH_HARDWARE : NACRE_DEPTH_LINEAR;
    for (std::uint32_t y = 0; y < extent.height; ++y) {
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const int u = static_cast<int>(x) - offset.x;
            const int v = static_cast<int>(y) - offset.y;
            const std::size_t i = input.index(x, y);
            const double depth = 300 + 0.1 * u;
            input.materialId[i] = static_cast<std::uint16_t>(v < 3 ? 0 : u < 20 ? 1 : 2);
            const float light = u / 8 % 2 == 0 ? 1.0f : 0.125f; // exact in every format
            input.irradiance[i] = {light, light, light, 1};
            input.depth[i] = static_cast<float>(!hardwareDepth       ? depth
                                                : camera.perspective ? camera.hardwareScale / depth
                                                                     : camera.hardwareScale * depth);
        }
    }
    return input;
}

/// Largest difference over the part's pixels. `whole` has the part alone.
double difference(const std::vector<Float4>& image, bool imageIsWhole, const std::vector<Float4>& whole) {
    double largest = 0;
    for (std::uint32_t y = 0; y < part.extent.height; ++y) {
        for (std::uint32_t x = 0; x < part.extent.width; ++x) {
            const std::size_t at = imageIsWhole ? std::size_t{y} * part.extent.width + x
                                                : std::size_t{y + part.offset.y} * width + x + part.offset.x;
            for (int channel = 0; channel < 3; ++channel) {
                const double d = image[at][channel] - whole[std::size_t{y} * part.extent.width + x][channel];
                largest = std::isnan(d) ? 1e9 : std::max(largest, std::abs(d));
            }
        }
    }
    return largest;
}

/// Bits of a combination of optional inputs.
enum Optional : unsigned { Normal = 1, Strength = 2, Albedo = 4, All = 8 };

void addOptional(ScatterInput& input, unsigned given) {
    const std::size_t count = input.depth.size();
    if (given & Normal) {
        // The plane z = -300 - 0.1·u px: across a pixel of about 0.5 mm the depth grows by 0.1 mm.
        input.normal.assign(count, {0.196f, 0, 0.981f, 0});
    }
    if (given & Strength) {
        input.strength.assign(count, 0.75f);
    }
    if (given & Albedo) {
        input.albedo.assign(count, {0.5f, 0.25f, 0.75f, 1});
    }
}

class MatrixTest : public GpuTest {
protected:
    MatrixTest() {
        NacreContextInfo info = gpu.contextInfo({width, height});
        info.techniques = 1u << NACRE_TECHNIQUE_BRUTE | 1u << NACRE_TECHNIQUE_SEPARABLE | 1u << NACRE_TECHNIQUE_BANK;
        effect_ = std::make_unique<Effect>(gpu, info);
        Material first;
        first.layers = {{{0.3, 0.6, 0.9}, 0.1}, {{0.7, 0.4, 0.1}, 1.0}};
        first.albedoUse = AlbedoUse::PreAndPost;
        Material second = marble();
        const Material materials[] = {first, second};
        effect_->setMaterials(materials);
    }
    std::unique_ptr<Effect> effect_;
};

TEST_F(MatrixTest, TechniquesFollowBruteForEveryCombination) {
    double worst[2] = {0, 0};
    for (const Camera& camera : cameras) {
        for (unsigned given = 0; given < All; ++given) {
            for (const bool whole : {true, false}) {
                ScatterInput input = scene(camera, whole, false);
                addOptional(input, given);
                std::vector<Float4> brute = effect_->scatter(input, NACRE_TECHNIQUE_BRUTE);
                if (!whole) {
                    std::vector<Float4> cut;
                    for (std::uint32_t y = 0; y < part.extent.height; ++y) {
                        const auto row = brute.begin() + (y + part.offset.y) * width + part.offset.x;
                        cut.insert(cut.end(), row, row + part.extent.width);
                    }
                    brute = cut;
                }
                const NacreTechnique techniques[] = {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BANK};
                for (int i = 0; i < 2; ++i) {
                    const double d = difference(effect_->scatter(input, techniques[i]), whole, brute);
                    EXPECT_LT(d, 0.04) << nacreTechniqueString(techniques[i]) << ", " << camera.name << ", inputs "
                                       << given << (whole ? "" : ", part of the image");
                    worst[i] = std::max(worst[i], d);
                }
            }
        }
    }
    std::printf("largest difference to brute: separable %.3f, bank %.3f\n", worst[0], worst[1]);
}

TEST_F(MatrixTest, FormatsEncodingsAndPartsGiveOnePicture) {
    struct LightFormat {
        VkFormat format;
        double step; ///< its relative precision
    };
    const LightFormat lights[] = {{VK_FORMAT_R32G32B32A32_SFLOAT, 2e-3},
                                  {VK_FORMAT_R16G16B16A16_SFLOAT, 3e-3},
                                  {VK_FORMAT_B10G11R11_UFLOAT_PACK32, 4e-2}};
    const auto compare = [&](NacreTechnique technique, const LightFormat& light, VkFormat id, VkFormat depth) {
        const bool whole = id == VK_FORMAT_R8_UINT;
        const bool hardware = depth == VK_FORMAT_D32_SFLOAT;
        const ScatterFormats formats{light.format, id, depth, light.format};
        for (const Camera& camera : cameras) {
            const std::vector<Float4> plain = effect_->scatter(scene(camera, true, false), technique);
            const std::vector<Float4> image = effect_->scatter(scene(camera, whole, hardware), technique, formats);
            EXPECT_LT(difference(image, whole, plain), light.step)
                << nacreTechniqueString(technique) << ", " << camera.name << ", VkFormat " << light.format << ", " << id
                << ", " << depth;
        }
    };
    for (const LightFormat& light : lights) {
        for (const VkFormat id : {VK_FORMAT_R8_UINT, VK_FORMAT_R16_UINT}) {
            for (const VkFormat depth : {VK_FORMAT_R32_SFLOAT, VK_FORMAT_D32_SFLOAT}) {
                compare(NACRE_TECHNIQUE_SEPARABLE, light, id, depth);
            }
        }
        // Inputs are read by the same functions everywhere; a software device takes seconds to compile these passes for
        // each combination of formats.
        compare(NACRE_TECHNIQUE_BRUTE, light, VK_FORMAT_R8_UINT, VK_FORMAT_D32_SFLOAT);
        compare(NACRE_TECHNIQUE_BANK, light, VK_FORMAT_R8_UINT, VK_FORMAT_D32_SFLOAT);
    }
}

TEST_F(MatrixTest, TwoViewsOfOneFrameAreTwoPictures) {
    NacreContextInfo info = gpu.contextInfo({width, height});
    info.recordsPerFrame = 2;
    Effect stereo(gpu, info);
    const Material materials[] = {skin(), marble()};
    stereo.setMaterials(materials);
    // Side by side in one image: the left and the right half with a camera each.
    ScatterInput both = ScatterInput::plane(64, 22, cameras[0].projection, 300);
    for (std::uint32_t y = 0; y < 22; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            both.irradiance[both.index(x, y)] = x / 4 % 2 == 0 ? Float4{0, 0, 0, 1} : Float4{1, 1, 1, 1};
        }
    }
    for (const NacreTechnique technique : {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BRUTE, NACRE_TECHNIQUE_BANK}) {
        ScatterImages images(gpu, both);
        ASSERT_EQ(nacreBeginFrame(stereo.context, 0), NACRE_SUCCESS);
        gpu.run([&](VkCommandBuffer commandBuffer) {
            images.info.technique = technique;
            for (int view = 0; view < 2; ++view) {
                images.info.view = makeView(cameras[view].projection);
                images.info.view.renderArea = {{32 * view, 0}, {32, 22}};
                EXPECT_EQ(nacreCmdScatter(stereo.context, commandBuffer, &images.info), NACRE_SUCCESS);
            }
        });
        const std::vector<Float4> image = gpu.download<Float4>(images.scattered);
        for (std::uint32_t view = 0; view < 2; ++view) {
            ScatterInput alone = ScatterInput::plane(32, 22, cameras[view].projection, 300);
            for (std::uint32_t i = 0; i < 32 * 22; ++i) {
                alone.irradiance[i] = both.irradiance[both.index(i % 32 + 32 * view, i / 32)];
            }
            const std::vector<Float4> expected = stereo.scatter(alone, technique);
            double largest = 0;
            for (std::uint32_t i = 0; i < 32 * 22; ++i) {
                for (int channel = 0; channel < 3; ++channel) {
                    largest =
                        std::max<double>(largest, std::abs(expected[i][channel] -
                                                           image[both.index(i % 32 + 32 * view, i / 32)][channel]));
                }
            }
            EXPECT_LT(largest, 2e-3) << nacreTechniqueString(technique) << ", view " << view;
        }
    }
}

} // namespace
