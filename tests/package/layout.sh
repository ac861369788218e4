#!/usr/bin/env bash
# layout.sh INCLUDE [EXPECTED]: what a compiled caller has built in of the C headers in INCLUDE: sizes and offsets, in bytes, of
# all structures' fields, and all enumerators' values, as a 64-bit C compiler sees them. Prints them; with EXPECTED they have to
# be what that file says.
set -euo pipefail
include=$1
expected=${2:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Without comments, a declaration a line.
declarations() {
    for header in nacre.h nacre_baselines.h nacre_passes.h; do
        cc -w -fpreprocessed -dD -E -P "$include/nacre/$header" | grep -v '^#' | tr '\n' ' ' | sed 's/[;{},]/&\n/g'
    done
}

{
    printf '#include <nacre/nacre_baselines.h>\n#include <nacre/nacre_passes.h>\n#include <stddef.h>\n#include <stdio.h>\nint main(void) {\n'
    printf 'printf("version %%d.%%d.%%d\\n", NACRE_VERSION_MAJOR, NACRE_VERSION_MINOR, NACRE_VERSION_PATCH);\n'
    declarations | awk '
        match($0, /typedef (struct|enum) Nacre[A-Za-z]+ *\{/) { kind = $2; name = $3; sub(/\{/, "", name); next }
        /\}/ {
            if (kind == "struct") { printf "printf(\"%s: %%zu\\n\", sizeof(%s));\n", name, name }
            kind = ""
        }
        kind == "struct" && match($0, /[A-Za-z0-9_]+(\[[A-Za-z0-9_]+\])* *;/) {
            field = substr($0, RSTART, RLENGTH); sub(/[\[ ;].*/, "", field)
            printf "printf(\"%s.%s: %%zu at %%zu\\n\", sizeof(((%s*)0)->%s), offsetof(%s, %s));\n",
                name, field, name, field, name, field
        }
        match($0, /NACRE_[A-Z0-9_]+ *=/) {
            value = substr($0, RSTART, RLENGTH); sub(/ *=/, "", value)
            printf "printf(\"%s = %%d\\n\", %s);\n", value, value
        }'
    printf 'return 0;\n}\n'
} > "$work/layout.c"
cc -std=c99 -Wall -Wextra -Werror -I "$include" "$work/layout.c" -o "$work/layout"
"$work/layout" > "$work/layout.txt"
if [ -z "$expected" ]; then
    cat "$work/layout.txt"
elif ! diff "$expected" "$work/layout.txt"; then
    echo "layout.sh: the headers (>) differ from $expected (<), so that callers of the same version no longer fit: raise the" \
        "version in nacre.h once it has been released, say so in CHANGELOG.md, and write that file anew" >&2
    exit 1
fi
