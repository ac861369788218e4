// The whole way from a Vulkan device to a picture with subsurface scattering and translucency: a sphere of wax on a
// plane of skin, lit from behind. A real renderer has the images already; scene.comp stands in for it.
//
// Usage: minimal [picture.png]
#include "gpu.hpp"

#include <nacre/nacre.hpp>
#include <stb/stb_image_write.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace {

constexpr std::uint32_t sceneSpirv[] =
#include "scene.inc"
    ;
constexpr std::uint32_t composeSpirv[] =
#include "compose.inc"
    ;

using Vector = std::array<float, 3>;

float dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector normalized(const Vector& v) {
    const float length = std::sqrt(dot(v, v));
    return {v[0] / length, v[1] / length, v[2] / length};
}

/// What scene.comp is told: a camera and a directional light with its shadow map's axes. Metres.
struct Scene {
    float eye[4];
    float right[4]; ///< [3] tangent of half the field of view
    float up[4];
    float lightOrigin[4]; ///< of the shadow map; [3] its range
    float lightRight[4];  ///< [3] half the width of the shadow map
    float lightUp[4];
    float lightDirection[4]; ///< [3] irradiance
};

/// Writes two axes, at right angles to `forward` and to each other.
void setAxes(const Vector& forward, float (&right)[4], float (&up)[4]) {
    const Vector x = normalized(cross(forward, {0, 1, 0}));
    const Vector y = cross(x, forward);
    for (int i = 0; i < 3; ++i) {
        right[i] = x[i];
        up[i] = y[i];
    }
}

Scene makeScene() {
    const Vector eye{0, 0.028f, 0.05f};
    const Vector target{0, 0.008f, 0};
    const Vector light = normalized({-0.6f, -0.5f, 0.6f});
    Scene scene{};
    setAxes(normalized({target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]}), scene.right, scene.up);
    setAxes(light, scene.lightRight, scene.lightUp);
    for (int i = 0; i < 3; ++i) {
        scene.eye[i] = eye[i];
        scene.lightDirection[i] = light[i];
        scene.lightOrigin[i] = -0.1f * light[i];
    }
    scene.right[3] = 0.3f;
    scene.lightOrigin[3] = 0.2f;
    scene.lightRight[3] = 0.05f;
    scene.lightDirection[3] = 4.0f;
    return scene;
}

NacreView makeView(const Scene& scene) {
    const Vector right{scene.right[0], scene.right[1], scene.right[2]};
    const Vector up{scene.up[0], scene.up[1], scene.up[2]};
    const Vector back = cross(right, up);
    const Vector eye{scene.eye[0], scene.eye[1], scene.eye[2]};
    // [snippet: view]
    NacreView view{}; // matrices are column-major; this is a square picture
    view.clipFromView[0] = 1 / scene.right[3];
    view.clipFromView[5] = -1 / scene.right[3]; // Vulkan's clip space: y points down
    view.clipFromView[11] = -1;                 // clip w is the distance in front of the camera
    view.clipFromView[14] = 0.001f;             // reversed depth with an infinite far plane
    for (int i = 0; i < 3; ++i) {
        view.viewFromWorld[4 * i + 0] = right[i];
        view.viewFromWorld[4 * i + 1] = up[i];
        view.viewFromWorld[4 * i + 2] = back[i];
    }
    view.viewFromWorld[12] = -dot(right, eye);
    view.viewFromWorld[13] = -dot(up, eye);
    view.viewFromWorld[14] = -dot(back, eye);
    view.viewFromWorld[15] = 1;
    view.depthEncoding = NACRE_DEPTH_LINEAR; // NACRE_DEPTH_HARDWARE takes the depth buffer itself
    view.metersPerUnit = 1;
    // [end]
    return view;
}

// [snippet: messages]
void onMessage(NacreSeverity severity, const char* message, void*) {
    std::fprintf(stderr, "nacre %s: %s\n", severity == NACRE_SEVERITY_ERROR ? "error" : "info", message);
}

void check(NacreResult result) {
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(nacreResultString(result)); // onMessage has said which field, and why
    }
}
// [end]

nacre::Context createContext(const Gpu& gpu, VkExtent2D extent) {
    // [snippet: context]
    NacreContextInfo info{};
    info.headerVersion = NACRE_HEADER_VERSION;
    info.instance = gpu.instance;
    info.physicalDevice = gpu.physicalDevice;
    info.device = gpu.device;
    info.getInstanceProcAddr = vkGetInstanceProcAddr;
    info.maxExtent = extent;
    info.framesInFlight = 1;
    info.techniques = 1u << NACRE_TECHNIQUE_DEFAULT;
    info.messageCallback = onMessage;
    nacre::Context context;
    check(nacre::Context::create(info, context));
    // [end]
    return context;
}

void setMaterials(nacre::Context& context) {
    // [snippet: materials]
    // Weights per colour, variance in mm²: light travels a centimetre in wax, red light a millimetre in skin.
    const NacreLayer wax[] = {{{0.3f, 0.5f, 0.75f}, 0.5f}, {{0.7f, 0.5f, 0.25f}, 90.0f}};
    const NacreLayer skin[] = {{{0.4f, 0.8f, 0.95f}, 0.03f}, {{0.6f, 0.2f, 0.05f}, 1.6f}};
    NacreMaterial materials[] = {nacreDefaultMaterial(), nacreDefaultMaterial()};
    materials[0].layers = wax;
    materials[0].layerCount = 2;
    materials[0].translucency = 0.8f; // of the light that comes through; 1 is what the layers say
    materials[0].exchangeGroups = 1;  // wax and skin touch, and keep their light apart
    materials[1].layers = skin;
    materials[1].layerCount = 2;
    materials[1].exchangeGroups = 2;
    check(context.setMaterials(1, materials)); // ids 1 and 2; 0 is everything without subsurface scattering
    // [end]
}

NacreLight makeLight(const Scene& scene) {
    // [snippet: light]
    NacreLight light{};
    light.kind = NACRE_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 3; ++i) {
        light.position[i] = scene.lightOrigin[i]; // where the shadow map's depth is 0
        light.direction[i] = scene.lightDirection[i];
        light.irradiance[i] = scene.lightDirection[3];
        // shadowClipFromWorld: the map's axes, from -1 to 1 over its width
        light.shadowClipFromWorld[4 * i + 0] = scene.lightRight[i] / scene.lightRight[3];
        light.shadowClipFromWorld[4 * i + 1] = scene.lightUp[i] / scene.lightRight[3];
        light.shadowClipFromWorld[12] -= light.shadowClipFromWorld[4 * i + 0] * scene.lightOrigin[i];
        light.shadowClipFromWorld[13] -= light.shadowClipFromWorld[4 * i + 1] * scene.lightOrigin[i];
    }
    light.shadowClipFromWorld[15] = 1;
    light.shadowMap = 0;
    light.shadowRange = scene.lightOrigin[3]; // stored value · range = distance along the light
    // [end]
    return light;
}

/// Runs one of the example's own passes, after what was written before it.
void dispatch(const Gpu& gpu, VkPipeline pipeline, const Scene& scene, VkExtent2D extent) {
    vkCmdBindPipeline(gpu.commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(gpu.commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, gpu.layout, 0, 1, &gpu.set, 0, nullptr);
    vkCmdPushConstants(gpu.commandBuffer, gpu.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(scene), &scene);
    vkCmdDispatch(gpu.commandBuffer, (extent.width + 7) / 8, (extent.height + 7) / 8, 1);
}

void barrier(VkCommandBuffer commandBuffer, VkPipelineStageFlags stage, VkAccessFlags access) {
    VkMemoryBarrier written{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    written.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    written.dstAccessMask = access;
    vkCmdPipelineBarrier(commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, stage, 0, 1, &written, 0, nullptr, 0,
                         nullptr);
}

void render(const char* path) {
    // [snippet: requirements]
    NacreRequirements requirements{};
    check(nacreGetRequirements(&requirements));
    Gpu gpu(requirements);
    // [end]
    const VkExtent2D extent{512, 512};
    const NacreImage irradiance = gpu.createImage(VK_FORMAT_R16G16B16A16_SFLOAT, extent);
    const NacreImage depth = gpu.createImage(VK_FORMAT_R32_SFLOAT, extent);
    const NacreImage materialId = gpu.createImage(VK_FORMAT_R16_UINT, extent);
    const NacreImage normal = gpu.createImage(VK_FORMAT_R16G16B16A16_SFLOAT, extent);
    const NacreImage shadowMap = gpu.createImage(VK_FORMAT_R32_SFLOAT, extent, VK_IMAGE_VIEW_TYPE_2D_ARRAY);
    const NacreImage scattered = gpu.createImage(VK_FORMAT_R16G16B16A16_SFLOAT, extent);
    const NacreImage transmitted = gpu.createImage(VK_FORMAT_R16G16B16A16_SFLOAT, extent);
    void* picture = nullptr;
    const VkBuffer buffer = gpu.createBuffer(VkDeviceSize{4} * extent.width * extent.height, &picture);
    gpu.bind(std::array{irradiance, depth, materialId, normal, shadowMap, scattered, transmitted}, buffer);
    const VkPipeline scenePipeline = gpu.createPipeline(sceneSpirv);
    const VkPipeline composePipeline = gpu.createPipeline(composeSpirv);

    nacre::Context context = createContext(gpu, extent);
    setMaterials(context);
    const Scene scene = makeScene();
    const VkCommandBuffer commandBuffer = gpu.begin();
    dispatch(gpu, scenePipeline, scene, extent);

    // [snippet: frame]
    barrier(commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
    check(context.beginFrame(0));

    NacreScatterInfo scatter{};
    scatter.view = makeView(scene);
    scatter.irradiance = irradiance;
    scatter.depth = depth;
    scatter.materialId = materialId;
    scatter.normal = normal;
    scatter.scattered = scattered;
    check(context.cmdScatter(commandBuffer, scatter));

    const NacreLight light = makeLight(scene);
    NacreTransmitInfo transmit{};
    transmit.view = scatter.view;
    transmit.depth = depth;
    transmit.materialId = materialId;
    transmit.normal = normal;
    transmit.lightCount = 1;
    transmit.lights = &light;
    transmit.shadowMapCount = 1;
    transmit.shadowMaps = &shadowMap;
    transmit.transmitted = transmitted;
    check(context.cmdTransmit(commandBuffer, transmit));
    barrier(commandBuffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
    // [end]

    dispatch(gpu, composePipeline, scene, extent);
    barrier(commandBuffer, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
    gpu.submitAndWait();
    const auto width = static_cast<int>(extent.width);
    if (stbi_write_png(path, width, static_cast<int>(extent.height), 4, picture, 4 * width) == 0) {
        throw std::runtime_error(std::string("cannot write ") + path);
    }
    std::printf("wrote %s\n", path);
}

} // namespace

int main(int argc, char** argv) {
    try {
        render(argc > 1 ? argv[1] : "minimal.png");
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "minimal: %s\n", error.what());
        return 1;
    }
}
