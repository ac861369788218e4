// What the frames of one configuration took.
#pragma once

#include "app/bench/results.hpp"
#include "renderer/renderer.hpp"

namespace nacre::bench {

/// Collects frame reports of one configuration and summarises them.
class Samples {
public:
    /// A whole frame, or the effect alone.
    void add(const renderer::FrameReport& report, bool wholeFrame);

    /// Fills the times, pass shares, sizes and memory of a measurement. There must have been a whole frame.
    void fill(Measurement& measurement) const;
    Summary effect() const { return summarize(effect_); }

private:
    struct Pass {
        std::string name;
        std::vector<double> times;
    };

    renderer::FrameReport last_; ///< of a whole frame
    std::vector<double> frame_;
    std::vector<double> effect_;
    std::vector<double> copy_;
    std::vector<double> recording_;
    std::vector<double> passShares_;
    std::vector<Pass> passes_;
};

} // namespace nacre::bench
