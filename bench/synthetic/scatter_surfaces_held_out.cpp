// Kinds of scene that the bank's constants were not chosen on.
#include "bench/synthetic/scatter_surfaces.hpp"

#include <algorithm>
#include <numbers>

namespace nacre::bench {
namespace {

using std::numbers::pi;

// Between whole places, with a continuous slope.
double smoothNoise(double x, double y, std::uint32_t seed) {
    const double left = std::floor(x);
    const double top = std::floor(y);
    const auto ease = [](double t) { return t * t * (3 - 2 * t); };
    const auto at = [&](int i, int j) {
        return latticeNoise(static_cast<int>(left) + i, static_cast<int>(top) + j, seed);
    };
    const double u = ease(x - left);
    const double v = ease(y - top);
    return std::lerp(std::lerp(at(0, 0), at(1, 0), u), std::lerp(at(0, 1), at(1, 1), u), v);
}

} // namespace

// A plane at 80 degrees to the view up to the horizon, as one sees a floor: near and far in one picture.
Surface makeFloor(Dice&, const Frame& frame) {
    const Vector3<double> normal{0, -std::sin(80 * pi / 180), -std::cos(80 * pi / 180)};
    return [=](double x, double y, double distance) {
        return planeHit(normal, x, y, distance, stripe(x, y, frame.materialCount));
    };
}

// Bumps of five octaves.
Surface makeTerrain(Dice& dice, const Frame& frame) {
    const auto seed = static_cast<std::uint32_t>(dice(1, 1e6));
    const auto depthAt = [=](double x, double y) {
        double depth = 0;
        double scale = 1.0 / 60;
        double height = 30;
        for (int octave = 0; octave < 5; ++octave) {
            depth += height * (smoothNoise(x * scale, y * scale, seed + octave) - 0.5);
            scale *= 2.1;
            height *= 0.5;
        }
        return depth;
    };
    return [=](double x, double y, double distance) {
        constexpr double step = 0.01;
        const double slopeX = (depthAt(x + step, y) - depthAt(x - step, y)) / (2 * step);
        const double slopeY = (depthAt(x, y + step) - depthAt(x, y - step)) / (2 * step);
        const double depth = depthAt(x, y);
        return Hit{depth, stripe(x, y, frame.materialCount), slopeNormal(x, y, depth, slopeX, slopeY, distance)};
    };
}

// Forty corners of boxes that point at the camera, before a wall.
Surface makeBoxes(Dice& dice, const Frame& frame) {
    struct Box {
        double x, y, radius, depth, cosine, sine;
        int material;
    };
    std::vector<Box> boxes;
    for (int i = 0; i < 40; ++i) {
        const double turn = dice(0, pi / 2);
        boxes.push_back({dice(-0.5, 0.5) * frame.width, dice(-0.5, 0.5) * frame.height, dice(8, 40), dice(-40, 40),
                         std::cos(turn), std::sin(turn), dice.material(frame.materialCount)});
    }
    return [=](double x, double y, double distance) {
        Hit nearest{70, 1, {0, 0, -1}};
        for (const Box& box : boxes) {
            const double u = (x - box.x) * box.cosine + (y - box.y) * box.sine;
            const double v = (y - box.y) * box.cosine - (x - box.x) * box.sine;
            const double depth = box.depth - 0.9 * box.radius + 1.3 * std::abs(u) + 0.7 * std::abs(v);
            if (std::abs(u) + std::abs(v) < box.radius && depth < nearest.depth) {
                const double alongU = std::copysign(1.3, u);
                const double alongV = std::copysign(0.7, v);
                const double slopeX = alongU * box.cosine - alongV * box.sine;
                const double slopeY = alongU * box.sine + alongV * box.cosine;
                nearest = {depth, box.material, slopeNormal(x, y, depth, slopeX, slopeY, distance)};
            }
        }
        return nearest;
    };
}

// A sheet with round holes, through which a second one 14 px behind it is seen.
Surface makeSheets(Dice& dice, const Frame& frame) {
    const double spacing = dice(20, 28);
    const double radius = spacing / 3;
    return [=](double x, double y, double) {
        const double dx = x - spacing * std::round(x / spacing);
        const double dy = y - spacing * std::round(y / spacing);
        const bool open = isWithin(dx, dy, radius);
        return open ? Hit{14, 1 + 1 % frame.materialCount} : Hit{0, 1};
    };
}

// Five hundred tilted discs at all depths, nothing behind them.
Surface makeFoliage(Dice& dice, const Frame& frame) {
    struct Disc {
        double x, y, radius, depth, slopeX, slopeY;
        int material;
    };
    std::vector<Disc> discs;
    for (int i = 0; i < 500; ++i) {
        discs.push_back({dice(-0.55, 0.55) * frame.width, dice(-0.55, 0.55) * frame.height, dice(3, 13), dice(-90, 60),
                         dice(-1.2, 1.2), dice(-1.2, 1.2), dice.material(frame.materialCount)});
    }
    return [=](double x, double y, double distance) {
        Hit nearest{1e3, 0};
        for (const Disc& disc : discs) {
            const double depth = disc.depth + disc.slopeX * (x - disc.x) + disc.slopeY * (y - disc.y);
            if (isWithin(x - disc.x, y - disc.y, disc.radius) && depth < nearest.depth) {
                nearest = {depth, disc.material, slopeNormal(x, y, depth, disc.slopeX, disc.slopeY, distance)};
            }
        }
        return nearest.material != 0 ? nearest : Hit{};
    };
}

// Strands 1 to 3 px wide at all depths before a wall.
Surface makeHair(Dice& dice, const Frame& frame) {
    struct Strand {
        double cosine, sine, offset, halfWidth, depth;
        int material;
    };
    std::vector<Strand> strands;
    for (int i = 0; i < 120; ++i) {
        const double turn = dice(-0.5, 0.5);
        strands.push_back({std::cos(turn), std::sin(turn), dice(-0.55, 0.55) * frame.width, dice(0.5, 1.6),
                           dice(-60, 20), dice.material(frame.materialCount)});
    }
    return [=](double x, double y, double) {
        Hit nearest{40, 1};
        for (const Strand& strand : strands) {
            const bool inside = std::abs(strand.cosine * x + strand.sine * y - strand.offset) < strand.halfWidth;
            if (inside && strand.depth < nearest.depth) {
                nearest = {strand.depth, strand.material};
            }
        }
        return nearest;
    };
}

} // namespace nacre::bench
