#include "app/bake_options.hpp"

#include "app/command.hpp"

#include <CLI/CLI.hpp>

namespace nacre::app {

namespace {

constexpr unsigned maxBakeThreads = 4096;
constexpr std::uint32_t maxRays = 65536;
constexpr double maxWhite = 1e6; // mm, as thickness in scene files

const char* const bakeExamples = R"(
The local thickness of a point does not depend on any light: it is that of the slab that lets as much light through to
it as the body does, in all directions. MODEL may be a scene file; without it the gallery is baked.

FILE.exr has the thickness in millimetres (channel MM), padded beyond the surface's texels, and where those are (A).
FILE.png is 8 bits of grey, white being --white or what one texel in a thousand exceeds. It is the thicknessTexture of glTF's
KHR_materials_volume, whose thicknessFactor (metres) is printed.
FILE.ply has a value for each vertex, for models without texture coordinates.
FILE.checkpoint keeps what is done, so that --resume goes on where a run stopped.

Examples:
  nacre bake thickness head.glb -o T.png
  nacre bake thickness head.glb --surface skin --material skin --size 2048x2048 -o T.exr
  nacre bake thickness statue.obj -o statue.ply)";

std::optional<BakeForm> formOf(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".exr") {
        return BakeForm::Exr;
    }
    if (extension == ".png") {
        return BakeForm::Png;
    }
    return extension == ".ply" ? std::optional(BakeForm::Ply) : std::nullopt;
}

} // namespace

BakeOptionParser::BakeOptionParser(CLI::App& command) : command_(command) {
    const auto add = [&command](const char* group, const char* name, auto& value, const std::string& description,
                                const char* type) {
        command.add_option(name, value, description)->type_name(type)->group(group)->allow_extra_args(false);
    };
    command.add_option("MODEL", options_.input, "A model or a scene file; without it the built-in gallery")
        ->type_name("");
    add("Result", "-o,--output", options_.output, "FILE.exr, FILE.png or FILE.ply; default " + options_.output.string(),
        "FILE");
    add("Result", "--size", size_, "Texels of the picture; default " + size_, "WxH");
    add("Result", "--white", options_.white,
        "FILE.png: the thickness that white stands for; default what one texel in a thousand exceeds", "MM");
    addJsonOption(command, options_.json)->group("Result");

    add("Body", "--surface", options_.surface, "Only this surface; a picture needs it where there are several", "NAME");
    add("Body", "--material", options_.material,
        "Let light through as this preset or material file; default the surface's own material", "NAME|FILE");
    command
        .add_flag("--neutral", options_.neutral,
                  "Of no material: light falls with the length of the way; default where the surface has none")
        ->group("Body");

    add("Work", "--rays", options_.settings.samples,
        "Rays for each texel or vertex; default " + std::to_string(options_.settings.samples), "N");
    add("Work", "--seed", options_.settings.seed, "Other random numbers; default 1", "N");
    add("Work", "--threads", options_.settings.threads, "Default all cores", "N");
    command.add_flag("--resume", options_.resume, "Go on from the checkpoint, where there is one")->group("Work");
    command.add_flag("--restart", options_.restart, "Throw an earlier checkpoint away")->group("Work");
    command.footer(bakeExamples);
}

BakeOptions BakeOptionParser::finish() const {
    BakeOptions options = options_;
    const PictureSize size = parseSize(size_);
    options.width = size.width;
    options.height = size.height;
    requireRange(options.settings.samples, 1, maxRays, "--rays");
    requireRange(options.settings.threads, 0, maxBakeThreads, "--threads");
    const std::optional<BakeForm> form = formOf(options.output);
    if (!form) {
        throw UsageError("--output '" + options.output.string() + "' does not end in .exr, .png or .ply");
    }
    options.form = *form;
    if (options.white) {
        requireRange(*options.white, 1e-3, maxWhite, "--white");
        if (options.form != BakeForm::Png) {
            throw UsageError("--white is for a .png, and --output is '" + options.output.string() + "'");
        }
    }
    if (options.form == BakeForm::Ply) {
        requireWith(command_, {"--size"}, "a picture, and --output is '" + options.output.string() + "'");
    }
    if (options.neutral && !options.material.empty()) {
        throw UsageError("--neutral and --material exclude each other");
    }
    if (options.resume && options.restart) {
        throw UsageError("--resume and --restart exclude each other");
    }
    requireDistinctFiles({options.input, options.material, options.output, options.json});
    return options;
}

} // namespace nacre::app
