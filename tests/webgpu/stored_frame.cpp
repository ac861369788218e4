#include "tests/webgpu/stored_frame.hpp"

#include <fstream>
#include <iostream>
#include <stdexcept>

namespace nacre::tests {
namespace {

void check(NacreResult result) {
    if (result != NACRE_SUCCESS) {
        throw std::runtime_error(nacreResultString(result));
    }
}

constexpr NacreMessages messages{
    [](NacreSeverity, const char* message, void*) { std::cerr << "nacre: " << message << '\n'; }, nullptr};

const char* formatName(VkFormat format) {
    switch (format) {
    case VK_FORMAT_R32_SFLOAT:
        return "r32float";
    case VK_FORMAT_R16_UINT:
        return "r16uint";
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return "rgba16float";
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return "rgba32float";
    default:
        throw std::runtime_error("a stored frame has no images of VkFormat " + std::to_string(format));
    }
}

template <typename Item, typename Get> std::vector<Item> listed(const Get& get) {
    std::uint32_t count = 0;
    check(get(&count, nullptr));
    std::vector<Item> items(count);
    check(get(&count, items.data()));
    return items;
}

std::uint32_t bitOf(NacreImageSlot slot, const NacreImage& image) {
    return image.view != VK_NULL_HANDLE ? 1u << slot : 0u;
}

const char* kindOf(const NacreBinding& binding) {
    switch (binding.type) {
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return "uniform";
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
        return "storage";
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
        return "texture";
    default:
        return "output";
    }
}

nlohmann::json passJson(const NacrePass& pass) {
    nlohmann::json json{{"file", pass.file}};
    if (pass.indirectBinding != 0) {
        json["indirect"] = {{"binding", pass.indirectBinding}, {"offset", pass.indirectOffset}};
    } else {
        json["groups"] = {pass.groups.width, pass.groups.height, pass.groups.depth};
    }
    return json;
}

VkExtent2D areaOf(const NacreView& view, VkExtent2D whole) {
    return view.renderArea.extent.width > 0 ? view.renderArea.extent : whole;
}

// Whether some of them exchange no light with some others.
bool areSeparate(std::span<const NacreMaterial> materials) {
    std::uint32_t common = ~0u;
    for (const NacreMaterial& material : materials) {
        common &= material.exchangeGroups;
    }
    return common == 0 && materials.size() > 1;
}

} // namespace

StoredFrame::StoredFrame(std::filesystem::path folder, VkExtent2D extent, const NacreContextInfo& context,
                         std::span<const NacreMaterial> materials)
    : folder_(std::move(folder)),
      extent_(extent),
      constants_{{"separateMaterials", areSeparate(materials) ? 1 : 0},
                 {"noMaterialIds", context.noMaterialIds},
                 {"normalEncoding", (context.normalEncoding == NACRE_NORMAL_OCTAHEDRAL ? 1 : 0) |
                                        (context.normalSpace == NACRE_NORMAL_VIEW ? 2 : 0)}},
      materials_(materials.begin(), materials.end()),
      json_{{"extent", {extent.width, extent.height}},
            {"images", nlohmann::json::object()},
            {"calls", nlohmann::json::array()}} {
    std::filesystem::create_directories(folder_);
}

std::string StoredFrame::write(const std::string& name, std::span<const std::byte> bytes) const {
    std::ofstream file(folder_ / name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) {
        throw std::runtime_error("cannot write " + (folder_ / name).string());
    }
    return name;
}

nlohmann::json StoredFrame::imageJson(Gpu& gpu, const std::string& name, const GpuImage& image) const {
    return {{"file", write(name + ".bin", gpu.downloadBytes(image))},
            {"format", formatName(image.format)},
            {"extent", {image.extent.width, image.extent.height, image.layers}}};
}

void StoredFrame::addImage(Gpu& gpu, const std::string& name, const GpuImage& image) {
    json_["images"][name] = imageJson(gpu, name, image);
}

// What a buffer holds that a caller fills, as nacre_passes.h says.
std::vector<std::byte> StoredFrame::contents(NacreTechnique technique, const NacreBinding& binding,
                                             std::span<const std::byte> parameters,
                                             std::span<const std::byte> lights) const {
    const std::string_view name = binding.name;
    if (name == "parameters" || name == "lights") {
        const std::span<const std::byte> bytes = name == "lights" ? lights : parameters;
        return {bytes.begin(), bytes.end()};
    }
    std::vector<std::byte> bytes(binding.head + binding.stride * (materials_.size() + 1));
    for (std::uint32_t slot = 1; slot <= materials_.size(); ++slot) {
        std::byte* element = &bytes[binding.head + binding.stride * slot];
        const NacreMaterial* material = &materials_[slot - 1];
        if (name == "materials") {
            std::memcpy(&bytes[sizeof(slot) * slot], &slot, sizeof(slot)); // an id's slot is the id
            check(nacreFillMaterial(material, &messages, binding.stride, element));
        } else {
            check(nacreFillTable(technique, material, &messages, binding.stride, element));
        }
    }
    return bytes;
}

nlohmann::json StoredFrame::callJson(const char* name, NacreTechnique technique, VkExtent2D area,
                                     std::span<const std::byte> parameters, std::span<const std::byte> lights) const {
    nlohmann::json call{{"name", name},
                        {"constants", constants_},
                        {"bindings", nlohmann::json::array()},
                        {"passes", nlohmann::json::array()}};
    const auto bindings = listed<NacreBinding>(
        [&](std::uint32_t* count, NacreBinding* all) { return nacreGetBindings(technique, extent_, count, all); });
    for (const NacreBinding& binding : bindings) {
        nlohmann::json json{{"name", binding.name}, {"binding", binding.binding}, {"kind", kindOf(binding)}};
        const bool isBuffer = json["kind"] == "uniform" || json["kind"] == "storage";
        if (!isBuffer && binding.intermediate) {
            continue; // stands in for shadow maps that are not given
        }
        if (isBuffer && binding.intermediate) {
            json["bytes"] = binding.head;
        } else if (isBuffer) {
            const std::vector<std::byte> bytes = contents(technique, binding, parameters, lights);
            json["bytes"] = bytes.size();
            json["file"] = write(std::string(name) + "_" + binding.name + ".bin", bytes);
        }
        call["bindings"].push_back(json);
    }
    const auto passes = listed<NacrePass>(
        [&](std::uint32_t* count, NacrePass* all) { return nacreGetPasses(technique, area, count, all); });
    for (const NacrePass& pass : passes) {
        call["passes"].push_back(passJson(pass));
    }
    return call;
}

void StoredFrame::addScatter(Gpu& gpu, const NacreScatterInfo& info, const GpuImage& scattered) {
    const std::uint32_t images = bitOf(NACRE_IMAGE_NORMAL, info.normal) | bitOf(NACRE_IMAGE_STRENGTH, info.strength) |
                                 bitOf(NACRE_IMAGE_SCALE, info.scale) | bitOf(NACRE_IMAGE_ALBEDO, info.albedo);
    const auto bindings = listed<NacreBinding>([&](std::uint32_t* count, NacreBinding* all) {
        return nacreGetBindings(NACRE_TECHNIQUE_BANK, extent_, count, all);
    });
    std::vector<std::byte> parameters(bindings.front().head);
    check(nacreFillScatterParameters(&info, images, &messages, parameters.size(), parameters.data()));
    nlohmann::json call =
        callJson("bank", NACRE_TECHNIQUE_BANK, areaOf(info.view, info.irradiance.extent), parameters, {});
    call["expected"]["scattered"] = imageJson(gpu, "scattered", scattered);
    json_["calls"].push_back(call);
}

void StoredFrame::addTransmit(Gpu& gpu, const NacreTransmitInfo& info, const GpuImage& transmitted,
                              const GpuImage& thickness) {
    const std::uint32_t images = bitOf(NACRE_IMAGE_NORMAL, info.normal) | bitOf(NACRE_IMAGE_STRENGTH, info.strength) |
                                 bitOf(NACRE_IMAGE_SCALE, info.scale) | bitOf(NACRE_IMAGE_THICKNESS, info.thickness) |
                                 bitOf(NACRE_IMAGE_THICKNESS_OUT, info.thicknessOut);
    const auto bindings = listed<NacreBinding>([&](std::uint32_t* count, NacreBinding* all) {
        return nacreGetBindings(NACRE_TECHNIQUE_TRANSMIT, extent_, count, all);
    });
    std::vector<std::byte> parameters(bindings.front().head);
    check(nacreFillTransmitParameters(&info, images, &messages, parameters.size(), parameters.data()));
    const auto isLights = [](const NacreBinding& binding) { return binding.name == std::string_view("lights"); };
    const VkDeviceSize stride = std::find_if(bindings.begin(), bindings.end(), isLights)->stride;
    std::vector<std::byte> lights(stride * nacreGetLightElementCount(&info));
    check(nacreFillLights(&info, &messages, lights.size(), lights.data()));
    nlohmann::json call =
        callJson("transmit", NACRE_TECHNIQUE_TRANSMIT, areaOf(info.view, info.depth.extent), parameters, lights);
    call["constants"]["generalCall"] = nacreGetTransmitConstants(images, &info) >> 1 & 1u;
    call["expected"]["transmitted"] = imageJson(gpu, "transmitted", transmitted);
    call["expected"]["thicknessOut"] = imageJson(gpu, "thicknessOut", thickness);
    json_["calls"].push_back(call);
}

void StoredFrame::finish(double exposure) {
    json_["exposure"] = exposure;
    const std::string text = json_.dump(1);
    write("frame.json", std::as_bytes(std::span(text)));
}

} // namespace nacre::tests
