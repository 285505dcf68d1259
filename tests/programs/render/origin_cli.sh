#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Scenes far from 0: what is near 0 and what is moved far off, with all options in its coordinates, give the same bytes.
#   origin_cli.sh CGT_RENDER DATA_DIR CGT_CONVERT [EMULATOR...]
render=$1
folder=$2
convert=$3
shift 3
set -- "$render" "$folder" "$@"
. "$(dirname "$0")/../cli.sh"
drawn_with='-r 0.5 --style plain'

# write NAME X Y Z: two frames of 60 spheres, and a mesh, moved by X Y Z. All numbers have few binary digits.
write() {
    awk -v X="$2" -v Y="$3" -v Z="$4" -v mesh="$tmp/$1.obj" 'BEGIN {
        for (t = 0; t < 3; t++) {
            printf "60\nLattice=\"6 0 0 0 5 0 0 0 4\" Origin=\"%.4f %.4f %.4f\" pbc=\"T T T\"\n", X - 0.5, Y - 0.5, Z - 0.5
            for (i = 0; i < 60; i++)
                printf "C %.5f %.5f %.5f\n", X + i % 5 + t / 16, Y + int(i / 5) % 4 + i / 64, Z + int(i / 20) + t / 32
        }
        printf "v %d %d %d\nv %d %d %d\nv %d %d %d\nf 1 2 3\n", X, Y, Z - 1, X + 8, Y, Z - 1, X, Y + 8, Z - 1 >mesh
    }' >"$tmp/$1.xyz"
}
origin=4194304,-372000,65536
write near 0 0 0
write far 4194304 -372000 65536
printf '0 4,-18,8,2,2,2,0,0,1,30\n2 9,-8,3,2,2,2,0,0,1,40\n' >"$tmp/near.keys"
printf '0 4194308,-372018,65544,4194306,-371998,65538,0,0,1,30\n2 4194313,-372008,65539,4194306,-371998,65538,0,0,1,40\n' \
    >"$tmp/far.keys"

# same NEAR_OPTIONS FAR_OPTIONS: the same picture of either file.
same() {
    draw near $1 --first 1 --last 1 near.xyz
    says out '.'
    draw far $2 --origin $origin --first 1 --last 1 far.xyz
    [ ! -s "$tmp/stderr" ] || fail "$2: $(cat "$tmp/stderr")"
    cmp -s "$tmp/near.png" "$tmp/far.png" || fail "not the same picture: $2"
}
same '' ''
same '--ortho --view 1,1,1' '--ortho --view 1,1,1'
same '-k height' '-k height'
same '-k height --range=0.5,2.5' '-k height --range=65536.5,65538.5'
same '-k x+y' '-k x+y'
same '--box --bonds=1.2 --radius-scale=0.5 --trails=1' '--box --bonds=1.2 --radius-scale=0.5 --trails=1'
same '--images=2,1,1' '--images=2,1,1'
same '--floor' '--floor'
same '--floor-height=-2 --floor-axis=-x' '--floor-height=-4194306 --floor-axis=-x'
same '--show=x>1.5' '--show=x>4194305.5'
same '--slice=1,0,0,2.25' '--slice=1,0,0,4194306.25'
same '--cut=0,0,0,3.25,3,9' '--cut=4194304,-372000,65536,4194307.25,-371997,65545'
same '-c 4,-18,8,2,2,2,0,0,1,30' '-c 4194308,-372018,65544,4194306,-371998,65538,0,0,1,30'
same '--orbit=90 -c 4,-18,8,2,2,2,0,0,1,30' '--orbit=90 -c 4194308,-372018,65544,4194306,-371998,65538,0,0,1,30'
same '--camera-keys near.keys' '--camera-keys far.keys'
same '--lamp=1,-6,9,0.9' '--lamp=4194305,-372006,65545,0.9'
(cd "$tmp" && $emulator "$program" -q -n --mesh near.obj near.xyz) >/dev/null 2>&1 && same '--mesh near.obj' '--mesh far.obj'

# Found by itself, and told once, with the camera in the file's coordinates; settings in the picture name it.
run 0 -q -s 96x54 $drawn_with -o found.png --last 0 far.xyz
says err '^cgt-render: the spheres are far from 0, .*: --origin 4194306,-371998,65537 is subtracted'
[ "$(wc -l <"$tmp/stderr")" -eq 1 ] || fail "told more than once: $(cat "$tmp/stderr")"
says out '^camera *-c 41943[0-9.]*,-372[0-9.]*,655[0-9.]*,41943[0-9.]*,-371998'
grep -q 'origin = 4194306,-371998,65537' "$tmp/found.png" || fail "the picture does not tell its origin"
camera=$(sed -n 's/^camera *-c //p' "$tmp/stdout")
draw again -c "$camera" --origin 4194306,-371998,65537 --last 0 far.xyz
draw found --last 0 far.xyz
cmp -s "$tmp/again.png" "$tmp/found.png" || fail "the camera that was printed draws another picture"
draw by_camera -c "$camera" --last 0 far.xyz
says err 'the camera looks at places far from 0'
refuses 1 'eye and target of the camera are the same point in single precision' -c 9e7,0,0,9e7,0,0.25,0,1,0,30 \
    --origin 8,0,9e7 near.xyz
refuses 2 'not 3 numbers' --origin 1,2 near.xyz
(cd "$tmp" && cat far.xyz | $emulator "$program" -q -s 32x18 -o piped.png --last 0 -) >/dev/null 2>"$tmp/stderr" ||
    fail "a pipe of far spheres"
says err 'the spheres are far from 0'

# .frames hold the origin; a file that goes through again stays as it is.
program=$convert
run 0 -q -r 0.5 far.xyz far.frames
says err '^cgt-convert: the spheres are far from 0, .*: --origin 4194306,-371998,65537 is subtracted'
run 0 -q far.frames again.frames
cmp -s "$tmp/far.frames" "$tmp/again.frames" || fail "an origin changes on its way through"
run 0 -q -r 0.5 --origin $origin far.xyz moved.frames
[ ! -s "$tmp/stderr" ] || fail "told of an origin that was given: $(cat "$tmp/stderr")"
(cd "$tmp" && cat far.xyz | $emulator "$program" -q --format xyz - piped.frames) 2>"$tmp/stderr" || fail "a pipe of far spheres"
says err 'a pipe cannot be read again: give --origin 4194306,-371998,65537'
program=$render
draw found -k height --last 0 far.xyz
draw whole -k height --last 0 far.frames
cmp -s "$tmp/whole.png" "$tmp/found.png" || fail "a converted file draws another picture"
[ ! -s "$tmp/stderr" ] || fail "told of an origin that the file has: $(cat "$tmp/stderr")"
draw moved -k height --first 1 --last 1 moved.frames
draw near -k height --first 1 --last 1 near.xyz
cmp -s "$tmp/moved.png" "$tmp/near.png" || fail "a converted file with an origin draws another picture"

[ "$failures" -eq 0 ] || exit 1
