#!/usr/bin/env bash
# Renders README.md's close-ups of the gallery again: ear, wing and nose, without the effect and with it, anti-aliased.
# Takes the command to run as its argument; without one, build/release/app/nacre.
set -euo pipefail
cd "$(dirname "$0")/.."

nacre=${1:-build/release/app/nacre}
if [ ! -x "$nacre" ]; then
    echo "readme-pictures.sh: $nacre cannot be run; build it or name another" >&2
    exit 1
fi

# close_up NAME LIGHT TARGET FOV: two pictures, docs/images/effect-NAME-off.png and docs/images/effect-NAME-on.png
close_up() {
    local picture=(render --light "$2" --camera-position 0,0.3,1.75 --camera-target "$3" --fov "$4"
        --size 320x320 --samples 3 --shadow-map-size 4096)
    "$nacre" "${picture[@]}" --no-scatter --no-transmit --output "docs/images/effect-$1-off.png"
    "$nacre" "${picture[@]}" --output "docs/images/effect-$1-on.png"
}

close_up ear back -0.238,0.178,0 3.2
close_up wing back 0.365,0.2,0 4.6
close_up nose front -0.158,0.158,0 3.2
