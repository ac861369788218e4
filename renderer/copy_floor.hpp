// The physical floor of scattering: a pass that only moves the bytes. Internal to the renderer.
#pragma once

#include "renderer/gbuffer.hpp"
#include "renderer/pipelines.hpp"

namespace nacre::renderer {

/// Reads irradiance, depth and material ids and writes an image like the scattered light's.
class CopyFloor {
public:
    CopyFloor(Gpu& gpu, GBuffer& gbuffer, Image& irradiance, const vk::raii::Sampler& nearest);

    void record(const vk::raii::CommandBuffer& commandBuffer) const;
    /// What one pass reads and writes.
    std::uint64_t bytes() const { return bytes_; }

private:
    Image copy_;
    std::uint64_t bytes_ = 0;
    ComputePass pass_;
};

} // namespace nacre::renderer
