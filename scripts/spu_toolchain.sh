#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# spu_toolchain.sh           builds the SPU's compiler where it is missing; its last line is the folder of its programs
# spu_toolchain.sh --find    the folder alone; exit code 1 and no word where the compiler is missing
#
# spu-elf gcc 9.3, binutils 2.40 and newlib 3.3, from Debian packages alone, into
# ${XDG_CACHE_HOME:-~/.cache}/libcgt/spu-toolchain (50 MB). It takes eight minutes of one core, a download of 130 MB and
# 2 GB of disk while it runs; where the compiler is there already, nothing is done. Only the suite `spu` of
# scripts/test.sh and scripts/spu_sizes.sh need it.
#
# gcc 9 is the last that knows the SPU. Its source is a package of Debian 11 (gcc-9-source), those of binutils and newlib
# are source packages of Debian 12. They come through a private apt configuration made from this machine's own Debian
# entry: the host's apt is left as it is.
set -euo pipefail
cd "$(dirname "$0")/.."

recipe=1 # raise it when the compiler that this script builds changes: a cache with another number is built anew
prefix=${XDG_CACHE_HOME:-$HOME/.cache}/libcgt/spu-toolchain
work=$prefix.work
log=$prefix.log

is_ready() { [ "$(cat "$prefix/recipe" 2>/dev/null)" = "$recipe" ]; }

fail() {
    echo "spu_toolchain: $1" >&2
    exit 1
}

# quiet NAME COMMAND...: a step whose output goes to the log.
quiet() {
    local name=$1
    shift
    echo "== $name: $*" >>"$log"
    "$@" >>"$log" 2>&1 || {
        tail -n 20 "$log" >&2
        fail "$name failed; see $log"
    }
}

fetch() {
    local apt=$work/apt uri
    mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial"
    : >"$apt/status"
    uri=$(find /etc/apt/sources.list /etc/apt/sources.list.d \( -name '*.list' -o -name '*.sources' \) -exec cat {} + \
        2>/dev/null | grep -v '^[[:space:]]*#' | grep -oE '[a-z+]+:/[^ ]*/debian/?( |$)' | head -n 1 | tr -d ' ' || true)
    [ -n "$uri" ] || fail "no Debian entry among this machine's apt sources"
    printf '%s\n' "deb $uri bullseye main" "deb-src $uri bookworm main" >"$apt/sources.list"
    local options=(-q -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=-
        -o "Dir::State::Lists=$apt/lists" -o "Dir::State::status=$apt/status" -o "Dir::Cache=$apt/cache"
        -o APT::Sandbox::User=root)
    quiet fetch apt-get "${options[@]}" update
    quiet fetch apt-get "${options[@]}" source --download-only binutils=2.40-2 newlib
    quiet fetch apt-get "${options[@]}" download gcc-9-source
}

unpack() {
    quiet unpack dpkg-deb -x gcc-9-source_*.deb gcc-9-source
    mkdir -p gcc binutils newlib
    quiet unpack tar xf gcc-9-source/usr/src/gcc-9/gcc-9.*-dfsg.tar.xz -C gcc --strip-components=1 \
        --exclude='gcc-9.*/gcc/testsuite/g*' --exclude='gcc-9.*/libgo' --exclude='gcc-9.*/gcc/ada'
    quiet unpack tar xf binutils_2.40.orig.tar.xz -C binutils --strip-components=1
    quiet unpack tar xf newlib_3.*.orig.tar.* -C newlib --strip-components=1
}

build_binutils() {
    # gas 2.36 and later know a directive .nop that takes the SPU's instruction nop away.
    sed -i '/^  {"nop", s_nop, 0},/d' binutils/gas/read.c
    mkdir build-binutils && cd build-binutils
    quiet binutils ../binutils/configure --target=spu-elf --prefix="$prefix" --disable-nls --disable-gdb \
        --disable-gdbserver --disable-sim --disable-werror --disable-gprofng --disable-plugins CFLAGS=-O1 CXXFLAGS=-O1
    quiet binutils make -j"$jobs"
    quiet binutils make install
    cd ..
}

build_gcc() {
    mkdir build-gcc && cd build-gcc
    quiet gcc ../gcc/configure --target=spu-elf --prefix="$prefix" --enable-obsolete --enable-languages=c --with-newlib \
        --without-headers --enable-checking=release --disable-nls --disable-libssp --disable-libquadmath \
        --disable-libgomp --disable-libatomic --disable-shared --disable-threads --disable-lto --disable-plugin \
        --disable-multilib --disable-bootstrap --disable-libcc1 CFLAGS="-O1 -g0" CXXFLAGS="-O1 -g0"
    quiet gcc make -j"$jobs" all-gcc
    touch gcc/s-tm-texi # Debian's source has no tm.texi.in to make it from
    quiet gcc make install-gcc
    quiet libgcc make -j"$jobs" all-target-libgcc
    quiet libgcc make install-target-libgcc
    cd ..
}

# The C library, and libgloss for the start-up code. Its libm/fenv does not build for the SPU and is left out (-k).
build_newlib() {
    local libc=newlib/newlib/libc
    sed -i 's/^int sched_yield(void);/struct sched_param { int sched_priority; };\n&/' $libc/machine/spu/sys/sched.h
    sed -i '/^#ifdef __SPU__/,/^#endif/{/define __IEEE_BIG_ENDIAN\|__SPU__\|^#endif/!d}' $libc/include/machine/ieeefp.h
    mkdir build-newlib && cd build-newlib
    quiet newlib ../newlib/configure --target=spu-elf --prefix="$prefix" --disable-nls --disable-multilib
    make -j"$jobs" -k >>"$log" 2>&1 || true
    make -k install >>"$log" 2>&1 || true
    quiet libgloss make -o all-target-newlib configure-target-libgloss all-target-libgloss install-target-libgloss
    cd ..
}

# A program that links, with the SPU's own instructions in it.
probe() {
    printf '%s\n' '#include <math.h>' '#include <spu_intrinsics.h>' \
        'int main(void) { return (int)spu_extract(spu_re(spu_splats(sqrtf((float)spu_readch(0)))), 0); }' >probe.c
    quiet probe spu-elf-gcc -O2 probe.c -o probe -lm
    spu-elf-objdump -d probe | grep -q frest || fail "the compiler makes no frest of spu_re; see $log"
}

build() {
    local start=$SECONDS
    jobs=$(nproc)
    scripts/dependencies.sh spu
    echo "spu_toolchain: building the SPU's compiler, about eight minutes of one core; its log is $log"
    rm -rf "$prefix" "$work"
    mkdir -p "$prefix" "$work"
    : >"$log"
    cd "$work"
    export MAKEINFO=true MAKEFLAGS="MAKEINFO=true" PATH=$prefix/bin:$PATH
    local step
    for step in fetch unpack build_binutils build_gcc build_newlib probe; do
        local begun=$SECONDS
        $step
        echo "spu_toolchain: $step: $((SECONDS - begun)) s"
    done
    find "$prefix/bin" "$prefix/spu-elf/bin" "$prefix/libexec" -type f -exec strip {} + 2>/dev/null || true
    rm -rf "$work" "$prefix/share"
    echo "$recipe" >"$prefix/recipe"
    echo "spu_toolchain: ready after $((SECONDS - start)) s"
}

case ${1:-} in
--find)
    is_ready || exit 1
    ;;
"")
    mkdir -p "${prefix%/*}"
    exec 9>"$prefix.lock"
    flock 9 # one builds, others wait and find it
    is_ready || (build) || exit 1
    ;;
*)
    echo "usage: spu_toolchain.sh [--find]" >&2
    exit 2
    ;;
esac
echo "$prefix/bin"
