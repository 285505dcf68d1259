#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench rays: kinds of rays, orders, sizes of calls, counts that other sub-commands have too,
# errors and exit codes.
#   rays_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

camera='-c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46'
size=70x21 pixels=1470 structures=grid-queue,loose-grid,kd,kd-ropes,wide-tree
of_cloud=$structures of_blobs=$structures batches=1,16,100,all repeats=2
# Where it is slow, the scenes share the structures; each still has several to compare.
if [ -n "$slow" ]; then
    size=12x8 pixels=96 batches=1,all repeats=1
    of_cloud=grid-queue,loose-grid,wide-tree of_blobs=loose-grid,kd,kd-ropes
fi
run 0 make cloud2k "$tmp/cloud.frames" -n 2
run 0 make blobs2k "$tmp/blobs.frames" -n 2

# ---- Help -----------------------------------------------------------------------------------------------------------

run 0 rays --help
says out 'Usage: cgt-bench rays'
for option in --camera --size --threads --frames --repeat --variant --structure --kinds --orders --queries --batches \
    --rays --ao --light --json --kd-builder; do
    says out "$option"
done

# ---- Rows -----------------------------------------------------------------------------------------------------------

# All structures, kinds, orders and queries find the same hits, or the exit code would tell: as many in any order, by
# calls of any size, and to any hit as to the nearest.
for scene in cloud blobs; do
    [ $scene = cloud ] && of_scene=$of_cloud || of_scene=$of_blobs
    run 0 rays "$tmp/$scene.frames" -s $size -S $of_scene -Q nearest,any -B $batches -B 16 -r $repeats -n $pixels \
        -j "$tmp/rows.json"
    [ ! -s "$tmp/stderr" ] || fail "what is left out, or differs: $(head -n 3 "$tmp/stderr")"
    is scene "$(column scene)" $scene
    is structures "$(column config | sed 's/,variant=[a-z0-9]*//g')" "$(echo $of_scene | tr , ' ')"
    is kinds "$(column kind)" 'camera shadow ao bounce random'
    is orders "$(column order)" 'camera tile shuffled'
    is queries "$(column query)" 'nearest any'
    sizes=$(printf '%s\n16\n' $batches | tr , '\n' | sort -u | wc -l)
    rows=$(((4 * 3 + 1) * 2 * sizes * $(echo $of_scene | tr , '\n' | wc -l)))
    is rows "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" $rows
    is 'rows as JSON' "$(grep -c '"config"' "$tmp/rows.json")" $rows
    holds 'the same hits' 'c["different"] == 0 && c["hits"] + 0 <= c["rays"] + 0 &&
        ((k = c["kind"]) in hits ? hits[k] == c["hits"] && rays[k] == c["rays"] :
        (hits[k] = c["hits"]) > 0 && (rays[k] = c["rays"]) > 0)'
    holds 'sizes of calls' 'c["batch"] == 1 || c["batch"] == 16 || c["batch"] == 100 || c["batch"] == c["rays"]'
    holds 'random rays in no order' 'c["kind"] != "random" || c["order"] == "shuffled"'
    holds 'times' 'c["ns_per_ray_min"] > 0 && c["ns_per_ray_min"] <= c["ns_per_ray"] + 0 && c["build_min_ms"] > 0 &&
        c["build_min_ms"] <= c["build_ms"] + 0'
    holds 'rays with the build' '(d = c["mrays_with_build"] * (c["build_min_ms"] + 1e-6 * c["ns_per_ray_min"] *
        c["rays"]) * 1000 / c["rays"]) > 0.999 && d < 1.001'
    holds 'primitives' 'c["primitives"] == 2000 && c["threads"] == 1 && c["bytes"] > 0'
    holds 'rays' 'c["kind"] == "camera" ? c["rays"] == '$pixels' && (hit = c["hits"]) > 0 :
        c["kind"] == "random" ? c["rays"] == '$pixels' : c["rays"] == hit'
done

# The counts of cgt-bench frame: pixels that hit, ambient-occlusion rays that met nothing. The frame is the one that
# --frames ends with.
run 0 frame "$tmp/blobs.frames" $camera -s $size -a 3
in_frame=$(awk -F '\t' 'NR == 2 { print $8, 3 * $8 - $9 }' "$tmp/stdout")
run 0 rays "$tmp/blobs.frames" -s $size --frames 2 -K camera -K ao -O tile -Q any -a 3 -S kd -B all -r 1
is 'pixels and occluded rays' "$(awk -F '\t' 'NR > 1 { printf "%s%s", n++ ? " " : "", $15 }' "$tmp/stdout")" "$in_frame"

# Fewer rays than there are: the same limit for all kinds; calls as large as the set, or larger, are one.
run 0 rays "$tmp/cloud.frames" -s 25x18 -S kd,auto -n 90 -B 50,90,1000,all -O shuffled -t 2 --variant portable -r 1 -v
says err '^cloud: auto,variant=portable: '
is 'names' "$(column config)" 'kd,variant=portable auto,variant=portable'
is 'sizes of calls' "$(column batch)" '50 90'
is 'rays of each' "$(column rays)" 90
is 'what a kind is traced for' "$(awk -F '\t' 'NR > 1 && !seen[$5 $7]++ { printf "%s ", $5 ":" $7 }' "$tmp/stdout")" \
    'camera:nearest shadow:any ao:any bounce:nearest random:nearest random:any '
holds 'threads' 'c["threads"] == 2 && c["order"] == "shuffled"'

# A frame without a primitive: no hits, so no rays from hits.
printf 'CGTFRAM1\001\000\000\000\001\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000' >"$tmp/empty.frames"
run 0 rays "$tmp/empty.frames" -s 8x8 -S $structures -B all -r 1
is 'kinds without hits' "$(column kind)" 'camera random'
holds 'no hits' 'c["hits"] == 0 && c["different"] == 0'

# ---- Errors ---------------------------------------------------------------------------------------------------------

refuses 2 'FILE' rays
refuses 2 'one FILE' rays "$tmp/cloud.frames" "$tmp/blobs.frames"
refuses 1 'missing\.frames' rays "$tmp/missing.frames"
refuses 1 'no/folder' rays "$tmp/cloud.frames" -j "$tmp/no/folder/x.json"
refuses 2 'not octree' rays "$tmp/cloud.frames" -S kd,octree
refuses 2 'no mirror' rays "$tmp/cloud.frames" -K camera,mirror
refuses 2 '-O: no $' rays "$tmp/cloud.frames" -O tile,
refuses 2 'no all' rays "$tmp/cloud.frames" -Q all
refuses 2 '-B' rays "$tmp/cloud.frames" -B 1,0
refuses 2 '-B' rays "$tmp/cloud.frames" -B many
refuses 2 'more than 32' rays "$tmp/cloud.frames" -B "$(seq -s , 1 40)"
refuses 2 '-n' rays "$tmp/cloud.frames" -n 0
refuses 2 '-a' rays "$tmp/cloud.frames" -a 0
refuses 2 '-l' rays "$tmp/cloud.frames" -l 1,2
refuses 2 '-k' rays "$tmp/cloud.frames" -k 8

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cgt-bench rays: command line as described'
