#include "app/render_options.hpp"

#include "app/command.hpp"
#include "app/material_source.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
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
constexpr double maxCoordinate = 1e9; // as in scene files
constexpr std::uint32_t maxSamples = 4;
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

std::optional<glm::vec3> parsePoint(const std::string& text, const std::string& option) {
    if (text.empty()) {
        return std::nullopt;
    }
    glm::vec3 point(0);
    const char* position = text.data();
    const char* const end = position + text.size();
    for (int axis = 0; axis < 3; ++axis) {
        const bool separated = axis == 0 || (position != end && *position++ == ',');
        const auto [next, error] = std::from_chars(position, end, point[axis]);
        if (!separated || error != std::errc() || !std::isfinite(point[axis]) || (axis == 2 && next != end)) {
            throw UsageError(option + " '" + text + "' is not X,Y,Z, for example 0,1.5,-2");
        }
        requireRange(point[axis], -maxCoordinate, maxCoordinate, option);
        position = next;
    }
    return point;
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
    command.add_option("SCENE", options_.input, "A scene file or a model; without it the built-in gallery")
        ->type_name("");

    const std::string picture = "Picture";
    add(picture, "-o,--output", options_.output,
        "FILE.png (sRGB) or FILE.exr (linear, before exposure and tone curve); default " + options_.output.string(),
        "FILE");
    add(picture, "--size", size_, "Pixels; default " + size_, "WxH");
    add(picture, "--samples", options_.settings.samples,
        "Samples per axis of a pixel, 1 to " + std::to_string(maxSamples) + "; AOVs have a pixel for each; default " +
            std::to_string(options_.settings.samples),
        "N");
    add(picture, "--exposure", exposure_, "Make a PNG brighter (> 0) or darker (< 0) by powers of two", "EV");
    add(picture, "--material", options_.material, "Give every body this material: a preset or a material file",
        "NAME|FILE");

    const std::string light = "Light";
    addFlag(light, "--front", front_, "Only the lights on the camera's side, as --light front");
    addFlag(light, "--back", back_, "Only the lights on the far side, as --light back");
    add(light, "--light", options_.lights, "front, back, both, or a light's name; may be repeated", "SIDE|NAME");

    const std::string camera = "Camera";
    add(camera, "--camera", options_.camera, "One of the scene's cameras; default the first", "NAME|NUMBER");
    add(camera, "--camera-position", cameraPosition_, "Where the camera is, scene units", "X,Y,Z");
    add(camera, "--camera-target", cameraTarget_, "What the camera looks at, scene units", "X,Y,Z");
    add(camera, "--fov", fieldOfView_, "Vertical field of view", "DEGREES");

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
    const PictureSize size = parseSize(size_);
    options.settings.width = size.width;
    options.settings.height = size.height;
    options.settings.technique = find(techniques(), technique_, "technique");
    options.settings.scatter = !noScatter_;
    options.settings.transmit = !noTransmit_;
    options.settings.dither = true;
    requireRange(options.settings.samples, 1, maxSamples, "--samples");
    requireRange(options.settings.shadowMapSize, minShadowMapSize, maxShadowMapSize, "--shadow-map-size");
    if (options.output.extension() != ".png" && options.output.extension() != ".exr") {
        throw UsageError("--output '" + options.output.string() + "' ends neither in .png nor in .exr");
    }
    if (front_) {
        options.lights.emplace_back("front");
    }
    if (back_) {
        options.lights.emplace_back("back");
    }
    requireRange(exposure_, -maxExposure, maxExposure, "--exposure");
    if (exposure_ != 0 && options.output.extension() == ".exr") {
        throw UsageError("--exposure is for a PNG; '" + options.output.string() + "' holds the light before exposure");
    }
    options.exposure = static_cast<float>(exposure_);
    options.cameraPosition = parsePoint(cameraPosition_, "--camera-position");
    options.cameraTarget = parsePoint(cameraTarget_, "--camera-target");
    if (fieldOfView_) {
        requireRange(*fieldOfView_, 1, 170, "--fov");
        options.fieldOfView = static_cast<float>(*fieldOfView_ * std::numbers::pi / 180);
    }
    std::ranges::transform(aovs_, std::back_inserter(options.aovs), parseAov);
    options.settings.thickness =
        std::ranges::any_of(options.aovs, [](const AovOutput& aov) { return aov.output == Output::Thickness; });
    requireDistinct(options);
    return options;
}

} // namespace nacre::app
