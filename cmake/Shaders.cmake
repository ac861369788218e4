find_program(NACRE_GLSLC glslc REQUIRED)
find_program(NACRE_SPIRV_VAL spirv-val)
find_program(NACRE_SPIRV_CROSS spirv-cross)

# Everything that the project's programs load as SPIR-V. A developer build compiles it while a program runs.
if(PROJECT_IS_TOP_LEVEL)
    add_custom_target(shaders)
endif()

# Called at the end of the folder of the target's first shader.
function(nacre_shaders_target target)
    get_target_property(spirv ${target} NACRE_SPIRV)
    add_custom_target(${target}_shaders DEPENDS ${spirv})
    add_dependencies(${target} ${target}_shaders)
    if(TARGET shaders)
        add_dependencies(shaders ${target}_shaders)
    endif()
endfunction()

# nacre_translate(TARGET NAME GLSLC_ARGUMENTS...): one GLSL file as HLSL for shader model 5.0 and as MSL. Not optimised, so
# that everything keeps its name. The files are listed in target property NACRE_TRANSLATIONS.
function(nacre_translate target name)
    set(directory ${PROJECT_BINARY_DIR}/translations)
    set(spirv ${CMAKE_CURRENT_BINARY_DIR}/named_spirv/${name}.spv)
    file(MAKE_DIRECTORY ${directory} ${CMAKE_CURRENT_BINARY_DIR}/named_spirv)
    add_custom_command(
        OUTPUT ${directory}/${name}.hlsl ${directory}/${name}.metal
        COMMAND ${NACRE_GLSLC} ${ARGN} -MD -MF ${spirv}.d -MT ${directory}/${name}.hlsl -o ${spirv}
        COMMAND ${NACRE_SPIRV_CROSS} ${spirv} --hlsl --shader-model 50 --output ${directory}/${name}.hlsl
        COMMAND ${NACRE_SPIRV_CROSS} ${spirv} --msl --msl-version 20100 --output ${directory}/${name}.metal
        DEPFILE ${spirv}.d
        COMMENT "HLSL and MSL ${name}"
        VERBATIM)
    set_property(TARGET ${target} APPEND PROPERTY NACRE_TRANSLATIONS ${directory}/${name}.hlsl ${directory}/${name}.metal)
endfunction()

# nacre_shader(TARGET SOURCE [NAME name] [ENVIRONMENT vulkan1.2] [DEFINES A=1 ...] [TRANSLATED])
# Compiles one GLSL file to SPIR-V, validates it, and makes it includable as "NAME.spv.h" (EmbeddedShader `NAME_spv`).
# Target property NACRE_SPIRV lists the .spv files, which target `shaders` makes, without any C++. With TRANSLATED the file is translated, too (nacre_translate).
# NAME defaults to the file name with dots as underscores: scatter_brute.comp -> scatter_brute_comp.
function(nacre_shader target source)
    cmake_parse_arguments(arg "TRANSLATED" "NAME;ENVIRONMENT" "DEFINES;INCLUDES" ${ARGN})
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
    set(includes -I ${CMAKE_CURRENT_SOURCE_DIR})
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
        COMMAND ${CMAKE_COMMAND} -DINPUT=${spirv} -DOUTPUT=${header} -DSYMBOL=${arg_NAME}_spv -DNAME=${arg_NAME}
                -P ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
        MAIN_DEPENDENCY ${CMAKE_CURRENT_SOURCE_DIR}/${source}
        DEPENDS ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
        DEPFILE ${spirv}.d
        COMMENT "GLSL ${arg_NAME}"
        VERBATIM)
    target_sources(${target} PRIVATE ${header})
    get_target_property(earlier ${target} NACRE_SPIRV)
    if(NOT earlier)
        cmake_language(EVAL CODE "cmake_language(DEFER CALL nacre_shaders_target [[${target}]])")
    endif()
    set_property(TARGET ${target} APPEND PROPERTY NACRE_SPIRV ${spirv})
    target_include_directories(${target} PRIVATE ${directory} ${PROJECT_SOURCE_DIR}/cmake)
    if(arg_TRANSLATED AND NACRE_SPIRV_CROSS)
        nacre_translate(${target} ${arg_NAME} --target-env=${arg_ENVIRONMENT} ${includes} ${arg_DEFINES}
                        ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    endif()
endfunction()

# nacre_wgsl(TARGET SOURCE...): each pass in WGSL as a module without includes, wgsl/NAME.wgsl in the build folder. They are
# listed in target property NACRE_WGSL.
function(nacre_wgsl target)
    set(directory ${PROJECT_BINARY_DIR}/wgsl)
    file(MAKE_DIRECTORY ${directory})
    # What any of them may include.
    file(GLOB_RECURSE parts CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.wgsl ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
    foreach(source ${ARGN})
        get_filename_component(file ${source} NAME)
        add_custom_command(
            OUTPUT ${directory}/${file}
            COMMAND ${CMAKE_COMMAND} -DINPUT=${CMAKE_CURRENT_SOURCE_DIR}/${source} -DOUTPUT=${directory}/${file}
                    -DROOT=${CMAKE_CURRENT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/ExpandWgsl.cmake
            DEPENDS ${parts} ${PROJECT_SOURCE_DIR}/cmake/ExpandWgsl.cmake
            COMMENT "WGSL ${file}"
            VERBATIM)
        set_property(TARGET ${target} APPEND PROPERTY NACRE_WGSL ${directory}/${file})
    endforeach()
endfunction()
