// What the frames of one configuration took.
#pragma once

#include "bench/results/results.hpp"
#include "renderer/offscreen.hpp"

namespace nacre::bench {

/// Collects frame reports of one configuration and summarises them.
class Samples {
public:
    /// A frame with a timestamp around every pass.
    void addPasses(const renderer::FrameReport& report);
    /// A frame with timestamps around the whole.
    void addWhole(const renderer::FrameReport& report);
    /// The effect alone, on the images of a frame.
    void addEffect(const renderer::FrameReport& report);

    /// Fills the times, pass shares, sizes and memory of a measurement. There must have been a frame of either kind.
    void fill(Measurement& measurement) const;
    /// Of the effect alone, without timestamps inside.
    Summary effect() const { return summarize(effect_); }

private:
    struct Pass {
        std::string name;
        std::vector<double> times;
    };
    struct Passes {
        std::vector<Pass> passes; ///< in order of execution

        void add(const renderer::FrameReport& report);
        const Pass* find(const std::string& name) const;
    };

    renderer::FrameReport last_; ///< of a frame
    Passes inFrame_;
    Passes alone_;
    std::vector<double> effect_;
    std::vector<double> copy_;
    std::vector<double> frame_;
    std::vector<double> recording_;
};

} // namespace nacre::bench
