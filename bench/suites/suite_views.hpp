// What the suites look at.
#pragma once

#include "bench/suites/suite_plan.hpp"

#include <filesystem>

namespace nacre::bench {

/// The gallery (no file), or a model or scene file, through its first camera, with the lights of a side: "front",
/// "back" or "both".
std::shared_ptr<const View> makeView(const std::filesystem::path& file, const char* side);

/// It, lit from the front and lit from behind.
struct Views {
    std::shared_ptr<const View> front;
    std::shared_ptr<const View> back;
};
Views makeViews(const std::filesystem::path& file);

/// The view, and close-ups of its `count` bodies with a subsurface material and the most triangles.
std::vector<std::shared_ptr<const View>> closeUps(const std::shared_ptr<const View>& view, std::size_t count);

/// Of one body, in the scene's units.
scene::Bounds boundsOf(const scene::Scene& scene, const scene::Instance& instance);

/// A camera on the side of `from` that sees the bounds fill most of the picture's height.
scene::Camera lookAt(const scene::Bounds& bounds, const scene::Camera& from);

} // namespace nacre::bench
