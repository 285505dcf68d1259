#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# shade-tiles: a picture with alpha, whose middle pixels have the light that their balls' normals ask for.
#   shade_cli.sh SHADE_TILES DATA_DIR [EMULATOR...]
. "$(dirname "$0")/cli.sh"

run 0 "$tmp/shade.pam"
head='P7 WIDTH 640 HEIGHT 384 DEPTH 4 MAXVAL 255 TUPLTYPE RGB_ALPHA ENDHDR '
[ "$(head -n 7 "$tmp/shade.pam" | tr '\n' ' ')" = "$head" ] || fail 'the head of the picture'
[ "$(wc -c <"$tmp/shade.pam")" -eq $((${#head} + 640 * 384 * 4)) ] || fail 'the size of the picture'

# A ball in front, seen from (0, 0, 7), shows its near point in the middle: its light follows from where it lies.
# Nothing is hit in the corners.
od -A n -v -t u1 -w4 -j ${#head} "$tmp/shade.pam" | awk '
function root(x) { return x > 0 ? sqrt(x) : 0 }
{ red[NR - 1] = $1; alpha[NR - 1] = $4 }
END {
    for (i = 0; i < 300; i++) {
        y = 1 - 2 * (i + 0.5) / 300
        x = 2 * root(1 - y * y) * cos(2.39996323 * i); z = 2 * root(1 - y * y) * sin(2.39996323 * i); y = 2 * y
        if (z < 1.5) continue # others may hide it
        half = 0.3639702343 # of 40 degrees
        at = int((1 - y / (7 - z) / half) / 2 * 384) * 640 + int((x / (7 - z) * 384 / 640 / half + 1) / 2 * 640)
        to = sqrt(x * x + y * y + (7 - z) ^ 2)
        light = 0.15 + 0.85 * (-0.48 * x - 0.8 * y + 0.36 * (7 - z)) / to
        want = (light > 0.15 ? light : 0.15) * int(155 + 100 * cos(0.1 * i))
        off = red[at] - want
        if (off > 14 || off < -14 || alpha[at] != 255) { print "ball " i ": " red[at] ", not " want; wrong++ }
        balls++
    }
    if (alpha[0] || alpha[639] || red[0]) { print "a corner is not empty"; wrong++ }
    if (balls < 20) { print balls + 0 " balls to be seen"; wrong++ }
    exit wrong != 0
}' >"$tmp/wrong" || fail "$(cat "$tmp/wrong")"

run 2
says err '^usage: shade-tiles'
run 1 "$tmp/no/folder.pam"
says err 'folder.pam'

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'shade-tiles: light where it should be'
