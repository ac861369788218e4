#!/usr/bin/env bash
# nacre_lines.sh MOST FILE...: how many lines of an example are Nacre's: those between "[snippet: …]" and "[end]" that are not
# empty. Fails where these are not fewer than MOST, and where a line outside of them has Nacre's names.
set -euo pipefail
most=$1
shift
awk -v most="$most" '
    /\[end\]/ { inside = 0; next }
    /\[snippet: / { inside = 1; next }
    inside && NF { ++lines }
    !inside && !/^ *\/\// && /(^|[^a-z])(nacre[A-Z:\/]|Nacre|NACRE)/ && !/(createContext|nacre::Context context_|NacreRequirements requirements_|getRequirements)/ {
        print FILENAME ":" FNR ": Nacre outside of a snippet: " $0 > "/dev/stderr"
        failed = 1
    }
    END { print lines " lines are Nacre'"'"'s"; exit failed || lines >= most || lines < 20 }' "$@"
