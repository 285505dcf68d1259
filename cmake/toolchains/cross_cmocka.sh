#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cross_cmocka.sh PRESET     PRESET: one that has a toolchain file here
# Builds cmocka for a cross target into build/sysroot-PRESET, where the preset's toolchain file looks for it. Debian has
# no binary of cmocka for big-endian ppc64, so the source package is built. Nothing is done where it is there.
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

cmake/toolchains/debian_source.sh cmocka "$source"
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
