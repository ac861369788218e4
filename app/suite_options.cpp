#include "app/suite_options.hpp"

#include "app/command.hpp"

#include <CLI/CLI.hpp>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace nacre::app {

namespace {

constexpr std::uint32_t leastSide = 16; // fewer pixels tell nothing
constexpr double defaultNoise = 1;      // [%]
constexpr const char* group = "Suite";

template <typename Item> std::string namesOf(const std::vector<Item>& items) {
    std::string result;
    for (const Item& item : items) {
        result += (result.empty() ? "" : ", ") + item.name;
    }
    return result;
}

bool matches(const std::string& name, const std::string& pattern) {
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// Those of `all` that one of the patterns matches, in their own order; all where there is no pattern.
template <typename Item>
std::vector<Item> matching(std::vector<Item> all, const std::vector<std::string>& patterns, const std::string& option) {
    if (patterns.empty()) {
        return all;
    }
    for (const std::string& pattern : patterns) {
        if (std::ranges::none_of(all, [&](const Item& item) { return matches(item.name, pattern); })) {
            throw UsageError(option + " '" + pattern + "' is none of " + namesOf(all));
        }
    }
    std::erase_if(all, [&](const Item& item) {
        return std::ranges::none_of(patterns, [&](const std::string& pattern) { return matches(item.name, pattern); });
    });
    return all;
}

struct NamedMethod {
    std::string name;
    reference::Method method;
};

} // namespace

AccuracySuiteParser::AccuracySuiteParser(CLI::App& command) {
    CLI::Option* suite =
        command.add_flag("--suite", suite_, "Hold every technique against references on a fixed set of views");
    suite->group(group);
    const auto add = [&](const char* name, auto& value, const std::string& description, const char* type) {
        command.add_option(name, value, description)
            ->type_name(type)
            ->group(group)
            ->allow_extra_args(false)
            ->needs(suite);
    };
    command.add_flag("--list", options_.list, "Say which views, techniques and references there are, and end")
        ->group(group)
        ->needs(suite);
    add("-o,--output", options_.output, "Where the results go; default " + options_.output.string(), "FOLDER");
    add("--cache", options_.plan.store, "Where references are kept for the next run; default OUTPUT/references",
        "FOLDER");
    add("--view", views_, "Only the views of this name, which may have * and ?; may be repeated", "PATTERN");
    add("--technique", techniques_, "Only the techniques of this name; likewise", "PATTERN");
    add("--reference", references_, "Only surface (the surface integral) or walk (the random walk)", "NAME");
    add("--model", models_, "A model or scene file to look at besides; may be repeated", "FILE");
    add("--size", size_, "Pixels; default " + size_, "WxH");
    add("--spp", spp_, "Samples of every pixel of a reference", "N");
    add("--time", seconds_, "Time for each reference", "SECONDS");
    add("--noise", noise_, "Until a reference's noise is below this; default 1 where neither --spp nor --time is given",
        "PERCENT");
    add("--device", options_.device.name, "Number or part of the name, see `nacre devices`", "DEVICE");
}

std::vector<bench::AccuracyViewEntry> AccuracySuiteParser::chooseViews() const {
    std::vector<bench::AccuracyViewEntry> views = bench::accuracyViews();
    for (const std::filesystem::path& model : models_) {
        std::ranges::move(bench::accuracyViewsOf(model), std::back_inserter(views));
    }
    return matching(std::move(views), views_, "--view");
}

AccuracySuiteOptions AccuracySuiteParser::finish() const {
    AccuracySuiteOptions options = options_;
    bench::AccuracyPlan& plan = options.plan;
    plan.views = chooseViews();
    plan.techniques = matching(bench::accuracyTechniques(), techniques_, "--technique");
    const std::vector<NamedMethod> methods{{"surface", reference::Method::Surface}, {"walk", reference::Method::Walk}};
    std::ranges::transform(matching(methods, references_, "--reference"), std::back_inserter(plan.references),
                           &NamedMethod::method);
    const PictureSize size = parseSize(size_);
    if (size.width < leastSide || size.height < leastSide) {
        throw UsageError("--size '" + size_ + "' is smaller than " + std::to_string(leastSide) + 'x' +
                         std::to_string(leastSide) + ", from which little can be told");
    }
    plan.size = {size.width, size.height};
    if (spp_) {
        requireRange(*spp_, 2, 1e9, "--spp");
    }
    if (seconds_) {
        requireRange(*seconds_, 1e-3, 1e9, "--time");
    }
    if (noise_) {
        requireRange(*noise_, 1e-4, 100, "--noise");
    }
    plan.stop.spp = spp_;
    plan.stop.seconds = seconds_;
    plan.stop.noise = noise_ ? std::optional(*noise_ / 100) : std::nullopt;
    if (!spp_ && !seconds_ && !noise_) {
        plan.stop.noise = defaultNoise / 100;
    }
    if (plan.store.empty()) {
        plan.store = options.output / "references";
    }
    return options;
}

} // namespace nacre::app
