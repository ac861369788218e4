#include "app/view_report.hpp"

#include "app/json_report.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace nacre::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr int viewReportVersion = 1;
constexpr std::int64_t kibibyte = 1024;

Json toJson(const view::Distribution& times) {
    return {{"median", times.median}, {"p99", times.p99}};
}

Json toJson(const NamedRun& named) {
    const view::HeadlessRun& run = named.run;
    Json passes = Json::array();
    for (const auto& [name, median] : run.passes) {
        passes.push_back({{"name", name}, {"median", median}});
    }
    return {{"moving", movingName(named.moving)},
            {"frame", toJson(run.frame)},
            {"effect", toJson(run.effect)},
            {"processor", toJson(run.processor)},
            {"interval", toJson(run.interval)},
            {"passes", passes},
            {"memory", {{"frame", run.memoryFrame}, {"bytes", run.memory}, {"bytesAtEnd", run.memoryAtEnd}}},
            {"deviceAllocations", run.deviceAllocations},
            {"waits", run.waits}};
}

} // namespace

const char* movingName(view::Moving moving) {
    constexpr std::array names{"nothing", "lights", "material"};
    return names[static_cast<std::size_t>(moving)];
}

void printRun(std::ostream& out, const NamedRun& named) {
    constexpr std::array titles{"lights still", "lights moving", "material changing"};
    const view::HeadlessRun& run = named.run;
    std::array<char, 128> text{};
    const auto row = [&](const char* name, const view::Distribution& times) {
        std::snprintf(text.data(), text.size(), "  %-28s median %9.3f   p99 %9.3f\n", name, times.median, times.p99);
        out << text.data();
    };
    out << titles[static_cast<std::size_t>(named.moving)] << '\n';
    row("frame, device", run.frame);
    row("scatter and transmit, device", run.effect);
    row("frame, processor", run.processor);
    row("frame to frame", run.interval);
    out << "  memory after frame " << run.memoryFrame << ": " << run.memory / kibibyte << " KiB, at the end "
        << run.memoryAtEnd / kibibyte << " KiB; " << run.deviceAllocations << " device allocations, " << run.waits
        << " waits\n";
    for (const auto& [name, median] : run.passes) {
        std::snprintf(text.data(), text.size(), "    %-36s %9.3f\n", name.c_str(), median);
        out << text.data();
    }
}

std::string makeReport(const renderer::DeviceDescription& device, const nlohmann::ordered_json& scene,
                       const view::HeadlessSettings& settings, const std::vector<NamedRun>& runs) {
    Json report{{"schemaVersion", viewReportVersion},
                {"nacreVersion", NACRE_VERSION},
                {"device", {{"name", device.name}, {"kind", device.kind}, {"driver", device.driver}}},
                {"scene", scene},
                {"width", settings.width},
                {"height", settings.height},
                {"shadowMapSize", settings.shadowMapSize},
                {"frames", settings.frames},
                {"runs", Json::array()}};
    for (const NamedRun& run : runs) {
        report["runs"].push_back(toJson(run));
    }
    return formatReport(report);
}

} // namespace nacre::app
