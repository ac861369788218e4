#include "view/loop/reference_task.hpp"

#include "reference/reference.hpp"

#include <algorithm>
#include <chrono>

namespace nacre::view {
namespace {

constexpr std::uint32_t mostSamples = 4096;
constexpr std::chrono::seconds pictureInterval{1};
constexpr double sliceSeconds = 0.05; // between two looks at how far it is

Image pictureOf(const reference::Film& film) {
    Image image = makeImage(film.width, film.height, {"R", "G", "B"});
    auto value = image.values.begin();
    for (const reference::PixelSum& pixel : film.pixels) {
        const glm::dvec3 mean = pixel.mean();
        for (int channel = 0; channel < 3; ++channel) {
            *value++ = static_cast<float>(mean[channel]);
        }
    }
    return image;
}

} // namespace

ReferenceTask::ReferenceTask(scene::Scene scene, const scene::Camera& camera, std::uint32_t width, std::uint32_t height)
    : scene_(std::move(scene)),
      thread_([this, camera, width, height](const std::stop_token& cancel) { run(cancel, camera, width, height); }) {}

void ReferenceTask::run(const std::stop_token& cancel, const scene::Camera& camera, std::uint32_t width,
                        std::uint32_t height) {
    try {
        reference::Settings settings;
        settings.width = width;
        settings.height = height;
        settings.sliceSeconds = sliceSeconds;
        settings.cancel = cancel;
        // The window draws beside it.
        settings.threads = std::max(1u, std::thread::hardware_concurrency() / 2);
        reference::Reference reference(scene_, camera, settings);
        auto last = std::chrono::steady_clock::time_point{};
        std::uint32_t shown = 0;
        reference.run({.spp = mostSamples, .seconds = {}, .noise = {}}, [&](const reference::Progress& progress) {
            const auto now = std::chrono::steady_clock::now();
            const bool isNew = progress.spp > shown && now - last > pictureInterval;
            const std::scoped_lock lock(mutex_);
            state_.samples = progress.sppNow;
            state_.noise = progress.noise;
            if (isNew) {
                state_.light = pictureOf(reference.film());
                ++state_.version;
                shown = progress.spp;
                last = now;
            }
            return true;
        });
        if (!cancel.stop_requested()) {
            const std::scoped_lock lock(mutex_);
            state_.light = pictureOf(reference.film());
            ++state_.version;
        }
    } catch (const std::exception& error) {
        const std::scoped_lock lock(mutex_);
        state_.fault = error.what();
    }
}

ReferenceTask::State ReferenceTask::state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
}

std::uint64_t ReferenceTask::version() const {
    const std::scoped_lock lock(mutex_);
    return state_.version;
}

} // namespace nacre::view
