// The JSON that `nacre render --json` writes; docs/schemas/report.schema.json describes it.
#pragma once

#include "app/render_options.hpp"
#include "renderer/offscreen.hpp"
#include "scene/scene.hpp"

#include <string>

namespace nacre::app {

std::string makeReport(const RenderOptions& options, const scene::Scene& scene, const scene::Camera& camera,
                       const renderer::DeviceDescription& device, const renderer::FrameReport& frame,
                       const std::vector<std::string>& validationMessages);

} // namespace nacre::app
