#include "tests/gpu/timing/timing_options.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace nacre::tests {
namespace {

std::vector<NacreTechnique> parseTechniques(const std::string& names) {
    std::vector<NacreTechnique> result;
    std::istringstream list(names);
    for (std::string name; std::getline(list, name, ',');) {
        const std::vector<NacreTechnique> known = realTimeTechniques();
        const auto technique =
            std::ranges::find_if(known, [&](NacreTechnique each) { return name == nacreTechniqueString(each); });
        if (technique == known.end()) {
            throw std::runtime_error("--techniques has '" + name + "', must be names of real-time techniques");
        }
        result.push_back(*technique);
    }
    return result;
}

VkExtent2D parseSize(const std::string& text) {
    VkExtent2D extent{};
    int end = 0;
    if (std::sscanf(text.c_str(), "%5ux%5u%n", &extent.width, &extent.height, &end) != 2 || text[end] != '\0' ||
        extent.width == 0 || extent.height == 0) {
        throw std::runtime_error("--size is '" + text + "', must be WIDTHxHEIGHT");
    }
    return extent;
}

std::uint32_t parseRounds(const std::string& text) {
    const int rounds = std::atoi(text.c_str());
    if (rounds < 1) {
        throw std::runtime_error("--rounds is '" + text + "', must be 1 or more");
    }
    return static_cast<std::uint32_t>(rounds);
}

bool parseSwitch(const std::string& name, const std::string& text) {
    if (text != "on" && text != "off") {
        throw std::runtime_error(name + " is '" + text + "', must be on or off");
    }
    return text == "on";
}

std::optional<AlbedoUse> parseAlbedo(const std::string& text) {
    if (text == "post") {
        return AlbedoUse::Post;
    }
    if (text == "preAndPost") {
        return AlbedoUse::PreAndPost;
    }
    if (text != "off") {
        throw std::runtime_error("--albedo is '" + text + "', must be off, post or preAndPost");
    }
    return std::nullopt;
}

std::vector<VkBool32> parseSwitches(const std::string& name, const std::string& text) {
    if (text == "both") {
        return {VK_FALSE, VK_TRUE};
    }
    if (text != "on" && text != "off") {
        throw std::runtime_error(name + " is '" + text + "', must be on, off or both");
    }
    return {text == "on"};
}

} // namespace

const char* const timingUsage =
    R"(effect_timing: GPU times of the scatter techniques and of transmit, beside a copy pass

  --suite NAME          scenes, held-out, targets, footprint, layers, materials, transmit or all (all)
  --techniques A,B,...  of scenes and held-out (bank), footprint, layers and materials (all), in turn on every scene
  --size WIDTHxHEIGHT   px (1920x1080)
  --rounds N            of 20 steady repeats and 5 lone frames each (12)
  --shader-float16 X    on or off: half floats where the device has them (on)
  --skip-unscattered X  on, off or both: pixels without a material are left as they are (off)
  --albedo X            off, post or preAndPost: scatter is given 8-bit albedo, which materials use so (off)
  --csv FILE            where all figures go (effect_timing.csv)
)";

std::vector<NacreTechnique> realTimeTechniques() {
    std::vector<NacreTechnique> techniques{NACRE_TECHNIQUE_BANK};
    for (int i = 1; std::string(nacreTechniqueString(static_cast<NacreTechnique>(i))) != "unknown"; ++i) {
        if (i != NACRE_TECHNIQUE_BRUTE && i != NACRE_TECHNIQUE_BANK) {
            techniques.push_back(static_cast<NacreTechnique>(i));
        }
    }
    return techniques;
}

TimingOptions parseTimingOptions(std::span<char*> arguments) {
    TimingOptions options;
    for (std::size_t i = 1; i < arguments.size(); i += 2) {
        const std::string name = arguments[i];
        const std::string value = i + 1 < arguments.size() ? arguments[i + 1] : "";
        if (value.empty()) {
            throw std::runtime_error(name + " needs a value; --help lists the options");
        }
        if (name == "--suite") {
            options.suite = value;
        } else if (name == "--techniques") {
            options.techniques = parseTechniques(value);
        } else if (name == "--csv") {
            options.csv = value;
        } else if (name == "--rounds") {
            options.measure.rounds = parseRounds(value);
        } else if (name == "--shader-float16") {
            options.shaderFloat16 = parseSwitch(name, value);
        } else if (name == "--skip-unscattered") {
            options.skipUnscattered = parseSwitches(name, value);
        } else if (name == "--albedo") {
            options.albedo = parseAlbedo(value);
        } else if (name == "--size") {
            options.extent = parseSize(value);
        } else {
            throw std::runtime_error("unknown argument " + name + "; --help lists them");
        }
    }
    return options;
}

} // namespace nacre::tests
