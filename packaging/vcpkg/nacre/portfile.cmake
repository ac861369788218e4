# An overlay port of this repository: vcpkg install nacre --overlay-ports=packaging/vcpkg. It builds the sources it lies in.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES files NACRE_BUILD_FILES)
find_program(GLSLC glslc PATHS "${CURRENT_HOST_INSTALLED_DIR}/tools/shaderc" REQUIRED)
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS -DNACRE_BUILD_APP=OFF -DNACRE_BUILD_TESTS=OFF -DNACRE_BUILD_BASELINES=OFF -DNACRE_WARNINGS_AS_ERRORS=OFF
            "-DNACRE_GLSLC=${GLSLC}" ${features})
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/nacre)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
