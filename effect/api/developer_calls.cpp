// nacre_developer.h: only in a developer build.
#include "api/nacre_developer.h"

#include "api/guard.hpp"
#include "developer/shader_build.hpp"
#include "vulkan/context.hpp"

namespace {

void reload(nacre::effect::Context& context) {
    nacre::developer::compileShaders();
    // The old ones go when all new ones are made.
    nacre::effect::TechniquePipelines pipelines = nacre::effect::createPipelines(context, VK_NULL_HANDLE);
    std::swap(context.pipelines, pipelines);
}

} // namespace

NacreResult nacreReloadShaders(NacreContext context) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    return nacre::effect::guard(context->messageCallback, context->userData, [&] { reload(*context); });
}
