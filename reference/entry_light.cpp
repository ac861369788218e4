#include "reference/entry_light.hpp"

#include <cmath>

namespace nacre::reference {

using trace::Side;

std::optional<Wall> wallOf(const Material& material, const trace::SurfacePoint& point, bool seenFromBehind) {
    if (!(material.diffuseTransmission > 0)) {
        return std::nullopt;
    }
    const double share = material.diffuseTransmission * static_cast<double>(point.shareFactor);
    const glm::dvec3 albedo(point.albedo);
    glm::dvec3 color = albedo;
    if (const auto& own = material.diffuseTransmissionColor) {
        color =
            glm::dvec3((*own)[0], (*own)[1], (*own)[2]) * glm::dvec3(point.transmissionColor.value_or(glm::vec3(1)));
    } else if (point.transmissionColor) {
        color = glm::dvec3(*point.transmissionColor);
    }
    return Wall{seenFromBehind ? Side::Back : Side::Front, (1 - share) * albedo, share * color};
}

EntryLight::EntryLight(const trace::Geometry& geometry) : geometry_(geometry), illumination_(geometry) {}

void EntryLight::setRendered(const trace::View& view, const glm::dvec2& pictureSize, nacre::Image image) {
    view_ = view;
    pictureSize_ = pictureSize;
    image_ = std::move(image);
}

std::optional<glm::dvec3> EntryLight::rendered(const trace::SurfacePoint& point, Side side) const {
    if (!view_) {
        return std::nullopt;
    }
    const std::optional<glm::dvec2> place = view_->project(point.position);
    if (!place || !(place->x >= 0 && place->x < pictureSize_.x && place->y >= 0 && place->y < pictureSize_.y)) {
        return std::nullopt;
    }
    const glm::vec3 outward = side == Side::Front ? point.normal : -point.normal;
    trace::Ray back = view_->rayBack(point.position);
    if (glm::dot(back.direction, outward) <= 0) {
        return std::nullopt;
    }
    back.origin = geometry_.movedOff(point.position, outward);
    if (geometry_.occluded(back)) {
        return std::nullopt;
    }
    const auto column = static_cast<std::size_t>(place->x / pictureSize_.x * image_.width);
    const auto row = static_cast<std::size_t>(place->y / pictureSize_.y * image_.height);
    const std::span<const float> pixel = image_.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    return glm::dvec3(pixel[0], pixel[1], pixel[2]);
}

glm::dvec3 EntryLight::irradiance(const trace::SurfacePoint& point, Side side, trace::Random& random) const {
    const std::optional<glm::dvec3> fromImage = rendered(point, side);
    return fromImage ? *fromImage : illumination_.irradiance(point, side, random);
}

glm::dvec3 EntryLight::entering(const trace::SurfacePoint& point, trace::Random& random) const {
    glm::dvec3 sum = irradiance(point, Side::Front, random);
    if (point.doubleSided) {
        sum += irradiance(point, Side::Back, random);
    }
    return sum;
}

glm::dvec3 EntryLight::entering(const trace::SurfacePoint& point, const Wall& wall, trace::Random& random) const {
    const Side farSide = wall.nearSide == Side::Front ? Side::Back : Side::Front;
    return wall.nearWeight * irradiance(point, wall.nearSide, random) +
           wall.farWeight * irradiance(point, farSide, random);
}

} // namespace nacre::reference
