#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# platform_speed.sh [VARIANT]...      portable and avx512, unless variants are named
# What Windows costs: runs tests/platforms/platform_speed.c of the suites musl and windows, which have the same
# compiler and flags (-O1), by turns on this processor, and prints the least milliseconds of a frame and their ratio.
# Both suites of scripts/test.sh have to be built.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- portable avx512
for suite in musl windows; do
    cmake --build "build/$suite" -j "$(nproc)" --target platform_speed
done >build/platform_speed.log 2>&1 || { tail -n 20 build/platform_speed.log; exit 1; }

export PATH=$PATH:/usr/lib/wine WINEDEBUG=-all WINEPREFIX=$PWD/build/wine
for _ in 1 2 3 4 5; do
    for variant; do
        build/musl/tests/platform_speed "$variant" | sed 's/$/\t1/'
        wine64 build/windows/tests/platform_speed.exe "$variant" | tr -d '\r' | sed 's/$/\t2/'
    done
done | awk -F '\t' '
    {
        key = $1 "\t" $2
        if (!((key, $4) in least)) {
            least[key, $4] = $3
            if ($4 == 1) order[n++] = key
        }
        if ($3 < least[key, $4]) least[key, $4] = $3
    }
    END {
        print "variant\tspheres\tmusl\twindows\tratio"
        for (i = 0; i < n; i++) {
            key = order[i]
            printf "%s\t%.2f\t%.2f\t%.2f\n", key, least[key, 1], least[key, 2], least[key, 2] / least[key, 1]
        }
    }'
