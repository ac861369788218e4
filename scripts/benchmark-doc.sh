#!/usr/bin/env bash
# Writes docs/benchmark.md from docs/benchmark/method.md and the result files in docs/benchmark/. Takes the command to run
# as its argument; without one, build/release/app/nacre.
set -euo pipefail
cd "$(dirname "$0")/.."

nacre=${1:-build/release/app/nacre}
if [ ! -x "$nacre" ]; then
    echo "benchmark-doc.sh: $nacre cannot be run; build it or name another" >&2
    exit 1
fi
document=$(mktemp docs/.benchmark-XXXXXX)
trap 'rm -f "$document"' EXIT
cat docs/benchmark/method.md >"$document"
find docs/benchmark -name results.json -print0 | sort -z | while IFS= read -r -d '' results; do
    "$nacre" bench markdown "$results" >>"$document"
    report=$(dirname "$results")/report.html
    printf '[Report](%s), [results](%s)\n\n' "${report#docs/}" "${results#docs/}" >>"$document"
done
chmod 644 "$document"
mv "$document" docs/benchmark.md
