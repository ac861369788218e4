#include "bench/suites/frame_samples.hpp"

#include <algorithm>

namespace nacre::bench {
namespace {

constexpr const char* copyPass = "copy";

} // namespace

void Samples::Passes::add(const renderer::FrameReport& report) {
    for (const renderer::PassTime& time : report.passes) {
        const auto known =
            std::find_if(passes.begin(), passes.end(), [&](const Pass& other) { return other.name == time.name; });
        Pass& target = known == passes.end() ? passes.emplace_back(Pass{time.name, {}}) : *known;
        target.times.push_back(time.microseconds);
    }
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
    effect_.push_back(report.effectMicroseconds);
    copy_.push_back(report.copyMicroseconds);
}

void Samples::fill(Measurement& measurement) const {
    measurement.frame = summarize(frame_);
    measurement.effect = effect();
    measurement.copy = summarize(copy_);
    measurement.recording = summarize(recording_);
    double sum = 0;
    for (const Pass& pass : inFrame_.passes) {
        if (pass.name == copyPass) {
            continue;
        }
        const Pass* alone = alone_.find(pass.name);
        measurement.passes.push_back({pass.name, summarize(alone == nullptr ? pass.times : alone->times)});
        sum += summarize(pass.times).median;
    }
    measurement.passShare = ratioOf(sum, measurement.frame.median);
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
