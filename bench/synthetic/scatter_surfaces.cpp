// The scenes that the bank's constants were chosen on.
#include "bench/synthetic/scatter_surfaces.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace nacre::bench {

using std::numbers::pi;

double latticeNoise(int x, int y, std::uint32_t seed) {
    std::uint32_t h = seed + static_cast<std::uint32_t>(x) * 0x9e3779b9u + static_cast<std::uint32_t>(y) * 0x85ebca6bu;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return static_cast<double>(h ^ h >> 16) / 4294967296.0;
}

int stripe(double x, double y, int count) {
    const double wavy = x + 12 * std::sin(y / 23.0);
    return 1 + (static_cast<int>(std::floor(wavy / 45.0)) % count + count) % count;
}

Hit planeHit(const Vector3<double>& normal, double x, double y, double distance, int material) {
    constexpr double farthest = 8;
    const double along = normal[2] * distance / dot(normal, Vector3<double>{x / distance, y / distance, 1});
    const bool inSight = along > 0 && along < farthest * distance; // else the horizon, or behind the camera
    return inSight ? Hit{along - distance, material, normal} : Hit{0, 0, normal};
}

Vector3<double> slopeNormal(double x, double y, double depth, double slopeX, double slopeY, double distance) {
    return normalized(Vector3<double>{slopeX, slopeY, -(1 + (depth + x * slopeX + y * slopeY) / distance)});
}

// Facing the camera: every material in wavy strips, and holes that do not scatter.
Surface makePlane(Dice& dice, const Frame& frame) {
    std::array<std::array<double, 3>, 5> holes{};
    for (auto& hole : holes) {
        hole = {dice(-0.45, 0.45) * frame.width, dice(-0.45, 0.45) * frame.height, dice(4, 22)};
    }
    return [=](double x, double y, double) {
        const bool open = std::any_of(holes.begin(), holes.end(),
                                      [&](const auto& hole) { return isWithin(x - hole[0], y - hole[1], hole[2]); });
        return Hit{0, open ? 0 : stripe(x, y, frame.materialCount), {0, 0, -1}};
    };
}

// Nine overlapping spheres, some of two materials, in front of a wall.
Surface makeSpheres(Dice& dice, const Frame& frame) {
    struct Sphere {
        Vector3<double> centre;
        double radius;
        int material, other;
    };
    std::array<Sphere, 9> spheres{};
    for (Sphere& sphere : spheres) {
        sphere.radius = dice(0.1, 0.36) * frame.height;
        sphere.centre = {dice(-0.45, 0.45) * frame.width, dice(-0.45, 0.45) * frame.height,
                         dice(-0.3, 0.3) * frame.height};
        sphere.material = dice.material(frame.materialCount);
        sphere.other = dice(0, 1) < 0.4 ? dice.material(frame.materialCount) : sphere.material;
    }
    return [=](double x, double y, double distance) {
        Hit nearest{0.5 * frame.height, 1, {0, 0, -1}};
        const Vector3<double> ray = normalized(Vector3<double>{x / distance, y / distance, 1});
        for (const Sphere& sphere : spheres) {
            const Vector3<double> centre{sphere.centre[0], sphere.centre[1], sphere.centre[2] + distance};
            const double along = dot(ray, centre);
            const double under = along * along - dot(centre, centre) + sphere.radius * sphere.radius;
            if (under <= 0) {
                continue;
            }
            const double reach = along - std::sqrt(under);
            const double depth = reach * ray[2] - distance;
            if (depth < nearest.depth) {
                const Vector3<double> normal{(reach * ray[0] - centre[0]) / sphere.radius,
                                             (reach * ray[1] - centre[1]) / sphere.radius,
                                             (reach * ray[2] - centre[2]) / sphere.radius};
                nearest = {depth, normal[1] > 0.2 ? sphere.other : sphere.material, normal};
            }
        }
        return nearest;
    };
}

// Left a plane at 67 degrees to the view, right a corrugated sheet of slopes up to 60 degrees.
Surface makeTilt(Dice& dice, const Frame& frame) {
    const double turn = dice(0, 2 * pi);
    const double wave = dice(0.18, 0.3) * frame.height;
    const Vector3<double> normal{std::sin(67 * pi / 180) * std::cos(turn), std::sin(67 * pi / 180) * std::sin(turn),
                                 -std::cos(67 * pi / 180)};
    const double split = dice(-0.1, 0.1) * frame.height;
    return [=](double x, double y, double distance) {
        const int material = stripe(1.5 * y, x, frame.materialCount);
        if (x < split) {
            return planeHit(normal, x, y, distance, material);
        }
        const double phase = 2 * pi * x / wave;
        const double steepest = std::tan(60 * pi / 180);
        const double slope = steepest * std::cos(phase);
        const double depth = steepest * wave / (2 * pi) * std::sin(phase);
        return Hit{depth, material, slopeNormal(x, y, depth, slope, 0, distance)};
    };
}

// Bars 2 to 14 px wide 8 and 60 px before a wall, a mask with 16 px holes, dots in the air.
Surface makeThin(Dice& dice, const Frame& frame) {
    struct Bar {
        double at, width, depth;
        bool upright;
        int material;
    };
    std::vector<Bar> bars;
    const double widths[] = {2, 3, 4, 6, 8, 10, 14};
    for (const double barWidth : widths) {
        bars.push_back({dice(-0.48, 0.1) * frame.width, barWidth, dice(0, 1) < 0.5 ? -8.0 : -60.0, true,
                        dice.material(frame.materialCount)});
        bars.push_back({dice(-0.48, 0.48) * frame.height, barWidth, dice(0, 1) < 0.5 ? -8.0 : -60.0, false,
                        dice.material(frame.materialCount)});
    }
    std::array<std::array<double, 4>, 20> dots{};
    for (auto& dot : dots) {
        dot = {dice(-0.5, 0.5) * frame.width, dice(-0.5, 0.5) * frame.height, dice(1.5, 6), dice(-80, -30)};
    }
    return [=](double x, double y, double) {
        Hit nearest{0, 1, {0, 0, -1}};
        if (x > 0.2 * frame.width) {
            const bool hole = (static_cast<int>(std::floor(x / 16)) + static_cast<int>(std::floor(y / 16))) % 2 == 0;
            nearest.material = hole ? 0 : 2 % frame.materialCount + 1;
        }
        for (const Bar& bar : bars) {
            const bool inside = std::abs((bar.upright ? x : y) - bar.at) < bar.width / 2;
            if (inside && (!bar.upright || y < 0.35 * frame.height) && (bar.upright || x < 0.2 * frame.width) &&
                bar.depth < nearest.depth) {
                nearest = {bar.depth, bar.material, {0, 0, -1}};
            }
        }
        for (const auto& dot : dots) {
            if (isWithin(x - dot[0], y - dot[1], dot[2]) && dot[3] < nearest.depth) {
                nearest = {dot[3], 1, {0, 0, -1}};
            }
        }
        return nearest;
    };
}

} // namespace nacre::bench
