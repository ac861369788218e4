#include "app/render_options.hpp"

#include "app/command.hpp"
#include "app/material_source.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace nacre::app {

namespace {

using renderer::Output;

template <typename Value> struct Named {
    std::string_view name;
    Value value;
};

/// What --technique takes.
std::vector<Named<NacreTechnique>> techniques() {
    std::uint32_t count = 0;
    nacreGetTechniques(&count, nullptr);
    std::vector<NacreTechnique> all(count);
    nacreGetTechniques(&count, all.data());
    all.insert(all.begin(), NACRE_TECHNIQUE_DEFAULT);
    std::vector<Named<NacreTechnique>> named;
    for (const NacreTechnique technique : all) {
        named.push_back({nacreTechniqueString(technique), technique});
    }
    return named;
}

constexpr std::array aovs{
    Named<Output>{"irradiance", Output::Irradiance},   Named<Output>{"scattered", Output::Scattered},
    Named<Output>{"transmitted", Output::Transmitted}, Named<Output>{"depth", Output::Depth},
    Named<Output>{"normal", Output::Normal},           Named<Output>{"material", Output::Material},
    Named<Output>{"thickness", Output::Thickness},     Named<Output>{"albedo", Output::Albedo},
    Named<Output>{"specular", Output::Specular},
};

constexpr double maxExposure = 32;
constexpr std::uint32_t minShadowMapSize = 16;
constexpr std::uint32_t maxShadowMapSize = 16384;

template <typename Table> std::string names(const Table& table) {
    std::string result;
    for (const auto& entry : table) {
        result += (result.empty() ? "" : ", ") + std::string(entry.name);
    }
    return result;
}

template <typename Table> auto find(const Table& table, std::string_view name, const std::string& kind) {
    const auto entry = std::ranges::find(table, name, &Table::value_type::name);
    if (entry == table.end()) {
        throw UsageError("there is no " + kind + " '" + std::string(name) + "', only " + names(table));
    }
    return entry->value;
}

AovOutput parseAov(const std::string& text) {
    const std::size_t separator = text.find('=');
    if (separator == std::string::npos) {
        throw UsageError("--aov '" + text + "' is not NAME=FILE.exr");
    }
    const std::string name = text.substr(0, separator);
    const std::filesystem::path file = text.substr(separator + 1);
    const Output output = find(aovs, name, "AOV");
    if (file.extension() != ".exr") {
        throw UsageError("--aov " + name + ": the file '" + file.string() + "' does not end in .exr");
    }
    return {output, name, file};
}

/// No output may replace another one or the input.
void requireDistinct(const RenderOptions& options) {
    std::vector<std::filesystem::path> files{options.input, materialFile(options.material), options.output,
                                             options.json};
    std::ranges::transform(options.aovs, std::back_inserter(files), &AovOutput::file);
    requireDistinctFiles(std::move(files));
}

} // namespace

RenderOptionParser::RenderOptionParser(CLI::App& command) {
    const auto add = [&command](const std::string& group, const std::string& name, auto& value,
                                const std::string& description, const std::string& type) {
        command.add_option(name, value, description)
            ->type_name(type)
            ->group(group)
            ->allow_extra_args(false); // one value each time, so that a scene may follow it
    };
    const auto addFlag = [&command](const std::string& group, const std::string& name, bool& value,
                                    const std::string& description) {
        command.add_flag(name, value, description)->group(group);
    };
    scene_.addScene(command);
    scene_.addTime(command);
    const std::string picture = "Picture";
    add(picture, "-o,--output", options_.output,
        "FILE.png (sRGB) or FILE.exr (linear, before exposure and tone curve); default " + options_.output.string(),
        "FILE");
    scene_.addPicture(command, "AOVs have a pixel for each; ");
    add(picture, "--exposure", exposure_, "Make a PNG brighter (> 0) or darker (< 0) by powers of two", "EV");
    scene_.addLight(command);
    scene_.addCamera(command);

    const std::string effect = "Effect";
    add(effect, "--technique", technique_, "How light is spread: " + names(techniques()), "NAME");
    addFlag(effect, "--no-scatter", noScatter_, "Leave out light spreading under lit surfaces");
    addFlag(effect, "--no-transmit", noTransmit_, "Leave out light coming through thin parts");
    add(effect, "--shadow-map-size", options_.settings.shadowMapSize,
        "Texels a side; default " + std::to_string(options_.settings.shadowMapSize), "N");

    const std::string results = "Results and device";
    add(results, "--aov", aovs_, "One more image, may be repeated", "NAME=FILE.exr");
    addJsonOption(command, options_.json)->group(results);
    add(results, "--device", options_.device.name, "Number or part of the name, see `nacre devices`", "DEVICE");
    addFlag(results, "--validation", options_.device.validation, "Fail where the Vulkan validation layer complains");

    command.footer("AOVs: " + names(aovs) + R"(
--front and --back turn on a built-in light where the scene has none on that side.

Examples:
  nacre render -o gallery.png
  nacre render --back --no-transmit --no-scatter -o off.png
  nacre render bunny.obj --material jade --camera-position 0,0.1,0.3
  nacre render scene.json -o frame.exr --aov depth=depth.exr --json frame.json)");
}

RenderOptions RenderOptionParser::finish() const {
    RenderOptions options = options_;
    static_cast<SceneOptions&>(options) = scene_.finish();
    options.settings.width = options.width;
    options.settings.height = options.height;
    options.settings.samples = options.samples;
    options.settings.technique = find(techniques(), technique_, "technique");
    options.settings.scatter = !noScatter_;
    options.settings.transmit = !noTransmit_;
    options.settings.dither = true;
    requireRange(options.settings.shadowMapSize, minShadowMapSize, maxShadowMapSize, "--shadow-map-size");
    if (options.output.extension() != ".png" && options.output.extension() != ".exr") {
        throw UsageError("--output '" + options.output.string() + "' ends neither in .png nor in .exr");
    }
    requireRange(exposure_, -maxExposure, maxExposure, "--exposure");
    if (exposure_ != 0 && options.output.extension() == ".exr") {
        throw UsageError("--exposure is for a PNG; '" + options.output.string() + "' holds the light before exposure");
    }
    options.exposure = static_cast<float>(exposure_);
    std::ranges::transform(aovs_, std::back_inserter(options.aovs), parseAov);
    options.settings.thickness =
        std::ranges::any_of(options.aovs, [](const AovOutput& aov) { return aov.output == Output::Thickness; });
    requireDistinct(options);
    return options;
}

} // namespace nacre::app
