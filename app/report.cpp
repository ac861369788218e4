#include "app/report.hpp"

#include "app/json_report.hpp"
#include "app/render_scene.hpp"

#include <nlohmann/json.hpp>

namespace nacre::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr int reportVersion = 1;

Json toJson(const glm::vec3& value) {
    return Json::array({value.x, value.y, value.z});
}

Json describe(const renderer::DeviceDescription& device) {
    return {{"name", device.name}, {"kind", device.kind}, {"driver", device.driver}, {"apiVersion", device.apiVersion}};
}

Json describe(const Material& material) {
    return {{"name", material.name},
            {"layers", material.layers.size()},
            {"secondSurfaces", asksForSecondSurfaces(material)}};
}

Json describe(const scene::Camera& camera) {
    const bool perspective = camera.projection == scene::ProjectionKind::Perspective;
    Json result{{"name", camera.name},
                {"position", toJson(camera.position)},
                {"target", toJson(camera.target)},
                {"projection", perspective ? "perspective" : "orthographic"}};
    if (perspective) {
        result["verticalFieldOfView"] = camera.verticalFieldOfView;
    } else {
        result["orthographicHeight"] = camera.orthographicHeight;
    }
    return result;
}

Json describe(const RenderOptions& options, const scene::Scene& scene, const scene::Camera& camera) {
    const renderer::RenderSettings& settings = options.settings;
    return {{"width", settings.width},
            {"height", settings.height},
            {"samples", settings.samples},
            {"technique", nacreTechniqueString(settings.technique)},
            {"scatter", settings.scatter},
            {"transmit", settings.transmit},
            {"shadowMapSize", settings.shadowMapSize},
            {"exposure", scene.exposure},
            {"camera", describe(camera)}};
}

Json describe(const scene::Scene& scene, const renderer::FrameReport& frame, const std::string& name) {
    Json materials = Json::array();
    for (const Material& material : scene.materials) {
        materials.push_back(describe(material));
    }
    Json lights = Json::array();
    for (const scene::Light& light : scene.lights) {
        lights.push_back(light.name);
    }
    Json result = describeScene(name, scene.notes);
    result.update({{"triangleCount", frame.triangles},
                   {"lightCount", frame.lights},
                   {"materialCount", frame.materials},
                   {"lights", lights},
                   {"materials", materials}});
    return result;
}

Json describe(const renderer::FrameReport& frame) {
    Json passes = Json::array();
    for (const renderer::PassTime& pass : frame.passes) {
        passes.push_back({{"name", pass.name}, {"microseconds", pass.microseconds}});
    }
    return {{"totalMicroseconds", frame.totalMicroseconds},
            {"recordingMicroseconds", frame.recordingMicroseconds},
            {"passes", passes},
            {"scatterDispatches", frame.scatterDispatches},
            {"transmitDispatches", frame.transmitDispatches},
            {"effectBytes", frame.effectBytes},
            {"subsurfaceCoverage", frame.subsurfaceCoverage}};
}

Json describeFiles(const RenderOptions& options) {
    Json files = Json::array({{{"image", "color"}, {"file", options.output.string()}}});
    for (const AovOutput& aov : options.aovs) {
        files.push_back({{"image", aov.name}, {"file", aov.file.string()}});
    }
    return files;
}

} // namespace

std::string makeReport(const RenderOptions& options, const scene::Scene& scene, const scene::Camera& camera,
                       const renderer::DeviceDescription& device, const renderer::FrameReport& frame,
                       const std::vector<std::string>& validationMessages) {
    const Json report{{"schemaVersion", reportVersion},
                      {"nacreVersion", NACRE_VERSION},
                      {"device", describe(device)},
                      {"scene", describe(scene, frame, sceneName(options))},
                      {"settings", describe(options, scene, camera)},
                      {"frame", describe(frame)},
                      {"files", describeFiles(options)},
                      {"validationMessages", validationMessages}};
    return formatReport(report);
}

} // namespace nacre::app
