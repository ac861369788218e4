// What a suite measures: configurations in series, as data.
#pragma once

#include "renderer/offscreen.hpp"
#include "scene/scene.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nacre::bench {

/// A scene and how it is looked at.
struct View {
    std::string name;
    std::shared_ptr<const scene::Scene> scene;
    scene::Camera camera;
};

struct Size {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// One thing to measure.
struct Configuration {
    std::string technique; ///< what the results call it
    renderer::EffectSettings effect;
    std::shared_ptr<const View> view;
    Size size;
    std::uint32_t shadowMapSize = 2048;
    std::vector<Material> materials; ///< in place of the scene's
    double value = 0;                ///< of the series' variable
    std::string unit;                ///< of `value` where it is not the series'
};

/// Configurations that are compared with each other, measured in turn.
struct Series {
    std::string name;
    std::string variable;
    std::string unit;
    std::vector<Configuration>
        configurations;          ///< not empty; with `errorAt` all of one view and with the same materials
    std::optional<Size> errorAt; ///< compare each picture, enlarged to this size, with that of technique `brute`
};

/// A picture pair of the report.
struct Picture {
    std::string series;
    std::string title;
    std::string name; ///< of the files
    std::shared_ptr<const View> view;
    Size size;
    std::vector<Material> materials;
    renderer::EffectSettings before;
    std::string beforeText;
    renderer::EffectSettings after;
    std::string afterText;
};

struct Plan {
    std::string suite;
    std::string scene;
    std::vector<Series> series;
    std::vector<Picture> pictures;
};

/// What of the files of its views was left out or assumed (Scene::notes), each sentence once.
std::vector<std::string> notesOf(const Plan& plan);

/// Pixels per millimetre at the camera's target.
double pixelsPerMillimeter(const View& view, const Size& size);

/// NacreBaselineSettings::thesisStrength at which the thesis's kernel of `radius` texels has its offsets where they
/// belong at the camera's target.
float thesisStrength(const View& view, const Size& size, std::uint32_t radius);

/// px: rms radius of the widest channel of the widest material, at the camera's target.
double footprint(const View& view, const Size& size, const std::vector<Material>& materials);

} // namespace nacre::bench
