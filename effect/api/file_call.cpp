// nacre_files.h.
#include "nacre/nacre_files.h"

#include "nacre/files.hpp"
#include "nacre/nacre_material.hpp"

namespace {

NacreResult refuse(const NacreMessages* messages, const char* message, NacreResult result) {
    if (messages && messages->callback) {
        messages->callback(NACRE_SEVERITY_ERROR, message, messages->userData);
    }
    return result;
}

} // namespace

NacreResult nacreSetMaterialFile(NacreContext context, uint32_t id, const char* path, const NacreMessages* messages) {
    if (!context || !path) {
        return refuse(messages, context ? "path is null" : "context is null", NACRE_ERROR_INVALID_ARGUMENT);
    }
    try {
        std::vector<NacreLayer> layers;
        const NacreMaterial material = nacre::callMaterial(nacre::loadMaterial(path), layers);
        return nacreSetMaterials(context, id, 1, &material);
    } catch (const nacre::FileError& error) {
        return refuse(messages, error.what(), NACRE_ERROR_INVALID_ARGUMENT);
    } catch (const std::bad_alloc&) {
        return refuse(messages, "there is no memory for the material", NACRE_ERROR_OUT_OF_MEMORY);
    } catch (const std::exception& error) {
        return refuse(messages, error.what(), NACRE_ERROR_INVALID_ARGUMENT);
    }
}
