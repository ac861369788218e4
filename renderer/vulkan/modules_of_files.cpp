// Shaders are what lies in the build folder. Only in a developer build, in place of embedded_modules.cpp.
#include "developer/shader_build.hpp"
#include "effect/api/nacre_developer.h"
#include "renderer/vulkan/reloadable_pipeline.hpp"

namespace nacre::renderer {

vk::raii::ShaderModule makeShaderModule(const Gpu& gpu, const EmbeddedShader& shader) {
    std::vector<std::uint32_t> words;
    try {
        words = developer::readSpirv("renderer", shader.name);
    } catch (const std::runtime_error& error) {
        throw RendererError(error.what());
    }
    return {gpu.device, {.codeSize = words.size() * sizeof(std::uint32_t), .pCode = words.data()}};
}

bool shadersMayChange() {
    return true;
}

NacreResult reloadEffectShaders(NacreContext context) {
    return nacreReloadShaders(context);
}

} // namespace nacre::renderer
