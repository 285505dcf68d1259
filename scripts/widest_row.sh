#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# widest_row.sh
# Prints the widest row of cmake/variants.cmake that this CPU runs, by the features that src/dispatch/variant.c asks for.
# What it does not run need not be built.
set -euo pipefail
has_all() {
    local feature
    for feature in "$@"; do
        grep -qw "$feature" /proc/cpuinfo 2>/dev/null || return 1
    done
}
case $(uname -m) in
x86_64)
    if has_all avx2 fma bmi1 avx512f avx512bw avx512dq avx512vl; then echo avx512
    elif has_all avx2 fma bmi1; then echo avx2
    elif has_all sse4_1; then echo sse
    else echo portable
    fi ;;
aarch64) echo neon ;;
*) echo portable ;;
esac
