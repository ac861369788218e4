/* The baselines: techniques that the others are compared with. They are no part of what the library is for, and it may be
 * built without them (-DNACRE_BUILD_BASELINES=OFF). Who asks such a library for one gets NACRE_ERROR_UNSUPPORTED.
 *
 *  NACRE_TECHNIQUE_BRUTE   Adds up every pixel within the 99.9 % radius, by true distance and area. Slow; the reference.
 *  NACRE_TECHNIQUE_THESIS  Andersen, "Screen-Space Subsurface Scattering": a pass pair per material, a radius in texels.
 *                          Its rules are its own. The material's strength narrows the step between taps in place of mixing.
 *                          Other materials are black unless depth tells them apart. Exchange groups are not used. The width
 *                          of the scattering on screen does not follow the material's millimetres.
 */
#ifndef NACRE_BASELINES_H
#define NACRE_BASELINES_H

#include "nacre/nacre.h"

#ifdef __cplusplus
extern "C" {
#endif

/** NacreScatterInfo::baselines and NacreTransmitInfo::baselines. Other techniques do not look at it. */
typedef struct NacreBaselineSettings {
    uint32_t thesisRadius;        /**< [1 … 16] taps on either side; 0 = 5, or the baked kernel's */
    float thesisStrength;         /**< [> 0, 1e6] the thesis's sssStrength, in scene units: taps move by strength · 2 ·
                                       1.92 / depth / radius texels per millimetre of kernel offset (at most to the
                                       radius), and depth differences of 1 / (576 · strength) stop the light; 0 = 0.1 */
    VkBool32 thesisBakedKernel;   /**< every material gets the kernel of nacreBakeThesisKernel, which is compiled in */
    VkBool32 thesisTransmittance; /**< transmit, materials of layers: T = sum w exp(-d²/v), the thesis's own form, in place
                                       of exp(-d²/2v), added up layer by layer in every pixel as in its shader. Light that
                                       enters at a point that the camera sees is counted, too. Mesa's software
                                       device sums up to 512 lights of 32 layers, and drops those beyond */
} NacreBaselineSettings;

/** Compiles the kernel of a material that is set, with this radius ([1 … 16] 0 = 5), into the passes that
 *  NacreBaselineSettings::thesisBakedKernel chooses, in place of an earlier one. Later changes of the material do not reach
 *  it. The device must have finished with the context's work. On failure the earlier one stays. */
NACRE_API NacreResult nacreBakeThesisKernel(NacreContext context, uint32_t materialId, uint32_t radius);

#ifdef __cplusplus
}
#endif

#endif
