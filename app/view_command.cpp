// `nacre view`: a window to build materials in.
#include "app/command.hpp"
#include "app/json_report.hpp"
#include "app/render_scene.hpp"
#include "app/view_report.hpp"
#include "view/loop/headless.hpp"

#ifdef NACRE_HAS_WINDOW
#include "view/run_window.hpp"
#endif

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <charconv>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

namespace nacre::app {

namespace {

constexpr std::uint32_t mostFrames = 100'000;

struct ViewOptions : SceneOptions {
    renderer::DeviceSettings device;
    std::filesystem::path script;
    bool headless = false;
    std::string frames;
    std::uint32_t turntable = 0;       ///< 0: none
    std::optional<std::string> moving; ///< of movingName
    std::filesystem::path json;
    std::filesystem::path output;
    std::uint32_t shadowMapSize = 2048;
};

std::uint32_t parseFrame(const std::string& text) {
    std::uint32_t value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || value > mostFrames) {
        throw UsageError("--frames '" + text + "' is no number from 0 to " + std::to_string(mostFrames));
    }
    return value;
}

void failOnMessages(const renderer::Device& device) {
    const std::vector<std::string>& messages = device.validationMessages();
    if (!messages.empty()) {
        throw std::runtime_error("the validation layer has " + std::to_string(messages.size()) +
                                 " messages, the first: " + messages.front());
    }
}

void runHeadless(const ViewOptions& options) {
    using nacre::view::Moving;
    nacre::view::HeadlessSettings settings;
    settings.width = options.width;
    settings.height = options.height;
    settings.shadowMapSize = options.shadowMapSize;
    settings.frames = options.frames.empty() ? settings.frames : parseFrame(options.frames);
    requireRange(settings.frames, 2, mostFrames, "--frames");
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
    renderer::Device device(options.device);
    scene::Scene scene = makeScene(options);
    printNotes(scene.notes);
    scene.cameras.insert(scene.cameras.begin(), makeCamera(options, scene));
    const bool toTerminal = options.json != "-";
    if (toTerminal) {
        std::cout << settings.width << 'x' << settings.height << ", " << settings.frames << " frames on "
                  << device.description().name << ", ms\n";
    }
    std::vector<NamedRun> runs;
    for (const Moving moving : {Moving::Nothing, Moving::Lights, Moving::Material}) {
        if (!options.moving || *options.moving == movingName(moving)) {
            runs.push_back({moving, nacre::view::runHeadless(device, scene, settings, moving)});
            if (toTerminal) {
                printRun(std::cout, runs.back());
            }
        }
    }
    failOnMessages(device);
    if (!options.json.empty()) {
        writeText(options.json,
                  makeReport(device.description(), describeScene(sceneName(options), scene.notes), settings, runs));
    }
}

/// "A:B", both of them drawn; without it all frames.
void parseRange(const std::string& text, nacre::view::TurntableSettings& settings) {
    settings.last = settings.count - 1;
    if (text.empty()) {
        return;
    }
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) {
        throw UsageError("--frames '" + text + "' is not FIRST:LAST");
    }
    settings.first = parseFrame(text.substr(0, colon));
    settings.last = parseFrame(text.substr(colon + 1));
    if (settings.first > settings.last || settings.last >= settings.count) {
        throw UsageError("--frames " + text + " is no range of the frames 0 to " + std::to_string(settings.count - 1));
    }
}

void runTurntable(const ViewOptions& options) {
    nacre::view::TurntableSettings settings;
    settings.count = options.turntable;
    settings.width = options.width;
    settings.height = options.height;
    settings.shadowMapSize = options.shadowMapSize;
    settings.samples = options.samples * options.samples;
    settings.folder = options.output;
    if (settings.folder.empty()) {
        throw UsageError("--turntable needs a folder: -o DIR");
    }
    parseRange(options.frames, settings);
    renderer::Device device(options.device);
    scene::Scene scene = makeScene(options);
    printNotes(scene.notes);
    scene.cameras.insert(scene.cameras.begin(), makeCamera(options, scene));
    nacre::view::drawTurntable(device, scene, settings);
    failOnMessages(device);
}

/// Options of the three ways to view that would do nothing in another one.
void requireFittingOptions(const CLI::App& command, const ViewOptions& options) {
    const bool turns = command.count("--turntable") > 0;
    if (options.headless && turns) {
        throw UsageError("--headless and --turntable exclude each other");
    }
    if (!options.headless) {
        requireWith(command, {"--json", "--moving"}, "--headless");
    }
    if (turns) {
        requireRange(options.turntable, 1, mostFrames, "--turntable");
    } else {
        requireWith(command, {"--output", "--samples"}, "--turntable");
    }
    if (!options.headless && !turns) {
        requireWith(command, {"--frames", "--size", "--shadow-map-size"}, "--headless or --turntable");
    } else {
        requireWith(command, {"--script"}, "a window, without --headless and --turntable");
    }
}

void view(const ViewOptions& options) {
    requireRange(options.shadowMapSize, 16, 16384, "--shadow-map-size");
    if (options.turntable > 0) {
        runTurntable(options);
        return;
    }
    if (options.headless) {
        runHeadless(options);
        return;
    }
#ifdef NACRE_HAS_WINDOW
    nacre::view::RunSettings settings;
    settings.input = options.input;
    settings.load = [&options] {
        scene::Scene scene = makeScene(options);
        printNotes(scene.notes);
        const scene::Camera camera = makeCamera(options, scene);
        std::erase_if(scene.cameras, [&](const scene::Camera& other) { return other.name == camera.name; });
        scene.cameras.insert(scene.cameras.begin(), camera);
        return scene;
    };
    settings.device = options.device;
    settings.script = options.script;
    nacre::view::runWindow(settings);
#else
    throw std::runtime_error("this build has no window, because Qt 6 was not there when it was configured (Debian: "
                             "qt6-base-dev); --headless draws without one");
#endif
}

} // namespace

void addView(CLI::App& app) {
    CLI::App* command = app.add_subcommand("view", "Open a window: build a material, see its light change");
    const auto options = std::make_shared<ViewOptions>();
    const auto parser = std::make_shared<SceneOptionParser>();
    parser->addScene(*command);
    parser->addPicture(*command, "of a turntable's pictures; ");
    parser->addLight(*command);
    parser->addCamera(*command);
    const auto add = [&](const char* name, auto& value, const char* description, const char* type) {
        command->add_option(name, value, description)->type_name(type)->allow_extra_args(false);
    };
    add("--script", options->script, "Drive the window by the steps of this file, then end", "FILE.json");
    command->add_flag("--headless", options->headless, "No window: draw frames and say what they take");
    add("--frames", options->frames, "Of --headless how many, default 120; of --turntable which: FIRST:LAST", "N|A:B");
    add("--moving", options->moving, "Of --headless: draw frames with this changing alone; default one run of each",
        "nothing|lights|material");
    command->get_option("--moving")->check(CLI::IsMember({"nothing", "lights", "material"}));
    add("--json", options->json, "Of --headless: what frames took and what was allocated, as JSON", "FILE");
    add("--turntable", options->turntable, "No window: N pictures from around the scene", "N");
    add("-o,--output", options->output, "The folder for a turntable's pictures", "DIR");
    add("--shadow-map-size", options->shadowMapSize, "Texels a side, without a window; default 2048", "N");
    add("--device", options->device.name, "Number or part of the name, see `nacre devices`", "DEVICE");
    command->add_flag("--validation", options->device.validation, "Fail where the Vulkan validation layer complains");
    command->footer(R"(Examples:
  nacre view
  nacre view model.glb --material skin
  nacre view --headless --frames 600 --size 1920x1080
  nacre view model.glb --turntable 36 -o turn)");
    command->callback([options, parser, command] {
        requireFittingOptions(*command, *options);
        ViewOptions all = *options;
        static_cast<SceneOptions&>(all) = parser->finish();
        view(all);
    });
}

} // namespace nacre::app
