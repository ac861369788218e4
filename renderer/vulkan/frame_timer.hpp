// Timestamps between the passes of a frame. Internal to the renderer.
#pragma once

#include "nacre/nacre.h"
#include "renderer/frame_report.hpp"
#include "renderer/frame_settings.hpp"
#include "renderer/vulkan/open_device.hpp"

#include <span>
#include <utility>

namespace nacre::renderer {

/// Records timestamps into one frame's command buffer; read them when it has finished.
class FrameTimer {
public:
    explicit FrameTimer(const Gpu& gpu);

    /// Starts a frame, whose passes are timed if the frame's timing says so.
    void begin(const vk::raii::CommandBuffer& commandBuffer, Timing timing);
    /// Ends the pass that began at the last timestamp.
    void endPass(const vk::raii::CommandBuffer& commandBuffer, const std::string& name);
    /// A pass without timestamps inside, whatever `recorder` records.
    template <typename Recorder>
    void span(const vk::raii::CommandBuffer& commandBuffer, const std::string& name, const Recorder& recorder) {
        const Timing outer = std::exchange(timing_, Timing::Whole);
        recorder();
        timing_ = outer;
        endPass(commandBuffer, name);
    }
    /// Ends the frame.
    void end(const vk::raii::CommandBuffer& commandBuffer);
    /// Sets queries aside for passes that somebody else times: one before the first and one after each. The first pass
    /// counts from the timestamp before all of them, so that barriers belong to it; besides, Mesa's software device
    /// writes a timestamp late that a dispatch follows without a barrier.
    NacreTimestamps reserve(std::span<const char* const> passNames, const std::string& prefix);
    /// Fills the report's passes and total; leaves them empty while the device has not finished the frame.
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
    Timing timing_ = Timing::Passes;
    std::uint32_t queryCount_ = 0;
    std::vector<Pass> passes_;
};

} // namespace nacre::renderer
