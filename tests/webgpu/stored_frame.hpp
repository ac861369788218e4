// One frame's calls as files that another implementation of the passes can run: frame.json, and what it names. Inputs,
// what the passes read beside them (nacre_passes.h), and what the library's own passes wrote.
#pragma once

#include "nacre/nacre_passes.h"
#include "tests/gpu/support/effect.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace nacre::tests {

class StoredFrame {
public:
    /// The folder is made. `context`: whose calls they are. `materials`: 1, 2, …
    StoredFrame(std::filesystem::path folder, VkExtent2D extent, const NacreContextInfo& context,
                std::span<const NacreMaterial> materials);

    /// An image under its name in NacreScatterInfo and NacreTransmitInfo; `shadowMaps` is an array.
    void addImage(Gpu& gpu, const std::string& name, const GpuImage& image);
    /// A call with the bank; `scattered` is what nacreCmdScatter wrote.
    void addScatter(Gpu& gpu, const NacreScatterInfo& info, const GpuImage& scattered);
    /// Likewise with nacreCmdTransmit.
    void addTransmit(Gpu& gpu, const NacreTransmitInfo& info, const GpuImage& transmitted, const GpuImage& thickness);
    /// Writes frame.json. `exposure`: what a picture of the frame is multiplied by.
    void finish(double exposure);

private:
    /// Writes a file and returns its name.
    std::string write(const std::string& name, std::span<const std::byte> bytes) const;
    nlohmann::json imageJson(Gpu& gpu, const std::string& name, const GpuImage& image) const;
    nlohmann::json callJson(const char* name, NacreTechnique technique, VkExtent2D area,
                            std::span<const std::byte> parameters, std::span<const std::byte> lights) const;
    std::vector<std::byte> contents(NacreTechnique technique, const NacreBinding& binding,
                                    std::span<const std::byte> parameters, std::span<const std::byte> lights) const;

    std::filesystem::path folder_;
    VkExtent2D extent_;
    nlohmann::json constants_; ///< of all passes, by their names in WGSL
    std::vector<NacreMaterial> materials_;
    nlohmann::json json_;
};

} // namespace nacre::tests
