#!/usr/bin/env bash
# Writes docs/benchmark/results.md from the result files in docs/benchmark/, with each report's plots (at most ten) as
# pictures, which Chromium takes. Takes the command to run as its argument; without one, build/release/app/nacre.
set -euo pipefail
cd "$(dirname "$0")/.."

nacre=${1:-build/release/app/nacre}
if [ ! -x "$nacre" ]; then
    echo "benchmark-doc.sh: $nacre cannot be run; build it or name another" >&2
    exit 1
fi
if ! command -v chromium >/dev/null; then
    echo "benchmark-doc.sh: chromium, which takes the plots' pictures, is not installed" >&2
    exit 1
fi
document=$(mktemp docs/benchmark/.results-XXXXXX)
profile=$(mktemp -d)
trap 'rm -rf "$document" "$profile"' EXIT

# The plots of the report in a folder, as pictures beside it and as Markdown.
show_plots() {
    local count plot
    rm -f "$1"/plot-*.png
    count=$(grep -o '<canvas' "$1/report.html" | wc -l)
    for ((plot = 0; plot < count && plot < 10; ++plot)); do
        chromium --headless --no-sandbox --disable-gpu --disable-background-networking --hide-scrollbars \
            --window-size=720,450 --virtual-time-budget=5000 --user-data-dir="$profile" \
            --screenshot="$PWD/$1/plot-$plot.png" "file://$PWD/$1/report.html#plot-$plot" 2>/dev/null
        printf '![Plot %s](%s)\n' "$plot" "${1#docs/benchmark/}/plot-$plot.png"
    done
}

cat >"$document" <<'END'
# Results of the benchmark

`scripts/benchmark-doc.sh` writes this page from the results in this folder. [The benchmark](../benchmark.md) says how they
were measured, and [performance](../performance.md) what they mean.
END
find docs/benchmark -name results.json -print0 | sort -z | while IFS= read -r -d '' results; do
    folder=$(dirname "$results")
    "$nacre" bench report "$results" >/dev/null
    {
        printf '\n'
        "$nacre" bench markdown "$results"
        show_plots "$folder"
        printf '\n[Results](%s); `nacre bench report %s` makes the report.\n' "${results#docs/benchmark/}" "$results"
    } >>"$document"
    rm "$folder/results.csv" "$folder/report.html" # both can be made again
done
chmod 644 "$document"
mv "$document" docs/benchmark/results.md
