#!/usr/bin/env bash
# file_names.sh SOURCE: no two files below the folders of the sources have one name, so that an include, a message or a search
# means one. What every folder may have is left out, and so are the results of the benchmark, which have the same names in
# every run.
set -euo pipefail
cd "$1"
names=$(find . -mindepth 2 -type f -not -path './.*' -not -path './build*' -not -path './out/*' -not -path './docs/benchmark/*/*' \
    -not -name CMakeLists.txt -not -name README.md)
repeated=$(sed 's|.*/||' <<< "$names" | sort -f | uniq -di)
for name in $repeated; do
    echo "file_names.sh: one name, several files:" $(grep -iE "/${name//./\\.}\$" <<< "$names") >&2
done
echo "$(wc -l <<< "$names") files"
[ -z "$repeated" ]
