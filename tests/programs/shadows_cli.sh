#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cast-shadows: its picture has shadows where the lamp throws them, worked out here from the numbers in its source.
#   shadows_cli.sh CAST_SHADOWS DATA_DIR [EMULATOR...]
. "$(dirname "$0")/cli.sh"

run 0 "$tmp/shadows.ppm"
says out '^[0-9]* of [0-9]* points do not see the lamp$'
[ "$(head -n 3 "$tmp/shadows.ppm" | tr '\n' ' ')" = 'P6 640 384 255 ' ] || fail 'the head of the picture'
[ "$(wc -c <"$tmp/shadows.ppm")" -eq $((15 + 640 * 384 * 3)) ] || fail 'the size of the picture'

# The floor is grey, balls are not. Under the lamp's ray through a ball's centre the floor has the light that is
# everywhere; at points that no ball hides from the lamp, that of the lamp too; off the floor there is nothing.
od -A n -v -t u1 -w3 -j 15 "$tmp/shadows.ppm" | awk '
function level(light) { return 255 * sqrt(light) }
function pixel_of(x, y, z,   d, v, n) { # seen from (0, 4, 8) towards the origin; 38 degrees
    n = sqrt(80)
    d = (-4 * (y - 4) - 8 * (z - 8)) / n
    v = (8 * (y - 4) - 4 * (z - 8)) / n
    n = 0.3443276133 * d
    return int((1 - v / n) / 2 * 384) * 640 + int((x * 384 / 640 / n + 1) / 2 * 640)
}
function is(what, at, light,   distance) {
    distance = red[at] - level(light)
    if (distance > 2 || distance < -2 || !grey[at]) { print what ": " red[at] ", not " level(light); wrong++ }
}
function lit(x, z,   to) {
    to = sqrt((3 - x) ^ 2 + 36 + (2.5 - z) ^ 2)
    is("lit floor", pixel_of(x, 0, z), 0.9 * (0.12 + 0.85 * 6 / to))
}
{ red[NR - 1] = $1; grey[NR - 1] = $1 == $2 && $2 == $3 }
END {
    for (i = 0; i < 28; i++) {
        r = 0.18 + 0.008 * i
        s = 6 / (6 - r - 0.03 * (27 - i)) # from the lamp through the centre to the floor
        x = (0.25 + 0.11 * i) * cos(0.55 * i)
        z = (0.25 + 0.11 * i) * sin(0.55 * i)
        at = pixel_of(3 + s * (x - 3), 0, 2.5 + s * (z - 2.5))
        if (!grey[at]) continue # behind a ball
        is("shadow of ball " i, at, 0.9 * 0.12)
        shadows++
    }
    lit(3, 2.5); lit(-3.5, 3); lit(4, -3); lit(-4, -4)
    is("off the floor", 0, 0.05 * 0.9)
    if (shadows < 14) { print shadows + 0 " shadows to be seen"; wrong++ }
    exit wrong != 0
}' >"$tmp/wrong" || fail "$(cat "$tmp/wrong")"

run 2
says err '^usage: cast-shadows'
run 1 "$tmp/no/folder.ppm"
says err 'folder.ppm'

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cast-shadows: shadows where they should be'
