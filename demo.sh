#!/usr/bin/env bash
# From a fresh clone to pictures: installs the packages, builds, and renders the gallery into out/.
set -euo pipefail
cd "$(dirname "$0")"

scripts/install-packages.sh
cmake --preset release
cmake --build --preset release --target nacre_app

nacre=build/release/app/nacre
mkdir -p out
for light in front back; do
    "$nacre" render --samples 2 --light "$light" --output "out/gallery-$light.png"
    "$nacre" render --samples 2 --light "$light" --no-scatter --no-transmit --output "out/gallery-$light-off.png"
done

cat <<END

The gallery, lit from the front and from behind, with the effect on and off:
  out/gallery-front.png  out/gallery-front-off.png
  out/gallery-back.png   out/gallery-back-off.png

To go on:
  $nacre render model.glb --material skin --back --output out/model.png
  $nacre material list
  $nacre render --help
END
