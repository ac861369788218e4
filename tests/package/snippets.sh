#!/usr/bin/env bash
# snippets.sh [--write] DOCUMENT PATH...: the code blocks of a document that follow a line "<!-- snippet: name -->" are the
# lines between "[snippet: name]" and "[end]" in a file at one of the paths. Fails where they differ, where a block of C++,
# CMake or GLSL has no name, and where a snippet is not quoted. --write puts the lines into the document.
set -euo pipefail
write=0
if [ "$1" = --write ]; then
    write=1
    shift
fi
document=$1
shift

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/snippets"

# Every snippet into a file of its name, without the indentation of its first line.
find "$@" -type f -exec awk -v to="$work/snippets/" '
    /\[end\]/ { close(to name); name = "" }
    name != "" {
        if (first) { match($0, /^ */); indent = RLENGTH; first = 0 }
        print substr($0, match($0, /[^ ]/) > indent ? indent + 1 : (RSTART > 0 ? RSTART : 1)) > (to name)
    }
    /\[snippet: / { sub(/.*\[snippet: /, ""); sub(/\].*/, ""); name = $0; first = 1 }' {} \;

# The document with its named blocks filled in anew.
awk -v from="$work/snippets/" -v quoted="$work/quoted" -v document="$document" '
    /^<!-- snippet: / { name = $3; print name > quoted; print; next }
    /^```(cpp|cmake|glsl)$/ {
        if (name == "") { print document ": a block of code without a name, line " NR > "/dev/stderr"; exit 1 }
        print
        while ((getline line < (from name)) > 0) print line
        skipping = 1; name = ""; next
    }
    /^```$/ { skipping = 0 }
    !skipping { print }' "$document" > "$work/document"

if ! diff <(ls "$work/snippets") <(sort "$work/quoted"); then
    echo "snippets.sh: the snippets of $* (<) are not those of $document (>)" >&2
    exit 1
fi
if [ $write -eq 1 ]; then
    cp "$work/document" "$document"
elif ! diff "$document" "$work/document"; then
    echo "snippets.sh: $document (<) is not what the sources have (>); --write brings it up to date" >&2
    exit 1
fi
