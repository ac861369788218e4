#include "tests/gpu/support/scene_input.hpp"

namespace nacre::tests {
namespace {

Float4 toFloat4(double x, double y, double z, double w) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

} // namespace

ScatterInput toInput(const ScatterScene& scene, bool normals) {
    ScatterInput input;
    input.extent = {static_cast<std::uint32_t>(scene.width), static_cast<std::uint32_t>(scene.height)};
    input.view = makeView(Projection::perspective(scene.width, scene.height, scene.focalLength));
    for (std::size_t i = 0; i < scene.depth.size(); ++i) {
        const Rgb& light = scene.irradiance[i];
        input.irradiance.push_back(toFloat4(light[0], light[1], light[2], 1));
        input.depth.push_back(static_cast<float>(scene.depth[i]));
        input.materialId.push_back(scene.materialId[i]);
        if (normals) { // the scene's axes are the image's: y down, z away
            const Rgb& normal = scene.normal[i];
            input.normal.push_back(toFloat4(normal[0], -normal[1], -normal[2], 0));
        }
    }
    return input;
}

std::vector<Rgb> toRgb(std::span<const Float4> image) {
    std::vector<Rgb> result;
    for (const Float4& pixel : image) {
        result.push_back({pixel[0], pixel[1], pixel[2]});
    }
    return result;
}

} // namespace nacre::tests
