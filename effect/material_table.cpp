#include "material_table.hpp"

#include "failure.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nacre::effect {
namespace {

std::string fieldName(std::uint32_t id, const std::string& field) {
    return "NacreMaterial::" + field + " of material " + std::to_string(id);
}

/// The library's material of the caller's; checks what core cannot see.
Material convert(std::uint32_t id, const NacreMaterial& from) {
    if (from.layerCount > NACRE_MAX_LAYERS) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, fieldName(id, "layerCount"), " is ", from.layerCount, ", at most ",
             NACRE_MAX_LAYERS);
    }
    if (from.layerCount > 0 && !from.layers) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, fieldName(id, "layers"), " is null, layerCount is ", from.layerCount);
    }
    if (from.albedoUse != NACRE_ALBEDO_POST && from.albedoUse != NACRE_ALBEDO_PRE_AND_POST) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, fieldName(id, "albedoUse"), " is ", static_cast<int>(from.albedoUse));
    }
    if (!std::isfinite(from.thickness) || from.thickness < 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, fieldName(id, "thickness"), " is ", from.thickness,
             " mm, must be finite and not negative");
    }
    Material material;
    for (const NacreLayer& layer : std::span(from.layers, from.layerCount)) {
        material.layers.push_back({{layer.weight[0], layer.weight[1], layer.weight[2]}, layer.variance});
    }
    if (from.layerCount == 0) {
        material.meanFreePath = {from.meanFreePath[0], from.meanFreePath[1], from.meanFreePath[2]};
    }
    material.strength = from.strength;
    material.translucency = from.translucency;
    material.scale = from.scale == 0 ? 1 : from.scale;
    if (const std::string fault = findFault(material); !fault.empty()) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, "NacreMaterial of material ", id, ": ", fault);
    }
    return material;
}

MaterialParameters parametersOf(const NacreMaterial& from, const Profile& profile) {
    MaterialParameters parameters{};
    parameters.radius = static_cast<float>(profile.quantileRadius(radiusShare));
    parameters.strength = from.strength;
    parameters.translucency = from.translucency;
    parameters.thickness = from.thickness;
    parameters.set = 1;
    parameters.exchangeGroups = from.exchangeGroups;
    parameters.preAndPost = from.albedoUse == NACRE_ALBEDO_PRE_AND_POST;
    return parameters;
}

} // namespace

MaterialTable::MaterialTable(const Device& device, std::uint32_t maxMaterial, std::uint32_t frames,
                             const std::array<bool, techniqueCount>& enabled)
    : maxMaterial_(maxMaterial) {
    const VkDeviceSize alignment = std::max<VkDeviceSize>(device.limits.minStorageBufferOffsetAlignment, 16);
    VkDeviceSize size = 0;
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        const bool isParameters = i == techniqueCount;
        const VkDeviceSize stride = isParameters ? sizeof(MaterialParameters)
                                    : enabled[i] ? VkDeviceSize{techniques[i]->tableBytes}
                                                 : 0;
        const VkDeviceSize bytes = stride * (maxMaterial + 1);
        if (bytes > device.limits.maxStorageBufferRange) {
            fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreContextInfo::maxMaterials is ", maxMaterial, ": the table of ",
                 isParameters ? "materials" : techniques[i]->name, " would take ", bytes,
                 " bytes, the device's maxStorageBufferRange is ", device.limits.maxStorageBufferRange,
                 "; leave techniques out in NacreContextInfo::techniques or lower it");
        }
        sections_[i] = {size, stride};
        size += (bytes + alignment - 1) / alignment * alignment;
    }
    current_.resize(size);
    isSet_.resize(maxMaterial + 1);
    frames_.resize(frames);
    for (Frame& frame : frames_) {
        frame.buffer = createHostBuffer(device, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "nacre materials");
        std::memset(frame.buffer.mapped, 0, size);
        frame.changed.reserve(maxMaterial + 1);
        frame.isChanged.resize(maxMaterial + 1);
        frame.ids.reserve(maxMaterial + 1);
        frame.isSet.resize(maxMaterial + 1);
    }
}

void MaterialTable::set(std::uint32_t firstId, std::span<const NacreMaterial> materials) {
    std::size_t blockBytes = 0;
    for (const Section& section : sections_) {
        blockBytes += section.stride;
    }
    // Built apart and copied in the end: a material that is refused leaves the earlier ones as they were.
    std::vector<std::byte> blocks(blockBytes * materials.size());
    std::span<std::byte> free = blocks;
    const auto take = [&free](const Section& section) {
        const std::span<std::byte> part = free.first(section.stride);
        free = free.subspan(section.stride);
        return part;
    };
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Material material = convert(firstId + static_cast<std::uint32_t>(i), materials[i]);
        const std::unique_ptr<Profile> profile = makeProfile(material);
        for (std::size_t technique = 0; technique < techniqueCount; ++technique) {
            if (const std::span<std::byte> table = take(sections_[technique]); !table.empty()) {
                techniques[technique]->buildTable(material, *profile, table);
            }
        }
        const MaterialParameters parameters = parametersOf(materials[i], *profile);
        std::memcpy(take(sections_.back()).data(), &parameters, sizeof(parameters));
    }
    const std::byte* block = blocks.data();
    for (std::uint32_t id = firstId; id < firstId + materials.size(); ++id) {
        for (const Section& section : sections_) {
            std::memcpy(current_.data() + section.offset + section.stride * id, block, section.stride);
            block += section.stride;
        }
        setCount_ += isSet_[id] ? 0 : 1;
        isSet_[id] = true;
        for (Frame& frame : frames_) {
            if (!frame.isChanged[id]) {
                frame.isChanged[id] = true;
                frame.changed.push_back(id);
            }
        }
    }
    findSeparate();
}

void MaterialTable::findSeparate() {
    std::uint32_t common = 0xffffffffu;
    for (std::uint32_t id = 1; id <= maxMaterial_; ++id) {
        MaterialParameters parameters;
        std::memcpy(&parameters, current_.data() + sections_.back().offset + sections_.back().stride * id,
                    sizeof(parameters));
        common &= parameters.set != 0 ? parameters.exchangeGroups : 0xffffffffu;
    }
    haveSeparate_ = common == 0;
}

void MaterialTable::update(std::uint32_t index) {
    Frame& frame = frames_[index];
    for (const std::uint32_t id : frame.changed) {
        for (const Section& section : sections_) {
            const VkDeviceSize at = section.offset + section.stride * id;
            std::memcpy(frame.buffer.mapped + at, current_.data() + at, section.stride);
        }
        frame.isChanged[id] = false;
        if (!frame.isSet[id]) {
            frame.isSet[id] = true;
            frame.ids.push_back(id);
        }
    }
    frame.changed.clear();
    frame.haveSeparate = haveSeparate_;
}

VkDescriptorBufferInfo MaterialTable::range(std::uint32_t frame, const Section& section) const {
    return {frames_[frame].buffer.buffer.get(), section.offset, section.stride * (maxMaterial_ + 1)};
}

} // namespace nacre::effect
