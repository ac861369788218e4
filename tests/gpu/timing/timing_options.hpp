// What effect_timing is asked to do.
#pragma once

#include "nacre/material.hpp"
#include "nacre/nacre.h"
#include "tests/gpu/timing/measure.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nacre::tests {

struct TimingOptions {
    std::string suite = "all";
    std::string csv = "effect_timing.csv";
    VkExtent2D extent{1920, 1080};          // targets are measured at twice that, too
    std::vector<NacreTechnique> techniques; // none: what a suite measures usually
    MeasureSettings measure;
    bool shaderFloat16 = true;                       // where the device has it
    std::vector<VkBool32> skipUnscattered{VK_FALSE}; // one after the other
    std::optional<AlbedoUse> albedo;                 // an image of it is given, and every material uses it so
};

/// What --help says.
extern const char* const timingUsage;

/// All but `brute`; `bank` first.
std::vector<NacreTechnique> realTimeTechniques();

/// The program's name, then options with their values. Throws std::runtime_error naming the one that is wrong.
TimingOptions parseTimingOptions(std::span<char*> arguments);

} // namespace nacre::tests
