// Timestamps between the passes of a frame. Internal to the renderer.
#pragma once

#include "renderer/device_internal.hpp"
#include "renderer/renderer.hpp"

#include <span>

namespace nacre::renderer {

/// Records timestamps into one frame's command buffer; read them when it has finished.
class FrameTimer {
public:
    explicit FrameTimer(const Gpu& gpu);

    void begin(const vk::raii::CommandBuffer& commandBuffer);
    /// Ends the pass that began at the last timestamp.
    void endPass(const vk::raii::CommandBuffer& commandBuffer, const std::string& name);
    vk::QueryPool pool() const { return *pool_; }
    /// Sets queries aside for passes that somebody else times: one before the first and one after each. The first pass
    /// counts from the timestamp before all of them, so that barriers belong to it; besides, Mesa's software device
    /// writes a timestamp late that a dispatch follows without a barrier.
    std::uint32_t reserve(std::span<const char* const> passNames, const std::string& prefix);
    /// Fills the report's passes and total.
    void read(FrameReport& report) const;

private:
    struct Pass {
        std::string name;
        std::uint32_t firstQuery;
        std::uint32_t lastQuery;
    };

    void writeTimestamp(const vk::raii::CommandBuffer& commandBuffer);

    double microsecondsPerTick_ = 0;
    std::uint64_t validBits_ = 0;
    vk::raii::QueryPool pool_ = nullptr;
    std::uint32_t queryCount_ = 0;
    std::vector<Pass> passes_;
};

} // namespace nacre::renderer
