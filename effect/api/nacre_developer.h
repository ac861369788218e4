/* What a developer build (CMake option NACRE_DEVELOPER) offers beside nacre.h. Not installed. */
#ifndef NACRE_DEVELOPER_H
#define NACRE_DEVELOPER_H

#include "nacre/nacre.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Compiles the shaders that have changed (target `shaders` of the build folder) and makes the context's pipelines anew, but
 *  for those of nacreBakeThesisKernel, which calling it again makes anew. The device must have finished with the
 *  context's work. Where a shader does not compile everything stays as it is, the result is NACRE_ERROR_INVALID_ARGUMENT
 *  and the message is the compiler's. Bindings and parameter blocks must stay as the program was built with. */
NACRE_API NacreResult nacreReloadShaders(NacreContext context);

#ifdef __cplusplus
}
#endif

#endif
