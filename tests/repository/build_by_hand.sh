#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# build_by_hand.sh SOURCE_DIR CC [EMULATOR...]
# The library builds with one cc command, without CMake, and the resulting program casts a ray.
set -eu
cd "$1"
cc=$2
shift 2
program=$(mktemp)
trap 'rm -f "$program"' EXIT

# not optimised: the test is that it compiles and links
"$cc" -std=c11 -O0 -ffp-contract=off -DCGT_HAVE_PORTABLE -DCGT_VARIANT=portable -DCGT_VARIANT_PORTABLE -DCGT_LANES=4 \
    -DCGT_SPU_PORTABLE -Iinclude -Isimd -Isrc $(find src backends -name "*.c" ! -path "backends/cell/*" | LC_ALL=C sort) tests/repository/consumer/consumer.c \
    -o "$program" -lpthread -lm
"$@" "$program"
