/* A material file without a context, and without Vulkan's loader: the library says what is missing. */
#include <nacre/nacre_files.h>
#include <stdio.h>

static void onMessage(NacreSeverity severity, const char* message, void* userData) {
    (void)severity;
    *(int*)userData = 1;
    puts(message);
}

int main(void) {
    int told = 0;
    NacreMessages messages = {onMessage, NULL};
    messages.userData = &told;
    return nacreSetMaterialFile(NULL, 1, "skin.json", &messages) == NACRE_ERROR_INVALID_ARGUMENT && told ? 0 : 1;
}
