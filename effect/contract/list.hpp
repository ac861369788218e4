// Lists that the library hands over.
#pragma once

#include "contract/validation.hpp"

#include <algorithm>

namespace nacre::effect {

/// Vulkan's way to hand over a list: without `to` *count becomes its length, else how many of the items were written.
/// Throws when not all of them fit.
template <typename Item> void handOver(std::span<const Item> items, std::uint32_t* count, Item* to, const char* field) {
    checkGiven(count, field);
    if (!to) {
        *count = static_cast<std::uint32_t>(items.size());
        return;
    }
    *count = std::min(*count, static_cast<std::uint32_t>(items.size()));
    std::copy_n(items.begin(), *count, to);
    if (*count < items.size()) {
        fail(NACRE_ERROR_LIMIT_EXCEEDED, field, " is ", *count, ", there are ", items.size());
    }
}

} // namespace nacre::effect
