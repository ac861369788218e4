#!/usr/bin/env bash
# Renders the pictures of README.md again. Takes the command; without it, the release build's.
set -euo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
nacre=${1:-$folder/../../build/release/app/nacre}

for light in front back; do
    "$nacre" render --light "$light" --size 640x360 --samples 2 --output "$folder/gallery-$light.png"
    "$nacre" render --light "$light" --size 640x360 --samples 2 --no-scatter --no-transmit --output "$folder/gallery-$light-off.png"
done
