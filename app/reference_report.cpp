#include "app/reference_report.hpp"

#include "app/json_report.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace nacre::app {

namespace {

constexpr int referenceReportVersion = 1;

} // namespace

std::pair<std::uint32_t, std::uint32_t> sppOf(const reference::Checkpoint& checkpoint) {
    std::uint32_t least = 0;
    std::uint32_t most = 0;
    bool any = false;
    for (std::uint32_t i = 0; i < checkpoint.film.pixels.size(); ++i) {
        if (checkpoint.part.has(i)) {
            const std::uint32_t count = checkpoint.film.pixels[i].count;
            least = any ? std::min(least, count) : count;
            most = std::max(most, count);
            any = true;
        }
    }
    return {least, most};
}

std::string makeReport(const ReferenceResult& result) {
    using Json = nlohmann::ordered_json;
    const reference::Film& film = result.checkpoint.film;
    const auto [least, most] = sppOf(result.checkpoint);
    Json settings = Json::object();
    for (const auto& [name, value] : result.checkpoint.identity) {
        settings[name] = value;
    }
    settings["part"] =
        std::to_string(result.checkpoint.part.index) + "/" + std::to_string(result.checkpoint.part.count);
    const double noise = film.noise();
    const Json report{{"schemaVersion", referenceReportVersion},
                      {"nacreVersion", NACRE_VERSION},
                      {"scene", describeScene(result.scene, result.notes)},
                      {"settings", settings},
                      {"spp", {{"least", least}, {"most", most}}},
                      {"noise", std::isfinite(noise) ? Json(noise) : Json(nullptr)},
                      {"stoppedBy", result.stoppedBy},
                      {"seconds", result.seconds},
                      {"totalSeconds", film.seconds},
                      {"samplesPerSecond", result.samplesPerSecond},
                      {"warnings", result.warnings},
                      {"file", result.file.string()}};
    return formatReport(report);
}

} // namespace nacre::app
