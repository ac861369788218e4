// `nacre bake`: what is computed once for a model and kept.
#include "app/bake_options.hpp"
#include "app/bake_report.hpp"
#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/progress.hpp"
#include "app/progress_line.hpp"
#include "app/render_scene.hpp"
#include "app/terminal_text.hpp"
#include "bake/thickness_files.hpp"
#include "trace/fingerprint.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <set>

namespace nacre::app {

namespace {

constexpr std::chrono::seconds bakeCheckpointInterval{30};
constexpr std::size_t maxListed = 20;

void checkBakeOutputs(const BakeOptions& options) {
    checkWritable(options.output);
    const std::filesystem::path checkpoint = trace::checkpointOf(options.output);
    checkWritable(checkpoint);
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
    if (!options.resume && !options.restart && std::filesystem::exists(checkpoint)) {
        throw std::runtime_error(checkpoint.string() +
                                 ": is there from an earlier run; --resume goes on from it, --restart replaces it");
    }
}

/// The surfaces that have subsurface materials, or all where none has; in order, each once.
std::vector<std::uint32_t> bakedSurfaces(const scene::Scene& scene) {
    std::set<std::uint32_t> all;
    std::set<std::uint32_t> scattering;
    for (const scene::Instance& instance : scene.instances) {
        const std::uint32_t surface = scene.meshes[instance.mesh].surface;
        all.insert(surface);
        if (scene.surfaces[surface].material != scene::none) {
            scattering.insert(surface);
        }
    }
    const std::set<std::uint32_t>& chosen = scattering.empty() ? all : scattering;
    return {chosen.begin(), chosen.end()};
}

std::string listSurfaces(const scene::Scene& scene, std::span<const std::uint32_t> surfaces) {
    std::string names;
    for (const std::uint32_t surface : surfaces.first(std::min(surfaces.size(), maxListed))) {
        names += (names.empty() ? "'" : ", '") + scene.surfaces[surface].name + "'";
    }
    return surfaces.size() > maxListed ? names + " and " + std::to_string(surfaces.size() - maxListed) + " more"
                                       : names;
}

/// The surface to bake; scene::none for all.
std::uint32_t chooseSurface(const BakeOptions& options, const scene::Scene& scene) {
    const std::vector<std::uint32_t> surfaces = bakedSurfaces(scene);
    const std::string name = sceneName(options);
    if (!options.surface.empty()) {
        const auto found = std::ranges::find_if(
            surfaces, [&](std::uint32_t surface) { return scene.surfaces[surface].name == options.surface; });
        if (found == surfaces.end()) {
            throw std::runtime_error(name + ": has no surface '" + options.surface + "' to bake, only " +
                                     listSurfaces(scene, surfaces));
        }
        return *found;
    }
    if (surfaces.size() == 1) {
        return surfaces.front();
    }
    if (options.form != BakeForm::Ply) {
        throw std::runtime_error(name + ": has " + std::to_string(surfaces.size()) +
                                 " surfaces, and a picture is of one; --surface says which of " +
                                 listSurfaces(scene, surfaces));
    }
    return scene::none;
}

/// The material whose light decides; null when neutral.
const Material* chooseMaterial(const BakeOptions& options, const scene::Scene& scene, std::uint32_t surface) {
    if (options.neutral || (surface == scene::none && options.material.empty())) {
        return nullptr;
    }
    const std::uint32_t material = surface == scene::none ? 0 : scene.surfaces[surface].material;
    return material < scene.materials.size() ? &scene.materials[material] : nullptr;
}

bake::ThicknessLaw makeLaw(const Material* material) {
    return material == nullptr ? bake::ThicknessLaw() : bake::ThicknessLaw(*makeProfile(*material));
}

/// Where the values belong: texels of a picture, or vertices.
struct Layout {
    bake::Atlas atlas;           ///< of a picture
    bake::VertexPlaces vertices; ///< of a mesh

    const std::vector<trace::Hit>& places(BakeForm form) const {
        return form == BakeForm::Ply ? vertices.places : atlas.places;
    }
};

Layout makeLayout(const BakeOptions& options, const scene::Scene& scene, std::uint32_t surface) {
    Layout layout;
    if (options.form == BakeForm::Ply) {
        layout.vertices = bake::makeVertexPlaces(scene, surface);
        return layout;
    }
    layout.atlas = bake::makeAtlas(scene, surface, options.width, options.height, sceneName(options));
    if (layout.atlas.places.empty()) {
        throw std::runtime_error(sceneName(options) + ": the surface '" + scene.surfaces[surface].name +
                                 "' has no texture coordinates; --output FILE.ply has a value for each vertex");
    }
    return layout;
}

trace::Identity identityOf(const BakeOptions& options, const scene::Scene& scene, std::uint32_t surface,
                           const std::string& law) {
    const bool mesh = options.form == BakeForm::Ply;
    return {{"form", mesh ? "vertices" : "texels"},
            {"size", mesh ? "none" : std::to_string(options.width) + "x" + std::to_string(options.height)},
            {"surface", surface == scene::none ? "all" : std::to_string(surface)},
            {"law", law},
            {"rays", std::to_string(options.settings.samples)},
            {"seed", std::to_string(options.settings.seed)},
            {"scene", trace::fingerprintOf(scene)}};
}

std::string progressText(const bake::ThicknessBake& bake, std::size_t doneBefore, double secondsBefore) {
    const std::size_t done = bake.state().millimetres.size();
    const double share = static_cast<double>(done) / static_cast<double>(bake.placeCount());
    const double secondsEach = (bake.state().seconds - secondsBefore) / static_cast<double>(done - doneBefore);
    return progressBar(share) + ' ' + std::to_string(done) + " of " + std::to_string(bake.placeCount()) + ", " +
           formatDuration(secondsEach * static_cast<double>(bake.placeCount() - done)) + " left";
}

void runWithCheckpoints(const std::filesystem::path& checkpoint, const trace::Identity& identity,
                        bake::ThicknessBake& bake) {
    const std::size_t doneBefore = bake.state().millimetres.size();
    const double secondsBefore = bake.state().seconds;
    ProgressLine line;
    std::optional<std::chrono::steady_clock::time_point> saved; // the first time comes soon
    bake.run([&] {
        if (line.isDue()) {
            line.show(progressText(bake, doneBefore, secondsBefore));
        }
        if (!saved || std::chrono::steady_clock::now() - *saved > bakeCheckpointInterval) {
            bake::saveThickness(checkpoint, identity, bake.state());
            saved = std::chrono::steady_clock::now();
        }
        return !isInterrupted();
    });
}

void writeThickness(const BakeOptions& options, const scene::Scene& scene, const Layout& layout, double white,
                    std::span<const float> millimetres) {
    switch (options.form) {
    case BakeForm::Exr:
        bake::writeThicknessExr(options.output, layout.atlas, millimetres);
        return;
    case BakeForm::Png:
        bake::writeThicknessPng(options.output, layout.atlas, millimetres, white);
        return;
    case BakeForm::Ply:
        bake::writeThicknessPly(options.output, scene, layout.vertices, millimetres);
        return;
    }
}

std::vector<std::string> warningsOf(const BakeOptions& options, const bake::ThicknessBake& bake, const Layout& layout,
                                    double white) {
    std::vector<std::string> warnings = bake.warnings();
    if (layout.atlas.shared > 0) {
        warnings.push_back(std::to_string(layout.atlas.shared) +
                           " texels are those of several places at once, and have the thickness of the first");
    }
    const auto above = std::ranges::count_if(bake.state().millimetres, [&](float value) { return value > white; });
    if (options.white && above > 0) {
        warnings.push_back(std::to_string(above) + " texels are thicker than --white and were cut off there");
    }
    return warnings;
}

/// Without --white, what one value in a thousand exceeds: those of open meshes can be far off.
double whiteOf(const BakeOptions& options, std::vector<float> millimetres) {
    if (options.form != BakeForm::Png || options.white) {
        return options.white.value_or(0);
    }
    constexpr double leastWhite = 1e-3; // a thickness of 0 everywhere has no white of its own
    const auto place = millimetres.begin() + static_cast<std::ptrdiff_t>((millimetres.size() - 1) * 999 / 1000);
    std::ranges::nth_element(millimetres, place);
    return std::max<double>(*place, leastWhite);
}

void finish(const BakeOptions& options, const BakeResult& result) {
    for (const std::string& warning : result.warnings) {
        std::cerr << "nacre: warning: " << printable(warning) << '\n';
    }
    if (!options.json.empty()) {
        writeText(options.json, makeReport(options, result));
    }
    if (options.json != "-") {
        std::cout << printableLines(describeBake(options, result)) << std::flush;
    }
    printNotes(result.notes);
}

void stopInterrupted(const std::filesystem::path& checkpoint, const trace::Identity& identity,
                     const bake::ThicknessBake& bake) {
    bake::saveThickness(checkpoint, identity, bake.state());
    std::cerr << "nacre: interrupted; the same command with --resume goes on from " << printable(checkpoint.string())
              << '\n';
    throwIfInterrupted();
}

void bakeThickness(const BakeOptions& options) {
    checkBakeOutputs(options);
    const scene::Scene scene = [&] {
        const Progress progress("loading " + sceneName(options));
        return makeScene(options);
    }();
    requireInputsKept(options, scene, {options.output, options.json});
    const std::uint32_t surface = chooseSurface(options, scene);
    const Material* const material = chooseMaterial(options, scene, surface);
    const std::string law = material == nullptr ? "neutral" : material->name;
    const Layout layout = makeLayout(options, scene, surface);
    const trace::Identity identity = identityOf(options, scene, surface, law);
    const std::filesystem::path checkpoint = trace::checkpointOf(options.output);
    runInterruptibly([&] {
        bake::ThicknessBake bake(scene, layout.places(options.form), makeLaw(material), options.settings);
        if (options.resume && std::filesystem::exists(checkpoint)) {
            bake.resume(bake::loadThickness(checkpoint, identity, bake.placeCount()));
        }
        const double secondsBefore = bake.state().seconds;
        runWithCheckpoints(checkpoint, identity, bake);
        if (!bake.isComplete()) {
            stopInterrupted(checkpoint, identity, bake);
        }
        const double white = whiteOf(options, bake.state().millimetres);
        writeThickness(options, scene, layout, white, bake.state().millimetres);
        std::filesystem::remove(checkpoint);
        BakeResult result;
        result.scene = sceneName(options);
        result.notes = scene.notes;
        result.surface = surface == scene::none ? "" : scene.surfaces[surface].name;
        result.law = law;
        result.state = bake.state();
        result.texels = std::size_t{layout.atlas.width} * layout.atlas.height;
        result.white = white;
        result.secondsOfRun = bake.state().seconds - secondsBefore;
        result.warnings = warningsOf(options, bake, layout, white);
        finish(options, result);
    });
}

} // namespace

void addBake(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bake", "Compute once what a model keeps");
    command->require_subcommand(1);
    CLI::App* thickness =
        command->add_subcommand("thickness", "How thick the body is beneath each point of its surface");
    const auto parser = std::make_shared<BakeOptionParser>(*thickness);
    thickness->callback([parser] { bakeThickness(parser->finish()); });
}

} // namespace nacre::app
