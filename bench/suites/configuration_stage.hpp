// The renderers that a series needs, and who uses them last.
#pragma once

#include "bench/suites/suite_plan.hpp"

#include <map>

namespace nacre::bench {

/// Most repetitions of an effect, one after the other, whose mean is one measured time.
inline constexpr std::uint32_t mostRepetitions = 20;

/// Renders configurations; those of one view and size share a renderer.
class Stage {
public:
    explicit Stage(renderer::Device& device) : device_(device) {}

    /// Makes the configuration, which must outlive its being selected, the one that is rendered.
    void select(const Configuration& configuration);
    /// Renders the selected configuration.
    const renderer::FrameReport& renderFrame(renderer::Timing timing = renderer::Timing::Passes);
    /// Repeats the effect on its renderer's last frame (Offscreen::renderEffect), and renders one before where there is
    /// none yet.
    const renderer::FrameReport& renderEffect(std::uint32_t repetitions = 0);
    renderer::Pixels read(renderer::Output output) const { return actor_->renderer.read(output); }

private:
    struct Actor {
        renderer::Offscreen renderer;
        const Configuration* configuration = nullptr;
        bool rendered = false;
    };
    using Key = std::tuple<const View*, std::uint32_t, std::uint32_t, std::uint32_t>;

    renderer::Device& device_;
    std::map<Key, Actor> actors_;
    Actor* actor_ = nullptr;
    const Configuration* selected_ = nullptr;
};

} // namespace nacre::bench
