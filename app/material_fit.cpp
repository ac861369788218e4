// `nacre material fit`: a material as Gaussian layers, and how far they are from it.
#include "app/material_fit.hpp"

#include "app/command.hpp"
#include "app/material_source.hpp"
#include "app/rgb_table.hpp"
#include "app/terminal_text.hpp"
#include "nacre/files.hpp"
#include "nacre/gaussian.hpp"
#include "nacre/layering.hpp"

#include <CLI/CLI.hpp>

#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

namespace nacre::app {

namespace {

struct FitOptions {
    std::string nameOrFile;
    std::string slabs;
    int layers = slabLayerCount;
    std::filesystem::path json;
};

/// Layers, how far their CDF is from the material's, and what a stack reflects and lets through.
struct Fit {
    std::vector<Layer> layers;
    Rgb cdfError{};
    std::optional<Rgb> reflectance;
    std::optional<Rgb> transmittance;
};

Fit fitSlabs(const std::vector<Slab>& slabs, int layerCount) {
    const LayeredMedium medium(slabs);
    Fit fit{
        medium.reflectanceLayers(layerCount).layers, {}, medium.diffuseReflectance(), medium.diffuseTransmittance()};
    fit.cdfError = medium.cdfError(fit.layers);
    return fit;
}

Fit fitMaterial(const Material& material, int layerCount) {
    if (!material.slabs.empty()) {
        return fitSlabs(material.slabs, layerCount);
    }
    if (material.layers.size() <= static_cast<std::size_t>(layerCount) && !material.layers.empty()) {
        return {normalized(material.layers), {}, {}, {}};
    }
    Material unscaled = material; // the scale stays beside the layers
    unscaled.scale = 1;
    LayerFit fit = fitLayers(*makeProfile(unscaled), layerCount);
    return {std::move(fit.layers), fit.maxError, {}, {}};
}

std::string describe(const Material& material, const Fit& fit) {
    std::ostringstream text;
    text << printable(material.name) << ": " << fit.layers.size() << " layers\n" << rgbHeader();
    for (const Layer& layer : fit.layers) {
        std::ostringstream label;
        label << "weight, variance " << std::setprecision(6) << layer.variance << " mm²";
        text << rgbRow(label.str(), layer.weight);
    }
    text << rgbRow("largest CDF error", fit.cdfError);
    if (fit.reflectance && fit.transmittance) {
        text << rgbRow("diffuse reflectance", *fit.reflectance) << rgbRow("diffuse transmittance", *fit.transmittance);
    }
    return text.str();
}

Material sourceOf(const FitOptions& options) {
    if (options.slabs.empty()) {
        return readMaterial(options.nameOrFile);
    }
    Material material = parseMaterial("{\"slabs\": " + options.slabs + "}", "--slabs");
    material.name = "slabs";
    return material;
}

void fit(const FitOptions& options) {
    if (options.nameOrFile.empty() == options.slabs.empty()) {
        throw UsageError(options.slabs.empty() ? "MATERIAL or --slabs is needed"
                                               : "MATERIAL and --slabs exclude each other");
    }
    requireDistinctFiles({materialFile(options.nameOrFile), options.json});
    requireRange(options.layers, 1, maxLayers, "--layers");
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
    Material material = sourceOf(options);
    const Fit result = fitMaterial(material, options.layers);
    if (options.json != "-") {
        std::cout << describe(material, result);
    }
    if (options.json.empty()) {
        return;
    }
    material.layers = result.layers;
    material.slabs.clear();
    material.meanFreePath.reset();
    writeText(options.json, formatMaterial(material));
}

} // namespace

void addMaterialFit(CLI::App& material) {
    CLI::App* command = material.add_subcommand("fit", "Fit Gaussian layers to a material, and say how close they are");
    command->footer(
        R"(A stack of slabs is fitted by what it reflects (docs/theory.md, section 3); the error is the largest difference
between the shares of light that leave within a radius. A material that has no more layers than are asked for is shown
as it is.

Examples:
  nacre material fit my-skin.json --json my-skin-layers.json
  nacre material fit skin-burley --layers 4
  nacre material fit --slabs '[{"skin": {"melanin": 0.03}, "thickness": 0.1},
                               {"skin": {"haemoglobin": 0.02, "water": 0.65}, "thickness": "infinite"}]')");
    const auto options = std::make_shared<FitOptions>();
    command->add_option("MATERIAL", options->nameOrFile, "A preset's name or a material file")->type_name("");
    command->add_option("--slabs", options->slabs, "Slabs as a material file has them, in place of MATERIAL")
        ->type_name("JSON");
    command->add_option("--layers", options->layers, "How many layers at most, 1 to 32")->capture_default_str();
    addJsonOption(*command, options->json)->description("Write the layers as a material file; - is standard output");
    command->callback([options] { fit(*options); });
}

} // namespace nacre::app
