#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_readme.sh SOURCE_DIR STATIC_LIBRARY PICTURE_LIBRARY CC [EMULATOR...]
# The C code of README.md and docs/guide/build.md compiles without a warning; the programs do as C++17, too. The first
# program is examples/draw_spheres.c, and writes a picture. The second one runs and prints the distance that follows from
# its text: after 10 steps of 0.1 the sphere of radius 0.5 is around the origin, 5 from the eye. What follows is a
# function.
set -eu
source=$1 library=$2 pictures=$3 cc=$4
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk -v work="$work" '/^```/ { inside = $0 == "```c"; count += inside; next }
    inside { print >(work "/readme" count ".c") }' "$source/README.md" "$source/docs/guide/build.md"
for number in 1 2; do
    [ "$(grep -c 'int main' "$work/readme$number.c")" -eq 1 ] || { echo "no program $number"; exit 1; }
done
[ ! -e "$work/readme4.c" ] || { echo "code that nothing tests"; exit 1; }
mkdir "$work/cgt" # as installed
cp -r "$source"/include/cgt/*.h "$source"/simd/*.h "$source/simd/spu" "$work/cgt"
for number in 1 2; do
    "$cc" -std=c11 -Wall -Wextra -Wshadow -Werror -I"$work" "$work/readme$number.c" -o "$work/readme$number" \
        "$pictures" "$library" -lpthread -lm
    ! command -v c++ >/dev/null ||
        c++ -std=c++17 -Wall -Wshadow -Werror -I"$work" -fsyntax-only -x c++ "$work/readme$number.c"
done
"$cc" -std=c11 -Wall -Wextra -Wshadow -Werror -I"$work" -c "$work/readme3.c" -o "$work/readme3.o"
"$@" "$work/readme2" | tee "$work/output"
grep -qx 'sphere 0 is 4.500 away' "$work/output"

sed -n '/^#include/,$p' "$source/examples/draw_spheres.c" | cmp - "$work/readme1.c"
cd "$work"
"$@" "$work/readme1"
[ "$(od -An -tx1 -N8 spheres.png | tr -d ' ')" = 89504e470d0a1a0a ]
size=$(wc -c <spheres.png) # of 1280 * 720 * 3 bytes
[ "$size" -gt 50000 ] && [ "$size" -lt 800000 ] || { echo "spheres.png has $size bytes"; exit 1; }
