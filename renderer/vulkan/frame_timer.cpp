#include "renderer/vulkan/frame_timer.hpp"

namespace nacre::renderer {
namespace {

constexpr std::uint32_t maxQueries = 128;

} // namespace

FrameTimer::FrameTimer(const Gpu& gpu)
    : microsecondsPerTick_(static_cast<double>(gpu.limits.timestampPeriod) / 1000.0) {
    const std::uint32_t bits = gpu.physicalDevice.getQueueFamilyProperties()[gpu.queueFamily].timestampValidBits;
    validBits_ = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    pool_ = vk::raii::QueryPool(gpu.device, {.queryType = vk::QueryType::eTimestamp, .queryCount = maxQueries});
}

void FrameTimer::begin(const vk::raii::CommandBuffer& commandBuffer, Timing timing) {
    timing_ = timing;
    queryCount_ = 0;
    passes_.clear();
    commandBuffer.resetQueryPool(*pool_, 0, maxQueries);
    writeTimestamp(commandBuffer);
}

void FrameTimer::endPass(const vk::raii::CommandBuffer& commandBuffer, const std::string& name) {
    if (timing_ == Timing::Passes) {
        passes_.push_back({name, queryCount_ - 1, queryCount_});
        writeTimestamp(commandBuffer);
    }
}

void FrameTimer::end(const vk::raii::CommandBuffer& commandBuffer) {
    if (timing_ == Timing::Whole) {
        writeTimestamp(commandBuffer);
    }
}

NacreTimestamps FrameTimer::reserve(std::span<const char* const> passNames, const std::string& prefix) {
    if (timing_ == Timing::Whole) {
        return {};
    }
    const std::uint32_t first = queryCount_;
    for (const char* name : passNames) {
        const std::uint32_t begin = queryCount_ == first ? first - 1 : queryCount_;
        passes_.push_back({prefix + name, begin, ++queryCount_});
    }
    ++queryCount_;
    if (queryCount_ > maxQueries) {
        throw RendererError("a frame has more passes than can be timed");
    }
    return {*pool_, first};
}

void FrameTimer::writeTimestamp(const vk::raii::CommandBuffer& commandBuffer) {
    if (queryCount_ >= maxQueries) {
        throw RendererError("a frame has more passes than can be timed");
    }
    commandBuffer.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_, queryCount_++);
}

void FrameTimer::read(FrameReport& report) const {
    report.passes.clear();
    if (queryCount_ == 0) {
        return;
    }
    const auto [result, ticks] = pool_.getResults<std::uint64_t>(0, queryCount_, queryCount_ * sizeof(std::uint64_t),
                                                                 sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
    if (result != vk::Result::eSuccess || validBits_ == 0) {
        return;
    }
    const auto time = [&, &values = ticks](std::uint32_t from, std::uint32_t to) {
        return static_cast<double>((values[to] - values[from]) & validBits_) * microsecondsPerTick_;
    };
    for (const Pass& pass : passes_) {
        report.passes.push_back({pass.name, time(pass.firstQuery, pass.lastQuery)});
    }
    report.totalMicroseconds = time(0, queryCount_ - 1);
}

} // namespace nacre::renderer
