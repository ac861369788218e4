// Pipelines that can be made anew from shaders that have changed, as a developer build does. Internal to the renderer.
#pragma once

#include "cmake/embedded_shader.hpp"
#include "nacre/nacre.h"
#include "renderer/vulkan/open_device.hpp"

#include <functional>
#include <memory>

namespace nacre::renderer {

/// A pipeline, and how it is made.
struct PipelineRecipe {
    std::function<vk::raii::Pipeline()> make;
    vk::raii::Pipeline pipeline = nullptr;
};

class ReloadablePipeline {
public:
    ReloadablePipeline() = default;
    /// Calls `make`, now and in every reloadPipelines; what it refers to has to outlive the pipeline.
    ReloadablePipeline(Gpu& gpu, std::function<vk::raii::Pipeline()> make);

    vk::Pipeline operator*() const { return *recipe_->pipeline; }

private:
    std::shared_ptr<PipelineRecipe> recipe_;
};

/// Makes all of the device's reloadable pipelines anew, which it must not be using. When one cannot be made all stay.
void reloadPipelines(Gpu& gpu);

/// A module of a shader as it is now: as the program was built with or, in a developer build, of its file
/// (embedded_modules.cpp, modules_of_files.cpp).
vk::raii::ShaderModule makeShaderModule(const Gpu& gpu, const EmbeddedShader& shader);
/// Whether shaders can change: true in a developer build.
bool shadersMayChange();
/// nacreReloadShaders, which compiles the renderer's shaders, too. Only where shaders may change.
NacreResult reloadEffectShaders(NacreContext context);

} // namespace nacre::renderer
