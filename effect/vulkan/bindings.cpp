#include "vulkan/bindings.hpp"

#include "contract/validation.hpp"
#include "transmit/transmit_blocks.h"

namespace nacre::effect {
namespace {

NacreBinding binding(const char* name, std::uint32_t number, VkDescriptorType type) {
    NacreBinding result{};
    result.name = name;
    result.binding = number;
    result.type = type;
    result.count = 1;
    result.image = NACRE_IMAGE_SLOT_COUNT;
    return result;
}

NacreBinding buffer(const char* name, std::uint32_t number, VkDescriptorType type, std::size_t head,
                    std::size_t stride) {
    NacreBinding result = binding(name, number, type);
    result.head = head;
    result.stride = stride;
    return result;
}

NacreBinding image(NacreImageSlot slot, std::uint32_t number) {
    const NacreImageRequirements requirements = imageRequirements(slot);
    const bool isOutput = (requirements.usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0;
    NacreBinding result = binding(requirements.name, number,
                                  isOutput ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    result.count = slot == NACRE_IMAGE_SHADOW_MAP ? maxShadowMaps : 1;
    result.image = slot;
    return result;
}

NacreBinding intermediate(std::uint32_t index, VkExtent2D maxExtent) {
    const Intermediate& info = intermediates()[index];
    const bool isBuffer = info.format == VK_FORMAT_UNDEFINED;
    NacreBinding result = binding(info.name, bindingIntermediates + index,
                                  isBuffer ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    result.intermediate = VK_TRUE;
    result.format = info.format;
    result.array = info.array;
    if (isBuffer) {
        result.head = info.bytes(maxExtent);
    } else {
        result.extent = info.extent(maxExtent);
    }
    return result;
}

} // namespace

std::vector<NacreBinding> bindingsOf(CallKind kind, IntermediateSet used, VkExtent2D maxExtent) {
    const bool isScatter = kind == CallKind::Scatter;
    std::vector<NacreBinding> bindings{
        buffer("parameters", bindingParameters, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
               isScatter ? sizeof(ScatterParameters) : sizeof(TransmitParameters), 0),
        buffer("materials", bindingMaterials, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
               materialIdCount * sizeof(std::uint32_t), sizeof(MaterialParameters)),
        buffer("tables", bindingTables, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 0, 0),
        image(NACRE_IMAGE_DEPTH, bindingDepth),
        image(NACRE_IMAGE_MATERIAL_ID, bindingMaterialId),
        image(NACRE_IMAGE_NORMAL, bindingNormal),
        image(NACRE_IMAGE_STRENGTH, bindingStrength),
        image(NACRE_IMAGE_SCALE, bindingScale),
    };
    if (isScatter) {
        bindings.push_back(image(NACRE_IMAGE_IRRADIANCE, bindingIrradiance));
        bindings.push_back(image(NACRE_IMAGE_ALBEDO, bindingAlbedo));
        bindings.push_back(image(NACRE_IMAGE_SCATTERED, bindingScattered));
    } else {
        bindings.push_back(image(NACRE_IMAGE_THICKNESS, bindingThickness));
        bindings.push_back(
            buffer("lights", bindingLights, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 0, sizeof(LightParameters)));
        bindings.push_back(image(NACRE_IMAGE_SHADOW_MAP, bindingShadowMaps));
        bindings.push_back(image(NACRE_IMAGE_TRANSMITTED, bindingTransmitted));
        bindings.push_back(image(NACRE_IMAGE_THICKNESS_OUT, bindingThicknessOut));
    }
    for (std::uint32_t i = 0; i < maxIntermediates; ++i) {
        if (used >> i & 1u) {
            bindings.push_back(intermediate(i, maxExtent));
        }
    }
    return bindings;
}

} // namespace nacre::effect
