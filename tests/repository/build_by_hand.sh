#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# build_by_hand.sh SOURCE_DIR BUILD_DIR CC [EMULATOR...]
# The library builds with one cc command, without CMake, and the resulting program casts a ray. Nothing is compiled twice
# for that: the command's files, definitions and folders are compared with those of the build, whose archive is linked,
# and what knows the variants is compiled anew, since the command has the portable one alone.
set -eu
source=$1 build=$2 cc=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C
cd "$source"

# the command: cc FLAGS FILES consumer.c -lpthread -lm
flags="-std=c11 -O0 -ffp-contract=off -DCGT_HAVE_PORTABLE -DCGT_VARIANT=portable -DCGT_VARIANT_PORTABLE -DCGT_LANES=4
    -DCGT_SPU_PORTABLE -Iinclude -Isimd -Isrc"
find src backends -name "*.c" ! -path "backends/cell/*" | sort >"$work/by_hand"

# entries of the library's portable objects: "file command"
awk -F '"' '$2 == "command" { command = $0 } $2 == "file" { print $4 " " command }' "$build/compile_commands.json" |
    grep -E "^$source/(src|backends/[a-z_]*\.c)" | grep -vE ' -DCGT_LANES=(4[0-9]|[^4])|CGT_VARIANT=(sse|neon|wasm|spu) ' |
    grep -E 'CMakeFiles/cgt_(objects|archive_objects|kernel_portable)\.dir/' >"$work/entries"
sed -E "s#^$source/([^ ]*) .*#\1#" "$work/entries" | sort >"$work/built"
diff "$work/by_hand" "$work/built" || { echo "by hand (<) and by CMake (>) other files are compiled"; exit 1; }

# words FLAGS: definitions without their value 1, folders and the standard
words() { tr -s ' ' '\n' | grep -E '^-(D|I|std=)' | sed -E "s#^-I$source/#-I#; s/^(-D[A-Z0-9_]*)=1\$/\1/" | sort -u; }
echo "$flags" | words >"$work/by_hand"
words <"$work/entries" | grep -vE '^-DCGT_HAVE_(SSE|NEON|WASM|AVX2|AVX512)$|^-D(NDEBUG|_GNU_SOURCE)$' >"$work/built"
diff "$work/by_hand" "$work/built" || { echo "by hand (<) and by CMake (>) other flags are given"; exit 1; }

# shellcheck disable=SC2086 # flags are several words
"$cc" $flags src/dispatch/variant.c src/kernel/entry/kernel_table.c tests/repository/consumer/consumer.c \
    "$build/lib/libcgt.a" -o "$work/program" -lpthread -lm
"$@" "$work/program"
