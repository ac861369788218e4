// The effect for C++20: nacre.h with an owner for the context. Header only;
// errors stay result codes.
#pragma once

#include "nacre/nacre.h"

#include <cstdint>
#include <span>
#include <utility>

namespace nacre {

/// Owns a NacreContext. Move-only; the device must have finished with the
/// context's work when it is destroyed.
class Context {
public:
    Context() = default;
    Context(Context&& other) noexcept : context_(std::exchange(other.context_, nullptr)) {}
    Context& operator=(Context&& other) noexcept {
        std::swap(context_, other.context_);
        return *this;
    }
    ~Context() { nacreDestroyContext(context_); }

    /// nacreCreateContext. What `context` held before is destroyed on success and
    /// kept on failure.
    [[nodiscard]] static NacreResult create(const NacreContextInfo& info, Context& context) {
        Context created;
        const NacreResult result = nacreCreateContext(&info, &created.context_);
        if (result == NACRE_SUCCESS) {
            context = std::move(created);
        }
        return result;
    }

    /// nacreGetMemoryRequirements.
    [[nodiscard]] static NacreResult memoryRequirements(const NacreContextInfo& info,
                                                        NacreMemoryRequirements& requirements) {
        return nacreGetMemoryRequirements(&info, &requirements);
    }

    [[nodiscard]] NacreResult resize(VkExtent2D maxExtent, const NacreMemory* deviceMemory = nullptr) {
        return nacreResize(context_, maxExtent, deviceMemory);
    }
    [[nodiscard]] NacreResult setPreset(std::uint32_t id, const char* name) {
        return nacreSetPreset(context_, id, name);
    }
    /// Sets materials firstId, firstId + 1, …
    [[nodiscard]] NacreResult setMaterials(std::uint32_t firstId, std::span<const NacreMaterial> materials) {
        return nacreSetMaterials(context_, firstId, static_cast<std::uint32_t>(materials.size()), materials.data());
    }
    [[nodiscard]] NacreResult beginFrame(std::uint32_t frame) { return nacreBeginFrame(context_, frame); }
    [[nodiscard]] NacreResult cmdScatter(VkCommandBuffer commandBuffer, const NacreScatterInfo& info) {
        return nacreCmdScatter(context_, commandBuffer, &info);
    }
    [[nodiscard]] NacreResult cmdTransmit(VkCommandBuffer commandBuffer, const NacreTransmitInfo& info) {
        return nacreCmdTransmit(context_, commandBuffer, &info);
    }
    [[nodiscard]] NacreResult cmdCompose(VkCommandBuffer commandBuffer, const NacreComposeInfo& info) {
        return nacreCmdCompose(context_, commandBuffer, &info);
    }
    [[nodiscard]] NacreResult scatterCost(NacreTechnique technique, NacreCost& cost) const {
        return nacreGetScatterCost(context_, technique, &cost);
    }
    [[nodiscard]] NacreResult transmitCost(NacreCost& cost) const { return nacreGetTransmitCost(context_, &cost); }

    NacreContext get() const { return context_; }
    explicit operator bool() const { return context_ != nullptr; }

private:
    NacreContext context_ = nullptr;
};

} // namespace nacre
