#!/usr/bin/env bash
# Writes docs/accuracy.md from docs/accuracy/method.md and the tables of `nacre compare --suite`. Takes the command to run
# and the suite's options, e.g. `--noise 0.5`; without them build/release/app/nacre and none. References are kept in
# out/accuracy for the next run, and the page with pictures lies there.
set -euo pipefail
cd "$(dirname "$0")/.."

nacre=${1:-build/release/app/nacre}
if [ ! -x "$nacre" ]; then
    echo "accuracy-doc.sh: $nacre cannot be run; build it or name another" >&2
    exit 1
fi
"$nacre" compare --suite -o out/accuracy "${@:2}"
document=$(mktemp docs/.accuracy-XXXXXX)
trap 'rm -f "$document"' EXIT
cat docs/accuracy/method.md out/accuracy/accuracy.md >"$document"
chmod 644 "$document"
mv "$document" docs/accuracy.md
