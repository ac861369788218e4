#!/usr/bin/env bash
# package.sh SOURCE COMPARE_PICTURES: everything a user of the library does, in a directory outside of the source tree and
# with an empty environment: docs/integration.md from top to bottom, then programs that find the library by find_package,
# add_subdirectory and pkg-config, static and shared. The library is compiled twice, in few files: for the document, a little
# optimised, and for add_subdirectory, not optimised and by clang, whose warnings are errors, too.
set -euo pipefail
source_directory=$(realpath "$1")
compare_pictures=$(realpath "$2")
consumer=$source_directory/tests/package/consumer

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
ln -s "$source_directory" nacre

say() { printf '\n== %s ==\n' "$*"; }

# Runs a command that knows of nothing but the system; compiler launchers (ccache) pass, and what Mesa has compiled of
# shaders: other tests have the same ones.
cat > toolchain.cmake << 'END'
set(CMAKE_CXX_FLAGS_RELEASE "-O1 -DNDEBUG" CACHE STRING "")
if(EXISTS ${CMAKE_SOURCE_DIR}/effect/technique_table.cpp)
    set(CMAKE_UNITY_BUILD ON)
endif()
END
shader_cache=${MESA_SHADER_CACHE_DIR:-${XDG_CACHE_HOME:-$HOME/.cache}}
clean() {
    env -i PATH=/usr/local/bin:/usr/bin:/bin HOME="$work" CMAKE_GENERATOR=Ninja CMAKE_TOOLCHAIN_FILE="$work/toolchain.cmake" MESA_SHADER_CACHE_DIR="$shader_cache" \
        VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation \
        VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT \
        ${VK_DRIVER_FILES:+VK_DRIVER_FILES="$VK_DRIVER_FILES"} ${VK_ICD_FILENAMES:+VK_ICD_FILENAMES="$VK_ICD_FILENAMES"} \
        ${CMAKE_CXX_COMPILER_LAUNCHER:+CMAKE_CXX_COMPILER_LAUNCHER="$CMAKE_CXX_COMPILER_LAUNCHER"} \
        ${CCACHE_DIR:+CCACHE_DIR="$CCACHE_DIR"} ${CCACHE_NOHASHDIR:+CCACHE_NOHASHDIR="$CCACHE_NOHASHDIR"} "$@"
}

# Runs a program; whatever the validation layers say is a failure.
run() {
    clean "$@" > output.txt 2>&1 || { cat output.txt; exit 1; }
    cat output.txt
    if grep -E 'Validation (Error|Warning|Performance)|VUID-|SYNC-HAZARD' output.txt; then exit 1; fi
}

say "docs/integration.md"
awk '/^```sh$/ { typing = 1; next } /^```$/ { typing = 0 } typing' nacre/docs/integration.md \
    nacre/docs/integration-raster.md > commands.sh
cat commands.sh
run bash -euxo pipefail commands.sh
"$compare_pictures" minimal.png nacre/docs/images/minimal.png
"$compare_pictures" deferred.png nacre/docs/images/deferred.png
# Four samples a pixel against a picture of four pixels a pixel: no halo, and nearer than one sample comes (37 dB).
run deferred-build/deferred supersampled.png 2 1 2
"$compare_pictures" supersampled.png deferred-msaa.png 40
# The library is compiled from its own files, the standard headers and Vulkan's alone.
foreign=$(clean ninja -C nacre-build -t deps | sed -nE 's|^ +/usr/(local/)?include/||p' |
    grep -vE '^(vulkan|vk_video|c\+\+|bits|sys|linux|asm|asm-generic|gnu|[a-z0-9_]+-linux-gnu)/|^[^/]+$' || true)
if [ -n "$foreign" ]; then
    echo "package.sh: the library includes $foreign" >&2
    exit 1
fi

say "the shared library"
clean cmake -S nacre -B nacre-build -DBUILD_SHARED_LIBS=ON -DNACRE_BUILD_FILES=ON > log.txt
clean cmake --build nacre-build > log.txt || { cat log.txt; exit 1; }
clean cmake --install nacre-build --prefix "$work/shared" > log.txt
nacre/tests/package/abi.sh "$work/shared/lib/libnacre.so" "$work"/shared/include/nacre/*.h
mv nacre-install static # a prefix may be moved
rm -r nacre-build

for kind in static shared; do
    say "find_package, $kind"
    clean cmake -S "$consumer" -B "find-$kind" -DCMAKE_PREFIX_PATH="$work/$kind" > log.txt
    clean cmake --build "find-$kind" > log.txt || { cat log.txt; exit 1; }
    run "find-$kind/consumer"
    run "find-$kind/core_consumer"
    run "find-$kind/parts_consumer"

    say "a project in C alone, $kind"
    clean cmake -S "$consumer/c_alone" -B "c-$kind" -DCMAKE_PREFIX_PATH="$work/$kind" > log.txt
    clean cmake --build "c-$kind" > log.txt || { cat log.txt; exit 1; }
    run "c-$kind/c_alone"
    if [ $kind = shared ]; then run "c-$kind/c_file"; fi
    if clean cmake -S "$consumer/c_alone" -B "c-$kind" -DCOMPONENT=cores > log.txt 2>&1; then exit 1; fi
    grep -q 'nacre has no component "cores"' log.txt

    say "pkg-config, $kind"
    ask() { clean PKG_CONFIG_PATH="$work/$kind/lib/pkgconfig" pkg-config "$@" nacre; }
    flags=$(ask --cflags --libs)
    echo "$flags"
    # shellcheck disable=SC2086
    clean cc -std=c99 -Wall -Wextra -Wpedantic -Wno-missing-field-initializers -Werror "$consumer/consumer.c" \
        -o "pkg-config-$kind" $flags -lvulkan
    run env LD_LIBRARY_PATH="$work/$kind/lib" "./pkg-config-$kind"
    # shellcheck disable=SC2086
    clean cc -std=c99 -Wall -Wextra -Wpedantic -Werror "-DSPIRV_DIRECTORY=\"$(ask --variable=spirv)\"" \
        "$consumer/parts.c" -o "pkg-config-parts-$kind" $flags # without Vulkan's loader
    run env LD_LIBRARY_PATH="$work/$kind/lib" "./pkg-config-parts-$kind"
    shaders=$(ask --variable=shaders)
    if [ $kind = shared ]; then
        diff -r "$shaders" "$static_shaders"
        continue
    fi
    static_shaders=$shaders
    # The GLSL is whole: every pass compiles where it is installed.
    find "$shaders" -name '*.comp' > passes.txt
    [ -s passes.txt ]
    while read -r pass; do
        clean glslc --target-env=vulkan1.2 -I "$shaders" "$pass" -o pass.spv
    done < passes.txt
    # Every pass in WGSL is whole, too: it has no includes left.
    modules=$(ask --variable=wgsl)
    for module in bank_reduce bank_blur bank_combine_smooth bank_combine_edge transmit; do
        [ "$(grep -c '^fn main(' "$modules/$module.wgsl")" -eq 1 ]
        [ "$(grep -c '#include' "$modules/$module.wgsl")" -eq 0 ]
    done
done

for kind in static shared; do
    say "add_subdirectory, $kind"
    shared=$([ $kind = shared ] && echo ON || echo OFF)
    clean env CC=clang CXX=clang++ cmake -S "$consumer" -B subdirectory -DCMAKE_BUILD_TYPE=Debug \
        -DNACRE_SOURCE="$work/nacre" -DNACRE_WARNINGS_AS_ERRORS=ON -DCMAKE_UNITY_BUILD=ON \
        -DBUILD_SHARED_LIBS="$shared" > log.txt
    clean cmake --build subdirectory > log.txt || { cat log.txt; exit 1; }
    run subdirectory/consumer
    run subdirectory/core_consumer
    run subdirectory/parts_consumer
done
