// `nacre material`: the presets, what a material does, and whether a material file is right.
#include "app/command.hpp"
#include "app/json_report.hpp"
#include "app/material_fit.hpp"
#include "app/material_plot.hpp"
#include "app/material_source.hpp"
#include "app/rgb_table.hpp"
#include "app/terminal_text.hpp"
#include "nacre/files.hpp"
#include "nacre/presets.hpp"
#include "scene/length_units.hpp"
#include "scene/materialx/materialx_file.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace nacre::app {

namespace {

constexpr std::array slabThicknesses{0.5, 1.0, 2.0, 5.0, 10.0}; // mm, from an eyelid to an ear lobe and beyond

void listMaterials(const std::filesystem::path& json) {
    if (!json.empty()) {
        checkWritable(json);
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const Material& material : presets()) {
            list.push_back({{"name", material.name}, {"description", material.description}});
        }
        writeText(json, formatReport({{"schemaVersion", 1}, {"materials", list}}));
        return;
    }
    for (const Material& material : presets()) {
        std::cout << std::left << std::setw(18) << material.name << material.description << '\n';
    }
}

template <typename Function> Rgb eachChannel(Function function) {
    return {function(0), function(1), function(2)};
}

std::string number(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string describeProfile(const Material& material) {
    const std::unique_ptr<Profile> profile = makeProfile(material);
    std::string text = rgbRow("rms radius, mm", eachChannel([&](int channel) { return profile->rmsRadius(channel); }));
    for (const double share : {0.5, 0.9, 0.99}) {
        text += rgbRow("radius of " + number(share * 100) + " % of the light, mm",
                       eachChannel([&](int channel) { return profile->inverseCdf(channel, share); }));
    }
    for (const double thickness : slabThicknesses) {
        text += rgbRow("through " + number(thickness) + " mm",
                       eachChannel([&](int channel) { return profile->slabTransmittance(channel, thickness); }));
    }
    return text;
}

std::string describeLayers(const Material& material) {
    if (material.layers.empty()) {
        return rgbRow("mean free path, mm", material.meanFreePath.value_or(Rgb{}));
    }
    std::string text;
    for (const Layer& layer : material.layers) {
        text += rgbRow("layer, variance " + number(layer.variance) + " mm²", layer.weight);
    }
    return text;
}

std::string describeTransmission(const Material& material) {
    return material.diffuseTransmission > 0 ? ", diffuse transmission " + number(material.diffuseTransmission) : "";
}

/// What a reflection with two lobes has besides.
std::string describeSecondLobe(const Material& material) {
    return material.secondLobe > 0 ? ", second lobe " + number(material.secondLobe) + " of roughness × " +
                                         number(material.secondLobeRoughness)
                                   : "";
}

std::string describeMaterial(const Material& material) {
    std::ostringstream text;
    text << printable(material.name) << ": " << printable(material.description) << '\n'
         << "  strength " << material.strength << ", translucency " << material.translucency
         << describeTransmission(material) << ", scale " << material.scale << ", albedo use "
         << (material.albedoUse == AlbedoUse::Post ? "post" : "preAndPost") << ", second surfaces "
         << (asksForSecondSurfaces(material) ? "yes" : "no") << ", roughness " << material.roughness << ", specular "
         << material.specular << describeSecondLobe(material) << '\n'
         << rgbHeader();
    return text.str() + rgbRow("albedo", material.albedo) + describeLayers(material) + describeProfile(material);
}

struct ShowOptions {
    std::string nameOrFile;
    std::filesystem::path json;
    std::filesystem::path plot;
};

void showMaterial(const ShowOptions& options) {
    requireDistinctFiles({materialFile(options.nameOrFile), options.plot, options.json});
    if (!options.plot.empty()) {
        checkPlotName(options.plot);
        checkWritable(options.plot);
    }
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
    const Material material = readMaterial(options.nameOrFile);
    if (!options.plot.empty()) {
        plotMaterial(material, options.plot);
    }
    if (!options.json.empty()) {
        writeText(options.json, formatMaterial(material));
    }
    if (options.json.empty() && options.plot.empty()) {
        std::cout << describeMaterial(material);
    }
}

std::vector<std::string> unitNames() {
    std::vector<std::string> names;
    std::ranges::transform(scene::lengthUnits, std::back_inserter(names), &scene::LengthUnit::name);
    return names;
}

struct ImportOptions {
    std::filesystem::path document;
    std::string name;
    std::string units;
    std::filesystem::path json;
};

/// The material as a file. Throws FileError, naming the document.
std::string formatImported(const Material& material, const std::filesystem::path& document) {
    try {
        return formatMaterial(material);
    } catch (const FileError& error) {
        throw FileError(document.string() + ": " + error.what());
    }
}

void importMaterial(const ImportOptions& options) {
    requireDistinctFiles({options.document, options.json});
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
    const auto* unit = std::ranges::find(scene::lengthUnits, std::string_view(options.units),
                                         [](const auto& known) { return std::string_view(known.name); });
    const auto metersPerUnit = unit != scene::lengthUnits.end() ? std::optional(unit->metres) : std::nullopt;
    const auto [material, notes, inputs] = scene::importMaterialX(options.document, options.name, metersPerUnit);
    for (const std::string& input : inputs) {
        requireDistinctFiles({input, options.json});
    }
    if (options.json.empty()) {
        std::cout << describeMaterial(material) << std::flush;
    } else {
        writeText(options.json, formatImported(material, options.document));
    }
    for (const std::string& note : notes) {
        std::cerr << "nacre: note: " << printable(note) << '\n';
    }
}

void checkMaterials(const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) {
        const Material material = loadMaterial(file);
        std::cout << printable(file.string()) << ": '" << printable(material.name) << "' is a valid material\n";
    }
}

void addList(CLI::App& material) {
    CLI::App* command = material.add_subcommand("list", "List the presets");
    command->footer("Examples:\n  nacre material list\n  nacre material list --json presets.json");
    const auto json = std::make_shared<std::filesystem::path>();
    addJsonOption(*command, *json);
    command->callback([json] { listMaterials(*json); });
}

void addShow(CLI::App& material) {
    CLI::App* command =
        material.add_subcommand("show", "Say what a material does, draw it, or write it as a material file");
    command->footer(R"(Examples:
  nacre material show skin
  nacre material show skin --json my-skin.json          to start a material of one's own
  nacre material show skin --plot skin.svg               its profile and what slabs of it let through)");
    const auto options = std::make_shared<ShowOptions>();
    command->add_option("MATERIAL", options->nameOrFile, "A preset's name or a material file")
        ->required()
        ->type_name("");
    command->add_option("--plot", options->plot, "Draw the profile and the slab transmittance, as .png or .svg")
        ->type_name("FILE");
    addJsonOption(*command, options->json);
    command->callback([options] { showMaterial(*options); });
}

void addImport(CLI::App& material) {
    CLI::App* command = material.add_subcommand(
        "import", "Read a subsurface material of a MaterialX document: open_pbr_surface or standard_surface");
    command->footer(R"(Examples:
  nacre material import wax.mtlx
  nacre material import wax.mtlx --json wax.json         to render with: nacre render bunny.obj --material wax.json
  nacre material import heads.mtlx --name skin --units cm --json skin.json)");
    const auto options = std::make_shared<ImportOptions>();
    command->add_option("FILE", options->document, "A MaterialX document (.mtlx)")->required()->type_name("");
    command
        ->add_option("--name", options->name,
                     "The shader node or surfacematerial to read, of a document with several shader nodes")
        ->type_name("NAME");
    command
        ->add_option("--units", options->units,
                     "What lengths are in whose input has no unit: m, cm, mm, in or ft; cm by default, with a note")
        ->type_name("UNIT")
        ->check(CLI::IsMember(unitNames()));
    addJsonOption(*command, options->json);
    command->callback([options] { importMaterial(*options); });
}

void addCheck(CLI::App& material) {
    CLI::App* command = material.add_subcommand("check", "Check material files: exit code 0 when all are valid");
    command->footer("Examples:\n  nacre material check my-skin.json\n  nacre material check materials/*.json");
    const auto files = std::make_shared<std::vector<std::filesystem::path>>();
    command->add_option("FILE", *files, "Material files (docs/schemas/material.schema.json)")
        ->required()
        ->type_name("");
    command->callback([files] { checkMaterials(*files); });
}

} // namespace

void addMaterial(CLI::App& app) {
    CLI::App* command = app.add_subcommand("material", "List, show, import, check and fit subsurface materials");
    command->require_subcommand(1);
    command->footer(R"(Examples:
  nacre material list
  nacre material show skin --json my-skin.json
  nacre material import wax.mtlx --json wax.json
  nacre material check my-skin.json
  nacre material fit my-skin.json
  nacre render bunny.obj --material my-skin.json)");
    addList(*command);
    addShow(*command);
    addImport(*command);
    addCheck(*command);
    addMaterialFit(*command);
}

} // namespace nacre::app
