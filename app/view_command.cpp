// `nacre view`: a window to build materials in.
#include "app/command.hpp"
#include "app/material_source.hpp"

#ifdef NACRE_HAS_WINDOW
#include "view/run_window.hpp"
#endif

#include <CLI/CLI.hpp>

namespace nacre::app {

namespace {

struct ViewOptions {
    std::filesystem::path input;
    std::string material;
    std::string device;
    bool validation = false;
};

void view(const ViewOptions& options) {
#ifdef NACRE_HAS_WINDOW
    nacre::view::RunSettings settings;
    settings.input = options.input;
    if (!options.material.empty()) {
        settings.material = readMaterial(options.material);
    }
    settings.device.name = options.device;
    settings.device.validation = options.validation;
    nacre::view::runWindow(settings);
#else
    static_cast<void>(options);
    throw std::runtime_error("this build has no window, because Qt 6 was not there when it was configured (Debian: "
                             "qt6-base-dev); --headless draws without one");
#endif
}

} // namespace

void addView(CLI::App& app) {
    CLI::App* command = app.add_subcommand("view", "Open a window: build a material, see its light change");
    const auto options = std::make_shared<ViewOptions>();
    command->add_option("SCENE", options->input, "A scene file or a model; without it the built-in gallery")
        ->type_name("");
    command->add_option("--material", options->material, "Give every body this material: a preset or a material file")
        ->type_name("NAME|FILE");
    command->add_option("--device", options->device, "Number or part of the name, see `nacre devices`")
        ->type_name("DEVICE");
    command->add_flag("--validation", options->validation, "Fail where the Vulkan validation layer complains");
    command->callback([options] { view(*options); });
}

} // namespace nacre::app
