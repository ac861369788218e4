#include "bench/effect/effect_options.hpp"

#include "bench/techniques.hpp"

#include <algorithm>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace nacre::bench {
namespace {

template <typename Value> using Choice = std::pair<std::string_view, Value>;

/// The value of the choice called `text`.
template <typename Value, std::size_t count>
Value choose(std::string_view option, std::string_view text, const Choice<Value> (&choices)[count]) {
    std::string names;
    for (const auto& [name, value] : choices) {
        if (name == text) {
            return value;
        }
        names += (names.empty() ? "" : ", ") + std::string(name);
    }
    throw std::invalid_argument(std::string(option) + " is '" + std::string(text) + "', must be one of " + names);
}

} // namespace

std::vector<NacreTechnique> parseTechniques(const std::string& names) {
    std::vector<NacreTechnique> result;
    const std::vector<NacreTechnique> known = realTimeTechniques();
    std::istringstream list(names);
    for (std::string name; std::getline(list, name, ',');) {
        const auto technique =
            std::ranges::find_if(known, [&](NacreTechnique each) { return name == nacreTechniqueString(each); });
        if (technique == known.end()) {
            std::string all;
            for (const NacreTechnique each : known) {
                all += (all.empty() ? "" : ", ") + std::string(nacreTechniqueString(each));
            }
            throw std::invalid_argument("--techniques has '" + name + "', must be names of " + all);
        }
        result.push_back(*technique);
    }
    return result;
}

bool parseHalfFloats(std::string_view text) {
    return choose<bool>("--shader-float16", text, {{"on", true}, {"off", false}});
}

std::vector<VkBool32> parseSkipUnscattered(std::string_view text) {
    const int which = choose<int>("--skip-unscattered", text, {{"off", 0}, {"on", 1}, {"both", 2}});
    return which == 2 ? std::vector<VkBool32>{VK_FALSE, VK_TRUE} : std::vector<VkBool32>{which == 1};
}

std::optional<AlbedoUse> parseAlbedo(std::string_view text) {
    return choose<std::optional<AlbedoUse>>(
        "--albedo", text, {{"off", std::nullopt}, {"post", AlbedoUse::Post}, {"preAndPost", AlbedoUse::PreAndPost}});
}

VkFormat parseLightFormat(std::string_view text) {
    return choose<VkFormat>("--light-format", text,
                            {{"half", VK_FORMAT_R16G16B16A16_SFLOAT}, {"packed", VK_FORMAT_B10G11R11_UFLOAT_PACK32}});
}

} // namespace nacre::bench
