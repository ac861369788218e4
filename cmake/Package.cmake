# Installing nacre::nacre (and nacre::core, which its static library needs) and finding it again: by find_package and by
# pkg-config. BUILD_SHARED_LIBS chooses the kind. Component "nacre"; everything lies under the prefix, which may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

option(NACRE_INSTALL "Install the library, its headers and its shaders" ${PROJECT_IS_TOP_LEVEL})

set_target_properties(nacre_core PROPERTIES EXPORT_NAME core CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
# Both kinds are compiled alike, so that a build tree can turn from one into the other by linking.
set_target_properties(nacre PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                      DEFINE_SYMBOL "")
target_compile_definitions(nacre PRIVATE NACRE_BUILDING)
if(BUILD_SHARED_LIBS)
    target_compile_definitions(nacre PUBLIC $<$<PLATFORM_ID:Windows>:NACRE_SHARED>)
    # Of a shared library only the C API is seen; without the script instances of the C++ library's templates would be, too.
    if(CMAKE_SYSTEM_NAME STREQUAL Linux)
        set(exports ${PROJECT_SOURCE_DIR}/cmake/exports.map)
        target_link_options(nacre PRIVATE -Wl,--version-script=${exports} -Wl,--no-undefined)
        set_target_properties(nacre PROPERTIES LINK_DEPENDS ${exports})
    endif()
endif()

if(NOT NACRE_INSTALL OR NACRE_DEVELOPER) # a developer build's shaders are in its build folder
    return()
endif()

# A program in C that links a static library lacks C++'s runtime: the libraries that the C++ compiler adds by itself. core is
# always static, and with a shared nacre what needs it are material files.
set(runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER runtime INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|c\\+\\+abi|m)$")
list(REMOVE_DUPLICATES runtime)
target_link_libraries(nacre_core INTERFACE ${runtime})

set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
if(NACRE_BUILD_FILES)
    set(files nacre_material_files nacre_files)
endif()
install(TARGETS nacre nacre_core ${files} EXPORT nacre COMPONENT nacre
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT nacre NAMELINK_COMPONENT nacre
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT nacre
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT nacre)
install(EXPORT nacre NAMESPACE nacre:: FILE nacreTargets.cmake DESTINATION ${package_directory} COMPONENT nacre)
# Material files need a JSON library to build (header only), and none to use.
if(NOT NACRE_BUILD_FILES)
    set(no_files PATTERN files.hpp EXCLUDE PATTERN nacre_files.h EXCLUDE)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/nacre DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT nacre
        FILES_MATCHING PATTERN *.h PATTERN *.hpp ${no_files})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT nacre)
# The parts, for engines that dispatch by themselves: GLSL sources and the SPIR-V made of them.
if(NOT NACRE_BUILD_BASELINES)
    set(no_baselines PATTERN baselines EXCLUDE)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/effect/ DESTINATION ${CMAKE_INSTALL_DATADIR}/nacre/shaders COMPONENT nacre
        FILES_MATCHING PATTERN *.comp PATTERN *.glsl PATTERN *.h PATTERN api EXCLUDE PATTERN contract EXCLUDE PATTERN vulkan EXCLUDE
        ${no_baselines})
get_target_property(spirv nacre NACRE_SPIRV)
install(FILES ${spirv} DESTINATION ${CMAKE_INSTALL_DATADIR}/nacre/spirv COMPONENT nacre)
# And the passes that there are in WGSL, each a module.
get_target_property(wgsl nacre NACRE_WGSL)
install(FILES ${wgsl} DESTINATION ${CMAKE_INSTALL_DATADIR}/nacre/wgsl COMPONENT nacre)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/nacreConfig.cmake.in ${PROJECT_BINARY_DIR}/nacreConfig.cmake
                              INSTALL_DESTINATION ${package_directory} PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nacreConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nacreConfig.cmake ${PROJECT_BINARY_DIR}/nacreConfigVersion.cmake
        DESTINATION ${package_directory} COMPONENT nacre)

# pkg-config: a static library needs core and the C++ runtime at every link.
set(NACRE_PC_LIBS "-lnacre")
if(NOT BUILD_SHARED_LIBS)
    string(APPEND NACRE_PC_LIBS " -lnacre_core -lstdc++ -lm")
endif()
file(RELATIVE_PATH NACRE_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${PROJECT_SOURCE_DIR}/cmake/nacre.pc.in ${PROJECT_BINARY_DIR}/nacre.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/nacre.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT nacre)
