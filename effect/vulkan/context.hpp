// Everything a context owns.
#pragma once

#include "technique.hpp"
#include "vulkan/call_ring.hpp"
#include "vulkan/intermediates.hpp"
#include "vulkan/material_table.hpp"
#include "vulkan/memory_layout.hpp"
#include "vulkan/objects.hpp"
#include "vulkan/pass_pipelines.hpp"

#include <optional>
#include <vector>

namespace nacre::effect {

struct Context {
    Device device;
    NacreMessageCallback messageCallback = nullptr;
    void* userData = nullptr;
    VkExtent2D maxExtent{};
    std::uint32_t maxLights = 0;
    std::array<bool, techniqueCount> enabled{};
    bool shaderFloat16 = false; ///< NacreContextInfo::shaderFloat16
    bool noMaterialIds = false; ///< NacreContextInfo::noMaterialIds
    NacreNormalEncoding normalEncoding = NACRE_NORMAL_XYZ;
    NacreNormalSpace normalSpace = NACRE_NORMAL_WORLD;

    CallLayout scatter;
    CallLayout transmit;
    TechniquePipelines pipelines;
    std::vector<Owned<VkPipeline>> bakedPasses; ///< of nacreBakeThesisKernel; empty = not baked
    std::uint32_t bakedRadius = 0;
    NacreMemory givenMemory{};                ///< the caller's, for the intermediates
    Owned<VkDeviceMemory> intermediateMemory; ///< else this
    IntermediateResources intermediates;
    Owned<VkDeviceMemory> hostMemory;       ///< of materials and uniforms, unless the caller gave it
    std::optional<MaterialTable> materials; ///< made once the device is known
    Buffer uniforms;
    Owned<VkDescriptorPool> pool;
    std::vector<Frame> frames;
    std::optional<std::uint32_t> frame; ///< last given to nacreBeginFrame
};

} // namespace nacre::effect

struct NacreContext_T : nacre::effect::Context {};
