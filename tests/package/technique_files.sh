#!/usr/bin/env bash
# technique_files.sh SOURCE TECHNIQUE...: what a technique of the effect takes (CONTRIBUTING.md, "To add"). Each is a folder
# of its own, and named in at most three files beside: its enumerator, the table, and the list for CMake. Documents and tests
# speak of it, and the benchmark chooses what it measures; they are not counted.
set -euo pipefail
source=$1
shift
cd "$source"
most=3
for technique in "$@"; do
    folder=$(find effect -type d -name "$technique")
    if [ ! -f "$folder/$technique.cmake" ]; then
        echo "technique_files.sh: effect/ has no folder with $technique.cmake" >&2
        exit 1
    fi
    # As an enumerator, an object, a name, a file or a folder.
    names="NACRE_TECHNIQUE_${technique^^}\b|\b${technique}Technique\b|\"$technique\"|\bscatter_$technique|\b$technique(/|\.cmake)"
    files=$(grep -rlE "$names" --include='*.h' --include='*.hpp' --include='*.cpp' --include='*.c' --include='*.glsl' \
        --include='*.comp' --include='*.cmake' --include=CMakeLists.txt --exclude-dir='build*' --exclude-dir='.*' -- * |
        grep -vE "^($folder|bench|docs|tests|out)/" || true)
    echo "$technique: $folder, and" $files
    if [ "$(wc -w <<< "$files")" -gt $most ]; then
        echo "technique_files.sh: $technique stands in more than $most files beside its folder" >&2
        exit 1
    fi
done
