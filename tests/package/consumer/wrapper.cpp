// The C++20 wrapper, as installed.
#include <nacre/nacre.hpp>

extern "C" int useWrapper(const NacreContextInfo* info) {
    nacre::Context context;
    NacreMaterial material = nacreDefaultMaterial();
    for (float& channel : material.meanFreePath) {
        channel = 1;
    }
    const bool done = nacre::Context::create(*info, context) == NACRE_SUCCESS &&
                      context.setMaterials(1, {&material, 1}) == NACRE_SUCCESS &&
                      context.beginFrame(0) == NACRE_SUCCESS;
    return done ? 0 : 1;
}
