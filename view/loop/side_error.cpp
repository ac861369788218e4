#include "view/loop/side_error.hpp"

#include "image/false_color.hpp"
#include "image/flip.hpp"
#include "image/metrics.hpp"

#include <chrono>

namespace nacre::view {

SideError measureSides(const SidePair& pair) {
    SideError result;
    result.psnr = errors(toEncoding(pair.first, Encoding::Srgb), toEncoding(pair.second, Encoding::Srgb)).psnr(1);
    const Image map = flip(pair.first, pair.second);
    result.flip = mean(map);
    result.map = heatMap(map);
    if (!pair.firstLight.values.empty() && !pair.secondLight.values.empty()) {
        const std::vector<ErrorSums> channels = channelErrors(pair.firstLight, pair.secondLight);
        result.energyRatio = {channels[0].energyRatio(), channels[1].energyRatio(), channels[2].energyRatio()};
    }
    return result;
}

void SideErrorTask::begin(SidePair pair) {
    if (isBusy()) {
        next_ = std::move(pair);
        return;
    }
    running_ = std::async(std::launch::async, [held = std::move(pair)] { return measureSides(held); });
}

std::optional<SideError> SideErrorTask::take() {
    if (!isBusy() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return std::nullopt;
    }
    SideError result = running_.get();
    if (next_) {
        begin(*std::exchange(next_, std::nullopt));
    }
    return result;
}

} // namespace nacre::view
