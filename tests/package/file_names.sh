#!/usr/bin/env bash
# file_names.sh SOURCE ROOM...: no file in one of these folders has the name of a file elsewhere in the sources, so that an
# include, a message or a search means one. Every folder has its CMakeLists.txt; examples stand alone.
set -euo pipefail
cd "$1"
shift
names=$(find . -mindepth 2 -type f -not -path './.*' -not -path './build*' -not -path './out/*' | sed 's|^\./||' | grep -vE '/(CMakeLists\.txt|README\.md)$|^(docs|scenes|examples|tests/data)/')
repeated=$(sed 's|.*/||' <<< "$names" | sort | uniq -d)
failed=0
for name in $repeated; do
    files=$(grep -E "/${name//./\\.}\$" <<< "$names")
    for room in "$@"; do
        if grep -q "^$room/" <<< "$files"; then
            echo "file_names.sh: one name, several files:" $files >&2
            failed=1
            break
        fi
    done
done
echo "$(wc -l <<< "$names") files"
exit $failed
