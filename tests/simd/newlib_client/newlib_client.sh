#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# newlib_client.sh SOURCE_DIR C_COMPILER
# A real client of simd/spu_intrinsics.h: newlib's math functions for the SPU (3.3, libm/machine/spu/headers) compile for
# this machine, by each mapping, in the host's arithmetic and in the SPU's. What words do is not looked at here:
# test_spu_words.c compares each of them bit by bit.
#
#   unchanged   as they are
#   recast      after newlib_client/casts.awk has rewritten the casts, so that they are right on a little-endian host
#
# The sources come as a Debian source package through a private apt configuration made from this machine's own Debian
# entries, and stay in the working folder for the next run. CGT_NEWLIB_SOURCE names an unpacked newlib to take instead.
# Exit code 77: newlib cannot be had here.
set -eu
tree=$1
compiler=$2
client=$tree/tests/simd/newlib_client
headers=newlib/libm/machine/spu/headers
version=3.3.0
release=bookworm # the Debian release with that version

skip() {
    echo "newlib_client: skipped: $1"
    rm -rf newlib-apt newlib.part
    exit 77
}

# ---- the sources ----

# This machine's entries for Debian, turned into entries for the source packages of that release.
write_sources() {
    find /etc/apt/sources.list.d -name '*.sources' -exec cat {} + -exec echo \; 2>/dev/null |
        grep -v '^[[:space:]]*#' |
        awk -v release="$release" 'BEGIN { RS = ""; ORS = "\n\n" }
            /URIs:[^\n]*\/debian\/?([ \t\n]|$)/ && !done++ {
                sub(/Types:[^\n]*/, "Types: deb-src"); sub(/Suites:[^\n]*/, "Suites: " release)
                sub(/Components:[^\n]*/, "Components: main"); print
            }' >"$1/sources.list.d/host.sources"
    find /etc/apt/sources.list /etc/apt/sources.list.d -name '*.list' -exec cat {} + 2>/dev/null |
        sed -nE "s#^deb(-src)?[[:space:]]+((\[[^]]*\][[:space:]]+)?[^[:space:]]+/debian/?)[[:space:]].*#\2#p" |
        sed "s#.*#deb-src & $release main#" |
        head -n 1 >"$1/sources.list"
    [ -s "$1/sources.list" ] || [ -s "$1/sources.list.d/host.sources" ]
}

fetch() {
    command -v apt-get >/dev/null || skip "no apt-get; set CGT_NEWLIB_SOURCE"
    apt=$PWD/newlib-apt
    rm -rf "$apt" newlib.part
    mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/sources.list.d" newlib.part
    : >"$apt/status"
    write_sources "$apt" || skip "no Debian entry among this machine's apt sources; set CGT_NEWLIB_SOURCE"
    set -- -q -o "Dir::Etc::SourceList=$apt/sources.list" -o "Dir::Etc::SourceParts=$apt/sources.list.d" \
        -o "Dir::State::Lists=$apt/lists" -o "Dir::State::status=$apt/status" -o "Dir::Cache=$apt/cache" \
        -o APT::Sandbox::User=root -o Acquire::Retries=1 -o Acquire::http::Timeout=30 -o Acquire::https::Timeout=30
    echo "newlib_client: fetching the source package of newlib"
    if ! (cd newlib.part && apt-get "$@" update && apt-get "$@" source --download-only newlib) \
        >newlib-apt.log 2>&1; then
        tail -n 5 newlib-apt.log
        skip "its source package cannot be fetched; set CGT_NEWLIB_SOURCE"
    fi
    set -- newlib.part/newlib_"$version".orig.tar.*
    [ -e "$1" ] || skip "apt has another version of newlib than $version"
    tar xf "$1" -C newlib.part --strip-components=1 --wildcards "*/$headers/*"
    rm -rf "$apt" newlib.part/*.orig.tar.* newlib.part/*.dsc newlib.part/*.debian.tar.*
    mv newlib.part "newlib-$version"
}

source=${CGT_NEWLIB_SOURCE:-newlib-$version}
[ -n "${CGT_NEWLIB_SOURCE:-}" ] || [ -d "$source" ] || fetch
[ -e "$source/$headers/divf4.h" ] || {
    echo "newlib_client: $source/$headers/divf4.h: not there"
    exit 1
}

# ---- the two forms of the sources: folders that hold headers/ ----

build=newlib_client.build
rm -rf "$build"
mkdir -p "$build/unchanged/headers" "$build/recast/headers"
for file in "$source/$headers"/*f4.h "$source/$headers"/*d2.h "$source/$headers/cos_sin.h" \
    "$source/$headers/erf_utils.h" "$source/$headers/simdmath.h" "$source/$headers/vec_literal.h"; do
    cp "$file" "$build/unchanged/headers"
    awk -f "$client/casts.awk" "$file" >"$build/recast/headers/${file##*/}"
done

# ---- compile ----

macros=$(echo | "$compiler" -dM -E -x c -)
has() { echo "$macros" | grep -q "^#define $1\$"; }

bad=0
runs=0
# check FORM FLAGS...: the functions of floats, and those of doubles
check() {
    form=$1
    shift
    cast=
    [ "$form" = unchanged ] || cast="-include $client/casts.h"
    for type in f4 d2; do
        runs=$((runs + 1))
        # an SPU's sources include spu_intrinsics.h first: some headers use its keyword before they do
        echo '#include <spu_intrinsics.h>' >"$build/client.c"
        (cd "$build/$form" && printf '#include "%s"\n' headers/*$type.h) >>"$build/client.c"
        # shellcheck disable=SC2086 # lists of words
        "$compiler" -std=gnu11 -fsyntax-only -Wall -Wextra -Werror -D__SPU__ -DCGT_SPU_HOST "$@" -I"$tree/simd" $cast \
            -isystem "$build/$form" -isystem "$build/$form/headers" "$build/client.c" && continue
        echo "$form $type $*: does not compile"
        bad=$((bad + 1))
    done
}

for form in unchanged recast; do
    for exact in "" -DCGT_SPU_EXACT; do
        check "$form" -DCGT_SPU_PORTABLE $exact
        if has '__x86_64__ 1'; then
            check "$form" -msse4.1 $exact
            check "$form" -mavx2 -mfma $exact
        elif has '__aarch64__ 1'; then
            check "$form" $exact
        fi
    done
done
echo "newlib_client: $runs compilations, $bad bad"
[ "$bad" -eq 0 ]
