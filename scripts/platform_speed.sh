#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# platform_speed.sh [PLATFORM]...      i686 musl windows wasm, unless some are named
# What a platform costs that runs on this processor: builds tests/platforms/platform_speed.c with the library, all with
# -O3, for it and for native Linux, runs them by turns, and prints the least milliseconds of a frame, by the variant
# portable and by the widest, and how many times as long as natively that takes.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- i686 musl windows wasm
scripts/dependencies.sh build tests "$@"
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
mkdir -p build/speed

build() {
    local preset=$1
    if [ "$1" = native ]; then preset=release; else cmake/toolchains/cross_cmocka.sh "$1"; fi
    cmake --preset "$preset" -B "build/speed/$1" "-DCMAKE_C_FLAGS_RELEASE=-O3 -DNDEBUG" -DCGT_ONLY_LIBRARY=ON \
        -DCGT_BUILD_TESTS=ON -DCGT_BUILD_ORACLE=OFF -DCGT_BUILD_EXAMPLES=OFF -DCGT_BUILD_BENCH=OFF \
        -DCGT_BUILD_RENDER=OFF
    cmake --build "build/speed/$1" -j "$(nproc)" --target platform_speed
}

for platform in native "$@"; do
    build "$platform" >"build/speed/$platform.log" 2>&1 || { tail -n 20 "build/speed/$platform.log"; exit 1; }
done
for _ in 1 2 3 4 5; do
    for platform in native "$@"; do
        cmake --build "build/speed/$platform" --target time_platform | tr -d '\r' | sed "s/^/$platform\t/"
    done
done | awk -F '\t' '
    NF == 4 {
        key = $1 "\t" $3
        way = $2 == "portable" ? 1 : 2
        if (!(key in name)) {
            name[key] = $2
            order[n++] = key
        }
        if (way == 2) name[key] = $2
        if (!((key, way) in least) || $4 < least[key, way]) least[key, way] = $4
    }
    function cell(key, way,   own, native) {
        native = "native\t" substr(key, index(key, "\t") + 1)
        own = least[key, way]
        return own == "" ? "-\t-" : sprintf("%.2f\t%.2f", own, own / least[native, way])
    }
    END {
        print "platform\tspheres\tportable\tratio\tvariant\twidest\tratio"
        for (i = 0; i < n; i++) {
            if (!((order[i], 2) in least)) least[order[i], 2] = least[order[i], 1]
            print order[i] "\t" cell(order[i], 1) "\t" name[order[i]] "\t" cell(order[i], 2)
        }
    }'
