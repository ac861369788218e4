// Vulkan's numbers by name, for messages.
#pragma once

#include <ostream>
#include <vulkan/vulkan_core.h>

namespace nacre::effect {

/// Written as the enumerator, or as "VkFormat 1000156000" where it is not among those that images here may have or
/// often have.
struct FormatName {
    VkFormat value;
};
struct LayoutName {
    VkImageLayout value;
};
struct ResultName {
    VkResult value;
};
std::ostream& operator<<(std::ostream& stream, FormatName name);
std::ostream& operator<<(std::ostream& stream, LayoutName name);
std::ostream& operator<<(std::ostream& stream, ResultName name);

} // namespace nacre::effect
