// The graphics pipelines of the example.
#pragma once

#include "raster_device.hpp"

struct Pipelines {
    VkPipeline shadow, surface, lighting, add;
};

/// With several samples a pixel, lighting resolves the G-buffer, too.
Pipelines createPipelines(Device& device, VkSampleCountFlagBits samples);
