#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# newlib_client.sh SOURCE_DIR C_COMPILER [EMULATOR...]
# A real client of simd/spu_intrinsics.h: newlib's math functions for the SPU (3.3, libm/machine/spu/headers), compiled
# for this machine and held against its libm by newlib_client/client.c, for each mapping, in the host's arithmetic and
# in the SPU's:
#
#   unchanged   as they are; on a little-endian host without the functions that cast between element sizes
#   recast      on a little-endian host: all of them, after newlib_client/casts.awk has rewritten the casts
#
# The sources come as a Debian source package through a private apt configuration made from this machine's own Debian
# entries, and stay in the working folder for the next run. CGT_NEWLIB_SOURCE names an unpacked newlib to take instead.
# Exit code 77: newlib cannot be had here.
set -eu
tree=$1
compiler=$2
shift 2
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

# ---- compile and run ----

macros=$(echo | "$compiler" -dM -E -x c -)
has() { echo "$macros" | grep -q "^#define $1\$"; }

bad=0
runs=0
# build FORM FLAGS...: the client, from that form of the sources
build() {
    form=$1
    shift
    cast=
    [ "$form" = unchanged ] || cast="-DCLIENT_CASTS_DONE -include $client/casts.h"
    objects=
    for part in client float_functions double_functions special_cases; do
        # shellcheck disable=SC2086 # lists of words
        "$compiler" -std=gnu11 -O1 -ffp-contract=off -Wall -Wextra -Werror -D__SPU__ -DCGT_SPU_HOST "$@" \
            -I"$tree/simd" $cast -isystem "$build/$form" -isystem "$build/$form/headers" -I"$tree/tests" \
            -c "$client/$part.c" -o "$build/$part.o" || return 1
        objects="$objects $build/$part.o"
    done
    # shellcheck disable=SC2086
    "$compiler" $objects -o "$build/client" -lm || return 1
}

# check FORM NAME FLAGS...: with the emulator of the command line
check() {
    runs=$((runs + 1))
    form=$1
    name=$2
    shift 2
    if ! build "$form" "$@"; then
        echo "$form $name: does not compile"
        bad=$((bad + 1))
        return
    fi
    # shellcheck disable=SC2086
    if $emulator "$build/client" >"$build/$form-$name.txt" 2>&1; then
        echo "$form $name: $(tail -n 1 "$build/$form-$name.txt")"
    else
        echo "$form $name: BAD"
        grep -v '^ok' "$build/$form-$name.txt" || true
        bad=$((bad + 1))
    fi
}

# check_mapping NAME FLAGS...: all functions in IEEE arithmetic and in the SPU's. Recast, all of them are there; unchanged,
# the others have the same text, so that one arithmetic is enough.
check_mapping() {
    mapping=$1
    shift
    for each in $forms; do
        check "$each" "$mapping-ieee" "$@"
    done
    check "${forms##* }" "$mapping-exact" "$@" -DCGT_SPU_EXACT
}

emulator=$*
forms="unchanged recast"
has '__BYTE_ORDER__ __ORDER_BIG_ENDIAN__' && forms=unchanged
check_mapping portable -DCGT_SPU_PORTABLE
if has '__x86_64__ 1'; then
    check_mapping sse -msse4.1
    if [ -z "$emulator" ] && grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then
        check_mapping sse-fma -mavx2 -mfma
    fi
elif has '__aarch64__ 1'; then
    check_mapping neon
fi

echo "newlib_client: $runs runs, $bad bad; every function's error is in $build/*.txt"
[ "$bad" -eq 0 ]
