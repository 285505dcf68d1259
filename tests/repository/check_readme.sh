#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_readme.sh SOURCE_DIR STATIC_LIBRARY CC [EMULATOR...]
# The C code of README.md compiles without a warning; its program runs and prints the distance that follows from its
# text: after 10 steps of 0.1 the sphere of radius 0.5 is around the origin, 5 from the eye.
set -eu
source=$1 library=$2 cc=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed -n '/^```c$/,/^```$/{/^```/!p;}' "$source/README.md" >"$work/readme.c"
[ "$(grep -c 'int main' "$work/readme.c")" -eq 1 ] || { echo "README.md: no program found"; exit 1; }
mkdir "$work/cgt" # as installed
cp -r "$source"/include/cgt/*.h "$source"/simd/*.h "$source/simd/spu" "$work/cgt"
"$cc" -std=c11 -Wall -Wextra -Wshadow -Werror -I"$work" "$work/readme.c" -o "$work/readme" "$library" \
    -lpthread -lm
"$@" "$work/readme" | tee "$work/output"
grep -qx 'sphere 0 is 4.500 away' "$work/output"
