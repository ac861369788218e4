// The one place that includes Vulkan-Hpp, so that every file of the renderer sees it configured alike. Internal.
#pragma once

#define VK_NO_PROTOTYPES
#define VULKAN_HPP_NO_SPACESHIP_OPERATOR
#define VULKAN_HPP_NO_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>
