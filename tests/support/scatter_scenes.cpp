#include "tests/support/scatter_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace nacre::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double skinReach = 12.5; // mm, 99.7 % of d'Eon's skin

struct Vector3 {
    double x = 0;
    double y = 0;
    double z = 0;
};

double dot(const Vector3& a, const Vector3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector3 normalized(const Vector3& a) {
    const double scale = 1 / std::sqrt(dot(a, a));
    return {a.x * scale, a.y * scale, a.z * scale};
}

// Positions in px on the plane at the middle depth, so that a scene looks the same at every footprint.
struct Hit {
    double depth = 0; // px, relative to the middle depth, away from the camera
    int material = 0;
    Vector3 normal{0, 0, -1};
};

// The numbers every scene is made from.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }

private:
    std::mt19937 engine_;
};

// Hard shadow edges, bright and dark discs, and a corner with noise in every pixel. Fixed to the scene.
class Lighting {
public:
    Lighting(Dice& dice, double width, double height) {
        for (Edge& edge : edges_) {
            const double angle = dice(0, 2 * pi);
            edge = {std::cos(angle), std::sin(angle), dice(-0.4, 0.4) * std::min(width, height)};
        }
        for (Disc& disc : discs_) {
            disc = {
                dice(-0.5, 0.5) * width, dice(-0.5, 0.5) * height, dice(2, 30), {dice(0, 1), dice(0, 1), dice(0, 1)}};
        }
        noiseSeed_ = static_cast<std::uint32_t>(dice(1, 1e6));
    }

    Rgb at(double x, double y, const Vector3& normal) const {
        const double facing = std::max(0.0, dot(normal, normalized({0.4, -0.5, -0.8})));
        int crossings = 0;
        for (const Edge& edge : edges_) {
            crossings += edge.x * x + edge.y * y > edge.offset;
        }
        const double lit = crossings % 2 == 0 ? 0.85 : 0.05;
        Rgb light{0.06 + lit * facing, 0.08 + 0.95 * lit * facing, 0.10 + 0.9 * lit * facing};
        for (const Disc& disc : discs_) {
            if (std::hypot(x - disc.x, y - disc.y) < disc.radius) {
                for (int channel = 0; channel < 3; ++channel) {
                    light[channel] = disc.color[channel] * (0.2 + 0.8 * facing);
                }
            }
        }
        if (x > 0 && y > 0) {
            const double scale = 0.75 + 0.5 * noise(static_cast<int>(x), static_cast<int>(y));
            for (double& value : light) {
                value = std::min(1.0, value * scale);
            }
        }
        return light;
    }

private:
    struct Edge {
        double x, y, offset;
    };
    struct Disc {
        double x, y, radius;
        Rgb color;
    };

    double noise(int x, int y) const {
        std::uint32_t h =
            noiseSeed_ + static_cast<std::uint32_t>(x) * 0x9e3779b9u + static_cast<std::uint32_t>(y) * 0x85ebca6bu;
        h = (h ^ h >> 16) * 0x7feb352du;
        h = (h ^ h >> 15) * 0x846ca68bu;
        return static_cast<double>(h ^ h >> 16) / 4294967296.0;
    }

    std::array<Edge, 4> edges_{};
    std::array<Disc, 14> discs_{};
    std::uint32_t noiseSeed_ = 0;
};

// A ray through (x, y) px at the middle depth; `distance` is the middle depth in px.
using Surface = std::function<Hit(double x, double y, double distance)>;

int stripe(double x, double y, int count) {
    const double wavy = x + 12 * std::sin(y / 23.0);
    return 1 + (static_cast<int>(std::floor(wavy / 45.0)) % count + count) % count;
}

// Facing the camera: every material in wavy strips, and holes that do not scatter.
Surface makePlane(Dice& dice, int materialCount, double width, double height) {
    std::array<std::array<double, 3>, 5> holes{};
    for (auto& hole : holes) {
        hole = {dice(-0.45, 0.45) * width, dice(-0.45, 0.45) * height, dice(4, 22)};
    }
    return [=](double x, double y, double) {
        const bool open = std::any_of(holes.begin(), holes.end(),
                                      [&](const auto& hole) { return std::hypot(x - hole[0], y - hole[1]) < hole[2]; });
        return Hit{0, open ? 0 : stripe(x, y, materialCount), {0, 0, -1}};
    };
}

// Nine overlapping spheres, some of two materials, in front of a wall.
Surface makeSpheres(Dice& dice, int materialCount, double width, double height) {
    struct Sphere {
        Vector3 centre;
        double radius;
        int material, other;
    };
    std::array<Sphere, 9> spheres{};
    for (Sphere& sphere : spheres) {
        sphere.radius = dice(0.1, 0.36) * height;
        sphere.centre = {dice(-0.45, 0.45) * width, dice(-0.45, 0.45) * height, dice(-0.3, 0.3) * height};
        sphere.material = 1 + static_cast<int>(dice(0, materialCount));
        sphere.other = dice(0, 1) < 0.4 ? 1 + static_cast<int>(dice(0, materialCount)) : sphere.material;
    }
    return [=](double x, double y, double distance) {
        Hit nearest{0.5 * height, 1, {0, 0, -1}};
        const Vector3 ray = normalized({x / distance, y / distance, 1});
        for (const Sphere& sphere : spheres) {
            const Vector3 centre{sphere.centre.x, sphere.centre.y, sphere.centre.z + distance};
            const double along = dot(ray, centre);
            const double under = along * along - dot(centre, centre) + sphere.radius * sphere.radius;
            if (under <= 0) {
                continue;
            }
            const double reach = along - std::sqrt(under);
            const double depth = reach * ray.z - distance;
            if (depth < nearest.depth) {
                const Vector3 normal{(reach * ray.x - centre.x) / sphere.radius,
                                     (reach * ray.y - centre.y) / sphere.radius,
                                     (reach * ray.z - centre.z) / sphere.radius};
                nearest = {depth, normal.y > 0.2 ? sphere.other : sphere.material, normal};
            }
        }
        return nearest;
    };
}

// Left a plane at 67 degrees to the view, right a corrugated sheet of slopes up to 60 degrees.
Surface makeTilt(Dice& dice, int materialCount, double, double height) {
    constexpr double farthest = 8;
    const double turn = dice(0, 2 * pi);
    const double wave = dice(0.18, 0.3) * height;
    const Vector3 normal{std::sin(67 * pi / 180) * std::cos(turn), std::sin(67 * pi / 180) * std::sin(turn),
                         -std::cos(67 * pi / 180)};
    const double split = dice(-0.1, 0.1) * height;
    return [=](double x, double y, double distance) {
        const int material = stripe(1.5 * y, x, materialCount);
        if (x < split) {
            const Vector3 ray{x / distance, y / distance, 1};
            const double along = normal.z * distance / dot(normal, ray);
            const bool inSight = along > 0 && along < farthest * distance; // else the horizon, or behind the camera
            return inSight ? Hit{along - distance, material, normal} : Hit{0, 0, normal};
        }
        const double phase = 2 * pi * x / wave;
        const double steepest = std::tan(60 * pi / 180);
        const double slope = steepest * std::cos(phase);
        const double depth = steepest * wave / (2 * pi) * std::sin(phase);
        // Depth is given along rays, which spread.
        return Hit{depth, material, normalized({slope, 0, -(1 + (depth + x * slope) / distance)})};
    };
}

// Bars 2 to 14 px wide 8 and 60 px before a wall, a mask with 16 px holes, dots in the air.
Surface makeThin(Dice& dice, int materialCount, double width, double height) {
    struct Bar {
        double at, width, depth;
        bool upright;
        int material;
    };
    std::vector<Bar> bars;
    const double widths[] = {2, 3, 4, 6, 8, 10, 14};
    for (const double barWidth : widths) {
        bars.push_back({dice(-0.48, 0.1) * width, barWidth, dice(0, 1) < 0.5 ? -8.0 : -60.0, true,
                        1 + static_cast<int>(dice(0, materialCount))});
        bars.push_back({dice(-0.48, 0.48) * height, barWidth, dice(0, 1) < 0.5 ? -8.0 : -60.0, false,
                        1 + static_cast<int>(dice(0, materialCount))});
    }
    std::array<std::array<double, 4>, 20> dots{};
    for (auto& dot : dots) {
        dot = {dice(-0.5, 0.5) * width, dice(-0.5, 0.5) * height, dice(1.5, 6), dice(-80, -30)};
    }
    return [=](double x, double y, double) {
        Hit nearest{0, 1, {0, 0, -1}};
        if (x > 0.2 * width) {
            const bool hole = (static_cast<int>(std::floor(x / 16)) + static_cast<int>(std::floor(y / 16))) % 2 == 0;
            nearest.material = hole ? 0 : 2 % materialCount + 1;
        }
        for (const Bar& bar : bars) {
            const bool inside = std::abs((bar.upright ? x : y) - bar.at) < bar.width / 2;
            if (inside && (!bar.upright || y < 0.35 * height) && (bar.upright || x < 0.2 * width) &&
                bar.depth < nearest.depth) {
                nearest = {bar.depth, bar.material, {0, 0, -1}};
            }
        }
        for (const auto& dot : dots) {
            if (std::hypot(x - dot[0], y - dot[1]) < dot[2] && dot[3] < nearest.depth) {
                nearest = {dot[3], 1, {0, 0, -1}};
            }
        }
        return nearest;
    };
}

Surface makeSurface(SceneKind kind, Dice& dice, int materialCount, double width, double height) {
    switch (kind) {
    case SceneKind::Plane:
        return makePlane(dice, materialCount, width, height);
    case SceneKind::Spheres:
        return makeSpheres(dice, materialCount, width, height);
    case SceneKind::Tilt:
        return makeTilt(dice, materialCount, width, height);
    default:
        return makeThin(dice, materialCount, width, height);
    }
}

std::string sceneName(const SceneSettings& settings) {
    static const char* const names[] = {"plane", "spheres", "tilt", "thin"};
    return std::string(names[static_cast<int>(settings.kind)]) + "@" +
           std::to_string(static_cast<int>(settings.footprint));
}

} // namespace

std::vector<Material> testMaterials() {
    Material skin;
    skin.name = "skin";
    skin.layers = {{{0.233, 0.455, 0.649}, 0.0064}, {{0.100, 0.336, 0.344}, 0.0484}, {{0.118, 0.198, 0.000}, 0.187},
                   {{0.113, 0.007, 0.007}, 0.567},  {{0.358, 0.004, 0.000}, 1.99},   {{0.078, 0.000, 0.000}, 7.41}};
    Material marble;
    marble.name = "marble";
    marble.layers = {{{0.0544578, 0.124549, 0.217725}, 0.0362209},
                     {{0.243663, 0.243532, 0.189042}, 0.114451},
                     {{0.310530, 0.315817, 0.374245}, 0.455584},
                     {{0.391349, 0.316102, 0.218988}, 3.48332}};
    Material wide;
    wide.name = "burley, wide";
    wide.meanFreePath = Rgb{0.75, 0.4, 0.25};
    Material narrow;
    narrow.name = "burley, narrow";
    narrow.meanFreePath = Rgb{0.3, 0.3, 0.3};
    return {skin, marble, wide, narrow};
}

ScatterScene makeScatterScene(const SceneSettings& settings) {
    ScatterScene scene;
    scene.name = sceneName(settings);
    scene.width = settings.width;
    scene.height = settings.height;
    scene.focalLength = 1.2 * settings.width * settings.zoom;
    scene.materials = settings.materials.empty() ? testMaterials() : settings.materials;
    for (const Material& material : scene.materials) {
        scene.profiles.push_back(makeProfile(material));
    }

    Dice dice(settings.seed);
    const double width = settings.width;
    const double height = settings.height;
    const double distance = 1.2 * width;
    const double millimetersPerPixel = skinReach / settings.footprint;
    const Lighting lighting(dice, width, height);
    const Surface surface = makeSurface(settings.kind, dice, static_cast<int>(scene.materials.size()), width, height);
    for (int row = 0; row < settings.height; ++row) {
        for (int column = 0; column < settings.width; ++column) {
            const double x = (column + 0.5 - width / 2) / settings.zoom + settings.shift;
            const double y = (row + 0.5 - height / 2) / settings.zoom + settings.shift;
            const Hit hit = surface(x, y, distance);
            scene.depth.push_back((distance + hit.depth) * millimetersPerPixel);
            scene.normal.push_back({hit.normal.x, hit.normal.y, hit.normal.z});
            scene.materialId.push_back(static_cast<std::uint8_t>(hit.material));
            scene.irradiance.push_back(lighting.at(x, y, hit.normal));
        }
    }
    return scene;
}

} // namespace nacre::tests
