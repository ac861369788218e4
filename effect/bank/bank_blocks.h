// What C++ and GLSL share of `bank` and `bank-surfaces`, beside what is tuned (bank_constants.h).
#ifndef NACRE_EFFECT_BANK_BLOCKS_H
#define NACRE_EFFECT_BANK_BLOCKS_H

#include "interface/blocks.h"

#ifdef __cplusplus
namespace nacre::effect {
#endif

// Intermediates (blocks.h).
NACRE_CONSTANT intermediateBankReduced = 3;
NACRE_CONSTANT intermediateBankBlurred = 4;
NACRE_CONSTANT intermediateBankBorrowed = 5;
NACRE_CONSTANT intermediateBankAreas = 6;
NACRE_CONSTANT intermediateBankTiles = 7;
NACRE_CONSTANT intermediateBankMaterials = 8;
NACRE_CONSTANT intermediateBankSeconds = 9;

// Mixture table of `bank` in 16-byte words: bins at the same scales for every material, so that a pixel finds its own without
// asking where its material's begin; each is a line of a cache, 128 bytes. A bin is eight kernels: halves red and green; those
// of the next bin; blue and that of the next bin; of kernels 0, 2 and 4 the material's strength, a float whose eight lowest
// bits are those of the kernels that have a weight; else nothing.
NACRE_CONSTANT bankBinWords = 8;
NACRE_CONSTANT bankTableBins = 193;
NACRE_CONSTANT bankTableWords = bankTableBins * bankBinWords;
// Workgroups along x of the combination's dispatches; longer lists take several rows. Those of 3840x2160 fit one.
NACRE_CONSTANT bankDispatchWidth = 65535;
struct BankDispatch {
    uint x, y, z; // VkDispatchIndirectCommand
    uint count;   // regions on the list, where it may be longer than a row
};

#ifdef __cplusplus
static_assert(sizeof(BankDispatch) == 16);

} // namespace nacre::effect
#endif
#endif
