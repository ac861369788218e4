#!/usr/bin/env bash
# abi.sh LIBRARY HEADER...: a shared library's dynamic symbols are the headers' NACRE_API functions, no more and no fewer,
# and it needs the C and C++ runtimes alone: not Vulkan's loader.
set -euo pipefail
library=$1
shift

declared=$(cat "$@" | tr '\n' ' ' | grep -oE 'NACRE_API [A-Za-z0-9_ ]+\*? ?nacre[A-Za-z]+\(' | grep -oE 'nacre[A-Za-z]+' | sort)
exported=$(nm --dynamic --defined-only --format=just-symbols "$library" | sort)
echo "$(wc -w <<< "$declared") functions declared"
[ -n "$declared" ]
if ! diff <(echo "$declared") <(echo "$exported"); then
    echo "abi.sh: declared (<) and exported (>) differ" >&2
    exit 1
fi

foreign=$(readelf --dynamic "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
    grep -vE '^(libc|libm|libgcc_s|libstdc\+\+|libc\+\+|libc\+\+abi|libunwind|ld-linux.*)\.so' || true)
if [ -n "$foreign" ]; then
    echo "abi.sh: $library needs $foreign" >&2
    exit 1
fi
vulkan=$(nm --dynamic --undefined-only --format=just-symbols "$library" | grep '^vk' || true)
if [ -n "$vulkan" ]; then
    echo "abi.sh: $library links $vulkan" >&2
    exit 1
fi
