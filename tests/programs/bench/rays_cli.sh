#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench rays: kinds of rays, orders, sizes of calls, counts that other subjects have, too, errors
# and exit codes; and the options of a structure in cgt-bench frame.
#   rays_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

camera='-c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46'
size=70x21 pixels=1470 structures=queue-grid,loose-grid,kd,kd-ropes,bih,bvh
of_cloud=$structures of_blobs=$structures batches=1,16,100,all repeats=2 random=500
# Where it is slow, the scenes share the structures; each still has several to compare.
if [ -n "$slow" ]; then
    size=12x8 pixels=96 batches=1,all repeats=1 random=100
    of_cloud=queue-grid,loose-grid,bvh of_blobs=loose-grid,kd,kd-ropes
fi
run 0 make cloud2k "$tmp/cloud.frames" -n 2
run 0 make blobs2k "$tmp/blobs.frames" -n 2

# cells NAME: all values of a column.
cells() {
    awk -F '\t' -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i; next }
        { printf "%s%s", n++ ? " " : "", $at }' "$tmp/stdout"
}

# ---- Help -----------------------------------------------------------------------------------------------------------

run 0 rays --help
says out 'Usage: cgt-bench rays'
for option in --camera --size --threads --frames --repeat --variant --structure --kinds --orders --queries --batches \
    --rays --random --ao --light --traversals --layouts --json --kd-layout --kd-break \
    --kd-traversal; do
    says out "$option"
done

# ---- Rays -----------------------------------------------------------------------------------------------------------

# All structures, kinds, orders and queries find the same hits, or the exit code would tell: as many in any order, by
# calls of any size, and for any hit as for the closest.
for scene in cloud blobs; do
    [ $scene = cloud ] && of_scene=$of_cloud || of_scene=$of_blobs
    run 0 rays "$tmp/$scene.frames" -s $size -S $of_scene -O camera,tile -O shuffled -Q nearest,any -B $batches \
        -B 16 -r $repeats --rays $pixels -j "$tmp/rows.json"
    [ ! -s "$tmp/stderr" ] || fail "what is left out, or differs: $(head -n 3 "$tmp/stderr")"
    is scene "$(column scene)" $scene
    is structures "$(column config | sed 's/,variant=[a-z0-9]*//g')" "$(echo $of_scene | tr , ' ')"
    is kinds "$(column kind)" 'frame camera shadow ao bounce random'
    is orders "$(column order)" 'camera tile shuffled'
    is queries "$(column query)" 'nearest any'
    sizes=$(printf '%s\n16\n' $batches | tr , '\n' | sort -u | wc -l)
    rows=$((((4 * 3 + 1) * 2 * sizes + 1) * $(echo $of_scene | tr , '\n' | wc -l)))
    is rows "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" $rows
    is 'rows as JSON' "$(grep -c '"config"' "$tmp/rows.json")" $rows
    holds 'the same hits' 'c["different"] == 0 && c["hits"] + 0 <= c["rays"] + 0 &&
        ((k = c["kind"]) in hits ? hits[k] == c["hits"] && rays[k] == c["rays"] :
        (hits[k] = c["hits"]) > 0 && (rays[k] = c["rays"]) > 0)'
    holds 'sizes of calls' 'c["batch"] == 1 || c["batch"] == 16 || c["batch"] == 100 || c["batch"] == c["rays"]'
    holds 'a frame is one call' 'c["kind"] != "frame" ||
        c["batch"] == c["rays"] && c["order"] == "camera" && c["query"] == "nearest"'
    holds 'random rays in no order' 'c["kind"] != "random" || c["order"] == "shuffled"'
    holds 'times' 'c["ns_per_ray_min"] > 0 && c["ns_per_ray_min"] <= c["ns_per_ray"] + 0 && c["build_min_ms"] > 0 &&
        c["build_min_ms"] <= c["build_ms"] + 0'
    holds 'rays with the build' '(d = c["mrays_with_build"] * (c["build_min_ms"] + 1e-6 * c["ns_per_ray_min"] *
        c["rays"]) * 1000 / c["rays"]) > 0.999 && d < 1.001'
    holds 'primitives' 'c["primitives"] == 2000 && c["threads"] == 1 && c["bytes"] > 0'
    holds 'rays' 'c["kind"] == "frame" || c["kind"] == "camera" ? c["rays"] == '$pixels' && (hit = c["hits"]) > 0 :
        c["kind"] == "random" ? c["rays"] == '$pixels' : c["rays"] == hit'
    holds 'nodes and leaves' 'c["chosen"] == "bih" ? c["bih_nodes"] >= 2 * c["bih_leaves"] - 1 && c["bih_depth"] > 3 &&
        c["bytes"] >= 16 * c["bih_nodes"] && c["nodes_per_ray"] != "-" && c["kd_nodes"] == 0 :
        c["chosen"] !~ /^kd/ ? c["nodes_per_ray"] == "-" && c["kd_nodes"] == 0 && c["bih_nodes"] == 0 :
        c["kd_nodes"] == 2 * c["kd_leaves"] - 1 && c["kd_depth"] > 3 && c["kd_cost"] > 0 &&
        (c["kind"] != "random" || c["leaves_per_ray"] > 0.05) && c["bytes"] >= 8 * c["kd_nodes"]'
    holds 'tests' 'c["tests_per_ray"] > 0'
    holds 'loops of ropes' 'c["rope_loops"] == 0 && (c["config"] ~ /^kd-ropes/ ? c["rope_steps"] > 0 : 1)'
done

# The first four hits of a ray: near and far surfaces of spheres, and triangles behind others.
for scene in cloud blobs; do
    run 0 rays "$tmp/$scene.frames" -s $size -S loose-grid,kd,bvh -K camera -Q nearest,four -B 16,all -r 1
    is queries "$(column query)" 'nearest four'
    holds 'four hits' 'c["different"] == 0 && (c["query"] == "nearest" ? (hits = c["hits"]) > 0 :
        c["hits"] > 1.5 * hits && c["hits"] <= 4 * hits)'
done

# The counts of cgt-bench frame: pixels that hit, ambient-occlusion rays that met nothing. The frame is the one that
# --frames ends with.
run 0 frame "$tmp/blobs.frames" $camera -s $size -a 3
in_frame=$(awk -F '\t' 'NR == 2 { print $8, $8, 3 * $8 - $9 }' "$tmp/stdout")
run 0 rays "$tmp/blobs.frames" -s $size -n 2 -K frame,camera -K ao -O tile -Q any -a 3 -S kd -B all -r 1
is 'pixels and occluded rays' "$(cells hits)" "$in_frame"

# Fewer rays than there are: the same limit for all kinds but the frame and random rays; calls as large as the set, or
# larger, are one. What a kind is traced for by default.
run 0 rays "$tmp/cloud.frames" -s 25x18 -S kd,auto --rays 90 --random 70 -B 50,90,1000,all -O shuffled -t 2 \
    --variant portable -r 1 -v
says err '^cloud: auto,variant=portable, variant portable, structure '
is names "$(column config)" 'kd,variant=portable auto,variant=portable auto,rays=incoherent,variant=portable'
holds 'sizes of sets and calls' 'c["rays"] == (c["kind"] == "frame" ? 450 : c["kind"] == "random" ? 70 : 90) &&
    (c["batch"] == 50 || c["batch"] == c["rays"])'
is queries "$(awk -F '\t' 'NR > 1 && !seen[$5 $7]++ { printf "%s ", $5 ":" $7 }' "$tmp/stdout")" \
    'frame:nearest camera:nearest shadow:any ao:any bounce:nearest random:nearest random:any '
holds 'threads' 'c["threads"] == 2'
holds 'what was chosen' 'c["config"] ~ /^auto/ ? c["chosen"] != "none" : c["config"] ~ ("^" c["chosen"] ",")'

# A frame without a primitive: no hits, so no rays from hits.
printf 'CGTFRAM1\001\000\000\000\001\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000' >"$tmp/empty.frames"
run 0 rays "$tmp/empty.frames" -s 8x8 -S $structures -r 1
is 'kinds without hits' "$(column kind)" 'frame camera random'
holds 'no hits' 'c["hits"] == 0 && c["different"] == 0'

# ---- Rows -----------------------------------------------------------------------------------------------------------

# All structures of two files by all traversals. One ray at a time or packets: the tree is the same.
small="-s 40x22 -K frame,random -Q nearest --random $random -r 1"
run 0 rays "$tmp/cloud.frames" "$tmp/blobs.frames" $small --traversals
is 'structures and traversals' "$(column config | sed 's/,variant=[a-z0-9]*//g')" \
    "queue-grid queue-grid,loop=flattened loose-grid loose-grid,packet=16 kd,traversal=single kd,traversal=packet \
kd-ropes,traversal=single kd-ropes,traversal=packet bih,traversal=single bih,traversal=packet bvh auto auto,rays=incoherent"
holds 'the tree of a scene' 'c["config"] !~ /^kd/ ? 1 :
    (c["scene"] in nodes) ? nodes[c["scene"]] == c["kd_nodes"] : (nodes[c["scene"]] = c["kd_nodes"]) > 0'

# Structures by name, in the order of the command line; settings in the name.
run 0 rays "$tmp/cloud.frames" $small -S kd -S queue-grid -S kd --kd-traversal packet --kd-layout mixed \
    --kd-break 5 --variant portable --traversals
is 'rows by name' "$(column config)" "kd,traversal=packet,layout=mixed,break=5,variant=portable \
queue-grid,variant=portable queue-grid,variant=portable,loop=flattened"
# A loose grid by packets alone, where their size is given.
run 0 rays "$tmp/cloud.frames" $small -S loose-grid -k 8 --variant portable --traversals
is 'packets of a size' "$(column config)" 'loose-grid,variant=portable,packet=8'

# All layouts: one tree in each of them. All structures fit.
run 0 rays "$tmp/blobs.frames" -s 16x9 -K frame -r 1 --layouts --traversals
is 'rows of all layouts' "$(sed 1d "$tmp/stdout" | grep -c '^kd,')" 6
is 'rows of all' "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" $((2 + 2 + 6 + 6 + 2 + 1 + 2))
holds 'one tree for all layouts' 'c["config"] !~ /^kd,/ ||
    ("kd" in size ? size["kd"] == c["kd_nodes"] " " c["bytes"] : (size["kd"] = c["kd_nodes"] " " c["bytes"]) != "")'

run 0 make stadium "$tmp/stadium.frames" -n 1
is 'the size of a stadium' "$(wc -c <"$tmp/stadium.frames" | tr -d ' ')" \
    $((24 + 22000 * 12 + 4 + (101 * 100 + 26 * 40) * 12))
run 0 rays "$tmp/stadium.frames" -c 2,1.5,-3,0,0,0,0,1,0,45 -s 16x9 --random 50 -K frame,random -S kd -S auto -r 1
holds 'the stadium' 'c["primitives"] == 22000 && c["tests_per_ray"] > 0'

# ---- frame ----------------------------------------------------------------------------------------------------------

for structure in kd kd-ropes queue-grid loose-grid; do
    run 0 frame "$tmp/cloud.frames" $camera -s 40x22 -a 1 -S $structure -o "$tmp/$structure.hits"
    says out "^$structure	"
    cmp -s "$tmp/$structure.hits" "$tmp/kd.hits" || fail "$structure: different hits than kd"
done
run 0 frame "$tmp/cloud.frames" $camera -s 40x22 -S kd --kd-layout breadth-first \
    --kd-traversal single
says out '^kd,traversal=single,layout=breadth-first	'
run 0 frame "$tmp/cloud.frames" $camera -s 40x22 -S kd,bvh
is 'two ways' "$(grep -v '^#' "$tmp/stdout" | cut -f 1 | tr '\n' ' ')" 'config kd bvh '
is 'compared' "$(sed -n 's/^# //p' "$tmp/stdout" | cut -f 1,5 | tr '\t\n' '  ')" 'compare config other_pixels kd 0 bvh 0 '
refuses 2 '"hash" is not auto, ' frame "$tmp/cloud.frames" -S hash

# ---- Errors ---------------------------------------------------------------------------------------------------------

cloud=$tmp/cloud.frames
refuses 2 'FILE' rays
refuses 1 'missing\.frames' rays "$tmp/missing.frames"
refuses 1 'no/folder' rays "$cloud" -j "$tmp/no/folder/x.json"
refuses 2 '"octree" is not' rays "$cloud" -S kd,octree
refuses 2 'kd-layout' rays "$cloud" --kd-layout heap
refuses 2 'kd-traversal' rays "$cloud" --kd-traversal swarm
refuses 2 'only with' rays "$cloud" --kd-break 5
refuses 2 'kd-break' rays "$cloud" --kd-layout mixed --kd-break 51
refuses 2 'leave out' rays "$cloud" --layouts --kd-layout mixed
refuses 2 '"mirror" is not' rays "$cloud" -K camera,mirror
refuses 2 '-O: "" is not camera, ' rays "$cloud" -O tile,
refuses 2 '"all" is not' rays "$cloud" -Q all
refuses 2 '-B' rays "$cloud" -B 1,0
refuses 2 '-B' rays "$cloud" -B many
refuses 2 'more than 32' rays "$cloud" -B "$(seq -s , 1 40)"
refuses 2 '--rays' rays "$cloud" --rays 0
refuses 2 'random' rays "$cloud" --random x
refuses 2 '-a' rays "$cloud" -a 1025
refuses 2 '-a' rays "$cloud" -a 0
refuses 2 '-l' rays "$cloud" -l 1,2
refuses 2 'variant' rays "$cloud" --variant abacus

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cgt-bench rays: command line as described'
