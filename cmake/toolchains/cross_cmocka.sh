#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cross_cmocka.sh PRESET     PRESET: one that has a toolchain file here
# Builds cmocka for a cross target into build/sysroot-PRESET, where the preset's toolchain file looks for it. Debian has
# no binary of cmocka for big-endian ppc64, so the source package is built. It comes through a private apt configuration
# made from this machine's own Debian entries: the host's apt is left as it is. Nothing is done where it is there.
set -euo pipefail
cd "$(dirname "$0")/../.."
preset=${1:?"usage: cross_cmocka.sh PRESET"}
root=$PWD
sysroot=$root/build/sysroot-$preset
source=$root/build/cmocka-source
[ -e "$sysroot/lib/libcmocka.a" ] && exit 0

fail() {
    echo "cross_cmocka: $1" >&2
    exit 1
}

# The host's entries for this release, turned into entries for source packages.
write_sources() {
    local codename
    codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    [ -n "$codename" ] || fail "/etc/os-release names no release"
    find /etc/apt/sources.list /etc/apt/sources.list.d -name '*.sources' -exec cat {} + -exec echo \; 2>/dev/null |
        grep -v '^[[:space:]]*#' |
        awk -v name="$codename" 'BEGIN { RS = ""; ORS = "\n\n" } $0 ~ "Suites:[^\n]*[ \t]" name "([ \t\n]|$)" {
            sub(/Types:[^\n]*/, "Types: deb-src"); print }' >"$1/sources.list.d/host.sources" || true
    find /etc/apt/sources.list /etc/apt/sources.list.d \( -name '*.list' \) -exec cat {} + 2>/dev/null |
        sed -nE "s/^deb((-src)?[[:space:]].*[[:space:]]$codename[[:space:]])/deb-src\1/p" |
        sed 's/^deb-src-src/deb-src/' | sort -u >"$1/sources.list" || true
    [ -s "$1/sources.list" ] || [ -s "$1/sources.list.d/host.sources" ] ||
        fail "no entry for Debian $codename among this machine's apt sources"
}

fetch() {
    local apt=$root/build/apt-private
    rm -rf "$source.part"
    mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/sources.list.d" "$source.part"
    : >"$apt/status"
    write_sources "$apt"
    local options=(-q -o "Dir::Etc::SourceList=$apt/sources.list" -o "Dir::Etc::SourceParts=$apt/sources.list.d"
        -o "Dir::State::Lists=$apt/lists" -o "Dir::State::status=$apt/status" -o "Dir::Cache=$apt/cache"
        -o APT::Sandbox::User=root)
    echo "cross_cmocka: fetching the source package of cmocka"
    apt-get "${options[@]}" update
    (cd "$source.part" && apt-get "${options[@]}" source --download-only cmocka &&
        tar xf cmocka_*.orig.tar.?z --strip-components=1)
    rm -rf "$apt"
    mv "$source.part" "$source"
}

[ -d "$source" ] || fetch
mkdir -p "$sysroot/include" "$sysroot/lib"
if [ "$preset" = wasm ]; then # cmocka's own configuration takes minutes to link its probes by emcc
    emcc -msimd128 -pthread -O1 -D_GNU_SOURCE -D_UINTPTR_T_DEFINED -DHAVE_SIGNAL_H -DHAVE_INTTYPES_H -DHAVE_STRINGS_H \
        -DHAVE_MALLOC_H -I "$source/include" -c "$source/src/cmocka.c" -o "$sysroot/cmocka.o" &&
        emar rcs "$sysroot/lib/libcmocka.a" "$sysroot/cmocka.o" || fail "emcc did not compile cmocka"
    cp "$source"/include/cmocka.h "$sysroot/include"
    exit 0
fi
cmake -S "$source" -B "$sysroot/build" -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/$preset.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DWITH_STATIC_LIB=ON -DWITH_EXAMPLES=OFF >"$sysroot.log" 2>&1 &&
    cmake --build "$sysroot/build" --target cmocka-static >>"$sysroot.log" 2>&1 || {
    tail -n 30 "$sysroot.log"
    fail "the build failed; see $sysroot.log"
}
cp "$source"/include/cmocka.h "$sysroot/include"
archive=$(find "$sysroot/build" -name 'libcmocka*.a' | head -n 1)
[ -n "$archive" ] || fail "no static library in $sysroot/build"
cp "$archive" "$sysroot/lib/libcmocka.a"
echo "cross_cmocka: $sysroot/lib/libcmocka.a"
