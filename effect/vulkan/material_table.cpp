#include "vulkan/material_table.hpp"

#include "contract/effect_error.hpp"
#include "contract/material_check.hpp"

#include <algorithm>
#include <cstring>

namespace nacre::effect {
namespace {

constexpr VkDeviceSize leastAlignment = 128; // a line of a cache, of which tables are made (blocks.h)

// The first enabled technique that builds the same table.
std::size_t tableOf(std::size_t technique, const std::array<bool, techniqueCount>& enabled) {
    std::size_t first = 0;
    while (first < technique &&
           (!enabled[first] || techniques[first]->buildTable != techniques[technique]->buildTable)) {
        ++first;
    }
    return first;
}

} // namespace

MaterialTable::MaterialTable(const Device& device, std::uint32_t maxMaterials, std::uint32_t frames,
                             const std::array<bool, techniqueCount>& enabled, IdBits idBits)
    : maxMaterials_(maxMaterials), idBits_{idBits.mask >> idBits.shift << idBits.shift, idBits.shift} {
    for (std::size_t i = 0; i < techniqueCount; ++i) {
        tables_[i] = tableOf(i, enabled);
    }
    const VkDeviceSize alignment = std::max(device.limits.minStorageBufferOffsetAlignment, leastAlignment);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        const bool isParameters = i == techniqueCount;
        Section& section = sections_[i];
        const bool ownsTable = !isParameters && enabled[i] && tables_[i] == i;
        section.stride = isParameters ? sizeof(MaterialParameters) : ownsTable ? techniques[i]->tableBytes : 0;
        section.head = isParameters ? materialIdCount * sizeof(std::uint32_t) : 0;
        section.offset = size_ + section.head;
        const VkDeviceSize bytes = section.head + section.stride * (maxMaterials + 1);
        if (bytes > device.limits.maxStorageBufferRange) {
            fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreContextInfo::maxMaterials is ", maxMaterials, ": the table of ",
                 isParameters ? "materials" : techniques[i]->name, " would take ", bytes,
                 " bytes, the device's maxStorageBufferRange is ", device.limits.maxStorageBufferRange,
                 "; leave techniques out in NacreContextInfo::techniques or lower it");
        }
        size_ += (bytes + alignment - 1) / alignment * alignment;
    }
    frames_.resize(frames);
    for (Frame& frame : frames_) {
        frame.buffer = createBuffer(device, size_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "nacre materials");
    }
}

void MaterialTable::addTo(MemoryLayout& layout) {
    for (Frame& frame : frames_) {
        layout.add(frame.buffer);
    }
}

void MaterialTable::clear() {
    current_.resize(size_);
    slots_.resize(materialIdCount);
    for (Frame& frame : frames_) {
        std::memset(frame.buffer.mapped, 0, size_);
        frame.changed.reserve(maxMaterials_);
        frame.isChanged.resize(maxMaterials_ + 1);
    }
}

void MaterialTable::set(std::uint32_t firstId, std::span<const NacreMaterial> materials) {
    for (std::uint32_t id = firstId; id < firstId + materials.size(); ++id) {
        if ((id << idBits_.shift & ~idBits_.mask) != 0) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, "firstId is ", firstId, " and count ", materials.size(),
                 ": no pixel can have "
                 "id ",
                 id, ", NacreContextInfo::materialIdMask is ", idBits_.mask, " and materialIdShift ", idBits_.shift);
        }
    }
    const auto isNew = [](std::uint32_t slot) { return slot == 0; };
    const std::span<const std::uint32_t> slots = std::span(slots_).subspan(firstId, materials.size());
    const auto added = static_cast<std::uint32_t>(std::count_if(slots.begin(), slots.end(), isNew));
    if (added > maxMaterials_ - summary_.slotCount) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "firstId is ", firstId, " and count ", materials.size(), ": ",
             std::uint64_t{summary_.slotCount} + added, " materials would be set, NacreContextInfo::maxMaterials is ",
             maxMaterials_);
    }
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
        const CheckedMaterial checked = checkMaterial(materials[i], firstId + static_cast<std::uint32_t>(i));
        for (std::size_t technique = 0; technique < techniqueCount; ++technique) {
            if (const std::span<std::byte> table = take(sections_[technique]); !table.empty()) {
                techniques[technique]->buildTable(checked.material, *checked.profile, table);
            }
        }
        std::memcpy(take(sections_.back()).data(), &checked.parameters, sizeof(checked.parameters));
    }
    const std::byte* block = blocks.data();
    for (std::uint32_t id = firstId; id < firstId + materials.size(); ++id) {
        if (slots_[id] == 0) {
            slots_[id] = ++summary_.slotCount;
        }
        const std::uint32_t slot = slots_[id];
        for (const Section& section : sections_) {
            std::memcpy(current_.data() + section.offset + section.stride * slot, block, section.stride);
            block += section.stride;
        }
        for (Frame& frame : frames_) {
            if (!frame.isChanged[slot]) {
                frame.isChanged[slot] = true;
                frame.changed.push_back(id);
            }
        }
    }
    summarize();
}

void MaterialTable::summarize() {
    const Section& section = sections_.back();
    std::uint32_t common = 0xffffffffu;
    summary_.havePreAndPost = false;
    summary_.haveSecondSurfaces = false;
    summary_.havePartialStrength = false;
    for (std::uint32_t slot = 1; slot <= summary_.slotCount; ++slot) {
        MaterialParameters parameters;
        std::memcpy(&parameters, current_.data() + section.offset + section.stride * slot, sizeof(parameters));
        common &= parameters.exchangeGroups;
        summary_.havePreAndPost = summary_.havePreAndPost || parameters.preAndPost != 0;
        summary_.haveSecondSurfaces = summary_.haveSecondSurfaces || parameters.secondSurfaces != 0;
        summary_.havePartialStrength = summary_.havePartialStrength || parameters.strength < 1;
    }
    summary_.haveSeparate = common == 0;
}

/// Under every value that an image may have for this id, so that shaders look values up as they are.
void MaterialTable::writeSlot(Frame& frame, std::uint32_t id) const {
    const std::uint32_t bits = id << idBits_.shift;
    const Section& parameters = sections_.back();
    std::byte* const slots = frame.buffer.mapped + parameters.offset - parameters.head;
    const std::uint32_t others = NACRE_MAX_MATERIALS & ~idBits_.mask;
    std::uint32_t other = 0;
    do {
        const std::uint32_t value = bits | other;
        std::memcpy(slots + value * sizeof(slots_[id]), &slots_[id], sizeof(slots_[id]));
        other = (other - others) & others; // the next set of other bits
    } while (other != 0);
}

void MaterialTable::update(std::uint32_t index) {
    Frame& frame = frames_[index];
    for (const std::uint32_t id : frame.changed) {
        const std::uint32_t slot = slots_[id];
        for (const Section& section : sections_) {
            const VkDeviceSize at = section.offset + section.stride * slot;
            std::memcpy(frame.buffer.mapped + at, current_.data() + at, section.stride);
        }
        writeSlot(frame, id);
        frame.isChanged[slot] = false;
    }
    frame.changed.clear();
    frame.summary = summary_;
}

VkDescriptorBufferInfo MaterialTable::range(std::uint32_t frame, const Section& section) const {
    return {frames_[frame].buffer.buffer.get(), section.offset - section.head,
            section.head + section.stride * (maxMaterials_ + 1)};
}

} // namespace nacre::effect
