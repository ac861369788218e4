// The physical floor of scattering: a pass that only moves the bytes. Internal to the renderer and the
// benchmark.
#pragma once

#include "renderer/vulkan/compute_pass.hpp"

namespace nacre::renderer {

/// Reads irradiance, depth and material ids and writes an image like the scattered light's.
class CopyFloor {
public:
    /// The images that scattering must read, all of one size.
    struct Inputs {
        Image& irradiance;
        Image& depth;
        Image& materialId;
    };
    CopyFloor(Gpu& gpu, const Inputs& inputs, const vk::raii::Sampler& nearest);

    void record(const vk::raii::CommandBuffer& commandBuffer) const;
    template <typename Action> void forEachImage(const Action& action) { action(copy_); }
    /// What one pass reads and writes.
    std::uint64_t bytes() const { return bytes_; }

private:
    Image copy_;
    std::uint64_t bytes_ = 0;
    ComputePass pass_;
};

} // namespace nacre::renderer
