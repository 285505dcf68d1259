#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# store_budget.sh SOURCE_DIR CC
# A store of an SPE program that exceeds the budget does not compile, and the message says why; one that just fits does.
set -eu
source=$1 cc=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# compile BYTES FLAGS...
compile() {
    cat >"$work/program.c" <<END
#include "cell/machine/spe_program.h"
typedef struct store {
    char bytes[$1];
} store;
CGT_SPE_STORE(store, s)
CGT_SPE_MAIN(program)
{
    return s()->bytes[0];
}
END
    shift
    "$cc" -std=c11 -fsyntax-only -Wall -Wextra -Werror -Wno-psabi -I"$source/simd" -I"$source/backends" "$@" \
        "$work/program.c" >"$work/message" 2>&1
}

# expect BYTES FLAGS...: fits, one byte more does not
expect() {
    bytes=$1
    shift
    compile "$bytes" "$@" || { cat "$work/message"; echo "$bytes bytes do not compile: $*"; exit 1; }
    ! compile $((bytes + 1)) "$@" || { echo "$((bytes + 1)) bytes compile: $*"; exit 1; }
    grep -q "the store exceeds what text and stack leave of 256 KB" "$work/message" || { cat "$work/message"; exit 1; }
}

expect $((262144 - 65536 - 16384))
expect $((262144 - 20000 - 16384)) -DCGT_SPE_TEXT_BYTES=20000
expect $((262144 - 30000 - 8192)) -DCGT_SPE_TEXT_BYTES=30000 -DCGT_SPE_STACK_BYTES=8192 -DCGT_SPU_EXACT
echo "stores of 3 budgets"
