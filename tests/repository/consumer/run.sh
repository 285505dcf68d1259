#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# run.sh SOURCE_DIR BUILD_DIR CMAKE CC toolchain=FILE [EMULATOR...]
# Installs the library, moves it to another place, and there
#   compiles each installed header alone, as C and, but for the C-only vocabulary, as C++
#   compiles and runs a program written for an SPU with the vocabulary alone, in each of its forms
#   builds and runs a project that uses find_package(cgt), with static and shared library
#   builds and runs the same program through pkg-config, static and shared
set -eu
source=$1 build=$2 cmake=$3 cc=$4 toolchain=${5#toolchain=}
shift 5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --component library --prefix "$work/first" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
mv "$work/first" "$work/moved"
prefix=$work/moved
if grep -rlF "$work/first" "$prefix" || grep -rlF "$build" "$prefix/include" "$prefix"/lib*; then
    echo "the files above hold a path of the build"
    exit 1
fi

echo "== headers alone"
cxx=$(printf '%s\n' "$cc" | sed -E 's/clang([^/]*)$/clang++\1/; s/gcc([^/]*)$/g++\1/; s/(^|\/)cc$/\1c++/')
count=0
for header in "$prefix"/include/cgt/*.h; do
    name=cgt/${header##*/}
    case $name in
    # machine-specific or partial headers: spu_intrinsics.h includes the right ones
    cgt/spu_sse.h|cgt/spu_neon.h|cgt/spu_avx*|cgt/spu_wide_*|cgt/spu_portable_*|cgt/spu_exact_*) continue ;;
    esac
    printf '#include <%s>\n#include <%s>\nextern int cgt_header_alone;\n' "$name" "$name" >"$work/alone.c"
    "$cc" -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -fsyntax-only "$work/alone.c"
    case $name in
    cgt/spu_*|cgt/vec_types.h) ;; # _Generic: C only
    *)  if command -v "$cxx" >/dev/null; then
            "$cxx" -x c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -fsyntax-only "$work/alone.c"
        else
            echo "$name not tried as C++: no $cxx"
        fi ;;
    esac
    count=$((count + 1))
done
[ "$count" -ge 3 ]
if command -v "$cxx" >/dev/null; then # the structures of research.h are constants of C++, too
    printf '#include <cgt/research.h>\nextern const cgt_structure s;\nconstexpr cgt_structure s = CGT_STRUCTURE_%s;\n' \
        KD_ROPES >"$work/alone.c"
    "$cxx" -x c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -fsyntax-only "$work/alone.c"
fi

echo "== SPU source"
for flags in "" -DCGT_SPU_PORTABLE -DCGT_SPU_EXACT "-DCGT_SPU_EXACT -DCGT_SPU_PORTABLE" "-D__SPU__ -DCGT_SPU_HOST"; do
    # shellcheck disable=SC2086 # flags are several words
    "$cc" -std=c11 -O1 -Wall -Wextra -Wpedantic -Werror $flags -I"$prefix/include/cgt" \
        "$source/tests/repository/consumer/spu_source.c" -o "$work/spu_source"
    "$@" "$work/spu_source"
done

echo "== find_package"
"$cmake" -S "$source/tests/repository/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" \
    ${toolchain:+-DCMAKE_TOOLCHAIN_FILE="$toolchain"} >"$work/log" 2>&1 &&
    "$cmake" --build "$work/build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
for library in cgt static shared; do
    "$@" "$work/build/consumer_$library"
done

echo "== pkg-config"
if ! command -v pkg-config >/dev/null; then
    echo "pkg-config is not installed"
    exit 1
fi
pc=$(find "$prefix" -name cgt.pc)
export PKG_CONFIG_LIBDIR="${pc%/*}"
[ "$(pkg-config --modversion cgt)" = "$(sed -nE 's/.*VERSION_STRING "(.*)"/\1/p' "$prefix/include/cgt/version.h")" ]
libdir=$(pkg-config --variable=libdir cgt)
# shellcheck disable=SC2046 # flags are several words
"$cc" -std=c11 "$source/tests/repository/consumer/consumer.c" -o "$work/shared" $(pkg-config --cflags --libs cgt) \
    -Wl,-rpath,"$libdir"
"$@" "$work/shared"
mkdir "$work/archive"
cp "$libdir/libcgt.a" "$work/archive" # alone, so that the linker cannot take the shared one
# shellcheck disable=SC2046
"$cc" -std=c11 "$source/tests/repository/consumer/consumer.c" -o "$work/static" -L"$work/archive" \
    $(pkg-config --cflags --libs --static cgt | sed "s|-L[^ ]*||")
"$@" "$work/static"
