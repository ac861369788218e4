// What `nacre bench effect` is asked to do.
#pragma once

#include "bench/effect/gpu_timing.hpp"
#include "nacre/material.hpp"
#include "nacre/nacre.h"

#include <optional>
#include <string_view>

namespace nacre::bench {

struct EffectTimingOptions {
    std::string suite = "all";              ///< one of effectSuiteNames
    VkExtent2D extent{1920, 1080};          ///< targets are measured at twice that, too
    std::vector<NacreTechnique> techniques; ///< none: what a suite measures usually
    GpuTimingSettings timing;
    bool halfFloats = true;                               ///< where the device has them
    std::vector<VkBool32> skipUnscattered{VK_FALSE};      ///< one after the other
    std::optional<AlbedoUse> albedo;                      ///< an image of it is given, and every material uses it so
    VkFormat lightFormat = VK_FORMAT_R16G16B16A16_SFLOAT; ///< of irradiance and scattered light
};

// What the options' values mean. Throw std::invalid_argument naming the option and the value.
std::vector<NacreTechnique> parseTechniques(const std::string& names);
bool parseHalfFloats(std::string_view text);
std::vector<VkBool32> parseSkipUnscattered(std::string_view text);
std::optional<AlbedoUse> parseAlbedo(std::string_view text);
VkFormat parseLightFormat(std::string_view text);

} // namespace nacre::bench
