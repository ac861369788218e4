#!/usr/bin/env bash
# shader_spills.sh NACRE: what the driver's compiler says of the effect's passes. No pass may spill a vector register but
# transmit, which holds sixteen points of the lit surface at once (docs/performance.md, "Transmit").
set -euo pipefail
most_of_transmit=160

"$1" bench shaders | awk -v most="$most_of_transmit" '
    /^[a-z]/ { pass = $0 }
    pass ~ /bank combine smooth, half floats/ { complete = 1 }
    match($0, /Spilled VGPRs [0-9]+/) {
        spilled = substr($0, RSTART + 14, RLENGTH - 14) + 0
        limit = pass ~ /^transmit, / ? most : 0
        if (spilled > limit) { print pass ": " spilled " vector registers spilled, at most " limit; failed = 1 }
        seen++
    }
    END {
        if (!complete || seen < 20) { print "shader_spills.sh: passes are missing, " seen " seen"; failed = 1 }
        exit failed
    }'
