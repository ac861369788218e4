#include "renderer/passes/copy_floor.hpp"

#include "copy_floor_comp.spv.h"

namespace nacre::renderer {

CopyFloor::CopyFloor(Gpu& gpu, const Inputs& inputs, const vk::raii::Sampler& nearest) {
    const auto& [irradiance, depth, materialId] = inputs;
    const vk::Extent2D extent = irradiance.info().extent;
    copy_ = Image(gpu, {.name = "copy",
                        .format = vk::Format::eR16G16B16A16Sfloat,
                        .extent = extent,
                        .usage = vk::ImageUsageFlagBits::eStorage});
    pass_ = ComputePass(
        gpu, "copy", copy_floor_comp_spv,
        {sampled(irradiance, nearest), sampled(depth, nearest), sampled(materialId, nearest), written(copy_)});
    std::uint64_t pixel = 0;
    for (const Image* image : {&irradiance, &depth, &materialId, &copy_}) {
        pixel += pixelBytes(image->info().format);
    }
    bytes_ = pixel * extent.width * extent.height;
}

void CopyFloor::record(const vk::raii::CommandBuffer& commandBuffer) const {
    pass_.record(commandBuffer, 0, copy_.info().extent);
}

} // namespace nacre::renderer
