#include "contract/validation.hpp"

#include "technique.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::effect {
namespace {

constexpr VkFormat irradianceFormats[] = {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT,
                                          VK_FORMAT_B10G11R11_UFLOAT_PACK32};
constexpr VkFormat depthFormats[] = {
    VK_FORMAT_D32_SFLOAT,        VK_FORMAT_D16_UNORM,          VK_FORMAT_X8_D24_UNORM_PACK32,
    VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_D16_UNORM_S8_UINT,
    VK_FORMAT_R32_SFLOAT,        VK_FORMAT_R16_SFLOAT,         VK_FORMAT_R16_UNORM};
constexpr VkFormat materialIdFormats[] = {
    VK_FORMAT_R8_UINT,          VK_FORMAT_R16_UINT,          VK_FORMAT_R8G8_UINT,
    VK_FORMAT_R8G8B8A8_UINT,    VK_FORMAT_R16G16_UINT,       VK_FORMAT_R16G16B16A16_UINT,
    VK_FORMAT_S8_UINT,          VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT,
    VK_FORMAT_D16_UNORM_S8_UINT};
constexpr VkFormat normalFormats[] = {VK_FORMAT_R16G16B16A16_SFLOAT,
                                      VK_FORMAT_R32G32B32A32_SFLOAT,
                                      VK_FORMAT_R16G16B16A16_SNORM,
                                      VK_FORMAT_R16G16B16A16_UNORM,
                                      VK_FORMAT_R8G8B8A8_SNORM,
                                      VK_FORMAT_R8G8B8A8_UNORM,
                                      VK_FORMAT_A2B10G10R10_UNORM_PACK32,
                                      VK_FORMAT_R16G16_SFLOAT,
                                      VK_FORMAT_R16G16_SNORM,
                                      VK_FORMAT_R16G16_UNORM,
                                      VK_FORMAT_R8G8_SNORM,
                                      VK_FORMAT_R8G8_UNORM,
                                      VK_FORMAT_R32G32_SFLOAT};
constexpr VkFormat factorFormats[] = {VK_FORMAT_R8_UNORM,   VK_FORMAT_R16_UNORM,      VK_FORMAT_R16_SFLOAT,
                                      VK_FORMAT_R32_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_SFLOAT};
constexpr VkFormat thicknessFormats[] = {VK_FORMAT_R16_SFLOAT, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R16G16B16A16_SFLOAT};
constexpr VkFormat albedoFormats[] = {VK_FORMAT_R8G8B8A8_UNORM,           VK_FORMAT_R8G8B8A8_SRGB,
                                      VK_FORMAT_B8G8R8A8_UNORM,           VK_FORMAT_B8G8R8A8_SRGB,
                                      VK_FORMAT_A2B10G10R10_UNORM_PACK32, VK_FORMAT_R16G16B16A16_SFLOAT,
                                      VK_FORMAT_R32G32B32A32_SFLOAT};
constexpr VkFormat shadowMapFormats[] = {
    VK_FORMAT_R32_SFLOAT,        VK_FORMAT_R16_UNORM,         VK_FORMAT_R16_SFLOAT,
    VK_FORMAT_D32_SFLOAT,        VK_FORMAT_D16_UNORM,         VK_FORMAT_X8_D24_UNORM_PACK32,
    VK_FORMAT_D16_UNORM_S8_UINT, VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT};
constexpr VkFormat thicknessOutFormats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R16_SFLOAT};

template <std::size_t count>
NacreImageRequirements slot(const char* name, const VkFormat (&formats)[count], VkImageUsageFlags usage,
                            bool optional = false) {
    return {name, static_cast<std::uint32_t>(count), formats, usage, optional ? VK_TRUE : VK_FALSE};
}

void checkFormatAndUsage(const NacreImage& image, const NacreImageRequirements& requirements, const FieldName& field) {
    const std::span formats(requirements.formats, requirements.formatCount);
    if (std::find(formats.begin(), formats.end(), image.format) == formats.end()) {
        std::ostringstream allowed;
        for (const VkFormat format : formats) {
            allowed << (format == formats.front() ? "" : ", ") << FormatName{format};
        }
        fail(NACRE_ERROR_UNSUPPORTED_FORMAT, field, ".format is ", FormatName{image.format}, ", must be one of ",
             allowed.str());
    }
    if (image.usage != 0 && (image.usage & requirements.usage) != requirements.usage) {
        fail(NACRE_ERROR_UNSUPPORTED_FORMAT, field, ".usage is 0x", std::hex, image.usage, ", lacks 0x",
             requirements.usage & ~image.usage);
    }
    const bool sampledLayout = image.layout == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL ||
                               image.layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL ||
                               image.layout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL ||
                               image.layout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL ||
                               image.layout == VK_IMAGE_LAYOUT_STENCIL_READ_ONLY_OPTIMAL ||
                               image.layout == VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
    const bool isOutput = (requirements.usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0;
    if (image.layout != VK_IMAGE_LAYOUT_GENERAL && (isOutput || !sampledLayout)) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".layout is ", LayoutName{image.layout},
             isOutput ? ", must be VK_IMAGE_LAYOUT_GENERAL"
                      : ", must be a read-only layout or VK_IMAGE_LAYOUT_GENERAL");
    }
}

} // namespace

void checkBuilt(std::size_t technique, const char* field) {
    if (!techniques[technique]->isBuilt()) {
        fail(NACRE_ERROR_UNSUPPORTED, field, " asks for NacreTechnique ", technique + 1,
             ", a baseline that this library was built without (NACRE_BUILD_BASELINES)");
    }
}

NacreImageRequirements imageRequirements(NacreImageSlot which) {
    constexpr VkImageUsageFlags sampled = VK_IMAGE_USAGE_SAMPLED_BIT;
    constexpr VkImageUsageFlags storage = VK_IMAGE_USAGE_STORAGE_BIT;
    switch (which) {
    case NACRE_IMAGE_IRRADIANCE:
        return slot("irradiance", irradianceFormats, sampled);
    case NACRE_IMAGE_DEPTH:
        return slot("depth", depthFormats, sampled);
    case NACRE_IMAGE_MATERIAL_ID:
        return slot("materialId", materialIdFormats, sampled);
    case NACRE_IMAGE_NORMAL:
        return slot("normal", normalFormats, sampled, true);
    case NACRE_IMAGE_STRENGTH:
        return slot("strength", factorFormats, sampled, true);
    case NACRE_IMAGE_SCALE:
        return slot("scale", factorFormats, sampled, true);
    case NACRE_IMAGE_THICKNESS:
        return slot("thickness", thicknessFormats, sampled, true);
    case NACRE_IMAGE_ALBEDO:
        return slot("albedo", albedoFormats, sampled, true);
    case NACRE_IMAGE_SHADOW_MAP:
        return slot("shadowMaps", shadowMapFormats, sampled, true);
    case NACRE_IMAGE_SCATTERED:
        return slot("scattered", irradianceFormats, storage);
    case NACRE_IMAGE_TRANSMITTED:
        return slot("transmitted", irradianceFormats, storage);
    case NACRE_IMAGE_COMPOSED:
        return slot("composed", irradianceFormats, storage);
    case NACRE_IMAGE_THICKNESS_OUT:
        return slot("thicknessOut", thicknessOutFormats, storage, true);
    default:
        fail(NACRE_ERROR_INVALID_ARGUMENT, "slot is ", static_cast<int>(which), ", must be a NacreImageSlot");
    }
}

void checkRange(float value, float low, float high, const FieldName& field) {
    if (!(value >= low && value <= high)) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", value, ", must be in [", low, ", ", high, "]");
    }
}

void checkFinite(std::span<const float> values, const FieldName& field) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, field, "[", i, "] is ", values[i], ", must be finite");
        }
    }
}

namespace {

void checkArea(const VkRect2D& area, const FieldName& field) {
    if (area.extent.width == 0 || area.extent.height == 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".extent is ", area.extent.width, "x", area.extent.height,
             ", must not be empty");
    }
    if (area.offset.x < 0 || area.offset.y < 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".offset is ", area.offset.x, ",", area.offset.y,
             ", must not be negative");
    }
}

bool isEmpty(const VkRect2D& area) {
    return area.extent.width == 0 && area.extent.height == 0;
}

bool contains(const VkRect2D& outer, const VkRect2D& inner) {
    const auto ends = [](std::int32_t offset, std::uint32_t size) { return std::int64_t{offset} + size; };
    return inner.offset.x >= outer.offset.x && inner.offset.y >= outer.offset.y &&
           ends(inner.offset.x, inner.extent.width) <= ends(outer.offset.x, outer.extent.width) &&
           ends(inner.offset.y, inner.extent.height) <= ends(outer.offset.y, outer.extent.height);
}

} // namespace

VkRect2D viewport(const NacreView& view, VkExtent2D extent) {
    return isEmpty(view.renderArea) ? VkRect2D{{0, 0}, extent} : view.renderArea;
}

VkRect2D renderArea(const NacreView& view, VkExtent2D extent, VkExtent2D maxExtent, const FieldName& info) {
    VkRect2D area = viewport(view, extent);
    FieldName field = info + "::view.renderArea";
    checkArea(area, field);
    if (!isEmpty(view.scissor)) {
        field = info + "::view.scissor";
        checkArea(view.scissor, field);
        if (!contains(area, view.scissor)) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", view.scissor.extent.width, "x",
                 view.scissor.extent.height, " at ", view.scissor.offset.x, ",", view.scissor.offset.y,
                 ", must lie within the render area, ", area.extent.width, "x", area.extent.height, " at ",
                 area.offset.x, ",", area.offset.y);
        }
        area = view.scissor;
    }
    if (area.extent.width > maxExtent.width || area.extent.height > maxExtent.height) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, field, ".extent is ", area.extent.width, "x", area.extent.height,
             ", the context's maxExtent is ", maxExtent.width, "x", maxExtent.height, " (see nacreResize)");
    }
    return area;
}

void checkCovers(VkExtent2D extent, const VkRect2D& area, const FieldName& field) {
    const std::uint64_t right = std::uint64_t(area.offset.x) + area.extent.width;
    const std::uint64_t bottom = std::uint64_t(area.offset.y) + area.extent.height;
    if (extent.width < right || extent.height < bottom) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".extent is ", extent.width, "x", extent.height,
             ", the render area reaches to ", right, "x", bottom);
    }
}

void checkNormals(const NacreImage& image, NacreNormalEncoding encoding, const FieldName& field) {
    constexpr VkFormat two[] = {VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_R16G16_SNORM, VK_FORMAT_R16G16_UNORM,
                                VK_FORMAT_R8G8_SNORM,    VK_FORMAT_R8G8_UNORM,   VK_FORMAT_R32G32_SFLOAT};
    if (image.view != VK_NULL_HANDLE && encoding == NACRE_NORMAL_XYZ &&
        std::find(std::begin(two), std::end(two), image.format) != std::end(two)) {
        fail(NACRE_ERROR_UNSUPPORTED_FORMAT, field, ".format is ", FormatName{image.format},
             ", which has two channels, but NacreContextInfo::normalEncoding is NACRE_NORMAL_XYZ");
    }
}

void checkMaterialId(const NacreImage& image, bool noMaterialIds, const VkRect2D& area, const FieldName& field) {
    if (noMaterialIds && image.view != VK_NULL_HANDLE) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".view is given, but NacreContextInfo::noMaterialIds is VK_TRUE");
    }
    if (!noMaterialIds) {
        checkImage(image, NACRE_IMAGE_MATERIAL_ID, area, field);
    }
}

bool checkImage(const NacreImage& image, NacreImageSlot which, const VkRect2D& area, const FieldName& field) {
    const NacreImageRequirements requirements = imageRequirements(which);
    if (image.view == VK_NULL_HANDLE) {
        if (!requirements.optional) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".view is null, the image is required");
        }
        return false;
    }
    checkFormatAndUsage(image, requirements, field);
    checkCovers(image.extent, area, field);
    return true;
}

void checkShadowMap(const NacreImage& image, const FieldName& field) {
    if (image.view == VK_NULL_HANDLE) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".view is null");
    }
    checkFormatAndUsage(image, imageRequirements(NACRE_IMAGE_SHADOW_MAP), field);
    if (image.extent.width == 0 || image.extent.height == 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".extent is ", image.extent.width, "x", image.extent.height);
    }
}

} // namespace nacre::effect
