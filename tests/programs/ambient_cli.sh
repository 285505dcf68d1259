#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# ambient-occlusion: its picture is bright where nothing hides the sky and dark in the corners, by the numbers in its
# source; and a second run repeats it.
#   ambient_cli.sh AMBIENT_OCCLUSION DATA_DIR [EMULATOR...]
. "$(dirname "$0")/cli.sh"

samples=64
[ -z "$slow" ] || samples=2
run 0 "$tmp/sky.ppm" $samples
says out '^[0-9]* pixels see [0-9.]* % of the sky$'
[ "$(head -n 3 "$tmp/sky.ppm" | tr '\n' ' ')" = 'P6 640 384 255 ' ] || fail 'the head of the picture'
[ "$(wc -c <"$tmp/sky.ppm")" -eq $((15 + 640 * 384 * 3)) ] || fail 'the size of the picture'
if [ -z "$slow" ]; then # adds nothing where it is
    run 0 "$tmp/again.ppm" $samples
    cmp "$tmp/sky.ppm" "$tmp/again.ppm" || fail 'a different picture the second time'
fi

# Seen from (5, 9, 14) towards (0, 2, 0), 38 degrees. Red of the top of the pile, where the sky is whole; of the sky
# itself and of the floor far away; and of the floor between two balls at the pile's edge, which hide much of it.
od -A n -v -t u1 -w3 -j 15 "$tmp/sky.ppm" | awk '
function pixel_of(x, y, z,   f, r, u, h) {
    f = (-5 * (x - 5) - 7 * (y - 9) - 14 * (z - 14)) / sqrt(270)
    r = (14 * (x - 5) - 5 * (z - 14)) / sqrt(221)
    u = (-35 * (x - 5) + 221 * (y - 9) - 98 * (z - 14)) / sqrt(35 * 35 + 221 * 221 + 98 * 98)
    h = 0.3443276133 * f
    return int((1 - u / h) / 2 * 384) * 640 + int((r * 384 / 640 / h + 1) / 2 * 640)
}
function within(what, at, low, high) {
    if (red[at] < low || red[at] > high) { print what ": " red[at] ", not " low " to " high; wrong++ }
}
{ red[NR - 1] = $1 }
END {
    top = 255 * sqrt(0.6 + 0.4 * cos(0.9 * 29))
    within("top of the pile", pixel_of(0, 2 + 3 * sqrt(2), 0), top - 2, top + 1)
    within("sky", 0, 241, 242)
    within("far floor", pixel_of(-14, 0, -14), 234, 242)
    within("floor between balls", pixel_of(4, 0, 2), 60, 190)
    exit wrong != 0
}' >"$tmp/wrong" || fail "$(cat "$tmp/wrong")"

for samples in 0 1025 1x ''; do
    run 2 "$tmp/sky.ppm" "$samples"
    says err '^usage: ambient-occlusion'
done
run 2
if [ -z "$slow" ]; then # it traces first
    run 1 "$tmp/no/folder.ppm" 1
    says err 'folder.ppm'
fi

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'ambient-occlusion: the sky where it should be'
