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

/// Times of all frames of a run.
struct Times {
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
    Times times;
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
    std::int64_t memory = 0;
    for (std::uint32_t frame = 0; frame < settings.frames; ++frame) {
        const double changing = draw(frame + warmUpFrames);
        times.processor.push_back(changing + loop.stepMilliseconds());
        const auto now = std::chrono::steady_clock::now();
        times.interval.push_back(std::chrono::duration<double, std::milli>(now - last).count());
        last = now;
        memory = frame == settings.frames / 2 ? heapBytes() : memory;
    }
    loop.wait();
    HeadlessRun run{distributionOf(times.frame),
                    distributionOf(times.effect),
                    distributionOf(times.processor),
                    distributionOf(times.interval),
                    {},
                    heapBytes() - memory};
    for (const auto& [name, values] : times.passes) {
        run.passes.emplace_back(name, distributionOf(values).median);
    }
    return run;
}

void printHeadless(std::ostream& out, renderer::Device& device, const scene::Scene& scene,
                   const HeadlessSettings& settings) {
    out << settings.width << 'x' << settings.height << ", " << settings.frames << " frames on "
        << device.description().name << ", ms\n";
    const auto row = [&](const std::string& name, const Distribution& times) {
        std::array<char, 128> text{};
        std::snprintf(text.data(), text.size(), "  %-28s median %9.3f   p99 %9.3f\n", name.c_str(), times.median,
                      times.p99);
        out << text.data();
    };
    for (const auto& [moving, title] :
         {std::pair(Moving::Nothing, "lights still"), std::pair(Moving::Lights, "lights moving"),
          std::pair(Moving::Material, "material changing")}) {
        const HeadlessRun run = runHeadless(device, scene, settings, moving);
        out << title << '\n';
        row("frame, device", run.frame);
        row("scatter and transmit, device", run.effect);
        row("frame, processor", run.processor);
        row("frame to frame", run.interval);
        out << "  growth of memory             " << run.memoryGrowth / 1024 << " KiB\n";
        for (const auto& [name, median] : run.passes) {
            std::array<char, 128> text{};
            std::snprintf(text.data(), text.size(), "    %-36s %9.3f\n", name.c_str(), median);
            out << text.data();
        }
    }
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
