#include "bench/suites/configuration_stage.hpp"

namespace nacre::bench {
namespace {

renderer::RenderSettings settingsOf(const Configuration& configuration) {
    renderer::RenderSettings settings{configuration.effect};
    settings.width = configuration.size.width;
    settings.height = configuration.size.height;
    settings.shadowMapSize = configuration.shadowMapSize;
    settings.copyFloor = true;
    settings.effectRepetitions = mostRepetitions;
    settings.shadowMapsEveryFrame = true; // so that a frame's time is that of one whose lights move
    return settings;
}

/// None asks for another technique than the one that is measured.
std::vector<Material> askingForNothing(std::vector<Material> materials) {
    for (Material& material : materials) {
        material.secondSurfaces = false;
    }
    return materials;
}

} // namespace

void Stage::select(const Configuration& configuration) {
    if (selected_ == &configuration) {
        return;
    }
    const Key key{configuration.view.get(), configuration.size.width, configuration.size.height,
                  configuration.shadowMapSize};
    auto found = actors_.find(key);
    if (found == actors_.end()) {
        renderer::Offscreen renderer(device_, *configuration.view->scene, settingsOf(configuration));
        found = actors_.emplace(key, Actor{std::move(renderer)}).first;
    }
    actor_ = &found->second;
    if (actor_->configuration == nullptr || actor_->configuration->materials != configuration.materials) {
        actor_->renderer.setMaterials(askingForNothing(configuration.materials));
    }
    actor_->renderer.setEffect(configuration.effect);
    actor_->configuration = &configuration;
    selected_ = &configuration;
}

const renderer::FrameReport& Stage::renderFrame(renderer::Timing timing) {
    actor_->renderer.render(selected_->view->camera, timing);
    actor_->rendered = true;
    return actor_->renderer.report();
}

const renderer::FrameReport& Stage::renderEffect(std::uint32_t repetitions) {
    if (!actor_->rendered) {
        renderFrame();
    }
    actor_->renderer.renderEffect(repetitions);
    return actor_->renderer.report();
}

} // namespace nacre::bench
