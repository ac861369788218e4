// The images of the example: a G-buffer, shadow maps, light and the picture; and the effect's.
#pragma once

#include "raster_device.hpp"

struct GBuffer {
    Image albedo, normal, depth;
};

struct Images {
    GBuffer drawn;    // one or several samples a pixel
    GBuffer resolved; // of several samples: one
    Image ids;        // of several samples, in place of the stencil
    Image shadowMap, irradiance, picture;
    Image scattered, transmitted, composed; // the effect's

    template <typename Each> void forEach(Each&& each) {
        for (Image* image :
             {&drawn.albedo, &drawn.normal, &drawn.depth, &resolved.albedo, &resolved.normal, &resolved.depth, &ids,
              &shadowMap, &irradiance, &picture, &scattered, &transmitted, &composed}) {
            each(*image);
        }
    }
};

/// All but the effect's.
Images createImages(Device& device, VkExtent2D extent, VkSampleCountFlagBits samples);
