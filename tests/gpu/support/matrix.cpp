#include "tests/gpu/support/matrix.hpp"
#include "tests/support/worst.hpp"

#include <cmath>
#include <cstdio>
#include <iterator>
#include <sstream>
#include <utility>

namespace nacre::tests {
namespace {

constexpr VkOffset2D rectangleOffset{6, 4};

double depthAt(int u) {
    return 300 + 0.1 * u;
}

/// Light that every format holds exactly; much more of it outside of the area, where nobody may look.
float lightAt(int u, int v, int eye) {
    const bool inside =
        u >= 0 && v >= 0 && u < static_cast<int>(matrixArea.width) && v < static_cast<int>(matrixArea.height);
    return !inside ? 64.0f : (u + 3 * eye) / 8 % 2 == 0 ? 1.0f : 0.125f;
}

std::uint16_t idAt(int u, int v) {
    return static_cast<std::uint16_t>(v >= 0 && v < 3 ? 0 : u < 20 ? 1 : 2);
}

const char* name(MatrixPart part) {
    constexpr const char* names[] = {"whole image", "rectangle", "dynamic resolution", "image layers"};
    return names[static_cast<int>(part)];
}

} // namespace

std::vector<MatrixFormats> matrixFormats() {
    constexpr std::pair<VkFormat, double> lights[] = {{VK_FORMAT_R32G32B32A32_SFLOAT, 2e-3},
                                                      {VK_FORMAT_R16G16B16A16_SFLOAT, 3e-3},
                                                      {VK_FORMAT_B10G11R11_UFLOAT_PACK32, 4e-2}};
    constexpr VkFormat ids[] = {VK_FORMAT_R8_UINT, VK_FORMAT_R16_UINT};
    constexpr VkFormat depths[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_D32_SFLOAT};
    std::vector<MatrixFormats> all;
    for (std::size_t light = 0; light < std::size(lights); ++light) {
        for (std::size_t id = 0; id < std::size(ids); ++id) {
            all.push_back({lights[light].first, ids[id], depths[(light + id) % 2], lights[light].second});
        }
    }
    return all;
}

std::vector<MatrixCamera> matrixCameras(int eye) {
    const double width = matrixArea.width;
    const double height = matrixArea.height;
    std::vector<MatrixCamera> cameras{{"perspective", true, Projection::perspective(width, height, 600)},
                                      {"off-centre", true, Projection::perspective(width, height, 600, 20, 3)},
                                      {"orthographic", false, Projection::orthographic(width, height, 2)}};
    for (MatrixCamera& camera : cameras) {
        camera.projection.clipFromView[camera.perspective ? 8 : 12] += 0.25f * static_cast<float>(eye);
    }
    return cameras;
}

MatrixImages::MatrixImages(Gpu& gpu, const MatrixFormats& formats, MatrixPart part, int eye)
    : gpu_(gpu), formats_(formats), part_(part) {
    const bool isWhole = part == MatrixPart::Whole || part == MatrixPart::Layers;
    extent_ = isWhole ? matrixArea : matrixLarger;
    area_ = {part == MatrixPart::Rectangle ? rectangleOffset : VkOffset2D{}, isWhole ? VkExtent2D{} : matrixArea};
    const std::vector<int> eyes = part == MatrixPart::Layers ? std::vector{0, 1} : std::vector{eye};
    const auto layers = static_cast<std::uint32_t>(eyes.size());
    const std::size_t count = std::size_t{extent_.width} * extent_.height * layers;

    std::vector<Float4> light;
    std::vector<std::uint16_t> ids;
    std::vector<std::vector<float>> depths(matrixCameras(0).size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const int u = static_cast<int>(i % extent_.width) - area_.offset.x;
        const int v = static_cast<int>(i / extent_.width % extent_.height) - area_.offset.y;
        const float value = lightAt(u, v, eyes[i / (extent_.width * extent_.height)]);
        light.push_back({value, value, value, 1});
        ids.push_back(idAt(u, v));
        for (std::size_t camera = 0; camera < depths.size(); ++camera) {
            const bool perspective = matrixCameras(0)[camera].perspective;
            const double hardware = perspective ? 1 / depthAt(u) : 1e-4 * depthAt(u);
            depths[camera].push_back(static_cast<float>(formats.depth == VK_FORMAT_D32_SFLOAT ? hardware : depthAt(u)));
        }
    }
    uploadLight(gpu, irradiance_ = createInput(formats.light, layers), light);
    uploadIds(gpu, materialId_ = createInput(formats.materialId, layers), ids);
    for (const std::vector<float>& depth : depths) {
        gpu.upload(depth_.emplace_back(createInput(formats.depth, layers)), depth);
    }
    // The plane of the perspective cameras: across a pixel of about 0.5 mm the depth grows by 0.1 mm.
    gpu.upload(normal_ = createInput(VK_FORMAT_R32G32B32A32_SFLOAT, layers), std::vector<Float4>(count, matrixNormal));
    gpu.upload(albedo_ = createInput(VK_FORMAT_R32G32B32A32_SFLOAT, layers),
               std::vector<Float4>(count, {0.5f, 0.25f, 0.75f, 1}));
    gpu.upload(strength_ = createInput(VK_FORMAT_R32_SFLOAT, layers), std::vector<float>(count, matrixStrength));
    gpu.upload(thickness_ = createInput(VK_FORMAT_R32_SFLOAT, layers), std::vector<float>(count, matrixThickness));

    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        for (std::size_t camera = 0; camera < depths.size(); ++camera) {
            for (unsigned optional = 0; optional < MatrixScatterAll; ++optional) {
                calls_.push_back({layer, eyes[layer], camera, optional});
            }
        }
    }
    const auto outputs = static_cast<std::uint32_t>(calls_.size());
    const auto createOutput = [&](VkFormat format) {
        return gpu.createImage({.format = format,
                                .extent = extent_,
                                .usage = VK_IMAGE_USAGE_STORAGE_BIT,
                                .layers = outputs,
                                .layerViews = true});
    };
    light_ = createOutput(formats.light);
    thicknessOut_ = createOutput(VK_FORMAT_R32_SFLOAT);

    source_.kind = NACRE_LIGHT_DIRECTIONAL;
    source_.position[2] = -600;
    source_.direction[2] = 1;
    source_.irradiance[0] = source_.irradiance[1] = source_.irradiance[2] = 1;
    source_.shadowRange = 1000;
    source_.shadowClipFromWorld[0] = source_.shadowClipFromWorld[5] = 0.02f;
    source_.shadowClipFromWorld[15] = 1;
}

GpuImage MatrixImages::createInput(VkFormat format, std::uint32_t layers) {
    return gpu_.createImage({.format = format,
                             .extent = extent_,
                             .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                             .layout = format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL
                                                                      : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                             .layers = layers,
                             .layerViews = true});
}

NacreView MatrixImages::view(const MatrixCall& call) const {
    NacreView result = makeView(matrixCameras(call.eye)[call.camera].projection);
    result.renderArea = area_;
    result.depthEncoding = formats_.depth == VK_FORMAT_D32_SFLOAT ? NACRE_DEPTH_HARDWARE : NACRE_DEPTH_LINEAR;
    return result;
}

NacreScatterInfo MatrixImages::scatterInfo(std::size_t index) const {
    const MatrixCall& call = calls_[index];
    NacreScatterInfo info{};
    info.view = view(call);
    info.irradiance = irradiance_.nacreLayer(call.layer);
    info.depth = depth_[call.camera].nacreLayer(call.layer);
    info.materialId = materialId_.nacreLayer(call.layer);
    info.normal = call.optional & MatrixNormal ? normal_.nacreLayer(call.layer) : NacreImage{};
    info.strength = call.optional & MatrixStrength ? strength_.nacreLayer(call.layer) : NacreImage{};
    info.albedo = call.optional & MatrixAlbedo ? albedo_.nacreLayer(call.layer) : NacreImage{};
    info.scattered = light_.nacreLayer(static_cast<std::uint32_t>(index));
    return info;
}

NacreTransmitInfo MatrixImages::transmitInfo(std::size_t index, const NacreImage& shadowMap) const {
    const MatrixCall& call = calls_[index];
    NacreTransmitInfo info{};
    info.view = view(call);
    info.depth = depth_[call.camera].nacreLayer(call.layer);
    info.materialId = materialId_.nacreLayer(call.layer);
    info.normal = normal_.nacreLayer(call.layer);
    info.thickness = call.optional & MatrixThickness ? thickness_.nacreLayer(call.layer) : NacreImage{};
    info.strength = call.optional & MatrixTransmitStrength ? strength_.nacreLayer(call.layer) : NacreImage{};
    info.lightCount = 1;
    info.lights = &source_;
    info.shadowMapCount = 1;
    info.shadowMaps = &shadowMap;
    info.transmitted = light_.nacreLayer(static_cast<std::uint32_t>(index));
    info.thicknessOut =
        call.optional & MatrixThicknessOut ? thicknessOut_.nacreLayer(static_cast<std::uint32_t>(index)) : NacreImage{};
    return info;
}

std::string MatrixImages::description(std::size_t index) const {
    const MatrixCall& call = calls_[index];
    std::ostringstream text;
    text << name(part_) << ", " << matrixCameras(call.eye)[call.camera].name << ", optional images " << call.optional
         << ", eye " << call.eye << ", VkFormat " << formats_.light << ", " << formats_.materialId << ", "
         << formats_.depth;
    return text.str();
}

template <typename T> std::vector<std::vector<T>> MatrixImages::cropped(const std::vector<T>& layers) const {
    std::vector<std::vector<T>> parts;
    for (std::size_t call = 0; call < calls_.size(); ++call) {
        std::vector<T>& part = parts.emplace_back();
        for (std::uint32_t y = 0; y < matrixArea.height; ++y) {
            const std::size_t row = (call * extent_.height + y + area_.offset.y) * extent_.width + area_.offset.x;
            part.insert(part.end(), layers.begin() + row, layers.begin() + row + matrixArea.width);
        }
    }
    return parts;
}

std::vector<std::vector<Float4>> MatrixImages::results() {
    return cropped(downloadLight(gpu_, light_));
}

std::vector<std::vector<float>> MatrixImages::thicknesses() {
    return cropped(gpu_.download<float>(thicknessOut_));
}

double largestDifference(const std::vector<Float4>& a, const std::vector<Float4>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            largest = larger(largest, std::abs(double{a[i][channel]} - b[i][channel]));
        }
    }
    return largest;
}

/// A context for this technique.
std::unique_ptr<Effect> MatrixTest::makeEffect(NacreTechnique technique) {
    NacreContextInfo info = gpu.contextInfo(matrixLarger);
    info.techniques = 1u << technique;
    info.recordsPerFrame = 64;
    auto effect = std::make_unique<Effect>(gpu, info);
    Material first;
    first.layers = {{{0.3, 0.6, 0.9}, 0.1}, {{0.7, 0.4, 0.1}, 1.0}};
    first.albedoUse = AlbedoUse::PreAndPost;
    const Material materials[] = {first, marble()};
    effect->setMaterials(materials);
    return effect;
}

/// Every call of these images, all in one frame.
std::vector<std::vector<Float4>> MatrixTest::scatter(Effect& effect, MatrixImages& images, NacreTechnique technique) {
    EXPECT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
    gpu.run([&](VkCommandBuffer commandBuffer) {
        for (std::size_t call = 0; call < images.calls().size(); ++call) {
            NacreScatterInfo info = images.scatterInfo(call);
            info.technique = technique;
            EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &info), NACRE_SUCCESS) << effect.messages.back();
        }
    });
    return images.results();
}

/// What each eye sees in the plainest formats and all of an image.
std::vector<std::vector<Float4>> MatrixTest::plain(Effect& effect, NacreTechnique technique) {
    std::vector<std::vector<Float4>> both;
    for (const int eye : {0, 1}) {
        MatrixImages images(gpu, {}, MatrixPart::Whole, eye);
        const std::vector<std::vector<Float4>> pictures = scatter(effect, images, technique);
        both.insert(both.end(), pictures.begin(), pictures.end());
    }
    return both;
}

/// What each eye sees by brute, which takes a software device longer than all else: once for all tests.
const std::vector<std::vector<Float4>>& MatrixTest::reference() {
    static const std::vector<std::vector<Float4>> pictures =
        plain(*makeEffect(NACRE_TECHNIQUE_BRUTE), NACRE_TECHNIQUE_BRUTE);
    return pictures;
}

void MatrixTest::expectFollows(NacreTechnique technique, double tolerance, std::span<const MatrixFormats> allFormats) {
    const std::unique_ptr<Effect> effect = makeEffect(technique);
    const std::vector<std::vector<Float4>>& brute = reference();
    const std::vector<std::vector<Float4>> own = technique == NACRE_TECHNIQUE_BRUTE ? brute : plain(*effect, technique);
    EXPECT_GT(largestDifference(brute[0], brute[brute.size() / 2]), 0.2) << "the eyes see one picture";
    double worst = 0;
    int calls = 0;
    for (const MatrixFormats& formats : allFormats) {
        for (const MatrixPart part : matrixParts) {
            MatrixImages images(gpu, formats, part);
            const std::vector<std::vector<Float4>> pictures = scatter(*effect, images, technique);
            for (std::size_t i = 0; i < pictures.size(); ++i, ++calls) {
                const double toBrute = largestDifference(pictures[i], brute[i]);
                const double toItself = largestDifference(pictures[i], own[i]);
                worst = std::max(worst, formats.step < 0.01 ? toBrute : 0);
                EXPECT_TRUE(toBrute < tolerance + formats.step && toItself < formats.step)
                    << images.description(i) << ": " << toBrute << " from brute, " << toItself << " from itself";
            }
        }
    }
    std::printf("%s: %d calls, largest difference to brute %.3f\n", nacreTechniqueString(technique), calls, worst);
}

} // namespace nacre::tests
