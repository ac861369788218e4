# nacre_warnings(TARGET): the project's own code is compiled with warnings, which are errors unless another project includes it.
option(NACRE_WARNINGS_AS_ERRORS "Treat warnings as errors" ${PROJECT_IS_TOP_LEVEL})

# The sanitizers' presets do not optimise: it would double the time to compile. What their tests spend their time in is
# compiled with this all the same.
if(NACRE_SANITIZE)
    set(NACRE_OPTIMISE_SANITIZED -O2)
endif()

function(nacre_warnings target)
    if(MSVC)
        target_compile_options(${target} PRIVATE /W4 /permissive- /utf-8 $<$<BOOL:${NACRE_WARNINGS_AS_ERRORS}>:/WX>)
        return()
    endif()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
        -Wno-missing-field-initializers $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-missing-designated-field-initializers;-Wno-unknown-warning-option>
        $<$<BOOL:${NACRE_WARNINGS_AS_ERRORS}>:-Werror>)
    if(NACRE_SANITIZE)
        target_compile_options(${target} PUBLIC -fsanitize=${NACRE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
        target_compile_definitions(${target} PRIVATE NACRE_SANITIZED)
        target_link_options(${target} PUBLIC -fsanitize=${NACRE_SANITIZE})
    endif()
endfunction()
