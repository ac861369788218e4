/* A context's materials from files. Target nacre::material_files, in builds with NACRE_BUILD_FILES. */
#ifndef NACRE_FILES_H
#define NACRE_FILES_H

#include "nacre/nacre.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Sets material id to that of a material file (JSON, docs/schemas/material.schema.json), as nacreSetMaterials does.
 *  NACRE_ERROR_INVALID_ARGUMENT where the file cannot be read or is faulty: `messages` (null = none) hears which field of it is
 *  to blame. What the context refuses its own callback hears. */
NacreResult nacreSetMaterialFile(NacreContext context, uint32_t id, const char* path, const NacreMessages* messages);

#ifdef __cplusplus
}
#endif

#endif
