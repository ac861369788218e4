// nacre_baselines.h.
#include "api/guard.hpp"
#include "baselines/baselines.hpp"
#include "vulkan/context.hpp"

NacreResult nacreBakeThesisKernel(NacreContext context, uint32_t materialId, uint32_t radius) {
    using namespace nacre::effect;
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return guard(context->messageCallback, context->userData, [&] { bakeThesisKernel(*context, materialId, radius); });
}
