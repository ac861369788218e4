find_program(NACRE_GLSLC glslc REQUIRED)
find_program(NACRE_SPIRV_VAL spirv-val)

# nacre_shader(TARGET SOURCE [NAME name] [ENVIRONMENT vulkan1.2] [DEFINES A=1 ...])
# Compiles one GLSL file to SPIR-V, validates it, and makes it includable as "NAME.spv.h" (array `NAME_spv`).
# NAME defaults to the file name with dots as underscores: scatter_brute.comp -> scatter_brute_comp.
function(nacre_shader target source)
    cmake_parse_arguments(arg "" "NAME;ENVIRONMENT" "DEFINES;INCLUDES" ${ARGN})
    if(NOT arg_ENVIRONMENT)
        set(arg_ENVIRONMENT vulkan1.2)
    endif()
    get_filename_component(file ${source} NAME)
    if(NOT arg_NAME)
        string(REPLACE "." "_" arg_NAME ${file})
    endif()
    set(directory ${CMAKE_CURRENT_BINARY_DIR}/spirv)
    file(MAKE_DIRECTORY ${directory})
    set(spirv ${directory}/${arg_NAME}.spv)
    set(header ${directory}/${arg_NAME}.spv.h)
    list(TRANSFORM arg_DEFINES PREPEND -D)
    set(includes -I ${CMAKE_CURRENT_SOURCE_DIR}/shaders)
    foreach(include ${arg_INCLUDES})
        list(APPEND includes -I ${include})
    endforeach()
    set(validate "")
    if(NACRE_SPIRV_VAL)
        set(validate COMMAND ${NACRE_SPIRV_VAL} --target-env ${arg_ENVIRONMENT} ${spirv})
    endif()
    add_custom_command(
        OUTPUT ${header} ${spirv}
        COMMAND ${NACRE_GLSLC} --target-env=${arg_ENVIRONMENT} -O -Werror -MD -MF ${spirv}.d -MT ${header} ${includes} ${arg_DEFINES}
                -o ${spirv} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
        ${validate}
        COMMAND ${CMAKE_COMMAND} -DINPUT=${spirv} -DOUTPUT=${header} -DSYMBOL=${arg_NAME}_spv -P ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
        MAIN_DEPENDENCY ${CMAKE_CURRENT_SOURCE_DIR}/${source}
        DEPENDS ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
        DEPFILE ${spirv}.d
        COMMENT "GLSL ${arg_NAME}"
        VERBATIM)
    target_sources(${target} PRIVATE ${header})
    target_include_directories(${target} PRIVATE ${directory})
endfunction()
