// Checks of what the caller hands over. Each throws an EffectError that names the field and its value.
#pragma once

#include "contract/effect_error.hpp"

#include <span>

namespace nacre::effect {

/// Throws when the library was built without the technique, an index in `techniques`.
void checkBuilt(std::size_t technique, const char* field);

/// The formats and usage of nacreGetImageRequirements; throws for a slot that does not exist.
NacreImageRequirements imageRequirements(NacreImageSlot slot);

/// Throws when a pointer or handle is null.
template <typename Handle> void checkGiven(Handle handle, const char* field) {
    if (!handle) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is null");
    }
}

/// Throws when a value is not finite or not within [low, high].
void checkRange(float value, float low, float high, const FieldName& field);
/// Throws when a value is not finite.
void checkFinite(std::span<const float> values, const FieldName& field);

/// What the projection maps to: `view.renderArea`, or all of `extent`.
VkRect2D viewport(const NacreView& view, VkExtent2D extent);
/// The part of the images that is worked on: the viewport, or `view.scissor` in it. Throws when it is empty, or larger
/// than maxExtent.
VkRect2D renderArea(const NacreView& view, VkExtent2D extent, VkExtent2D maxExtent, const FieldName& info);

/// Throws when an image of this extent does not cover the area.
void checkCovers(VkExtent2D extent, const VkRect2D& area, const FieldName& field);
/// Throws when an image (required unless its slot is optional) lacks what its slot needs or does not cover the area.
/// `field` is the struct and member, e.g. "NacreScatterInfo::depth". Returns whether it is given.
bool checkImage(const NacreImage& image, NacreImageSlot slot, const VkRect2D& area, const FieldName& field);
/// Throws where normals of this encoding do not fit into the image's format.
void checkNormals(const NacreImage& image, NacreNormalEncoding encoding, const FieldName& field);
/// checkImage of the ids, which a context without them must not be given.
void checkMaterialId(const NacreImage& image, bool noMaterialIds, const VkRect2D& area, const FieldName& field);
/// The same for an image whose pixels are not the view's: a shadow map.
void checkShadowMap(const NacreImage& image, const FieldName& field);

} // namespace nacre::effect
