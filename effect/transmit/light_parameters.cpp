#include "transmit/light_parameters.hpp"

#include "contract/validation.hpp"
#include "contract/view_parameters.hpp"
#include "transmit/transmit_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

namespace nacre::effect {
namespace {

/// A point light may have one, too.
bool hasCone(const NacreLight& light) {
    return light.kind == NACRE_LIGHT_SPOT || (light.kind == NACRE_LIGHT_POINT && light.outerConeAngle > 0);
}

void checkLight(const NacreLight& light, const FieldName& field, std::uint32_t shadowMapCount) {
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
    if (light.kind != NACRE_LIGHT_DIRECTIONAL) {
        checkRange(light.outerConeAngle, 0, std::numbers::pi_v<float> / 2, field + ".outerConeAngle");
        checkRange(light.innerConeAngle, 0, light.outerConeAngle, field + ".innerConeAngle");
    }
    if (light.shadowMap == NACRE_NO_SHADOW_MAP) {
        return;
    }
    if (light.shadowMap >= shadowMapCount) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".shadowMap is ", light.shadowMap,
             ", NacreTransmitInfo::shadowMapCount is ", shadowMapCount);
    }
    if (!std::isfinite(light.shadowRange) || light.shadowRange <= 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, ".shadowRange is ", light.shadowRange, ", must be positive");
    }
    if (light.kind != NACRE_LIGHT_POINT) {
        checkFinite(light.shadowClipFromWorld, field + ".shadowClipFromWorld");
    }
}

using Row = std::array<double, 4>;

/// A row of shadowClipFromWorld, for offsets from the light's position.
Row shadowRow(const NacreLight& light, int row) {
    const float* m = light.shadowClipFromWorld + row;
    Row result{m[0], m[4], m[8], m[12]};
    for (std::size_t i = 0; i < 3; ++i) {
        result[3] += result[i] * light.position[i];
    }
    return result;
}

void setProjection(LightParameters& parameters, const NacreLight& light, VkExtent2D size) {
    const Row w = shadowRow(light, 3);
    const auto scaled = [](const Row& row, double scale) {
        const auto value = [&](std::size_t i) { return static_cast<float>(scale * row[i]); };
        return vec4{value(0), value(1), value(2), value(3)};
    };
    double texel = 0;
    const auto texelRow = [&](int axis, double texels) {
        Row row = shadowRow(light, axis);
        texel = std::max(texel, 2 / (std::hypot(row[0], row[1], row[2]) * texels));
        std::transform(row.begin(), row.end(), w.begin(), row.begin(), std::plus<>());
        return scaled(row, 0.5 * texels); // clip [-1, 1] is [0, texels]
    };
    parameters.shadowX = texelRow(0, size.width);
    parameters.shadowY = texelRow(1, size.height);
    parameters.shadowW = scaled(w, 1);
    parameters.shadowTexel = static_cast<float>(texel);
}

LightParameters parametersOf(const NacreLight& light, const NacreTransmitInfo& info, float metersPerUnit) {
    LightParameters parameters{};
    parameters.position = {light.position[0], light.position[1], light.position[2], light.range};
    if (light.kind != NACRE_LIGHT_POINT || hasCone(light)) {
        const float length = std::hypot(light.direction[0], light.direction[1], light.direction[2]);
        parameters.direction = {light.direction[0] / length, light.direction[1] / length, light.direction[2] / length,
                                0};
    }
    parameters.direction.w = light.shadowRange;
    parameters.irradiance = {light.irradiance[0], light.irradiance[1], light.irradiance[2], metersPerUnit};
    if (hasCone(light)) {
        const float outer = std::cos(light.outerConeAngle);
        parameters.coneScale = 1.0f / std::max(std::cos(light.innerConeAngle) - outer, 0.001f);
        parameters.coneOffset = -outer * parameters.coneScale;
    }
    parameters.kind = static_cast<uint>(light.kind);
    parameters.shadowMap = light.shadowMap;
    parameters.shadowLayer = light.shadowLayer;
    if (light.shadowMap != NACRE_NO_SHADOW_MAP) {
        const VkExtent2D size = info.shadowMaps[light.shadowMap].extent;
        parameters.shadowSize = {static_cast<float>(size.width), static_cast<float>(size.height)};
        if (light.kind == NACRE_LIGHT_POINT) {
            parameters.shadowTexel = 2.0f / static_cast<float>(std::min(size.width, size.height));
        } else {
            setProjection(parameters, light, size);
        }
    }
    return parameters;
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
        checkLight(info.lights[i], FieldName("NacreTransmitInfo::lights").at(i), info.shadowMapCount);
    }
}

void fillLights(const NacreTransmitInfo& info, std::byte* to) {
    const auto metersPerUnit = static_cast<float>(1e-3 * mmPerUnit(info.view, "NacreTransmitInfo"));
    for (std::uint32_t i = 0; i < info.lightCount; ++i) {
        const LightParameters light = parametersOf(info.lights[i], info, metersPerUnit);
        std::memcpy(to + i * sizeof(light), &light, sizeof(light));
    }
}

} // namespace nacre::effect
