#include "bench/effect/effect_suites.hpp"

#include "bench/effect/transmit_scene.hpp"
#include "bench/machine.hpp"
#include "bench/techniques.hpp"
#include "renderer/passes/copy_floor.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <ostream>
#include <sstream>

namespace nacre::bench {
namespace {

using Techniques = std::vector<NacreTechnique>;

// Of the kinds that `bank` was tuned on, those with edges.
constexpr SceneKind edgeKinds[] = {SceneKind::Spheres, SceneKind::Tilt, SceneKind::Thin};
constexpr double secondsBetweenReports = 5;

// What a subject's works use.
struct SubjectStage {
    SubjectStage(renderer::Gpu& gpu, const ScatterScene& scene, std::span<const std::uint16_t> ids, bool wideIds,
                 const EffectTimingOptions& options, const vk::raii::Sampler& nearest)
        : images(gpu, scene, ids, wideIds, options.albedo.has_value(), static_cast<vk::Format>(options.lightFormat)),
          copy(gpu, {images.irradiance, images.depth, images.materialId}, nearest) {}

    ScatterImages images;
    renderer::CopyFloor copy;
};

std::string format(const char* pattern, auto... values) {
    char text[256];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

class EffectSuite {
public:
    EffectSuite(renderer::Gpu& gpu, const EffectTimingOptions& options, const Reporter& say, std::ostream& out)
        : gpu_(gpu),
          options_(options),
          say_(say),
          out_(out),
          pipelines_(gpu.device, vk::PipelineCacheCreateInfo()),
          nearest_(gpu.device, vk::SamplerCreateInfo()) {}

    // One of each: a minute's answer to a change of shaders.
    void runScenes() {
        const ScatterSubject planes[] = {{.extent = options_.extent},
                                         {.extent = options_.extent, .block = 45},
                                         {.extent = options_.extent, .layers = 8, .materials = 1},
                                         {.extent = options_.extent, .footprint = 60, .coverage = 0.25},
                                         {.extent = options_.extent, .footprint = 60, .coverage = 0}};
        for (const ScatterSubject& plane : planes) {
            measureSubject(plane, techniquesOr({NACRE_TECHNIQUE_BANK}));
        }
        measureKinds(edgeKinds);
    }

    // What nothing was tuned on, some of it edges all over.
    void runHeldOut() { measureKinds(heldOutSceneKinds); }

    void runTargets() {
        const Techniques bank{NACRE_TECHNIQUE_BANK};
        for (const bool small : {true, false}) {
            const std::uint32_t scale = small ? 1 : 2;
            const VkExtent2D extent{scale * options_.extent.width, scale * options_.extent.height};
            for (const double footprint : {6.0, 20.0, 60.0}) {
                measureSubject({.extent = extent, .footprint = footprint}, small ? realTimeTechniques() : bank);
                measureSubject({.extent = extent, .footprint = footprint, .coverage = 0.25}, bank);
            }
            for (const SceneKind kind : edgeKinds) {
                for (const double footprint : {6.0, 60.0}) {
                    measureSubject({.kind = kind, .extent = extent, .footprint = footprint}, bank);
                }
            }
        }
    }

    void runFootprints() {
        const std::size_t first = rows_.size();
        for (const double footprint : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0}) {
            measureSubject({.extent = options_.extent, .footprint = footprint, .materials = 1},
                           techniquesOr(realTimeTechniques()));
        }
        printSlopes(first, "px of footprint", [](const ScatterSubject& subject) { return subject.footprint; });
    }

    void runLayers() {
        const std::size_t first = rows_.size();
        for (const int layers : {1, 2, 4, 8, 16, 32}) {
            measureSubject({.extent = options_.extent, .layers = layers, .materials = 1},
                           techniquesOr(realTimeTechniques()));
        }
        printSlopes(first, "layer", [](const ScatterSubject& subject) { return 1.0 * subject.layers; });
    }

    // In blocks of 8 px, which is hard: every few pixels another material, each all over the picture. And in blocks of
    // 40 px, of which 1920x1080 has about as many as there are materials.
    void runMaterials() {
        for (const std::uint32_t block : {8u, 40u}) {
            const std::size_t first = rows_.size();
            std::vector<ScatterSubject> subjects;
            for (const int materials : {1, 5, 10, 50, 100, 500, 1000}) {
                subjects.push_back({.extent = options_.extent, .materials = materials, .block = block});
            }
            measureSubjects(subjects, techniquesOr(realTimeTechniques()));
            printSlopes(first, "material in blocks of " + std::to_string(block) + " px",
                        [](const ScatterSubject& subject) { return 1.0 * subject.materials; });
        }
    }

    // Three lights with shadow maps. Twice: the difference is the noise floor.
    void runTransmit() {
        constexpr std::uint32_t shadowMapSize = 2048;
        const ScatterSubject subject{
            .kind = SceneKind::Spheres, .extent = options_.extent, .coverage = 0.25, .materials = 1};
        NacreContextInfo contextInfo = makeContextInfo();
        contextInfo.techniques = 1u << NACRE_TECHNIQUE_BANK;
        Material material = layeredSkin(subject.layers);
        material.secondSurfaces = false;
        material.translucency = 1;
        const EffectContext effect(contextInfo, {&material, 1});
        const TransmitScene scene(gpu_, subject.extent, subject.coverage, shadowMapSize);
        TimedWork work{.name = "transmit", .passes = {"nacre transmit"}, .begin = {}, .record = {}};
        work.begin = [&] { effect.check(nacreBeginFrame(effect.handle(), 0)); };
        work.record = [&](const vk::raii::CommandBuffer& commandBuffer, VkQueryPool pool, std::uint32_t first) {
            NacreTransmitInfo info = scene.info;
            info.timestamps = {pool, first};
            effect.check(nacreCmdTransmit(effect.handle(), *commandBuffer, &info));
        };
        std::vector<TimedWork> works(2, work);
        works[1].name += " again";
        out_ << subject.label() << ", 3 lights\n";
        for (WorkTimes& times : timeInTurns(gpu_, works, options_.timing, progressOf(subject.label()))) {
            addRow(subject, std::move(times));
        }
    }

    std::vector<EffectTime> takeRows() { return std::move(rows_); }

private:
    Techniques techniquesOr(const Techniques& usual) const {
        return options_.techniques.empty() ? usual : options_.techniques;
    }

    NacreContextInfo makeContextInfo() const {
        NacreContextInfo info = renderer::effectContextInfo(gpu_);
        info.pipelineCache = *pipelines_;
        info.maxExtent = options_.extent;
        info.recordsPerFrame = options_.timing.repeats;
        info.shaderFloat16 = options_.halfFloats && gpu_.halfFloats;
        return info;
    }

    TurnProgress progressOf(const std::string& what) {
        return [this, what](const char* step, std::size_t done, std::size_t all) {
            if (secondsSince(lastLine_) > secondsBetweenReports) {
                say_(what + ": " + step + " " + std::to_string(done) + " of " + std::to_string(all));
                lastLine_ = std::chrono::steady_clock::now();
            }
        };
    }

    TimedWork makeScatterWork(const EffectContext& effect, const ScatterImages& images, NacreTechnique technique,
                              VkBool32 skipUnscattered) const {
        NacreCost cost{};
        effect.check(nacreGetScatterCost(effect.handle(), technique, &cost));
        TimedWork work;
        work.name = nacreTechniqueString(technique) + std::string(skipUnscattered ? " skipping" : "");
        work.passes.assign(cost.passNames, cost.passNames + cost.passCount);
        work.begin = [&effect] { effect.check(nacreBeginFrame(effect.handle(), 0)); };
        work.record = [&effect, &images, technique, skipUnscattered](const vk::raii::CommandBuffer& commandBuffer,
                                                                     VkQueryPool pool, std::uint32_t first) {
            NacreScatterInfo info = images.info;
            info.technique = technique;
            info.skipUnscattered = skipUnscattered;
            info.timestamps = {pool, first};
            effect.check(nacreCmdScatter(effect.handle(), *commandBuffer, &info));
        };
        return work;
    }

    static TimedWork makeCopyWork(const SubjectStage& stage) {
        return {.name = "copy",
                .passes = {"copy"},
                .begin = [] {},
                .record =
                    [&stage](const vk::raii::CommandBuffer& commandBuffer, VkQueryPool pool, std::uint32_t first) {
                        const auto timestamp = [&](std::uint32_t query) {
                            if (pool != VK_NULL_HANDLE) {
                                commandBuffer.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, pool, query);
                            }
                        };
                        timestamp(first);
                        stage.copy.record(commandBuffer);
                        timestamp(first + 1);
                    }};
    }

    // The copy pass, the techniques in turn, and the first of these again: their difference is the noise floor.
    std::vector<TimedWork> makeWorks(const EffectContext& effect, const SubjectStage& stage,
                                     std::span<const NacreTechnique> techniques) const {
        std::vector<TimedWork> works{makeCopyWork(stage)};
        for (const NacreTechnique technique : techniques) {
            for (const VkBool32 skipUnscattered : options_.skipUnscattered) {
                works.push_back(makeScatterWork(effect, stage.images, technique, skipUnscattered));
            }
        }
        works.push_back(works[1]);
        works.back().name += " again";
        return works;
    }

    // Subjects that differ in the materials on the screen alone, all in turn, in a context with those of the last,
    // which has the most: so neither the time of day nor where things lie in memory is taken for a difference between
    // them.
    void measureSubjects(std::span<const ScatterSubject> subjects, std::span<const NacreTechnique> techniques) {
        const ScatterSubject& most = subjects.back();
        ScatterScene scene = makeSubjectScene(most);
        for (Material& material : scene.materials) {
            material.albedoUse = options_.albedo.value_or(material.albedoUse);
        }
        NacreContextInfo info = makeContextInfo();
        info.maxExtent = most.extent;
        info.maxMaterials = static_cast<std::uint32_t>(scene.materials.size());
        info.techniques = 0;
        for (const NacreTechnique technique : techniques) {
            info.techniques |= 1u << technique;
        }
        const EffectContext effect(info, scene.materials);
        std::list<SubjectStage> stages;
        std::vector<TimedWork> works;
        for (const ScatterSubject& subject : subjects) {
            const SubjectStage& stage =
                stages.emplace_back(gpu_, scene, scatterIds(scene, subject), most.materials > 4, options_, nearest_);
            std::ranges::move(makeWorks(effect, stage, techniques), std::back_inserter(works));
        }
        std::vector<WorkTimes> times = timeInTurns(gpu_, works, options_.timing, progressOf(most.label()));
        const std::size_t perSubject = works.size() / subjects.size();
        for (std::size_t i = 0; i < times.size(); ++i) {
            const ScatterSubject& subject = subjects[i / perSubject];
            if (i % perSubject == 0) {
                out_ << subject.label() << '\n';
            }
            addRow(subject, std::move(times[i]));
        }
        out_.flush();
    }

    void measureSubject(const ScatterSubject& subject, const Techniques& techniques) {
        measureSubjects({&subject, 1}, techniques);
    }

    void measureKinds(std::span<const SceneKind> kinds) {
        for (const SceneKind kind : kinds) {
            measureSubject({.kind = kind, .extent = options_.extent, .footprint = 60},
                           techniquesOr({NACRE_TECHNIQUE_BANK}));
        }
    }

    void addRow(const ScatterSubject& subject, WorkTimes times) {
        const auto column = [](const Summary& time) {
            return format("%8.1f [%7.1f %7.1f]", time.median, time.p5, time.p95);
        };
        out_ << format("  %-16s steady ", times.name.c_str()) << column(times.steady) << "  single "
             << column(times.single) << "  n " << times.steady.count << ' ';
        for (std::size_t i = 0; i < times.passes.size(); ++i) {
            out_ << ' ' << times.passNames[i] << format(" %.1f", times.passes[i].median);
        }
        out_ << '\n';
        rows_.push_back({subject, std::move(times)});
    }

    // Of the rows from `first` on, a line for each name.
    template <typename Parameter> void printSlopes(std::size_t first, const std::string& what, Parameter parameter) {
        std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> series;
        for (const EffectTime& row : std::span(rows_).subspan(first)) {
            series[row.times.name].first.push_back(parameter(row.subject));
            series[row.times.name].second.push_back(row.times.steady.median);
        }
        for (const auto& [name, points] : series) {
            const Line line = fitLine(points.first, points.second);
            out_ << format("  %-16s %.2f us + (%.4f +- %.4f) us per ", name.c_str(), line.intercept, line.slope,
                           (line.slopeHigh - line.slopeLow) / 2)
                 << what << '\n';
        }
    }

    renderer::Gpu& gpu_;
    const EffectTimingOptions& options_;
    const Reporter& say_;
    std::ostream& out_;
    vk::raii::PipelineCache pipelines_; ///< from one context to the next
    vk::raii::Sampler nearest_;
    std::vector<EffectTime> rows_;
    std::chrono::steady_clock::time_point lastLine_ = std::chrono::steady_clock::now();
};

struct NamedSuite {
    const char* name;
    void (EffectSuite::*run)();
};

constexpr NamedSuite effectSuites[] = {
    {"scenes", &EffectSuite::runScenes},    {"held-out", &EffectSuite::runHeldOut},
    {"targets", &EffectSuite::runTargets},  {"footprint", &EffectSuite::runFootprints},
    {"layers", &EffectSuite::runLayers},    {"materials", &EffectSuite::runMaterials},
    {"transmit", &EffectSuite::runTransmit}};
constexpr const char* allSuites = "all";

} // namespace

std::vector<std::string> effectSuiteNames() {
    std::vector<std::string> names;
    for (const NamedSuite& suite : effectSuites) {
        names.emplace_back(suite.name);
    }
    names.emplace_back(allSuites);
    return names;
}

std::vector<EffectTime> runEffectSuite(renderer::Device& device, const EffectTimingOptions& options,
                                       const Reporter& say, std::ostream& out) {
    renderer::Gpu& gpu = device.implementation();
    const renderer::DeviceDescription& description = device.description();
    out << description.name << " (" << description.kind << "), " << description.driver << ", Vulkan "
        << description.apiVersion << ", half floats " << (options.halfFloats && gpu.halfFloats ? "on" : "off") << '\n';
    EffectSuite suite(gpu, options, say, out);
    for (const NamedSuite& each : effectSuites) {
        if (options.suite == allSuites || options.suite == each.name) {
            (suite.*each.run)();
        }
    }
    for (const Clock& clock : readClocks(description.name, description.kind == "software")) {
        out << "clock of " << clock.name << " at the end: " << format("%.0f MHz", clock.before) << '\n';
    }
    return suite.takeRows();
}

std::string formatEffectCsv(std::span<const EffectTime> rows) {
    std::ostringstream csv;
    csv << "scene,width,height,coverage,footprint,layers,materials,block,technique,samples,"
           "steady_median_us,steady_p5_us,steady_p95_us,single_median_us,single_p5_us,single_p95_us,pass_medians_us\n";
    for (const auto& [subject, times] : rows) {
        csv << sceneKindName(subject.kind) << ',' << subject.extent.width << ',' << subject.extent.height << ','
            << subject.coverage << ',' << subject.footprint << ',' << subject.layers << ',' << subject.materials << ','
            << subject.block << ',' << times.name << ',' << times.steady.count << ',' << times.steady.median << ','
            << times.steady.p5 << ',' << times.steady.p95 << ',' << times.single.median << ',' << times.single.p5 << ','
            << times.single.p95 << ',';
        for (std::size_t i = 0; i < times.passes.size(); ++i) {
            csv << (i > 0 ? ";" : "") << times.passNames[i] << '=' << times.passes[i].median;
        }
        csv << '\n';
    }
    return csv.str();
}

} // namespace nacre::bench
