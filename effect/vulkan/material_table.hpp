// The materials, as the shaders read them. A material that is set takes the
// next slot, and the shaders find its slot by its id: ids may lie anywhere, and
// tables are as long as the materials are many. Every frame in flight has a
// copy of its own, brought up to date when the frame begins, so that no frame
// sees half of a change.
#pragma once

#include "technique.hpp"
#include "vulkan/memory_layout.hpp"

#include <span>
#include <vector>

namespace nacre::effect {

/// Which bits of a pixel's value are its id: (value & mask) >> shift.
struct IdBits {
    std::uint32_t mask = NACRE_MAX_MATERIALS;
    std::uint32_t shift = 0;
};

class MaterialTable {
public:
    /// maxMaterials: how many may be set. enabled[i]: whether techniques[i] needs its table; those that build the same
    /// one share it.
    MaterialTable(const Device& device, std::uint32_t maxMaterials, std::uint32_t frames,
                  const std::array<bool, techniqueCount>& enabled, IdBits idBits);
    void addTo(MemoryLayout& layout);
    /// No material is set. Call once, when the buffers have memory.
    void clear();

    /// Sets materials firstId … . Throws EffectError naming the material and field; nothing has changed then.
    void set(std::uint32_t firstId, std::span<const NacreMaterial> materials);
    /// Copies what changed since this frame began last.
    void update(std::uint32_t frame);

    VkDescriptorBufferInfo parameters(std::uint32_t frame) const { return range(frame, sections_.back()); }
    VkDescriptorBufferInfo table(std::uint32_t frame, std::size_t technique) const {
        return range(frame, sections_[tables_[technique]]);
    }
    /// One material's table, as set last.
    std::span<const std::byte> currentTable(std::uint32_t id, std::size_t technique) const {
        const Section& section = sections_[tables_[technique]];
        return std::span(current_).subspan(section.offset + section.stride * slots_[id], section.stride);
    }
    bool isSet(std::uint32_t id) const { return id < slots_.size() && slots_[id] != 0; }
    std::uint32_t setCount() const { return summary_.slotCount; }
    /// What is known of a frame's materials together.
    struct Summary {
        std::uint32_t slotCount = 0;      ///< how many are set: theirs are the slots 1 … slotCount
        bool haveSeparate = false;        ///< some may not exchange light: no exchange group holds them all
        bool havePreAndPost = false;      ///< some have NACRE_ALBEDO_PRE_AND_POST
        bool haveSecondSurfaces = false;  ///< some have NacreMaterial::secondSurfaces
        bool havePartialStrength = false; ///< some have NacreMaterial::strength below 1
    };
    const Summary& summary(std::uint32_t frame) const { return frames_[frame].summary; }
    /// Of the materials set so far.
    const Summary& summary() const { return summary_; }

private:
    /// One array in the buffer: `head` bytes, then `stride` bytes a slot; slot 0
    /// is no material's.
    struct Section {
        VkDeviceSize offset = 0; ///< of slot 0
        VkDeviceSize stride = 0;
        VkDeviceSize head = 0; ///< before the offset
    };
    struct Frame {
        Buffer buffer;
        std::vector<std::uint32_t> changed; ///< ids, capacity for all
        std::vector<bool> isChanged;        ///< by slot
        Summary summary;
    };
    void writeSlot(Frame& frame, std::uint32_t id) const;
    VkDescriptorBufferInfo range(std::uint32_t frame, const Section& section) const;
    void summarize();

    std::uint32_t maxMaterials_;
    IdBits idBits_;
    std::array<std::size_t, techniqueCount>
        tables_{}; ///< whose section each technique reads: its own or an earlier one's
    std::array<Section, techniqueCount + 1> sections_; ///< one a technique, then slots by id and MaterialParameters
    VkDeviceSize size_ = 0;                            ///< of all sections
    Summary summary_;                                  ///< of the next frame
    std::vector<std::byte> current_;                   ///< laid out as the frames' buffers; the
                                                       ///< slots by id are not used
    std::vector<std::uint32_t> slots_;                 ///< by id, in current_; 0 = not set
    std::vector<Frame> frames_;
};

} // namespace nacre::effect
