#include "view/model/inspection.hpp"

#include "trace/geometry.hpp"
#include "trace/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace nacre::view {
namespace {

constexpr double smallestFootprint = 0.5; // px: less does not leave its pixel
constexpr double leastShare = 0.001;      // of light that is worth a word

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

double widestRadius(const Material& material) {
    const std::unique_ptr<Profile> profile = makeProfile(material);
    return std::max({profile->rmsRadius(0), profile->rmsRadius(1), profile->rmsRadius(2)});
}

std::string scatterSentence(const Material& material, const renderer::EffectSettings& effect, double radius,
                            double pixels) {
    if (!effect.scatter) {
        return "It does not scatter here, because scatter is off.";
    }
    if (material.strength == 0) {
        return "It does not scatter here, because the material's strength is 0.";
    }
    if (pixels < smallestFootprint) {
        return "It scatters, but cannot be seen to: light travels " + number(radius) + " mm, which is " +
               number(pixels) + " px from here.";
    }
    return "It scatters: light travels " + number(radius) + " mm, which is " + number(pixels) + " px here.";
}

/// mm that a ray through the point along `direction` stays inside the body.
std::optional<double> thicknessAlong(const trace::Geometry& geometry, const trace::SurfacePoint& point,
                                     const glm::vec3& direction) {
    const glm::vec3 start = geometry.movedOff(point.position, -point.normal);
    const std::optional<trace::Hit> hit = geometry.closest({.origin = start, .direction = direction});
    if (!hit) {
        return std::nullopt;
    }
    return hit->distance * geometry.scene().metersPerUnit * 1000;
}

std::string transmitSentence(const trace::Geometry& geometry, const EditedScene& edited, const Material& material,
                             const renderer::EffectSettings& effect, const trace::SurfacePoint& point) {
    if (!effect.transmit) {
        return "Nothing comes through, because transmit is off.";
    }
    if (material.translucency == 0) {
        return "Nothing comes through, because the material's translucency is 0.";
    }
    const std::unique_ptr<Profile> profile = makeProfile(material);
    double best = 0;
    double thickness = 0;
    const scene::Light* through = nullptr;
    bool anyBehind = false;
    bool shadowless = false;
    for (const scene::Light& light : edited.lights) {
        const glm::vec3 towards = light.kind == scene::LightKind::Directional
                                      ? -glm::normalize(light.direction)
                                      : glm::normalize(light.position - point.position);
        if (glm::dot(towards, point.normal) >= 0) {
            continue;
        }
        anyBehind = true;
        shadowless = shadowless || !light.castsShadow;
        const std::optional<double> inside = thicknessAlong(geometry, point, towards);
        if (!light.castsShadow || !inside) {
            continue;
        }
        const double share = std::max({profile->slabTransmittance(0, *inside), profile->slabTransmittance(1, *inside),
                                       profile->slabTransmittance(2, *inside)});
        if (share > best || through == nullptr) {
            best = share;
            thickness = *inside;
            through = &light;
        }
    }
    if (!anyBehind) {
        return "Nothing comes through, because no light stands behind this place.";
    }
    if (through == nullptr) {
        return shadowless ? "Nothing comes through, because the light behind it casts no shadow."
                          : "Nothing comes through, because the body is open towards the light behind it.";
    }
    const std::string where = "'" + through->name + "' is behind " + number(thickness) + " mm of it";
    if (best < leastShare) {
        return "Nothing comes through, because " + where + ", more than light travels.";
    }
    return "At most " + number(100 * best) + " % of the light comes through: " + where + ".";
}

} // namespace

std::optional<Inspection> inspect(const trace::Geometry& geometry, const EditedScene& edited,
                                  const scene::Camera& camera, const renderer::EffectSettings& effect, glm::dvec2 place,
                                  std::uint32_t width, std::uint32_t height) {
    const trace::View view(camera, width, height);
    const std::optional<trace::Hit> hit = geometry.visible(view.ray(place.x * width, place.y * height));
    if (!hit) {
        return std::nullopt;
    }
    const scene::Scene& scene = geometry.scene();
    const scene::Instance& instance = scene.instances[hit->instance];
    const trace::SurfacePoint point = geometry.surfaceAt(*hit);
    Inspection result{.body = instance.name,
                      .surface = scene.meshes[instance.mesh].surface,
                      .material = {},
                      .pixelsPerMillimeter = 0,
                      .sentence = {}};
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const double depth = glm::dot(point.position - camera.position, forward);
    const double heightThere = camera.projection == scene::ProjectionKind::Orthographic
                                   ? camera.orthographicHeight
                                   : 2 * depth * std::tan(camera.verticalFieldOfView / 2);
    result.pixelsPerMillimeter = height / (heightThere * scene.metersPerUnit * 1000);
    const std::uint32_t material = edited.surfaces[result.surface].material;
    if (material == scene::none) {
        result.sentence = "It has no subsurface material: light leaves where it falls.";
        return result;
    }
    result.material = material;
    Material drawn = edited.materials[material].drawn();
    drawn.scale *= static_cast<double>(point.scale);
    const double radius = widestRadius(drawn);
    result.sentence = scatterSentence(drawn, effect, radius, radius * result.pixelsPerMillimeter) + " " +
                      transmitSentence(geometry, edited, drawn, effect, point);
    return result;
}

} // namespace nacre::view
