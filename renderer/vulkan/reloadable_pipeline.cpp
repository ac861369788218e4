#include "renderer/vulkan/reloadable_pipeline.hpp"

#include <utility>

namespace nacre::renderer {

ReloadablePipeline::ReloadablePipeline(Gpu& gpu, std::function<vk::raii::Pipeline()> make)
    : recipe_(std::make_shared<PipelineRecipe>(PipelineRecipe{.make = std::move(make)})) {
    recipe_->pipeline = recipe_->make();
    std::erase_if(gpu.pipelines, [](const std::weak_ptr<PipelineRecipe>& recipe) { return recipe.expired(); });
    gpu.pipelines.push_back(recipe_);
}

void reloadPipelines(Gpu& gpu) {
    std::vector<std::pair<std::shared_ptr<PipelineRecipe>, vk::raii::Pipeline>> made;
    for (const std::weak_ptr<PipelineRecipe>& recipe : gpu.pipelines) {
        if (std::shared_ptr<PipelineRecipe> alive = recipe.lock()) {
            vk::raii::Pipeline pipeline = alive->make();
            made.emplace_back(std::move(alive), std::move(pipeline));
        }
    }
    for (auto& [recipe, pipeline] : made) {
        recipe->pipeline = std::move(pipeline);
    }
}

} // namespace nacre::renderer
