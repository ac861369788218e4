// What the synthetic scenes show, as functions of a pixel's place.
#pragma once

#include "bench/synthetic/scatter_scenes.hpp"
#include "bench/synthetic/vector3.hpp"

#include <cmath>
#include <functional>
#include <random>

namespace nacre::bench {

/// Positions in px on the plane at the middle depth, so that a scene looks the same at every footprint.
struct Hit {
    double depth = 0; ///< px, relative to the middle depth, away from the camera
    int material = 0;
    Vector3<double> normal{0, 0, -1};
};

/// The numbers every scene is made from.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    /// [1, count]
    int material(int count) { return 1 + static_cast<int>((*this)(0, count)); }

private:
    std::mt19937 engine_;
};

/// A ray through (x, y) px at the middle depth; `distance` is the middle depth in px.
using Surface = std::function<Hit(double x, double y, double distance)>;

/// How large a picture is, px, and how many materials it shows.
struct Frame {
    double width = 0;
    double height = 0;
    int materialCount = 0;
};

inline bool isWithin(double x, double y, double radius) {
    return x * x + y * y < radius * radius;
}
/// [0, 1] at whole places, different at each.
double latticeNoise(int x, int y, std::uint32_t seed);
/// A material in wavy stripes.
int stripe(double x, double y, int count);
/// Where a ray meets a plane through the middle of the scene; nothing where that is far away or behind the camera.
Hit planeHit(const Vector3<double>& normal, double x, double y, double distance, int material);
/// Normal of a surface whose depth along the rays, which spread, changes so from pixel to pixel.
Vector3<double> slopeNormal(double x, double y, double depth, double slopeX, double slopeY, double distance);

Surface makePlane(Dice& dice, const Frame& frame);
Surface makeSpheres(Dice& dice, const Frame& frame);
Surface makeTilt(Dice& dice, const Frame& frame);
Surface makeThin(Dice& dice, const Frame& frame);

Surface makeFloor(Dice& dice, const Frame& frame);
Surface makeTerrain(Dice& dice, const Frame& frame);
Surface makeBoxes(Dice& dice, const Frame& frame);
Surface makeSheets(Dice& dice, const Frame& frame);
Surface makeFoliage(Dice& dice, const Frame& frame);
Surface makeHair(Dice& dice, const Frame& frame);

} // namespace nacre::bench
