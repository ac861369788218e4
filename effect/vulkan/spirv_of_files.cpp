// The passes' SPIR-V is what lies in the build folder. Only in a developer build, in place of spirv_embedded.cpp.
#include "developer/shader_build.hpp"
#include "vulkan/pass_pipelines.hpp"

namespace nacre::effect {

std::span<const std::uint32_t> currentSpirv(const Pass& pass, std::vector<std::uint32_t>& storage) {
    storage = developer::readSpirv("effect", pass.file);
    return storage;
}

} // namespace nacre::effect
