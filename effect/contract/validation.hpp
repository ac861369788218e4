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

/// The part of the images that is worked on: `view.renderArea`, or all of `extent`. Throws when it is empty, larger
/// than maxExtent or reaches out of the image.
VkRect2D renderArea(const NacreView& view, VkExtent2D extent, VkExtent2D maxExtent, const FieldName& info);

/// Throws when an image of this extent does not cover the area.
void checkCovers(VkExtent2D extent, const VkRect2D& area, const FieldName& field);
/// Throws when an image (required unless its slot is optional) lacks what its slot needs or does not cover the area.
/// `field` is the struct and member, e.g. "NacreScatterInfo::depth". Returns whether it is given.
bool checkImage(const NacreImage& image, NacreImageSlot slot, const VkRect2D& area, const FieldName& field);
/// The same for an image whose pixels are not the view's: a shadow map.
void checkShadowMap(const NacreImage& image, const FieldName& field);

} // namespace nacre::effect
