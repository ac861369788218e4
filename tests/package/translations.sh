#!/usr/bin/env bash
# translations.sh BUILD_DIRECTORY: every pass is valid for Vulkan 1.2 and has its HLSL and its MSL, each with an entry point
# and with as many resources as the SPIR-V that it was made from.
set -euo pipefail
spirv_directory=$1/effect/spirv
named_directory=$1/effect/named_spirv
translations=$1/translations
passes=0
for spirv in "$spirv_directory"/*.spv; do
    name=$(basename "$spirv" .spv)
    spirv-val --target-env vulkan1.2 "$spirv"
    spirv-val --target-env vulkan1.2 "$named_directory/$name.spv"
    # Resources: variables that a binding decorates. Members are not counted twice: the decoration is on the variable.
    bindings=$(spirv-dis --raw-id "$named_directory/$name.spv" | grep -c 'OpDecorate .* Binding ')
    used=$(spirv-dis --raw-id "$spirv" | grep -c 'OpDecorate .* Binding ') # MSL has those alone
    hlsl=$translations/$name.hlsl
    msl=$translations/$name.metal
    grep -qE '^void main\(' "$hlsl" || { echo "$hlsl has no main" >&2; exit 1; }
    grep -qE '^\[numthreads\(' "$hlsl" || { echo "$hlsl has no numthreads" >&2; exit 1; }
    grep -qE '^kernel void ' "$msl" || { echo "$msl has no kernel" >&2; exit 1; }
    in_hlsl=$(grep -cE ' register\([tub][0-9]+' "$hlsl" || true)
    in_msl=$(grep -E '^kernel void ' "$msl" | grep -oE '\[\[(buffer|texture)\([0-9]+\)\]\]' | wc -l)
    if [ "$in_hlsl" -ne "$bindings" ]; then
        echo "$hlsl has $in_hlsl resources, the SPIR-V $bindings" >&2
        exit 1
    fi
    if [ "$in_msl" -lt "$used" ]; then
        echo "$msl has $in_msl resources, the SPIR-V uses $used" >&2
        exit 1
    fi
    passes=$((passes + 1))
done
sources=$(find "$translations" -name '*.hlsl' | wc -l)
echo "$passes passes, $sources HLSL files"
[ "$passes" -gt 0 ] && [ "$sources" -eq "$passes" ]
