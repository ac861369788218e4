#!/usr/bin/env bash
# technique_files.sh SOURCE TECHNIQUE...: what a technique of the effect takes (CONTRIBUTING.md, "To add"). Each is a folder
# of its own, and named in at most three files beside: its enumerator, the table, and the list for CMake. A technique with a
# setting of its own in nacre.h may stand in a fourth, the benchmark's table of the values that it measures. Documents and
# tests speak of techniques, and are not counted.
set -euo pipefail
source=$1
shift
cd "$source"
header=include/nacre/nacre.h
for technique in "$@"; do
    folder=$(find effect -type d -name "$technique")
    if [ ! -f "$folder/$technique.cmake" ]; then
        echo "technique_files.sh: effect/ has no folder with $technique.cmake" >&2
        exit 1
    fi
    beside=("$header" effect/technique_table.cpp effect/CMakeLists.txt)
    if grep -qE "^ *[A-Za-z0-9_]+ $technique[A-Z][A-Za-z]*;" "$header"; then
        beside+=(bench/suites/technique_variants.cpp)
    fi
    # As an enumerator, an object, a name, a file or a folder.
    names="NACRE_TECHNIQUE_${technique^^}\b|\b${technique}Technique\b|\"$technique\"|\bscatter_$technique|\b$technique(/|\.cmake)"
    files=$(grep -rlE "$names" --include='*.h' --include='*.hpp' --include='*.cpp' --include='*.c' --include='*.glsl' \
        --include='*.comp' --include='*.cmake' --include=CMakeLists.txt --exclude-dir='build*' --exclude-dir='.*' -- * |
        grep -vE "^($folder|docs|tests|out)/" || true)
    echo "$technique: $folder, and" $files
    for file in $files; do
        if [[ " ${beside[*]} " != *" $file "* ]]; then
            echo "technique_files.sh: $file names $technique, beside its folder and ${beside[*]}" >&2
            exit 1
        fi
    done
done
