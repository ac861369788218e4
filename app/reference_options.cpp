#include "app/reference_options.hpp"

#include "app/command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>

namespace nacre::app {

namespace {

using reference::Method;

constexpr double defaultReferenceNoise = 2; // %
constexpr std::uint32_t maxParts = 1000000;
constexpr std::uint32_t maxReferenceSpp = 100000000;
constexpr unsigned maxThreads = 4096;

constexpr std::array methods{Method::Surface, Method::Walk};
constexpr std::array boundaries{reference::Boundary::Matched, reference::Boundary::Fresnel};

template <typename Value, std::size_t count>
std::string names(const std::array<Value, count>& values, const char* (*nameOf)(Value)) {
    std::string result;
    for (const Value value : values) {
        result += (result.empty() ? "" : ", ") + std::string(nameOf(value));
    }
    return result;
}

template <typename Value, std::size_t count>
Value find(const std::array<Value, count>& values, const char* (*nameOf)(Value), const std::string& name,
           const char* kind) {
    const auto found = std::ranges::find_if(values, [&](Value value) { return nameOf(value) == name; });
    if (found == values.end()) {
        throw UsageError("there is no " + std::string(kind) + " '" + name + "', only " + names(values, nameOf));
    }
    return *found;
}

reference::Part parsePart(const std::string& text) {
    if (text.empty()) {
        return {};
    }
    reference::Part part;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, part.index);
    const bool separated = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = separated ? std::from_chars(first.ptr + 1, end, part.count) : first;
    if (!separated || second.ec != std::errc() || second.ptr != end) {
        throw UsageError("--part '" + text + "' is not I/N, for example 3/8");
    }
    if (part.count < 1 || part.count > maxParts || part.index < 1 || part.index > part.count) {
        throw UsageError("--part " + text + " is outside 1/N to N/N, N up to " + std::to_string(maxParts));
    }
    return part;
}

const char* const examples = R"(
The picture is linear diffuse radiance (R G B), with the share of the pixel that is covered (A), the variance of the
radiance (variance.R variance.G variance.B), the material's number (material.ID, 0 where there is none) and the number
of samples (samples.N). Specular light, emission and the background are left out. FILE.exr.checkpoint beside it keeps
every sum, so that --resume goes on where a run stopped, also with a higher --spp or a lower --noise.

Examples:
  nacre reference head.glb --size 640x360 --noise 2 -o head.exr
  nacre reference head.glb --method walk --boundary fresnel -o walk.exr
  nacre reference scene.json --back --spp 256 -o back.exr --json back.json
  nacre reference scene.json --time 3600 --resume -o frame.exr
  nacre render scene.json -o r.exr --aov irradiance=e.exr
  nacre reference scene.json --direct e.exr -o same-shadows.exr
  nacre reference scene.json --spp 512 --part 3/8 -o part3.exr
  nacre reference merge frame.exr part1.exr part2.exr part3.exr …)";

} // namespace

ReferenceOptionParser::ReferenceOptionParser(CLI::App& command) : command_(command) {
    const auto add = [&command](const char* group, const char* name, auto& value, const std::string& description,
                                const char* type) {
        command.add_option(name, value, description)->type_name(type)->group(group)->allow_extra_args(false);
    };
    const auto addFlag = [&command](const char* group, const char* name, bool& value, const char* description) {
        command.add_flag(name, value, description)->group(group);
    };
    scene_.addScene(command);
    add("Picture", "-o,--output", options_.output, "FILE.exr; default " + options_.output.string(), "FILE");
    scene_.addPicture(command, "");

    add("Method", "--method", method_,
        "How light under the surface is computed: " + names(methods, reference::methodName) + "; default " + method_,
        "NAME");
    addFlag("Method", "--no-exchange", noExchange_, "surface: light stays within bodies of one material");
    add("Method", "--boundary", boundary_,
        "walk: whether light is reflected back into a body: " + names(boundaries, reference::boundaryName) +
            "; default " + boundary_,
        "NAME");
    add("Method", "--anisotropy", options_.settings.anisotropy,
        "walk: how forward light is scattered, -0.99 to 0.99; what is scattered in all stays the same; default 0", "G");
    add("Method", "--direct", options_.direct,
        "Take the light that enters where the camera sees it from this irradiance image of `nacre render`", "FILE.exr");

    add("Work", "--spp", spp_, "Stop after this many samples of every pixel", "N");
    add("Work", "--time", seconds_, "Stop after this time", "SECONDS");
    add("Work", "--noise", noise_,
        "Stop at this standard error over subsurface pixels; default 2 where neither --spp nor --time is given",
        "PERCENT");
    add("Work", "--seed", options_.settings.seed, "Other random numbers; default 1", "N");
    add("Work", "--threads", options_.settings.threads, "Default all cores", "N");
    add("Work", "--part", part_, "Only the I-th of N shares of the pixels, for `nacre reference merge`", "I/N");
    addFlag("Work", "--resume", options_.resume, "Go on from the checkpoint, where there is one");
    addFlag("Work", "--restart", options_.restart, "Throw an earlier checkpoint away");

    scene_.addLight(command);
    scene_.addCamera(command);
    addJsonOption(command, options_.json)->group("Results");
    command.footer(examples);
}

ReferenceOptions ReferenceOptionParser::finish() const {
    ReferenceOptions options = options_;
    static_cast<SceneOptions&>(options) = scene_.finish();
    options.settings.method = find(methods, reference::methodName, method_, "method");
    options.settings.boundary = find(boundaries, reference::boundaryName, boundary_, "boundary");
    if (options.settings.method == Method::Surface) {
        requireWith(command_, {"--boundary", "--anisotropy"}, "--method walk");
    } else {
        requireWith(command_, {"--no-exchange"}, "--method surface");
    }
    requireRange(options.settings.anisotropy, -0.99, 0.99, "--anisotropy");
    options.settings.width = options.width;
    options.settings.height = options.height;
    options.settings.samples = options.samples;
    options.settings.exchange = !noExchange_;
    options.settings.part = parsePart(part_);
    requireRange(options.settings.threads, 0, maxThreads, "--threads");
    if (spp_) {
        requireRange(*spp_, 1, maxReferenceSpp, "--spp");
    }
    if (seconds_) {
        requireRange(*seconds_, 1e-3, 1e9, "--time");
    }
    const bool noneGiven = !spp_ && !seconds_ && !noise_;
    const std::optional<double> noise = noneGiven ? defaultReferenceNoise : noise_;
    if (noise) {
        requireRange(*noise, 1e-3, 100, "--noise");
        options.stop.noise = *noise / 100;
    }
    options.stop.spp = spp_;
    options.stop.seconds = seconds_;
    if (options.output.extension() != ".exr") {
        throw UsageError("--output '" + options.output.string() + "' does not end in .exr");
    }
    if (options.resume && options.restart) {
        throw UsageError("--resume and --restart exclude each other");
    }
    requireDistinctFiles({options.input, options.material, options.direct, options.output, options.json});
    return options;
}

} // namespace nacre::app
