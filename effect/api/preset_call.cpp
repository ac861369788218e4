// nacreSetPreset and nacreGetPresets: the library's own materials by name.
#include "api/guard.hpp"
#include "contract/list.hpp"
#include "contract/validation.hpp"
#include "vulkan/context.hpp"

#include "nacre/nacre_material.hpp"
#include "nacre/presets.hpp"

namespace nacre::effect {
namespace {

const Material& presetOf(const char* name) {
    checkGiven(name, "name");
    if (const Material* preset = findPreset(name)) {
        return *preset;
    }
    std::string known;
    for (const Material& preset : presets()) {
        known += (known.empty() ? "" : ", ") + preset.name;
    }
    fail(NACRE_ERROR_INVALID_ARGUMENT, "name is \"", name, "\", must be one of ", known);
}

} // namespace
} // namespace nacre::effect

using namespace nacre::effect;

NacreResult nacreGetPresets(uint32_t* count, const char** names) {
    return guard(nullptr, nullptr, [&] {
        std::vector<const char*> all;
        for (const nacre::Material& preset : nacre::presets()) {
            all.push_back(preset.name.c_str());
        }
        handOver(std::span<const char* const>(all), count, names, "count");
    });
}

NacreResult nacreSetPreset(NacreContext context, uint32_t id, const char* name) {
    if (!context) {
        return NACRE_ERROR_INVALID_ARGUMENT;
    }
    NacreResult result = NACRE_SUCCESS;
    const NacreResult found = guard(context->messageCallback, context->userData, [&] {
        std::vector<NacreLayer> layers;
        const NacreMaterial material = nacre::callMaterial(presetOf(name), layers);
        result = nacreSetMaterials(context, id, 1, &material); // has said what is wrong
    });
    return found != NACRE_SUCCESS ? found : result;
}
