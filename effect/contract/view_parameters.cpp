#include "contract/view_parameters.hpp"

#include "contract/validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nacre::effect {
namespace {

/// Column-major 4x4: m(row, column).
struct Matrix {
    const float* values;
    double operator()(int row, int column) const { return values[column * 4 + row]; }
};

struct Vector2 {
    double x, y;
};
vec2 toFloat(Vector2 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}
vec4 toFloat(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0};
}

/// Clip x and y are A·(x, y) + b(z); with A's inverse a pixel's ray is affine in the pixel's position.
void setRays(ViewParameters& parameters, const Matrix& clip, const VkRect2D& area, double mmPerUnit,
             const FieldName& field) {
    const double a = clip(0, 0) / mmPerUnit, b = clip(0, 1) / mmPerUnit;
    const double c = clip(1, 0) / mmPerUnit, d = clip(1, 1) / mmPerUnit;
    const double determinant = a * d - b * c;
    if (determinant == 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is not a projection: x and y do not determine the pixel");
    }
    const auto solve = [&](Vector2 v) {
        return Vector2{(d * v.x - b * v.y) / determinant, (a * v.y - c * v.x) / determinant};
    };
    const double wz = clip(3, 2) / mmPerUnit, w1 = clip(3, 3);
    // Normalised device coordinates of a pixel centre: pixel·step + start.
    const Vector2 step{2.0 / area.extent.width, 2.0 / area.extent.height};
    const Vector2 start{(1.0 - 2.0 * area.offset.x) / area.extent.width - 1.0,
                        (1.0 - 2.0 * area.offset.y) / area.extent.height - 1.0};
    const Vector2 rayX = solve({step.x * wz, 0});
    const Vector2 rayY = solve({0, step.y * wz});
    const Vector2 ray = solve({start.x * wz - clip(0, 2) / mmPerUnit, start.y * wz - clip(1, 2) / mmPerUnit});
    const Vector2 originX = solve({step.x * w1, 0});
    const Vector2 originY = solve({0, step.y * w1});
    const Vector2 origin = solve({start.x * w1 - clip(0, 3), start.y * w1 - clip(1, 3)});
    parameters.rayX = toFloat(rayX);
    parameters.rayY = toFloat(rayY);
    parameters.rayBias = toFloat(ray);
    parameters.originX = toFloat(originX);
    parameters.originY = toFloat(originY);
    parameters.originBias = toFloat(origin);
    parameters.clipW = toFloat({wz, w1});
    const auto clipZ = [&](Vector2 v) { return (clip(2, 0) * v.x + clip(2, 1) * v.y) / mmPerUnit; };
    parameters.depthSlope = toFloat(clipZ(rayX), clipZ(rayY), clipZ(ray) + clip(2, 2) / mmPerUnit);
    parameters.depthBias = toFloat(clipZ(originX), clipZ(originY), clipZ(origin) + clip(2, 3));
}

/// The camera's own place or, where an orthographic one sees what lies behind it, a little behind the near plane.
double distanceOrigin(const ViewParameters& parameters, const VkRect2D& area) {
    if (parameters.clipW.x != 0 || (parameters.flags & flagHardwareDepth) == 0) {
        return 0;
    }
    double nearest = -std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (int corner = 0; corner < 8; ++corner) { // of what is seen
        const double x = area.offset.x + ((corner & 1) != 0 ? area.extent.width : 0.0);
        const double y = area.offset.y + ((corner & 2) != 0 ? area.extent.height : 0.0);
        const auto at = [x, y](const vec4& affine) { return affine.x * x + affine.y * y + affine.z; };
        const double clipZ = (corner & 4) != 0 ? parameters.clipW.y : 0.0;
        const double z = (clipZ - at(parameters.depthBias)) / at(parameters.depthSlope);
        nearest = std::max(nearest, z);
        farthest = std::min(farthest, z);
    }
    const double behind = nearest + 0.01 * (nearest - farthest);
    return std::isfinite(behind) ? std::max(behind, 0.0) : 0.0;
}

void setWorld(ViewParameters& parameters, const Matrix& view, double mmPerUnit, const FieldName& field) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            double dot = 0;
            for (int k = 0; k < 3; ++k) {
                dot += view(i, k) * view(j, k);
            }
            if (std::abs(dot - (i == j)) > 1e-3) {
                fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is not a rotation and translation: its rows ", i, " and ",
                     j, " have the dot product ", dot);
            }
        }
    }
    const auto column = [](double x, double y, double z, double w) {
        return vec4{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
    };
    Vector2 originXy{};
    double originZ = 0;
    for (int k = 0; k < 3; ++k) {
        originXy.x -= view(k, 0) * view(k, 3);
        originXy.y -= view(k, 1) * view(k, 3);
        originZ -= view(k, 2) * view(k, 3);
    }
    for (int i = 0; i < 3; ++i) {
        parameters.viewFromWorld.columns[i] = column(view(0, i), view(1, i), view(2, i), 0);
        parameters.worldFromView.columns[i] =
            column(view(i, 0) / mmPerUnit, view(i, 1) / mmPerUnit, view(i, 2) / mmPerUnit, 0);
    }
    parameters.viewFromWorld.columns[3] = column(0, 0, 0, 1);
    parameters.worldFromView.columns[3] = column(originXy.x, originXy.y, originZ, 1);
}

} // namespace

double mmPerUnit(const NacreView& view, const FieldName& info) {
    const float metersPerUnit = view.metersPerUnit == 0 ? 1.0f : view.metersPerUnit;
    checkRange(metersPerUnit, 1e-6f, 1e6f, info + "::view.metersPerUnit");
    return 1000.0 * metersPerUnit;
}

void setView(ViewParameters& parameters, const NacreView& view, const VkRect2D& viewport, const VkRect2D& area,
             bool worldMatrix, const FieldName& info) {
    const FieldName clipField = info + "::view.clipFromView";
    checkFinite(view.clipFromView, clipField);
    if (view.depthEncoding != NACRE_DEPTH_LINEAR && view.depthEncoding != NACRE_DEPTH_HARDWARE) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, info, "::view.depthEncoding is ", static_cast<int>(view.depthEncoding));
    }
    const double unit = mmPerUnit(view, info);

    const Matrix clip{view.clipFromView};
    if (clip(3, 0) != 0 || clip(3, 1) != 0) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, clipField, "[", clip(3, 0) != 0 ? 3 : 7, "] is ",
             clip(3, 0) != 0 ? clip(3, 0) : clip(3, 1), ", must be 0: clip w may depend on view z alone");
    }
    if (clip(3, 2) > 0 || (clip(3, 2) == 0 && clip(3, 3) <= 0)) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, clipField, "[11] is ", clip(3, 2), " and [15] is ", clip(3, 3),
             ": clip w must be positive in front of the camera, which looks along -Z");
    }
    setRays(parameters, clip, viewport, unit, clipField);
    if (worldMatrix) {
        checkFinite(view.viewFromWorld, info + "::view.viewFromWorld");
        setWorld(parameters, Matrix{view.viewFromWorld}, unit, info + "::view.viewFromWorld");
    }
    parameters.areaOffset = {area.offset.x, area.offset.y};
    parameters.areaExtent = {static_cast<std::int32_t>(area.extent.width),
                             static_cast<std::int32_t>(area.extent.height)};
    parameters.mmPerUnit = static_cast<float>(unit);
    parameters.flags |= view.depthEncoding == NACRE_DEPTH_HARDWARE ? flagHardwareDepth : 0u;
    parameters.distanceOrigin = static_cast<float>(distanceOrigin(parameters, area));
}

} // namespace nacre::effect
