#include "bench/synthetic/scatter_scenes.hpp"
#include "bench/synthetic/scatter_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nacre::bench {
namespace {

using std::numbers::pi;
constexpr double reachMillimeters = 12.5; // mm, within which 99.7 % of the widest test material's light leaves

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

    Rgb at(double x, double y, const Vector3<double>& normal) const {
        const double facing = std::max(0.0, dot(normal, normalized(Vector3<double>{0.4, -0.5, -0.8})));
        int crossings = 0;
        for (const Edge& edge : edges_) {
            crossings += edge.x * x + edge.y * y > edge.offset;
        }
        const double lit = crossings % 2 == 0 ? 0.85 : 0.05;
        Rgb light{0.06 + lit * facing, 0.08 + 0.95 * lit * facing, 0.10 + 0.9 * lit * facing};
        for (const Disc& disc : discs_) {
            if (isWithin(x - disc.x, y - disc.y, disc.radius)) {
                for (int channel = 0; channel < 3; ++channel) {
                    light[channel] = disc.color[channel] * (0.2 + 0.8 * facing);
                }
            }
        }
        if (x > 0 && y > 0) {
            const double scale = 0.75 + 0.5 * latticeNoise(static_cast<int>(x), static_cast<int>(y), noiseSeed_);
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

    std::array<Edge, 4> edges_{};
    std::array<Disc, 14> discs_{};
    std::uint32_t noiseSeed_ = 0;
};

struct KindInfo {
    const char* name;
    Surface (*makeSurface)(Dice& dice, const Frame& frame);
};

constexpr KindInfo kinds[] = {{"plane", makePlane}, {"spheres", makeSpheres}, {"tilt", makeTilt},
                              {"thin", makeThin},   {"floor", makeFloor},     {"terrain", makeTerrain},
                              {"boxes", makeBoxes}, {"sheets", makeSheets},   {"foliage", makeFoliage},
                              {"hair", makeHair}};
static_assert(std::size(kinds) == std::size(tunedSceneKinds) + std::size(heldOutSceneKinds));

} // namespace

const char* sceneKindName(SceneKind kind) {
    return kinds[static_cast<std::size_t>(kind)].name;
}

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
    const KindInfo& kind = kinds[static_cast<std::size_t>(settings.kind)];
    scene.name = std::string(kind.name) + "@" + std::to_string(static_cast<int>(settings.footprint));
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
    const double millimetersPerPixel = reachMillimeters / settings.footprint;
    const Lighting lighting(dice, width, height);
    const Surface surface = kind.makeSurface(dice, {width, height, static_cast<int>(scene.materials.size())});
    for (int row = 0; row < settings.height; ++row) {
        for (int column = 0; column < settings.width; ++column) {
            const double x = (column + 0.5 - width / 2) / settings.zoom + settings.shift;
            const double y = (row + 0.5 - height / 2) / settings.zoom + settings.shift;
            const Hit hit = surface(x, y, distance);
            scene.depth.push_back((distance + hit.depth) * millimetersPerPixel);
            scene.normal.push_back(hit.normal);
            scene.materialId.push_back(static_cast<std::uint8_t>(hit.material));
            scene.irradiance.push_back(lighting.at(x, y, hit.normal));
        }
    }
    return scene;
}

} // namespace nacre::bench
