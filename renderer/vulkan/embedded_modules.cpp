// Shaders are part of the program. A developer build has modules_of_files.cpp in this file's place.
#include "renderer/vulkan/reloadable_pipeline.hpp"

namespace nacre::renderer {

vk::raii::ShaderModule makeShaderModule(const Gpu& gpu, const EmbeddedShader& shader) {
    return {gpu.device, {.codeSize = shader.words.size_bytes(), .pCode = shader.words.data()}};
}

bool shadersMayChange() {
    return false;
}

NacreResult reloadEffectShaders(NacreContext) {
    return NACRE_ERROR_INVALID_ARGUMENT;
}

} // namespace nacre::renderer
