// The passes' SPIR-V is part of the library. A developer build has spirv_of_files.cpp in this file's place.
#include "vulkan/pass_pipelines.hpp"

namespace nacre::effect {

std::span<const std::uint32_t> currentSpirv(const Pass& pass, std::vector<std::uint32_t>&) {
    return pass.spirv;
}

} // namespace nacre::effect
