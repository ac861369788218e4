#include "view/loop/headless.hpp"

#include "image/image_file.hpp"
#include "view/loop/picture_loop.hpp"
#include "view/model/camera_control.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <malloc.h>
#include <numbers>
#include <thread>

namespace nacre::view {
namespace {

constexpr std::uint32_t warmUpFrames = 3; // shadow maps, and what drivers do at first
constexpr std::uint32_t earlyFrame = 100; // memory is looked at here for the first time
constexpr float wholeTurn = 2 * std::numbers::pi_v<float>;
constexpr std::chrono::microseconds pause{50}; // until a busy device is asked again

bool isEffect(const std::string& pass) {
    return pass.starts_with("scatter") || pass.starts_with("transmit");
}

double effectMillisecondsOf(const renderer::FrameReport& report) {
    double sum = 0;
    for (const renderer::PassTime& pass : report.passes) {
        sum += isEffect(pass.name) ? pass.microseconds / 1e3 : 0;
    }
    return sum;
}

/// Every light turned about the vertical.
std::vector<scene::Light> turnedLights(const std::vector<scene::Light>& lights, float angle) {
    std::vector<scene::Light> result = lights;
    const auto turned = [angle](const glm::vec3& v) {
        return glm::vec3(std::cos(angle) * v.x + std::sin(angle) * v.z, v.y,
                         -std::sin(angle) * v.x + std::cos(angle) * v.z);
    };
    for (scene::Light& light : result) {
        light.direction = turned(light.direction);
        light.position = turned(light.position);
    }
    return result;
}

void drawOne(PictureLoop& loop) {
    while (loop.step() == Step::Busy) {
        std::this_thread::sleep_for(pause);
    }
}

LoopSettings loopSettings(std::uint32_t width, std::uint32_t height, std::uint32_t shadowMapSize) {
    LoopSettings settings;
    settings.width = width;
    settings.height = height;
    settings.shadowMapSize = shadowMapSize;
    settings.thickness = false;
    settings.tolerableMilliseconds = std::numeric_limits<double>::infinity();
    return settings;
}

/// Times of all frames of a run, with room for them from the start: they are no growth.
struct Times {
    explicit Times(std::size_t count) {
        for (std::vector<double>* values : {&frame, &effect, &processor, &interval}) {
            values->reserve(count);
        }
    }

    std::vector<double> frame;
    std::vector<double> effect;
    std::vector<double> processor;
    std::vector<double> interval;
    std::vector<std::pair<std::string, std::vector<double>>> passes;

    void add(const renderer::FrameReport& report) {
        frame.push_back(report.totalMicroseconds / 1e3);
        effect.push_back(effectMillisecondsOf(report));
        for (std::size_t i = 0; i < report.passes.size(); ++i) {
            if (i >= passes.size()) {
                passes.push_back({report.passes[i].name, {}});
                passes.back().second.reserve(frame.capacity());
            }
            passes[i].second.push_back(report.passes[i].microseconds / 1e3);
        }
    }
};

} // namespace

Distribution distributionOf(std::vector<double> values) {
    if (values.empty()) {
        return {};
    }
    std::ranges::sort(values);
    const auto at = [&](double share) {
        const auto place = static_cast<std::size_t>(std::ceil(share * double(values.size())));
        return values[std::clamp<std::size_t>(place, 1, values.size()) - 1];
    };
    return {at(0.5), at(0.99)};
}

std::int64_t heapBytes() {
    const auto counts = mallinfo2();
    return static_cast<std::int64_t>(counts.uordblks + counts.hblkhd);
}

HeadlessRun runHeadless(renderer::Device& device, const scene::Scene& scene, const HeadlessSettings& settings,
                        Moving moving) {
    LoopSettings forLoop = loopSettings(settings.width, settings.height, settings.shadowMapSize);
    forLoop.restartEveryFrame = true;
    PictureLoop loop(device, scene, forLoop);
    Times times(settings.frames);
    scene::Camera camera = scene.cameras.at(0);
    std::vector<Material> materials = scene.materials;
    const auto draw = [&](std::uint32_t frame) {
        orbit(camera, {wholeTurn / static_cast<float>(settings.frames), 0});
        loop.setCamera(camera);
        const auto begin = std::chrono::steady_clock::now();
        const float angle = wholeTurn * static_cast<float>(frame) / static_cast<float>(settings.frames);
        if (moving == Moving::Lights) {
            loop.setLights(turnedLights(scene.lights, angle));
        } else if (moving == Moving::Material && !materials.empty()) {
            materials[0].scale = scene.materials[0].scale * (1.5 + 0.5 * std::sin(angle));
            loop.setMaterials(materials);
        }
        const std::chrono::duration<double, std::milli> changing = std::chrono::steady_clock::now() - begin;
        drawOne(loop);
        return changing.count();
    };
    for (std::uint32_t frame = 0; frame < warmUpFrames; ++frame) {
        draw(frame);
    }
    loop.wait();
    loop.onFinished = [&](const renderer::FrameReport& report) { times.add(report); };
    auto last = std::chrono::steady_clock::now();
    HeadlessRun run;
    run.memoryFrame = std::min(earlyFrame, settings.frames / 2);
    const std::uint64_t allocations = device.implementation().allocations;
    const std::uint64_t waits = loop.waits();
    for (std::uint32_t frame = 0; frame < settings.frames; ++frame) {
        const double changing = draw(frame + warmUpFrames);
        times.processor.push_back(changing + loop.stepMilliseconds());
        const auto now = std::chrono::steady_clock::now();
        times.interval.push_back(std::chrono::duration<double, std::milli>(now - last).count());
        last = now;
        run.memory = frame == run.memoryFrame ? heapBytes() : run.memory;
    }
    run.memoryAtEnd = heapBytes();
    run.deviceAllocations = device.implementation().allocations - allocations;
    run.waits = loop.waits() - waits;
    loop.wait();
    run.frame = distributionOf(times.frame);
    run.effect = distributionOf(times.effect);
    run.processor = distributionOf(times.processor);
    run.interval = distributionOf(times.interval);
    for (const auto& [name, values] : times.passes) {
        run.passes.emplace_back(name, distributionOf(values).median);
    }
    return run;
}

void drawTurntable(renderer::Device& device, const scene::Scene& scene, const TurntableSettings& settings) {
    std::filesystem::create_directories(settings.folder);
    LoopSettings forLoop = loopSettings(settings.width, settings.height, settings.shadowMapSize);
    forLoop.stillSamples = settings.samples;
    PictureLoop loop(device, scene, forLoop);
    for (std::uint32_t frame = settings.first; frame <= settings.last; ++frame) {
        scene::Camera camera = scene.cameras.at(0);
        orbit(camera, {wholeTurn * static_cast<float>(frame) / static_cast<float>(settings.count), 0});
        loop.setCamera(camera);
        while (!loop.isConverged()) {
            drawOne(loop);
        }
        std::array<char, 16> name{};
        std::snprintf(name.data(), name.size(), "%04u.png", frame);
        writePng(settings.folder / name.data(), loop.read(0).shown);
    }
}

} // namespace nacre::view
