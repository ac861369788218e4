#!/usr/bin/env bash
# compare_passes.sh STORE_FRAMES MODULES SOURCE: the passes in WGSL write what the library's write, on synthetic frames that use
# all that there is in WGSL, in headless Chromium on its software device. Exit status 77: skipped.
set -euo pipefail
store_frames=$1
modules=$2
source=$3
for program in chromium python3; do
    if ! command -v $program > /dev/null; then
        echo "compare_passes.sh: skipped, because $program is not installed"
        exit 77
    fi
done
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT
"$store_frames" "$frames" spheres everything lights encoded
"$source/scripts/webgpu.py" "$modules" "$frames" --check
