#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Files for Windows: a DLL exports what its headers declare, no file needs a DLL that Windows lacks, and programs that
# are linked with the DLLs run and get what others get.
#   windows_files.sh OBJDUMP SOURCES NATIVE_PICK DRAW_SPHERES_DLL DRAW_SPHERES "FILE..." [EMULATOR...]
set -u
objdump=$1 sources=$2 pick=$3 draw_dll=$4 draw=$5 files=$6
shift 6
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT
failures=0
fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

for file in $files; do
    needs=
    case ${file##*/} in
    libcgt.dll) headers="cgt.h all_hits.h bounces.h research.h" ;;
    libcgt-picture.dll) headers="color.h picture.h" needs=libcgt.dll ;;
    libcgt-figure.dll) headers=figure.h needs="libcgt.dll|libcgt-picture.dll" ;;
    libcgt-trajectory.dll) headers=trajectory.h ;;
    *.exe) headers= ;;
    *) fail "no rule for $file" ;;
    esac
    # shellcheck disable=SC2086 # several words
    [ -z "$headers" ] ||
        (cd "$sources/include/cgt" && exec sh "$sources/tests/repository/check_exports.sh" "$objdump" "$file" $headers) ||
        fail "exports"
    "$objdump" -p "$file" | sed -nE 's/^[[:space:]]*DLL Name: //p' | sort >"$tmp/needs"
    grep -q . "$tmp/needs" || fail "$file needs nothing at all"
    grep -vixE "KERNEL32.dll|msvcrt.dll|$needs" "$tmp/needs" && fail "$file needs these DLLs"
done

found=$("$@" "$pick" "$sources/examples/data/caffeine.xyz" 0,-20,0,0,0,0,0,0,1,30 64 36 32 18 0 0 36 14 30 22 38 20 |
    tr -d '\r' | paste -sd' ')
[ "$found" = "8 -1 6 8 12" ] || fail "a program of cgt-trajectory's DLL gets '$found'"
(cd "$tmp" && "$@" "$draw_dll" && mv spheres.png dll.png && "$@" "$draw" && cmp spheres.png dll.png) ||
    fail "a program of cgt-picture's DLL"
[ "$failures" -eq 0 ] || exit 1
