/* The effect without a context, as installed: lists the default technique's passes, and fills what they read, without a
 * device and without Vulkan's loader. SPIRV_DIRECTORY: where the package has the passes' files; not defined in a build
 * of the library itself. */
#include <nacre/nacre_passes.h>
#include <stdio.h>
#include <stdlib.h>

static int equalsFile(const NacrePass* pass) {
#ifdef SPIRV_DIRECTORY
    char path[1024];
    char* bytes = malloc(pass->spirvSize + 1);
    FILE* file;
    size_t size;
    snprintf(path, sizeof(path), "%s/%s.spv", SPIRV_DIRECTORY, pass->file);
    file = fopen(path, "rb");
    if (!file || !bytes) {
        printf("%s cannot be read\n", path);
        return 0;
    }
    size = fread(bytes, 1, pass->spirvSize + 1, file);
    fclose(file);
    if (size != pass->spirvSize || memcmp(bytes, pass->spirv, size) != 0) {
        printf("%s is not the pass %s\n", path, pass->name);
        free(bytes);
        return 0;
    }
    free(bytes);
#endif
    return pass->file != NULL;
}

static int listPasses(NacreTechnique technique) {
    const VkExtent2D area = {1920, 1080};
    NacrePass passes[8];
    uint32_t count = 8;
    uint32_t i;
    if (nacreGetPasses(technique, area, &count, passes) != NACRE_SUCCESS) {
        return 0;
    }
    for (i = 0; i < count; ++i) {
        printf("%s: %ux%u workgroups\n", passes[i].name, passes[i].groups.width, passes[i].groups.height);
        if (!equalsFile(&passes[i])) {
            return 0;
        }
    }
    return count > 0;
}

/* A material's tables, as large as its binding says. */
static int fillTable(NacreTechnique technique) {
    const VkExtent2D extent = {1920, 1080};
    NacreMaterial material = nacreDefaultMaterial();
    NacreBinding bindings[32];
    uint32_t count = 32;
    uint32_t i;
    int filled = 0;
    material.meanFreePath[0] = material.meanFreePath[1] = material.meanFreePath[2] = 1;
    if (nacreGetBindings(technique, extent, &count, bindings) != NACRE_SUCCESS) {
        return 0;
    }
    for (i = 0; i < count; ++i) {
        if (strcmp(bindings[i].name, "tables") == 0) {
            void* table = malloc((size_t)bindings[i].stride);
            filled =
                table && nacreFillTable(technique, &material, NULL, (size_t)bindings[i].stride, table) == NACRE_SUCCESS;
            free(table);
        }
    }
    return filled;
}

int main(void) {
    const VkExtent2D area = {64, 64};
    NacreTechnique techniques[16] = {NACRE_TECHNIQUE_TRANSMIT};
    uint32_t count = 15;
    uint32_t passCount = 0;
    uint32_t i;
    if (nacreGetTechniques(&count, techniques + 1) != NACRE_SUCCESS) {
        return 1;
    }
    for (i = 0; i <= count; ++i) {
        if (!listPasses(techniques[i]) || !fillTable(techniques[i])) {
            return 1;
        }
    }
    /* What is installed has the baselines; a library that is built as another project's part has not. */
    printf("%u techniques\n", (unsigned)count);
#ifdef SPIRV_DIRECTORY
    return count == 6 && nacreGetPasses(NACRE_TECHNIQUE_THESIS, area, &passCount, NULL) == NACRE_SUCCESS ? 0 : 1;
#else
    return count == 4 && nacreGetPasses(NACRE_TECHNIQUE_THESIS, area, &passCount, NULL) == NACRE_ERROR_UNSUPPORTED ? 0
                                                                                                                   : 1;
#endif
}
