// What is on the screen while scatter is timed, and its images on the device.
#pragma once

#include "bench/effect/effect_context.hpp"

namespace nacre::bench {

struct ScatterSubject {
    SceneKind kind = SceneKind::Plane;
    VkExtent2D extent{};
    double footprint = 20; ///< px, SceneSettings::footprint
    double coverage = 1;   ///< planes: share of the pixels that scatter, a rectangle in the middle
    int layers = 6;        ///< planes: of every material
    int materials = 4;     ///< planes; the other scenes have the four test materials
    /// px, planes: side of the blocks that each are of the next material. Where it is odd, half of their borders fall
    /// into 2x2 px.
    std::uint32_t block = 8;

    /// "plane 1920x1080 cover 100% footprint 20 px, 6 layers, 4 materials in blocks of 8 px"
    std::string label() const;
};

/// Skin (d'Eon and Luebke) where there are six layers, else a material of its width in so many.
Material layeredSkin(int layers);

/// The subject's scene; a plane's ids are in scatterIds.
ScatterScene makeSubjectScene(const ScatterSubject& subject);

/// Material ids, which may exceed a scene's 8 bits.
std::vector<std::uint16_t> scatterIds(const ScatterScene& scene, const ScatterSubject& subject);

/// The images of a scatter call, and the struct that names them.
struct ScatterImages {
    /// `wideIds`: ids of 16 bits. `lightFormat`: of irradiance and scattered light.
    ScatterImages(renderer::Gpu& gpu, const ScatterScene& scene, std::span<const std::uint16_t> ids, bool wideIds,
                  bool albedo, vk::Format lightFormat);

    EffectImages images;
    renderer::Image& irradiance;
    renderer::Image& depth;
    renderer::Image& materialId;
    NacreScatterInfo info{};
};

} // namespace nacre::bench
