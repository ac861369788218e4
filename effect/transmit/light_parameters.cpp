#include "transmit/light_parameters.hpp"

#include "contract/validation.hpp"
#include "contract/view_parameters.hpp"
#include "contract/vulkan_names.hpp"
#include "transmit/shadow_decoding.hpp"
#include "transmit/transmit_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <span>

namespace nacre::effect {
namespace {

bool isDepthFormat(VkFormat format) {
    return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT && format != VK_FORMAT_S8_UINT;
}

/// A map of a light: the light's own, or a cascade's.
struct MapUse {
    const float (&clipFromWorld)[16];
    std::uint32_t shadowMap;
    std::uint32_t layer;
    const VkRect2D& rectangle;
    float range;
};

MapUse mapOf(const NacreLight& light) {
    return {light.shadowClipFromWorld, light.shadowMap, light.shadowLayer, light.shadowRectangle, light.shadowRange};
}

MapUse mapOf(const NacreLight& light, const NacreShadowCascade& cascade) {
    return {cascade.clipFromWorld, cascade.shadowMap, cascade.layer, cascade.rectangle,
            cascade.range == 0 ? light.shadowRange : cascade.range};
}

VkExtent2D sizeOf(const MapUse& map, const NacreTransmitInfo& info) {
    const bool isWhole = map.rectangle.extent.width == 0 && map.rectangle.extent.height == 0;
    return isWhole ? info.shadowMaps[map.shadowMap].extent : map.rectangle.extent;
}

void checkRectangle(const VkRect2D& rectangle, VkExtent2D extent, const FieldName& field) {
    if (rectangle.extent.width == 0 && rectangle.extent.height == 0) {
        return;
    }
    const auto ends = [](std::int32_t offset, std::uint32_t size, std::uint32_t most) {
        return offset >= 0 && size > 0 && std::uint64_t(offset) + size <= most;
    };
    if (!ends(rectangle.offset.x, rectangle.extent.width, extent.width) ||
        !ends(rectangle.offset.y, rectangle.extent.height, extent.height)) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", rectangle.extent.width, "x", rectangle.extent.height, " at ",
             rectangle.offset.x, ",", rectangle.offset.y, ", must lie within its shadow map's ", extent.width, "x",
             extent.height);
    }
}

void checkLinear(const MapUse& map, VkFormat format, const FieldName& field, const FieldName& range) {
    if (isDepthFormat(format)) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field,
             ".shadowDepthEncoding is NACRE_DEPTH_LINEAR, but its map, "
             "NacreTransmitInfo::shadowMaps[",
             map.shadowMap, "], has the depth format ", FormatName{format},
             ", whose values are a depth buffer's; must be NACRE_DEPTH_HARDWARE");
    }
    if (!std::isfinite(map.range) || map.range <= 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, range, " is ", map.range, ", must be positive");
    }
}

void checkHardware(const NacreLight& light, const MapUse& map, const NacreTransmitInfo& info, const FieldName& matrix) {
    checkFinite(map.clipFromWorld, matrix);
    const bool isCube = light.kind == NACRE_LIGHT_POINT;
    const VkExtent2D size = sizeOf(map, info);
    if (isCube ? !cubeDecodingOf(map.clipFromWorld, size).isValid : !decodingOf(map.clipFromWorld, {}, size).isValid) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, matrix, " has no inverse",
             isCube ? ", must be the perspective projection of a cube's face"
                    : ", must be the matrix the map was drawn with");
    }
}

void checkMap(const NacreLight& light, const MapUse& map, const NacreTransmitInfo& info, const FieldName& field,
              const FieldName& owner, bool isCascade) {
    if (map.shadowMap >= info.shadowMapCount) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, owner, ".shadowMap is ", map.shadowMap,
             ", NacreTransmitInfo::shadowMapCount is ", info.shadowMapCount);
    }
    const NacreImage& image = info.shadowMaps[map.shadowMap];
    const FieldName matrix = owner + (isCascade ? ".clipFromWorld" : ".shadowClipFromWorld");
    checkRectangle(map.rectangle, image.extent, owner + (isCascade ? ".rectangle" : ".shadowRectangle"));
    if (light.shadowDepthEncoding == NACRE_DEPTH_HARDWARE) {
        checkHardware(light, map, info, matrix);
        return;
    }
    checkLinear(map, image.format, field, owner + (isCascade ? ".range" : ".shadowRange"));
    if (light.kind != NACRE_LIGHT_POINT) {
        checkFinite(map.clipFromWorld, matrix);
    }
}

void checkCascades(const NacreLight& light, const NacreTransmitInfo& info, const FieldName& field) {
    if (light.cascadeCount > NACRE_MAX_CASCADES) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, field, ".cascadeCount is ", light.cascadeCount, ", at most ",
             NACRE_MAX_CASCADES);
    }
    if (light.kind == NACRE_LIGHT_POINT) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".cascadeCount is ", light.cascadeCount,
             ", a point light has a cube in place of cascades");
    }
    if (!light.cascades) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".cascades is null, cascadeCount is ", light.cascadeCount);
    }
    checkRange(light.cascadeBlend, 0, 1, field + ".cascadeBlend");
    float before = 0;
    for (std::uint32_t i = 0; i < light.cascadeCount; ++i) {
        const NacreShadowCascade& cascade = light.cascades[i];
        const FieldName owner = (field + ".cascades").at(i);
        checkMap(light, mapOf(light, cascade), info, field, owner, true);
        if (light.cascadeChoice == NACRE_CASCADE_BY_VIEW_DEPTH &&
            (!std::isfinite(cascade.farDepth) || cascade.farDepth <= before)) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, owner, ".farDepth is ", cascade.farDepth, ", must be above ", before);
        }
        before = cascade.farDepth;
    }
}

void checkShadow(const NacreLight& light, const NacreTransmitInfo& info, const FieldName& field) {
    if (light.shadowDepthEncoding != NACRE_DEPTH_LINEAR && light.shadowDepthEncoding != NACRE_DEPTH_HARDWARE) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".shadowDepthEncoding is ",
             static_cast<int>(light.shadowDepthEncoding), ", must be a NacreDepthEncoding");
    }
    if (light.cascadeChoice != NACRE_CASCADE_BY_MAP && light.cascadeChoice != NACRE_CASCADE_BY_VIEW_DEPTH) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".cascadeChoice is ", static_cast<int>(light.cascadeChoice),
             ", must be a NacreCascadeChoice");
    }
    if (light.cascadeCount > 0) {
        checkCascades(light, info, field);
    } else if (light.shadowMap != NACRE_NO_SHADOW_MAP) {
        checkMap(light, mapOf(light), info, field, field, false);
    }
}

/// A point light may have one, too.
bool hasCone(const NacreLight& light) {
    return light.kind == NACRE_LIGHT_SPOT || (light.kind == NACRE_LIGHT_POINT && light.outerConeAngle > 0);
}

void checkLight(const NacreLight& light, const FieldName& field, const NacreTransmitInfo& info) {
    if (light.kind < NACRE_LIGHT_DIRECTIONAL || light.kind > NACRE_LIGHT_POINT) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".kind is ", static_cast<int>(light.kind),
             ", must be a NacreLightKind");
    }
    checkFinite(light.position, field + ".position");
    checkFinite(light.irradiance, field + ".irradiance");
    for (const float value : light.irradiance) {
        checkRange(value, 0, 3e38f, field + ".irradiance");
    }
    if (light.kind != NACRE_LIGHT_POINT || hasCone(light)) {
        checkFinite(light.direction, field + ".direction");
        if (std::hypot(light.direction[0], light.direction[1], light.direction[2]) < 1e-12f) {
            fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".direction is 0,0,0, must have a length");
        }
    }
    checkRange(light.range, 0, 3e38f, field + ".range");
    for (const float value : light.attenuation) {
        checkRange(value, 0, 3e38f, field + ".attenuation");
    }
    if (light.kind != NACRE_LIGHT_DIRECTIONAL) {
        checkRange(light.outerConeAngle, 0, std::numbers::pi_v<float> / 2, field + ".outerConeAngle");
        checkRange(light.innerConeAngle, 0, light.outerConeAngle, field + ".innerConeAngle");
    }
    checkShadow(light, info, field);
}

using Row = std::array<double, 4>;

/// A row of a map's matrix, for offsets from a point.
Row shadowRow(const float (&clipFromWorld)[16], const std::array<double, 3>& origin, int row) {
    const float* m = clipFromWorld + row;
    Row result{m[0], m[4], m[8], m[12]};
    for (std::size_t i = 0; i < 3; ++i) {
        result[3] += result[i] * origin[i];
    }
    return result;
}

void setProjection(LightParameters& parameters, const float (&clipFromWorld)[16], const std::array<double, 3>& origin,
                   VkExtent2D size) {
    const Row w = shadowRow(clipFromWorld, origin, 3);
    const auto scaled = [](const Row& row, double scale) {
        const auto value = [&](std::size_t i) { return static_cast<float>(scale * row[i]); };
        return vec4{value(0), value(1), value(2), value(3)};
    };
    double texel = 0;
    const auto texelRow = [&](int axis, double texels) {
        Row row = shadowRow(clipFromWorld, origin, axis);
        texel = std::max(texel, 2 / (std::hypot(row[0], row[1], row[2]) * texels));
        std::transform(row.begin(), row.end(), w.begin(), row.begin(), std::plus<>());
        return scaled(row, 0.5 * texels); // clip [-1, 1] is [0, texels]
    };
    parameters.shadowX = texelRow(0, size.width);
    parameters.shadowY = texelRow(1, size.height);
    parameters.shadowW = scaled(w, 1);
    parameters.shadowTexel = static_cast<float>(texel);
}

/// Everything of a light but its map.
LightParameters parametersOf(const NacreLight& light, float metersPerUnit) {
    LightParameters parameters{};
    parameters.position = {light.position[0], light.position[1], light.position[2], light.range};
    if (light.kind != NACRE_LIGHT_POINT || hasCone(light)) {
        const float length = std::hypot(light.direction[0], light.direction[1], light.direction[2]);
        parameters.direction = {light.direction[0] / length, light.direction[1] / length, light.direction[2] / length,
                                0};
    }
    parameters.irradiance = {light.irradiance[0], light.irradiance[1], light.irradiance[2], metersPerUnit};
    const float* a = light.attenuation;
    const bool isPhysical = a[0] == 0 && a[1] == 0 && a[2] == 0;
    parameters.attenuation = isPhysical ? vec4{0, 0, 1, 0} : vec4{a[0], a[1], a[2], 0};
    if (hasCone(light)) {
        const float outer = std::cos(light.outerConeAngle);
        parameters.coneScale = 1.0f / std::max(std::cos(light.innerConeAngle) - outer, 0.001f);
        parameters.coneOffset = -outer * parameters.coneScale;
    }
    parameters.kind = static_cast<uint>(light.kind);
    parameters.shadowMap = NACRE_NO_SHADOW_MAP;
    parameters.cascadeBlend = light.cascadeBlend;
    parameters.shadowFlags = (light.shadowDepthEncoding == NACRE_DEPTH_HARDWARE ? shadowHardwareDepth : 0u) |
                             (light.shadowFrontFacesCulled ? shadowFrontFacesCulled : 0u) |
                             (light.cascadeChoice == NACRE_CASCADE_BY_VIEW_DEPTH ? shadowCascadeByViewDepth : 0u);
    return parameters;
}

void setMap(LightParameters& parameters, const NacreLight& light, const MapUse& map, const NacreTransmitInfo& info) {
    const VkExtent2D size = sizeOf(map, info);
    const bool isHardware = light.shadowDepthEncoding == NACRE_DEPTH_HARDWARE;
    std::array<double, 3> origin{light.position[0], light.position[1], light.position[2]};
    if (isHardware && light.kind == NACRE_LIGHT_DIRECTIONAL) {
        origin = middleOfMap(map.clipFromWorld);
        parameters.position = {static_cast<float>(origin[0]), static_cast<float>(origin[1]),
                               static_cast<float>(origin[2]), light.range};
        origin = {parameters.position.x, parameters.position.y, parameters.position.z};
    }
    parameters.direction.w = map.range;
    parameters.shadowMap = map.shadowMap;
    parameters.shadowLayer = map.layer;
    parameters.shadowOrigin = {map.rectangle.offset.x, map.rectangle.offset.y};
    parameters.shadowSize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    if (light.kind == NACRE_LIGHT_POINT) {
        parameters.shadowTexel = 2.0f / static_cast<float>(std::min(size.width, size.height));
    } else {
        setProjection(parameters, map.clipFromWorld, origin, size);
    }
    if (isHardware) {
        parameters.offsetFromTexel = (light.kind == NACRE_LIGHT_POINT ? cubeDecodingOf(map.clipFromWorld, size)
                                                                      : decodingOf(map.clipFromWorld, origin, size))
                                         .offsetFromTexel;
    }
}

bool isGeneral(const NacreLight& light) {
    const bool hasMap = light.shadowMap != NACRE_NO_SHADOW_MAP;
    const float* a = light.attenuation;
    return light.cascadeCount > 0 || a[0] != 0 || a[1] != 0 || a[2] != 0 ||
           (hasMap && (light.shadowDepthEncoding == NACRE_DEPTH_HARDWARE || light.shadowFrontFacesCulled ||
                       light.shadowRectangle.extent.width != 0));
}

} // namespace

void checkLights(const NacreTransmitInfo& info) {
    if (info.shadowMapCount > NACRE_MAX_SHADOW_MAPS) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, "NacreTransmitInfo::shadowMapCount is ", info.shadowMapCount, ", at most ",
             NACRE_MAX_SHADOW_MAPS);
    }
    if (info.lightCount > 0) {
        checkGiven(info.lights, "NacreTransmitInfo::lights");
    }
    if (info.shadowMapCount > 0) {
        checkGiven(info.shadowMaps, "NacreTransmitInfo::shadowMaps");
    }
    for (std::uint32_t i = 0; i < info.lightCount; ++i) {
        checkLight(info.lights[i], FieldName("NacreTransmitInfo::lights").at(i), info);
    }
}

std::uint32_t lightElementCount(const NacreTransmitInfo& info) {
    std::uint32_t count = info.lightCount;
    for (const NacreLight& light : std::span(info.lights, info.lightCount)) {
        count += light.cascadeCount;
    }
    return count;
}

Variant variantOf(const NacreTransmitInfo& info, ImageSet given) {
    const std::span lights(info.lights, info.lightCount);
    return (info.shadowMapCount > 1 ? severalShadowMaps : 0) |
           ((given >> NACRE_IMAGE_SCALE & 1u) != 0 || std::any_of(lights.begin(), lights.end(), isGeneral) ? generalCall
                                                                                                           : 0);
}

void fillLights(const NacreTransmitInfo& info, std::byte* to) {
    const double unit = mmPerUnit(info.view, "NacreTransmitInfo");
    const auto write = [to](std::uint32_t index, const LightParameters& light) {
        std::memcpy(to + index * sizeof(light), &light, sizeof(light));
    };
    std::uint32_t next = info.lightCount;
    for (std::uint32_t i = 0; i < info.lightCount; ++i) {
        const NacreLight& light = info.lights[i];
        LightParameters parameters = parametersOf(light, static_cast<float>(1e-3 * unit));
        LightParameters cascadeParameters = parameters;
        for (std::uint32_t c = 0; c < light.cascadeCount; ++c) {
            setMap(cascadeParameters, light, mapOf(light, light.cascades[c]), info);
            cascadeParameters.cascadeSpan = {c == 0 ? 0.0f : cascadeParameters.cascadeSpan.y,
                                             static_cast<float>(unit * light.cascades[c].farDepth)};
            write(next + c, cascadeParameters);
        }
        if (light.cascadeCount > 0) {
            parameters.firstCascade = next;
            parameters.cascadeCount = light.cascadeCount;
            next += light.cascadeCount;
        } else if (light.shadowMap != NACRE_NO_SHADOW_MAP) {
            setMap(parameters, light, mapOf(light), info);
        }
        write(i, parameters);
    }
}

} // namespace nacre::effect
