#!/usr/bin/env bash
# nacre_lines.sh MOST FILE OTHER...: how many lines of an example are Nacre's: those of FILE between "[snippet: …]" and "[end]"
# that are not empty. Fails where these are not fewer than MOST, where another line of FILE has Nacre's names but for passing them
# on, and where an OTHER has them anywhere.
set -euo pipefail
most=$1
shift
awk -v most="$most" -v main="$1" '
    /\[end\]/ { inside = 0; next }
    /\[snippet: / { inside = 1; next }
    inside && NF && FILENAME == main { ++lines }
    (!inside || FILENAME != main) && !/^ *\/\// && /(^|[^a-z])(nacre[A-Z:\/]|Nacre|NACRE)/ &&
        !(FILENAME == main && /^ *(nacre::Context context_;|NacreRequirements requirements_;)$/) {
        print FILENAME ":" FNR ": Nacre outside of a snippet: " $0 > "/dev/stderr"
        failed = 1
    }
    END { print lines " lines are Nacre'"'"'s"; exit failed || lines >= most || lines < 20 }' "$@"
