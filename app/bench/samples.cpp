#include "app/bench/samples.hpp"

#include <algorithm>

namespace nacre::bench {
namespace {

constexpr const char* copyPass = "copy";

bool isEffect(const std::string& pass) {
    return pass.starts_with("scatter: ") || pass.starts_with("transmit: ");
}

} // namespace

void Samples::add(const renderer::FrameReport& report, bool wholeFrame) {
    double effect = 0;
    double sum = 0;
    for (const renderer::PassTime& pass : report.passes) {
        const auto known =
            std::find_if(passes_.begin(), passes_.end(), [&](const Pass& other) { return other.name == pass.name; });
        Pass& target = known == passes_.end() ? passes_.emplace_back(Pass{pass.name, {}}) : *known;
        target.times.push_back(pass.microseconds);
        effect += isEffect(pass.name) ? pass.microseconds : 0;
        sum += pass.microseconds;
        if (pass.name == copyPass) {
            copy_.push_back(pass.microseconds);
        }
    }
    effect_.push_back(effect);
    if (!wholeFrame) {
        return;
    }
    // The copy is no part of a frame but of its measurement.
    const double copy = copy_.empty() ? 0 : copy_.back();
    frame_.push_back(report.totalMicroseconds - copy);
    passShares_.push_back((sum - copy) / (report.totalMicroseconds - copy));
    recording_.push_back(report.recordingMicroseconds);
    last_ = report;
}

void Samples::fill(Measurement& measurement) const {
    measurement.frame = summarize(frame_);
    measurement.effect = summarize(effect_);
    measurement.copy = summarize(copy_);
    measurement.recording = summarize(recording_);
    measurement.passShare = summarize(passShares_).median;
    for (const Pass& pass : passes_) {
        if (pass.name != copyPass) {
            measurement.passes.push_back({pass.name, summarize(pass.times)});
        }
    }
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
