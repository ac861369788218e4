# Script: writes a C++ header (OUTPUT) with the commit of the repository at SOURCE, unless it is already in it. COMMIT, when
# it is not empty, is taken as it is.
if(NOT COMMIT)
    set(COMMIT unknown)
    find_program(git git)
    if(git)
        execute_process(COMMAND ${git} describe --always --dirty --abbrev=12 --exclude=*
                        WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE described RESULT_VARIABLE failed
                        OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
        if(NOT failed)
            set(COMMIT ${described})
        endif()
    endif()
endif()
set(text "#pragma once\n#include <string_view>\ninline constexpr std::string_view commit = \"${COMMIT}\";\n")
set(old "")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
    file(WRITE ${OUTPUT} "${text}")
endif()
