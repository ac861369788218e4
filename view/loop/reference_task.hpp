// A reference that is computed beside the window.
#pragma once

#include "image/image.hpp"
#include "scene/scene.hpp"

#include <mutex>
#include <string>
#include <thread>

namespace nacre::view {

/// Computes the surface integral of a scene's materials on a thread of its own, until the task is destroyed.
class ReferenceTask {
public:
    ReferenceTask(scene::Scene scene, const scene::Camera& camera, std::uint32_t width, std::uint32_t height);
    struct State {
        Image light;               ///< R G B radiance; empty before the first sample of every pixel
        double samples = 0;        ///< of every pixel, on average
        double noise = 0;          ///< relative standard error; infinite below 2 samples
        std::string fault;         ///< what went wrong, or nothing
        std::uint64_t version = 0; ///< grows with every new picture
    };
    State state() const;
    /// State::version without the picture.
    std::uint64_t version() const;

private:
    void run(const std::stop_token& cancel, const scene::Camera& camera, std::uint32_t width, std::uint32_t height);

    scene::Scene scene_;
    mutable std::mutex mutex_;
    State state_;
    std::jthread thread_; // asked to stop, and joined, before the rest goes
};

} // namespace nacre::view
