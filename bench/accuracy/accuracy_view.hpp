// One of the views that techniques are compared with references on.
#pragma once

#include "bench/suites/suite_plan.hpp"

#include <filesystem>
#include <functional>

namespace nacre::bench {

/// A view without specular reflection and emission, so that its picture is diffuse radiance, as a reference's is.
struct AccuracyView : View {
    std::uint32_t shadowMapSize = 4096; ///< texels a side
};

/// A view by its name; the scene is made when it is asked for.
struct AccuracyViewEntry {
    std::string name;
    std::string what; ///< what it shows, a phrase
    std::function<AccuracyView()> make;
};

/// The fixed set: planes, balls, thin parts from both sides, a fin, bodies that touch, surroundings alone, point and
/// spot lights, the gallery and its bodies. The small bodies are of skin-burley (the leaf of leaf) unless their text
/// says otherwise, in the dark but for the light that it names.
std::vector<AccuracyViewEntry> accuracyViews();

/// A model or scene file from its first camera, lit from the front and from behind. Where it has no subsurface material
/// it is of skin-burley.
std::vector<AccuracyViewEntry> accuracyViewsOf(const std::filesystem::path& file);

} // namespace nacre::bench
