#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cgt-render --bounces: what its options do to pixels, the same bytes for threads and variants, and what is refused.
# What light does is checked by tests/whitted.
#   bounce_cli.sh CGT_RENDER DATA_DIR [EMULATOR...]
. "$(dirname "$0")/../cli.sh"

drawn_with="-c 4,-18,8,4,4,3,0,0,1,30"

# Balls of two elements in contact, over a large one.
{
    printf '7\nballs\n'
    for i in 1 2 3; do
        printf 'O %s 4 5\nH %s 2 4\n' $((2 * i)) $((2 * i))
    done
    printf 'C 4 4 2\n'
} >"$tmp/balls.xyz"
# Two closed pyramids, and one that lacks a face.
printf 'v 0 0 0\nv 8 0 0\nv 4 8 0\nv 4 4 6\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >"$tmp/closed.obj"
sed '$d' "$tmp/closed.obj" >"$tmp/open.obj"

draw none --bounces 0 balls.xyz
draw matt --bounces 8 --material all=matt balls.xyz
same none matt "matt balls throw reflections"
draw mirror --bounces 8 --material all=mirror balls.xyz
differs matt mirror "--material all=mirror"
draw mirror_1 --bounces 1 --material all=mirror balls.xyz
differs mirror mirror_1 "--bounces 1"
draw glass --bounces 8 --material O=glass --material H=mirror balls.xyz
differs matt glass "--material O=glass"
draw thin --bounces 8 --material O=glass:1.1 --material H=mirror balls.xyz
differs glass thin "glass:1.1"
draw first --bounces 8 --material O=glass:1.5:0 --material H=mirror balls.xyz
same glass first "a priority of 0 is not the default"
printf '2\n\nO 0 0 0\nH 0.6 0 0.2\n' >"$tmp/overlap.xyz"
draw inner --bounces 8 --material O=glass:1.1:3 --material H=glass:2.0:4 overlap.xyz
draw outer --bounces 8 --material O=glass:1.1:4 --material H=glass:2.0:3 overlap.xyz
differs inner outer "the priority of glass"
draw last --bounces 8 --material O=mirror --material O=glass --material all=mirror --material C=matt balls.xyz
same glass last "the last of two materials of an element, and its own before all, do not count"
draw ground --bounces 8 --floor --material O=glass --material H=mirror balls.xyz
differs glass ground "--floor"
draw given --bounces 8 --floor -c 4,-18,8,4,4,3,0,0,1,30 -k red balls.xyz
draw bare --bounces 8 -c 4,-18,8,4,4,3,0,0,1,30 -k red balls.xyz
differs given bare "--floor where camera and colour are given"
# Values have more colours than there are materials: the order of the balls does not count.
many() { awk 'BEGIN { print "900\n"; for (i = 0; i < 900; i++) { k = '"$1"'; print "C", k, k % 30 * 4, k % 7 } }'; }
many i >"$tmp/rising.xyz"
many 899-i >"$tmp/falling.xyz"
draw rising --bounces 2 --material all=mirror -k x rising.xyz
draw falling --bounces 2 --material all=mirror -k x falling.xyz
same rising falling "mirrors that come late have other colours"
draw less --bounces 8 --hide 2 --material all=glass balls.xyz
differs less glass "--hide"
draw several -t 3 --bounces 8 --material O=glass --material H=mirror balls.xyz
same glass several "three threads draw another picture"
draw narrow --variant portable --bounces 8 --material O=glass --material H=mirror balls.xyz
same glass narrow "another variant draws another picture"
# a run of two frames, whole and by parts
cat "$tmp/balls.xyz" "$tmp/balls.xyz" | sed '10,$s/ 2$/ 3/' >"$tmp/run.xyz"
for part in 1/1 1/2 2/2; do
    mkdir "$tmp/part${part%/*}${part#*/}"
    run 0 -q --no-metadata -s 48x27 -c 4,-18,8,4,4,3,0,0,1,30 --part $part --bounces 4 --floor --material O=glass \
        --material H=mirror -o "part${part%/*}${part#*/}/%02d.png" run.xyz
done
cp "$tmp/part12/"* "$tmp/part22/"
diff -r "$tmp/part11" "$tmp/part22" >"$tmp/difference" || fail "parts draw other pictures: $(head -n 3 "$tmp/difference")"
[ "$(ls "$tmp/part22" | wc -l)" -eq 2 ] || fail "not two pictures: $(ls "$tmp/part22")"
draw mesh --bounces 8 --material all=glass -k red closed.obj
draw clear --bounces 8 --material all=glass -k white closed.obj
differs mesh clear "glass of a mesh has no colour where the camera is given"
draw mesh --bounces 8 --material all=glass closed.obj
draw opaque --bounces 8 open.obj
differs mesh opaque "glass of a mesh"
run 0 -q -s 32x18 --bounces 3 --material all=mirror -o depth.exr balls.xyz
[ -s "$tmp/depth.exr" ] || fail "no picture with depths"

refuses 1 'glass must be closed: the mesh is not closed: the edge of triangle' --bounces 3 --material all=glass open.obj
refuses 1 'without figures' --bounces 3 --bonds=2.5 balls.xyz
refuses 1 'stats counts' --bounces 3 --stats balls.xyz
draw plain --bounces 8 --floor=c0a080 --material O=glass --material H=mirror balls.xyz
differs plain ground "--floor=COLOR"
refuses 2 'is for --bounces' --material O=glass balls.xyz
refuses 2 '65' --bounces 65 balls.xyz
refuses 2 'neither a type' --bounces 3 --material Xx=glass balls.xyz
refuses 2 'is not matt' --bounces 3 --material O=wood balls.xyz
refuses 2 'form TYPE=KIND' --bounces 3 --material glass balls.xyz
for index in 0 0.99 nan -1.5 1e9; do
    refuses 2 '--material' --bounces 3 --material O=glass:$index balls.xyz
done
for priority in -1 256 x 1:2 ''; do
    refuses 2 '--material' --bounces 3 --material "O=glass:1.5:$priority" balls.xyz
done

[ "$failures" -eq 0 ] || exit 1
echo 'cgt-render --bounces: as described'
