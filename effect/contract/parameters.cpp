#include "contract/parameters.hpp"

#include "baselines/baselines.hpp"
#include "contract/validation.hpp"
#include "contract/view_parameters.hpp"
#include "technique.hpp"

#include <cmath>

namespace nacre::effect {
namespace {

std::uint32_t flagsOf(ImageSet given) {
    const auto flag = [given](NacreImageSlot slot, std::uint32_t value) {
        return (given >> slot & 1u) != 0 ? value : 0u;
    };
    return flag(NACRE_IMAGE_NORMAL, flagNormal) | flag(NACRE_IMAGE_STRENGTH, flagStrength) |
           flag(NACRE_IMAGE_SCALE, flagScale) | flag(NACRE_IMAGE_ALBEDO, flagAlbedo) |
           flag(NACRE_IMAGE_THICKNESS, flagThickness) | flag(NACRE_IMAGE_THICKNESS_OUT, flagThicknessOut);
}

template <typename Info> void setNormals(ViewParameters& view, const Info& info, const FieldName& name) {
    checkFinite(std::span(&info.normalScale, 1), name + "::normalScale");
    checkFinite(std::span(&info.normalBias, 1), name + "::normalBias");
    view.normalScale = info.normalScale == 0 ? 1.0f : info.normalScale;
    view.normalBias = info.normalBias;
}

/// A step of one pixel is rayX·z + originX, and proportional to clip w.
float pixelWidth(const ViewParameters& view) {
    const bool perspective = view.clipW.x != 0;
    const vec2 x = perspective ? view.rayX : view.originX;
    const vec2 y = perspective ? view.rayY : view.originY;
    return std::sqrt(std::abs(x.x * y.y - x.y * y.x)) / std::abs(perspective ? view.clipW.x : view.clipW.y);
}

} // namespace

ScatterParameters scatterParameters(const NacreScatterInfo& info, ImageSet given, const VkRect2D& area,
                                    bool albedoBefore) {
    constexpr const char* name = "NacreScatterInfo";
    ScatterParameters parameters{};
    ViewParameters& view = parameters.view;
    view.flags = flagsOf(given) | (info.skipUnscattered ? flagSkipUnscattered : 0u);
    view.flags |= albedoBefore && (view.flags & flagAlbedo) != 0 ? flagAlbedoBefore : 0u;
    setNormals(view, info, name);
    setView(view, info.view, viewport(info.view, info.irradiance.extent), area, (view.flags & flagNormal) != 0, name);
    parameters.pixelWidth = pixelWidth(view);
    for (const Technique* technique : techniques) {
        if (technique->setParameters) {
            technique->setParameters(info, area.extent, parameters);
        }
    }
    return parameters;
}

TransmitParameters transmitParameters(const NacreTransmitInfo& info, ImageSet given, const VkRect2D& area) {
    constexpr const char* name = "NacreTransmitInfo";
    TransmitParameters parameters{};
    ViewParameters& view = parameters.view;
    view.flags = flagsOf(given) | flagNormal | (takesThesisTransmittance(info) ? flagThesisTransmittance : 0u);
    checkRange(info.normalOffset, 0, 1000, "NacreTransmitInfo::normalOffset");
    checkRange(info.filterRadius, 0, 1000, "NacreTransmitInfo::filterRadius");
    setNormals(view, info, name);
    setView(view, info.view, viewport(info.view, info.depth.extent), area, true, name);
    view.lightCount = info.lightCount;
    parameters.normalOffset = info.normalOffset == 0 ? 1.5f : info.normalOffset;
    parameters.filterRadius = info.filterRadius == 0 ? 2.0f : info.filterRadius;
    return parameters;
}

ScatterParameters composeParameters(const NacreComposeInfo& info, ImageSet given, const VkRect2D& area) {
    ScatterParameters parameters{};
    ViewParameters& view = parameters.view;
    view.areaOffset = {area.offset.x, area.offset.y};
    view.areaExtent = {static_cast<std::int32_t>(area.extent.width), static_cast<std::int32_t>(area.extent.height)};
    view.flags = flagsOf(given) | (info.transmitted.view != VK_NULL_HANDLE ? flagTransmitted : 0u) |
                 (info.scatteredHasAlbedo ? flagScatteredHasAlbedo : 0u);
    return parameters;
}

} // namespace nacre::effect
