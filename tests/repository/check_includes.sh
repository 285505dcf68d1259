#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_includes.sh SOURCE_DIR
# Who may include whom: include <- simd <- src <- backends. Programs see the public API and each other's common parts;
# cgt-bench also sees the library's inside, and the hard cases and the oracle of the tests, and compare-embree beside it
# sees Embree; tests see all. The library includes nothing of others but C and POSIX.
set -eu
cd "$1"
bad=$(mktemp)
trap 'rm -f "$bad"' EXIT

standard='assert|ctype|errno|fenv|float|inttypes|iso646|limits|locale|math|setjmp|signal|stdalign|stdarg|stdatomic'
standard="$standard|stdbool|stddef|stdint|stdio|stdlib|stdnoreturn|string|time"
posix='pthread|sched|unistd|fcntl|strings|sys/[a-z]+'
intrinsics='[a-z]mmintrin|immintrin|arm_neon|altivec'

# check FOLDER "folders that its quoted includes may lie in" "angled includes that it may have"
check() {
    [ -d "$1" ] || return 0
    find "$1" -name '*.[ch]' -o -name '*.cpp' | LC_ALL=C sort |
        xargs awk -v top="$1" -v folders="$2" -v angled="^($3)\$" '
        function exists(path,   line, there) {
            there = (getline line <path) >= 0
            close(path)
            return there
        }
        # the path without "." and "..", or "" where it leaves the tree
        function plain(path,   part, n, i, out, count) {
            n = split(path, part, "/")
            count = 0
            for (i = 1; i <= n; i++) {
                if (part[i] == "..") { if (count-- == 0) return "" }
                else if (part[i] != "." && part[i] != "") out[++count] = part[i]
            }
            path = out[1]
            for (i = 2; i <= count; i++) path = path "/" out[i]
            return path
        }
        # the file that a quoted include finds lies in one of the folders
        function allowed(name, file,   n, i, folder, path, base) {
            sub(/[^\/]*$/, "", file)
            n = split(file " " folders, folder, " ")
            for (i = 1; i <= n; i++) {
                path = plain(folder[i] "/" name)
                if (path != "" && exists(path)) {
                    base = path
                    sub(/\/.*/, "", base)
                    return index(" " folders " ", " " base " ") > 0
                }
            }
            return 0
        }
        /^[ \t]*#[ \t]*include/ {
            text = $0
            good = 0
            if (match(text, /"[^"]+"/)) good = allowed(substr(text, RSTART + 1, RLENGTH - 2), FILENAME)
            else if (match(text, /<[^>]+>/)) good = substr(text, RSTART + 1, RLENGTH - 2) ~ angled
            if (!good) print FILENAME ":" FNR ": " top "/ may not have this: " text
        }' >>"$bad"
}

check include "" "cgt/[a-z_]+\\.h|($standard)\\.h"
check simd "simd" "cgt/[a-z_]+\\.h|($standard|$intrinsics)\\.h|spu_(intrinsics|mfcio)\\.h"
check src "src simd" "cgt/[a-z_]+\\.h|($standard|$posix)\\.h"
check backends "backends src simd" "cgt/[a-z_]+\\.h|($standard|$posix)\\.h"
check examples "examples" \
    "cgt/(cgt|research|version)\\.h|[a-z]+|($standard|$posix|argp)\\.h|OpenImageIO/[a-z]+\\.h|assimp/[a-z]+\\.h"
check bench "bench src simd examples tests" \
    "cgt/[a-z_]+\\.h|($standard|$posix|argp)\\.h|embree3/rtcore\\.h"

# What names an instruction set is in simd alone.
grep -rnE '\b(_mm(256|512)?_[a-z0-9]+_|v[a-z0-9]+q_(lane_|n_)?[fsu](8|16|32|64)\b)' include src backends examples bench \
    --include='*.[ch]' | sed 's/$/  <- an intrinsic outside simd/' >>"$bad" || true

if [ -s "$bad" ]; then
    cat "$bad"
    exit 1
fi
files=$(find include simd src backends examples bench -name '*.[ch]' | wc -l)
[ "$files" -gt 10 ] || { echo "only $files files found in $1"; exit 1; }
echo "$files files include what they may"
