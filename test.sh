#!/usr/bin/env bash
# Every test: the layout of the code, the whole suite optimised and compiled by GCC, clang-tidy over the library; then,
# compiled by clang, the CPU tests under AddressSanitizer and UndefinedBehaviorSanitizer, and two contexts on two threads under
# ThreadSanitizer.
set -euo pipefail
cd "$(dirname "$0")"

scripts/install-packages.sh

log=$(mktemp)
trap 'rm -f "$log"' EXIT

# Many tests wait for the one thread that compiles shaders, so that one test more than there are cores keeps all busy.
run_preset() {
    cmake --preset "$1" && cmake --build --preset "$1" && ctest --preset "$1" --parallel "$(($(nproc) + 1))" | tee -a "$log"
}

# What the checks of scripts/dev find is in their output; the summary says which of them failed.
check() {
    echo "== $* ==" | tee -a "$log"
    if ! "$@"; then
        echo "$* (Failed)" | tee -a "$log"
        status=1
    fi
}

status=0
check scripts/dev format --check
for preset in release asan tsan; do
    echo "== $preset ==" | tee -a "$log"
    run_preset "$preset" || status=$?
    [ "$preset" != release ] || check scripts/dev tidy --library
done

echo
grep -E '^== |tests passed|Total Test time|\((Failed|Timeout|Not Run|SEGFAULT|.*Exception.*|.*Subprocess.*)\)$' "$log" || true
exit "$status"
