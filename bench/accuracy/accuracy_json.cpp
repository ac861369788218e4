#include "bench/accuracy/accuracy_json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace nacre::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int accuracyVersion = 1;

Json toJson(const AccuracyViewResult& view);

Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json toJson(const AccuracyFigures& figures) {
    return {{"pixels", figures.pixels},
            {"psnr", finite(figures.psnr)},
            {"psnrWithoutNoise", finite(figures.psnrWithoutNoise)},
            {"isBound", figures.isBound},
            {"energyRatio", {finite(figures.energy[0]), finite(figures.energy[1]), finite(figures.energy[2])}}};
}

Json toJson(const AccuracyReference& reference) {
    return {{"method", reference.method},       {"spp", reference.samples},
            {"noise", finite(reference.noise)}, {"noisePsnr", finite(reference.noisePsnr)},
            {"seconds", reference.seconds},     {"warnings", reference.warnings}};
}

Json toJson(const AccuracyCell& cell) {
    Json json{{"technique", cell.technique}, {"reference", cell.reference}};
    json.update(toJson(cell.whole));
    json["flip"] = cell.flip;
    json["thin"] = cell.thin ? toJson(*cell.thin) : Json(nullptr);
    return json;
}

template <typename Item> Json toJson(const std::vector<Item>& items) {
    Json array = Json::array();
    for (const Item& item : items) {
        array.push_back(toJson(item));
    }
    return array;
}

Json toJson(const AccuracyViewResult& view) {
    return {{"name", view.name},
            {"what", view.what},
            {"shadowMapSize", view.shadowMapSize},
            {"references", toJson(view.references)},
            {"cells", toJson(view.cells)}};
}

} // namespace

std::string formatAccuracyJson(const AccuracyResults& results) {
    const Json json{{"schemaVersion", accuracyVersion}, {"nacreVersion", results.nacreVersion},
                    {"device", results.device},         {"width", results.width},
                    {"height", results.height},         {"views", toJson(results.views)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace nacre::bench
