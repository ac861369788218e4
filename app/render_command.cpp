// `nacre render`: one picture of a scene, and the images and figures behind it.
#include "app/command.hpp"
#include "app/progress.hpp"
#include "app/render_options.hpp"
#include "app/render_scene.hpp"
#include "app/report.hpp"
#include "app/terminal_text.hpp"
#include "image/image_file.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <iterator>

namespace nacre::app {

namespace {

void writePicture(const std::filesystem::path& file, const renderer::Offscreen& renderer, std::uint32_t samples) {
    if (file.extension() == ".exr") {
        writeExr(file, reduced(renderer.read(renderer::Output::Radiance), samples));
    } else {
        writePng(file, renderer.read(renderer::Output::Color));
    }
}

void checkOutputs(const RenderOptions& options) {
    checkWritable(options.output);
    for (const AovOutput& aov : options.aovs) {
        checkWritable(aov.file);
    }
    if (!options.json.empty()) {
        checkWritable(options.json);
    }
}

std::vector<std::filesystem::path> outputsOf(const RenderOptions& options) {
    std::vector<std::filesystem::path> outputs{options.output, options.json};
    std::ranges::transform(options.aovs, std::back_inserter(outputs), &AovOutput::file);
    return outputs;
}

void summarise(const RenderOptions& options, const renderer::DeviceDescription& device,
               const renderer::FrameReport& frame) {
    std::cout << printable(options.output.string() + ": " + sceneName(options)) << ", " << options.settings.width << 'x'
              << options.settings.height << ", " << frame.triangles << " triangles, " << frame.materials
              << " materials, " << frame.lights << " lights\n"
              << "frame " << std::lround(frame.totalMicroseconds) << " µs on " << device.name << ", scatter "
              << frame.scatterDispatches << " and transmit " << frame.transmitDispatches << " dispatches\n";
}

void failOnValidation(const std::vector<std::string>& messages) {
    if (!messages.empty()) {
        throw std::runtime_error("the validation layer has " + std::to_string(messages.size()) +
                                 " messages, the first: " + messages.front());
    }
}

void render(const RenderOptions& options) {
    checkOutputs(options);
    renderer::Device device(options.device);
    const scene::Scene scene = [&] {
        const Progress progress("loading " + sceneName(options));
        scene::Scene loaded = makeScene(options);
        loaded.exposure *= std::exp2(options.exposure);
        return loaded;
    }();
    requireInputsKept(options, scene, outputsOf(options));
    const scene::Camera camera = makeCamera(options, scene);
    renderer::FrameReport frame;
    {
        const Progress progress("rendering " + sceneName(options));
        renderer::Offscreen renderer(device, scene, options.settings);
        renderer.render(camera);
        writePicture(options.output, renderer, options.settings.samples);
        for (const AovOutput& aov : options.aovs) {
            writeExr(aov.file, renderer.read(aov.output));
        }
        frame = renderer.report();
    }
    if (!options.json.empty()) {
        writeText(options.json,
                  makeReport(options, scene, camera, device.description(), frame, device.validationMessages()));
    }
    if (options.json != "-") {
        summarise(options, device.description(), frame);
        std::cout.flush();
    }
    printNotes(scene.notes);
    failOnValidation(device.validationMessages());
}

} // namespace

void addRender(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Render a scene, a model or the built-in gallery to an image");
    const auto parser = std::make_shared<RenderOptionParser>(*command);
    command->callback([parser] { render(parser->finish()); });
}

} // namespace nacre::app
