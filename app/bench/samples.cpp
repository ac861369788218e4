#include "app/bench/samples.hpp"

#include <algorithm>

namespace nacre::bench {
namespace {

constexpr const char* copyPass = "copy";

bool isEffect(const std::string& pass) {
    return pass.starts_with("scatter: ") || pass.starts_with("transmit: ");
}

} // namespace

void Samples::Passes::add(const renderer::FrameReport& report) {
    double sum = 0;
    for (const renderer::PassTime& time : report.passes) {
        const auto known =
            std::find_if(passes.begin(), passes.end(), [&](const Pass& other) { return other.name == time.name; });
        Pass& target = known == passes.end() ? passes.emplace_back(Pass{time.name, {}}) : *known;
        target.times.push_back(time.microseconds);
        sum += isEffect(time.name) ? time.microseconds : 0;
    }
    effect.push_back(sum);
}

const Samples::Pass* Samples::Passes::find(const std::string& name) const {
    const auto pass = std::find_if(passes.begin(), passes.end(), [&](const Pass& other) { return other.name == name; });
    return pass == passes.end() ? nullptr : &*pass;
}

void Samples::addPasses(const renderer::FrameReport& report) {
    inFrame_.add(report);
    last_ = report;
}

void Samples::addWhole(const renderer::FrameReport& report) {
    frame_.push_back(report.totalMicroseconds);
    recording_.push_back(report.recordingMicroseconds);
}

void Samples::addEffect(const renderer::FrameReport& report) {
    alone_.add(report);
}

Summary Samples::effect() const {
    return summarize(effectSource().effect);
}

void Samples::fill(Measurement& measurement) const {
    measurement.frame = summarize(frame_);
    measurement.effect = effect();
    measurement.recording = summarize(recording_);
    double sum = 0;
    for (const Pass& pass : inFrame_.passes) {
        const Pass* alone = alone_.find(pass.name);
        const Summary time = summarize(alone == nullptr ? pass.times : alone->times);
        if (pass.name == copyPass) {
            measurement.copy = time;
        } else {
            measurement.passes.push_back({pass.name, time});
            sum += summarize(pass.times).median;
        }
    }
    measurement.passShare = sum / measurement.frame.median;
    for (const renderer::MemoryUse& use : last_.memory) {
        measurement.memory.push_back({use.name, use.bytes});
    }
    measurement.copyBytes = last_.copyBytes;
    measurement.coverage = last_.subsurfaceCoverage;
    measurement.triangles = last_.triangles;
    measurement.lights = last_.lights;
    measurement.materials = last_.materials;
    measurement.dispatches = last_.scatterDispatches + last_.transmitDispatches;
}

} // namespace nacre::bench
