// The materials, as the shaders read them. Every frame in flight has a copy of its own, brought up to date when the
// frame begins, so that no frame sees half of a change.
#pragma once

#include "device.hpp"
#include "pass_table.hpp"

#include <span>
#include <vector>

namespace nacre::effect {

class MaterialTable {
public:
    /// enabled[i]: whether techniques[i] needs its table.
    MaterialTable(const Device& device, std::uint32_t maxMaterial, std::uint32_t frames,
                  const std::array<bool, techniqueCount>& enabled);

    /// Sets materials firstId … . Throws Failure naming the material and field; nothing has changed then.
    void set(std::uint32_t firstId, std::span<const NacreMaterial> materials);
    /// Copies what changed since this frame began last.
    void update(std::uint32_t frame);

    VkDescriptorBufferInfo parameters(std::uint32_t frame) const { return range(frame, sections_.back()); }
    VkDescriptorBufferInfo table(std::uint32_t frame, std::size_t technique) const {
        return range(frame, sections_[technique]);
    }
    /// One material's table, as set last.
    std::span<const std::byte> currentTable(std::uint32_t id, std::size_t technique) const {
        const Section& section = sections_[technique];
        return std::span(current_).subspan(section.offset + section.stride * id, section.stride);
    }
    std::uint32_t maxMaterial() const { return maxMaterial_; }
    bool isSet(std::uint32_t id) const { return isSet_[id]; }
    std::uint32_t setCount() const { return setCount_; }
    /// The materials set in this frame.
    std::span<const std::uint32_t> ids(std::uint32_t frame) const { return frames_[frame].ids; }
    /// Whether, in this frame, some materials may not exchange light: no exchange group holds them all.
    bool haveSeparate(std::uint32_t frame) const { return frames_[frame].haveSeparate; }

private:
    /// One array in the buffer: `stride` bytes a material.
    struct Section {
        VkDeviceSize offset = 0;
        VkDeviceSize stride = 0;
    };
    struct Frame {
        Buffer buffer;
        std::vector<std::uint32_t> changed; ///< ids, capacity for all
        std::vector<bool> isChanged;
        std::vector<std::uint32_t> ids; ///< of the materials in the buffer, capacity for all
        std::vector<bool> isSet;
        bool haveSeparate = false;
    };
    VkDescriptorBufferInfo range(std::uint32_t frame, const Section& section) const;
    void findSeparate();

    std::uint32_t maxMaterial_;
    std::array<Section, techniqueCount + 1> sections_; ///< one a technique, then MaterialParameters
    bool haveSeparate_ = false;                        ///< as Frame::haveSeparate, for the next frame
    std::vector<std::byte> current_;                   ///< laid out as the frames' buffers
    std::vector<bool> isSet_;                          ///< by id, in current_
    std::uint32_t setCount_ = 0;
    std::vector<Frame> frames_;
};

} // namespace nacre::effect
