#!/usr/bin/env bash
# deferred_scene.sh NACRE COMPARE_PICTURES PICTURE: the picture of examples/deferred is near to that of the command, of the same
# bodies, light and camera; and near by what the effect does: without transmission it is not.
set -euo pipefail
nacre=$(realpath "$1")
compare_pictures=$(realpath "$2")
picture=$(realpath "$3")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# The unit sphere of ellipsoid.glsl.
awk 'BEGIN {
    rings = 48; segments = 64; pi = atan2(0, -1)
    for (r = 0; r <= rings; ++r)
        for (s = 0; s <= segments; ++s) {
            d = r / rings * pi; a = s / segments * 2 * pi
            point = sprintf("%.7f %.7f %.7f", sin(d) * cos(a), cos(d), sin(d) * sin(a))
            print "v " point "\nvn " point
        }
    for (r = 0; r < rings; ++r)
        for (s = 0; s < segments; ++s) {
            i = r * (segments + 1) + s + 1; j = i + segments + 1
            if (r > 0) printf "f %d//%d %d//%d %d//%d\n", i, i, i + 1, i + 1, j + 1, j + 1
            if (r < rings - 1) printf "f %d//%d %d//%d %d//%d\n", i, i, j + 1, j + 1, j, j
        }
}' > sphere.obj

# makeFrame of frame_block.cpp, for its last frame.
awk 'BEGIN {
    split("\"marble\" \"skin\" \"wax\"", material, " ")
    split("0.83,0.79,0.75 0.77,0.55,0.45 0.92,0.82,0.62", colour, " ")
    body = "\"model\": \"sphere.obj\", \"units\": \"m\""
    rough = "\"specular\": 0, \"roughness\": 1"
    printf "{\"models\": [{%s, \"name\": \"table\", \"translate\": [0, -0.1, -0.1], \"scale\": [0.6, 0.1, 0.6], ", body
    printf "\"material\": null, \"surface\": {\"baseColor\": [0.35, 0.35, 0.35], %s}}", rough
    for (i = 1; i < 8; ++i) {
        m = 1 + i % 3
        printf ",\n{%s, \"name\": \"body %d\", \"translate\": [%g, 0.021, %g], ", body, i, 0.05 * (i % 3 - 1), 0.06 - 0.045 * i
        printf "\"scale\": [0.02, 0.02, %g], \"material\": %s, ", i % 2 == 0 ? 0.0015 : 0.02, material[m]
        printf "\"surface\": {\"baseColor\": [%s], %s}}", colour[m], rough
    }
    sky = sprintf("[%.7f, %.7f, %.7f]", 0.15 / 3.14159265, 0.15 / 3.14159265, 0.15 / 3.14159265)
    printf "],\n\"lights\": [{\"type\": \"directional\", \"intensity\": 6, \"direction\": [-0.25, -0.45, 0.85]}],\n"
    printf "\"cameras\": [{\"position\": [0.024, 0.055, 0.17], \"target\": [0, 0.022, 0], \"verticalFieldOfView\": 40.107}],\n"
    printf "\"environment\": {\"zenith\": %s, \"horizon\": %s, \"ground\": %s}}\n", sky, sky, sky
}' > deferred.json

"$nacre" render deferred.json --size 480x270 -o command.exr
"$compare_pictures" command.exr "$picture" 29
"$nacre" render deferred.json --size 480x270 --no-transmit -o dark.exr
if "$compare_pictures" dark.exr "$picture" 29; then
    echo "deferred_scene.sh: transmission makes no difference" >&2
    exit 1
fi
