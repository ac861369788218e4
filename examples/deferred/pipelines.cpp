#include "pipelines.hpp"

namespace {

constexpr std::uint32_t bodyVert[] =
#include "body.vert.inc"
    ;
constexpr std::uint32_t surfaceFrag[] =
#include "surface.frag.inc"
    ;
constexpr std::uint32_t screenVert[] =
#include "screen.vert.inc"
    ;
constexpr std::uint32_t lightingFrag[] =
#include "lighting.frag.inc"
    ;
constexpr std::uint32_t resolveFrag[] =
#include "resolve.frag.inc"
    ;
constexpr std::uint32_t addFrag[] =
#include "add.frag.inc"
    ;

VkPipeline createLighting(Device& device, VkSampleCountFlagBits samples) {
    if (samples == VK_SAMPLE_COUNT_1_BIT) {
        return device.createPipeline({.vertex = screenVert,
                                      .fragment = lightingFrag,
                                      .colors = {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_SRGB}});
    }
    return device.createPipeline(
        {.vertex = screenVert,
         .fragment = resolveFrag,
         .colors = {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB,
                    VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R8_UINT}});
}

} // namespace

Pipelines createPipelines(Device& device, VkSampleCountFlagBits samples) {
    return {device.createPipeline({.vertex = bodyVert,
                                   .fragment = {},
                                   .colors = {},
                                   .depth = VK_FORMAT_D32_SFLOAT,
                                   .compare = VK_COMPARE_OP_LESS}),
            device.createPipeline({.vertex = bodyVert,
                                   .fragment = surfaceFrag,
                                   .colors = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R16G16_SFLOAT},
                                   .depth = VK_FORMAT_D32_SFLOAT_S8_UINT,
                                   .compare = VK_COMPARE_OP_GREATER,
                                   .writesStencil = true,
                                   .samples = samples}),
            createLighting(device, samples),
            device.createPipeline(
                {.vertex = screenVert, .fragment = addFrag, .colors = {VK_FORMAT_R8G8B8A8_SRGB}, .adds = true})};
}
