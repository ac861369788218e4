// What both pipelines of pass C of `bank` begin with. Included by bank_region_smooth.glsl and bank_region_edge.glsl.
#define BANK_ACCESS readonly
layout(constant_id = 1) const bool albedoOrFactors = true; // else no such image is given, and every material's strength is 1
#define POSSIBLE_FLAGS (albedoOrFactors ? ~0u : ~(flagAlbedo | flagAlbedoBefore | flagStrength | flagScale))
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

const int threads = 128;
