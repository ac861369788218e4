// effect_timing: GPU times of the scatter techniques and of transmit on synthetic scenes, beside a copy pass, as a
// table and CSV.
// Times are GPU timestamps in microseconds: medians [5 %, 95 %] over rounds × 20 steady repeats. --help lists the
// options.
#include "tests/gpu/support/scene_input.hpp"
#include "tests/gpu/timing/copy_pass.hpp"
#include "tests/gpu/timing/measure.hpp"
#include "tests/gpu/timing/timing_options.hpp"
#include "tests/gpu/timing/transmit_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <list>
#include <map>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr ScatterFormats smallIds{VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8_UINT, VK_FORMAT_R32_SFLOAT,
                                  VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM};
constexpr ScatterFormats largeIds{VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R16_UINT, VK_FORMAT_R32_SFLOAT,
                                  VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM};

// What is on the screen.
struct Subject {
    SceneKind kind = SceneKind::Plane;
    VkExtent2D extent{};
    double footprint = 20;
    double coverage = 1; // planes: share of the pixels that scatter, a rectangle in the middle
    int layers = 6;
    int materials = 4;
    // px, planes: side of the blocks that each are of the next material. Where it is odd, half of their borders fall
    // into 2x2 px.
    std::uint32_t block = 8;
    std::string label() const {
        char text[128];
        std::snprintf(text, sizeof(text), "%s %ux%u cover %.0f%% footprint %.0f px, %d layers, %d materials",
                      sceneKindName(kind), extent.width, extent.height, 100 * coverage, footprint, layers, materials);
        const bool inBlocks = kind == SceneKind::Plane && materials > 1;
        return text + (inBlocks ? " in blocks of " + std::to_string(block) + " px" : std::string());
    }
};

struct Row {
    Subject subject;
    Timing timing;
};

// A material of skin's width in `layers` Gaussians.
Material layeredSkin(int layers) {
    if (layers == 6) {
        return skin();
    }
    Material material;
    material.name = "layers";
    for (int i = 0; i < layers; ++i) {
        const double share = layers == 1 ? 1 : i / (layers - 1.0);
        const double variance = layers == 1 ? 1.38 : 0.0064 * std::pow(7.41 / 0.0064, share);
        material.layers.push_back({{1, 1 - 0.5 * share, 1 - 0.9 * share}, variance});
    }
    return material;
}

// Planes: square blocks of every material in turn. The other scenes have the four test materials.
ScatterScene makeSubject(const Subject& subject) {
    SceneSettings settings{.kind = subject.kind,
                           .footprint = subject.footprint,
                           .width = static_cast<int>(subject.extent.width),
                           .height = static_cast<int>(subject.extent.height)};
    ScatterScene scene = makeScatterScene(settings);
    if (subject.kind != SceneKind::Plane) {
        return scene;
    }
    scene.materials.assign(static_cast<std::size_t>(subject.materials), layeredSkin(subject.layers));
    return scene;
}

// Material ids of a plane, which may exceed the scene's 8 bits.
void setPlaneIds(ScatterInput& input, const Subject& subject) {
    const double half = 0.5 * std::sqrt(subject.coverage);
    for (std::uint32_t y = 0; y < input.extent.height; ++y) {
        for (std::uint32_t x = 0; x < input.extent.width; ++x) {
            const bool covered = std::abs((x + 0.5) / input.extent.width - 0.5) <= half &&
                                 std::abs((y + 0.5) / input.extent.height - 0.5) <= half;
            const std::uint32_t block = x / subject.block + y / subject.block * (input.extent.width / subject.block);
            const std::uint32_t id = 1 + block % static_cast<std::uint32_t>(subject.materials);
            input.materialId[input.index(x, y)] = static_cast<std::uint16_t>(covered ? id : 0);
        }
    }
}

Variant makeVariant(Effect& effect, const ScatterImages& images, NacreTechnique technique, VkBool32 skipUnscattered) {
    NacreCost cost{};
    nacreGetScatterCost(effect.context, technique, &cost);
    Variant variant;
    variant.name = nacreTechniqueString(technique) + std::string(skipUnscattered ? " skipping" : "");
    variant.passes.assign(cost.passNames, cost.passNames + cost.passCount);
    variant.begin = [&effect] { nacreBeginFrame(effect.context, 0); };
    variant.record = [&effect, &images, technique, skipUnscattered](VkCommandBuffer commandBuffer, VkQueryPool pool,
                                                                    std::uint32_t first) {
        NacreScatterInfo info = images.info;
        info.technique = technique;
        info.skipUnscattered = skipUnscattered;
        info.timestamps = {pool, first};
        if (nacreCmdScatter(effect.context, commandBuffer, &info) != NACRE_SUCCESS) {
            throw std::runtime_error(effect.messages.back());
        }
    };
    return variant;
}

void print(const Timing& timing) {
    std::printf("  %-16s steady %8.1f [%7.1f %7.1f]  single %8.1f [%7.1f %7.1f]  n %zu ", timing.name.c_str(),
                timing.steady.median, timing.steady.p5, timing.steady.p95, timing.single.median, timing.single.p5,
                timing.single.p95, timing.steady.samples);
    for (std::size_t i = 0; timing.passes.size() > 1 && i < timing.passes.size(); ++i) {
        std::printf(" %s %.1f", timing.passNames[i].c_str(), timing.passes[i].median);
    }
    std::puts("");
}

std::vector<NacreTechnique> techniquesOr(const TimingOptions& options, std::vector<NacreTechnique> usual) {
    return options.techniques.empty() ? std::move(usual) : options.techniques;
}

// What a subject's variants use.
struct Stage {
    Stage(Gpu& gpu, const ScatterInput& input, const ScatterFormats& formats)
        : images(gpu, input, formats), copy(gpu, images.info) {}
    ScatterImages images;
    CopyPass copy;
};

// The copy pass, the techniques in turn, and the first of these again (their difference is the noise floor).
std::vector<Variant> makeVariants(Effect& effect, const Stage& stage, std::span<const NacreTechnique> techniques,
                                  const TimingOptions& options) {
    std::vector<Variant> variants;
    variants.push_back({"copy",
                        {"copy"},
                        [] {},
                        [&stage](VkCommandBuffer commandBuffer, VkQueryPool pool, std::uint32_t first) {
                            stage.copy.record(commandBuffer, pool, first);
                        }});
    for (const NacreTechnique technique : techniques) {
        for (const VkBool32 skipUnscattered : options.skipUnscattered) {
            variants.push_back(makeVariant(effect, stage.images, technique, skipUnscattered));
        }
    }
    variants.push_back(variants[1]);
    variants.back().name += " again";
    return variants;
}

// Subjects that differ in the materials on the screen alone, all in turn, in a context with those of the last, which
// has the most: so neither the time of day nor where things lie in memory is taken for a difference between them.
void measureSubjects(Gpu& gpu, std::span<const Subject> subjects, std::span<const NacreTechnique> techniques,
                     const TimingOptions& options, std::vector<Row>& rows) {
    const Subject& most = subjects.back();
    ScatterScene scene = makeSubject(most);
    for (Material& material : scene.materials) {
        material.albedoUse = options.albedo.value_or(material.albedoUse);
    }
    NacreContextInfo info = gpu.contextInfo(most.extent);
    info.recordsPerFrame = options.measure.repeats;
    info.shaderFloat16 = options.shaderFloat16 && gpu.shaderFloat16;
    info.maxMaterials = static_cast<std::uint32_t>(scene.materials.size());
    info.techniques = 0;
    for (const NacreTechnique technique : techniques) {
        info.techniques |= 1u << technique;
    }
    Effect effect(gpu, info);
    effect.setMaterials(scene.materials);
    ScatterInput input = toInput(scene);
    if (options.albedo) {
        input.albedo.assign(input.depth.size(), {0.75f, 0.5f, 0.25f, 1});
    }
    std::list<Stage> stages;
    std::vector<Variant> variants;
    for (const Subject& subject : subjects) {
        if (subject.kind == SceneKind::Plane) {
            setPlaneIds(input, subject);
        }
        const Stage& stage = stages.emplace_back(gpu, input, most.materials > 4 ? largeIds : smallIds);
        std::ranges::move(makeVariants(effect, stage, techniques, options), std::back_inserter(variants));
    }
    std::vector<Timing> timings = measure(gpu, variants, options.measure);
    const std::size_t perSubject = variants.size() / subjects.size();
    for (std::size_t i = 0; i < timings.size(); ++i) {
        const Subject& subject = subjects[i / perSubject];
        if (i % perSubject == 0) {
            std::printf("%s\n", subject.label().c_str());
        }
        print(timings[i]);
        rows.push_back({subject, std::move(timings[i])});
    }
    std::fflush(stdout);
}

void measureSubject(Gpu& gpu, const Subject& subject, std::span<const NacreTechnique> techniques,
                    const TimingOptions& options, std::vector<Row>& rows) {
    measureSubjects(gpu, {&subject, 1}, techniques, options, rows);
}

void printSlopes(const char* what, std::span<const Row> rows, double (*parameter)(const Subject&)) {
    std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> series;
    for (const Row& row : rows) {
        series[row.timing.name].first.push_back(parameter(row.subject));
        series[row.timing.name].second.push_back(row.timing.steady.median);
    }
    for (const auto& [name, points] : series) {
        const Line line = fitLine(points.first, points.second);
        std::printf("  %-16s %.2f us + (%.4f +- %.4f) us per %s\n", name.c_str(), line.intercept, line.slope,
                    line.confidence, what);
    }
}

// Of the kinds that `bank` was tuned on, those with edges.
constexpr SceneKind edgeKinds[] = {SceneKind::Spheres, SceneKind::Tilt, SceneKind::Thin};

void measureKinds(Gpu& gpu, std::span<const SceneKind> kinds, const TimingOptions& options, std::vector<Row>& rows) {
    const std::vector<NacreTechnique> techniques = techniquesOr(options, {NACRE_TECHNIQUE_BANK});
    for (const SceneKind kind : kinds) {
        measureSubject(gpu, {.kind = kind, .extent = options.extent, .footprint = 60}, techniques, options, rows);
    }
}

// One of each: a minute's answer to a change of shaders.
void runScenes(Gpu& gpu, const TimingOptions& options, std::vector<Row>& rows) {
    const Subject planes[] = {{.extent = options.extent},
                              {.extent = options.extent, .block = 45},
                              {.extent = options.extent, .layers = 8, .materials = 1},
                              {.extent = options.extent, .footprint = 60, .coverage = 0.25},
                              {.extent = options.extent, .footprint = 60, .coverage = 0}};
    const std::vector<NacreTechnique> techniques = techniquesOr(options, {NACRE_TECHNIQUE_BANK});
    for (const Subject& plane : planes) {
        measureSubject(gpu, plane, techniques, options, rows);
    }
    measureKinds(gpu, edgeKinds, options, rows);
}

// What nothing was tuned on, some of it edges all over.
void runHeldOut(Gpu& gpu, const TimingOptions& options, std::vector<Row>& rows) {
    measureKinds(gpu, heldOutSceneKinds, options, rows);
}

void runTargets(Gpu& gpu, const TimingOptions& options, std::vector<Row>& rows) {
    const std::vector<NacreTechnique> techniques{NACRE_TECHNIQUE_BANK};
    const std::vector<NacreTechnique> all = realTimeTechniques();
    for (const bool small : {true, false}) {
        const std::uint32_t scale = small ? 1 : 2;
        const VkExtent2D extent{scale * options.extent.width, scale * options.extent.height};
        for (const double footprint : {6.0, 20.0, 60.0}) {
            measureSubject(gpu, {.extent = extent, .footprint = footprint}, small ? all : techniques, options, rows);
            measureSubject(gpu, {.extent = extent, .footprint = footprint, .coverage = 0.25}, techniques, options,
                           rows);
        }
        for (const SceneKind kind : edgeKinds) {
            for (const double footprint : {6.0, 60.0}) {
                measureSubject(gpu, {.kind = kind, .extent = extent, .footprint = footprint}, techniques, options,
                               rows);
            }
        }
    }
}

void runFootprints(Gpu& gpu, const TimingOptions& options, std::vector<Row>& all) {
    const std::vector<NacreTechnique> techniques = techniquesOr(options, realTimeTechniques());
    std::vector<Row> rows;
    for (const double footprint : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0}) {
        measureSubject(gpu, {.extent = options.extent, .footprint = footprint, .materials = 1}, techniques, options,
                       rows);
    }
    printSlopes("px of footprint", rows, [](const Subject& subject) { return subject.footprint; });
    all.insert(all.end(), rows.begin(), rows.end());
}

void runLayers(Gpu& gpu, const TimingOptions& options, std::vector<Row>& all) {
    const std::vector<NacreTechnique> techniques = techniquesOr(options, realTimeTechniques());
    std::vector<Row> rows;
    for (const int layers : {1, 2, 4, 8, 16, 32}) {
        measureSubject(gpu, {.extent = options.extent, .layers = layers, .materials = 1}, techniques, options, rows);
    }
    printSlopes("layer", rows, [](const Subject& subject) { return static_cast<double>(subject.layers); });
    all.insert(all.end(), rows.begin(), rows.end());
}

// In blocks of 8 px, which is hard: every few pixels another material, each all over the picture. And in blocks of 40
// px, of which 1920x1080 has about as many as there are materials.
void runMaterials(Gpu& gpu, const TimingOptions& options, std::vector<Row>& all) {
    const std::vector<NacreTechnique> techniques = techniquesOr(options, realTimeTechniques());
    for (const std::uint32_t block : {8u, 40u}) {
        std::vector<Row> rows;
        std::vector<Subject> subjects;
        for (const int materials : {1, 5, 10, 50, 100, 500, 1000}) {
            subjects.push_back({.extent = options.extent, .materials = materials, .block = block});
        }
        measureSubjects(gpu, subjects, techniques, options, rows);
        const std::string what = "material in blocks of " + std::to_string(block) + " px";
        printSlopes(what.c_str(), rows, [](const Subject& subject) { return static_cast<double>(subject.materials); });
        all.insert(all.end(), rows.begin(), rows.end());
    }
}

// Three lights with shadow maps. Twice: the difference is the noise floor.
void runTransmit(Gpu& gpu, const TimingOptions& options, std::vector<Row>& rows) {
    constexpr std::uint32_t shadowMapSize = 2048;
    const Subject subject{.kind = SceneKind::Spheres, .extent = options.extent, .coverage = 0.25, .materials = 1};
    NacreContextInfo contextInfo = gpu.contextInfo(options.extent);
    contextInfo.recordsPerFrame = options.measure.repeats;
    contextInfo.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
    Effect effect(gpu, contextInfo);
    Material material = skin();
    material.translucency = 1;
    effect.setMaterials({&material, 1});
    const TransmitScene scene(gpu, subject.extent, subject.coverage, shadowMapSize);
    Variant variant{.name = "transmit", .passes = {"nacre transmit"}};
    variant.begin = [&effect] { nacreBeginFrame(effect.context, 0); };
    variant.record = [&](VkCommandBuffer commandBuffer, VkQueryPool pool, std::uint32_t first) {
        NacreTransmitInfo info = scene.info;
        info.timestamps = {pool, first};
        if (nacreCmdTransmit(effect.context, commandBuffer, &info) != NACRE_SUCCESS) {
            throw std::runtime_error(effect.messages.back());
        }
    };
    std::vector<Variant> variants(2, variant);
    variants[1].name += " again";
    std::printf("%s, 3 lights\n", subject.label().c_str());
    for (Timing& timing : measure(gpu, variants, options.measure)) {
        print(timing);
        rows.push_back({subject, std::move(timing)});
    }
    std::fflush(stdout);
}

void writeCsv(const TimingOptions& options, std::span<const Row> rows) {
    std::ofstream file(options.csv);
    file << "scene,width,height,coverage,footprint,layers,materials,block,technique,samples,"
            "steady_median_us,steady_p5_us,steady_p95_us,single_median_us,single_p5_us,single_p95_us,pass_medians_us\n";
    for (const auto& [subject, timing] : rows) {
        file << sceneKindName(subject.kind) << ',' << subject.extent.width << ',' << subject.extent.height << ','
             << subject.coverage << ',' << subject.footprint << ',' << subject.layers << ',' << subject.materials << ','
             << subject.block << ',' << timing.name << ',' << timing.steady.samples << ',' << timing.steady.median
             << ',' << timing.steady.p5 << ',' << timing.steady.p95 << ',' << timing.single.median << ','
             << timing.single.p5 << ',' << timing.single.p95 << ',';
        for (std::size_t i = 0; i < timing.passes.size(); ++i) {
            file << (i ? ";" : "") << timing.passNames[i] << '=' << timing.passes[i].median;
        }
        file << '\n';
    }
    if (!file.flush()) {
        throw std::runtime_error("cannot write " + options.csv);
    }
}

} // namespace

int main(int count, char** arguments) {
    try {
        if (count == 2 && std::string(arguments[1]) == "--help") {
            std::fputs(timingUsage, stdout);
            return 0;
        }
        const TimingOptions options = parseTimingOptions({arguments, static_cast<std::size_t>(count)});
        Gpu gpu(false);
        std::printf("%s, driver %u, half floats %s\n", gpu.properties.deviceName, gpu.properties.driverVersion,
                    options.shaderFloat16 && gpu.shaderFloat16 ? "on" : "off");
        std::vector<Row> rows;
        const std::pair<const char*, void (*)(Gpu&, const TimingOptions&, std::vector<Row>&)> suites[] = {
            {"scenes", runScenes}, {"held-out", runHeldOut},    {"targets", runTargets},  {"footprint", runFootprints},
            {"layers", runLayers}, {"materials", runMaterials}, {"transmit", runTransmit}};
        bool known = false;
        for (const auto& [name, run] : suites) {
            if (options.suite == "all" || options.suite == name) {
                known = true;
                run(gpu, options, rows);
            }
        }
        if (!known) {
            throw std::runtime_error(
                "--suite is '" + options.suite +
                "', must be scenes, held-out, targets, footprint, layers, materials, transmit or all");
        }
        writeCsv(options, rows);
        return 0;
    } catch (const std::exception& exception) {
        std::fprintf(stderr, "effect_timing: %s\n", exception.what());
        return 1;
    }
}
