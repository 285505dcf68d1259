#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench structures, and the options of a structure in cgt-bench frame: rows, counts, transfers,
# errors and exit codes.
#   structures_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

camera='-c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46'
size=40x22 pixels=880 random=500 frames=2
[ -z "$slow" ] || size=16x9 pixels=144 random=100 frames=1
small="$camera -s $size -n 2 --random $random"
run 0 make cloud2k "$tmp/cloud.frames" -n 2
run 0 make blobs2k "$tmp/blobs.frames" -n 2

# ---- Help -----------------------------------------------------------------------------------------------------------

run 0 structures --help
says out 'Usage: cgt-bench structures'
for option in --camera --size --threads --frames --repeat --variant --structure --light --ao --all --fetch --json \
    --random --kd-builder --kd-layout --kd-break --kd-traversal; do
    says out "$option"
done

# ---- Rows -----------------------------------------------------------------------------------------------------------

# Both files in all structures: the hits are the same bits, or the exit code would tell.
run 0 structures "$tmp/cloud.frames" "$tmp/blobs.frames" $small -n $frames -l 3,4,-5 -a 4 -j "$tmp/rows.json"
[ ! -s "$tmp/stderr" ] || fail "what is left out, or differs: $(head -n 3 "$tmp/stderr")"
is scenes "$(column scene)" 'cloud blobs'
is 'structures and traversals' "$(column config | sed 's/,layout=[a-z-]*//g; s/,variant=[a-z0-9]*//g')" \
    "grid-queue grid-queue,loop=flattened loose-grid loose-grid,packet=16 \
kd,traversal=single,builder=binned kd,traversal=packet,builder=binned \
kd-ropes,traversal=single,builder=binned kd-ropes,traversal=packet,builder=binned wide-tree auto auto,rays=incoherent"
holds 'rays' 'c["primary_rays"] == '$pixels' && c["random_rays"] == '$random' &&
    c["shadow_rays"] > '$((pixels / 9))' && c["ao_rays"] == 4 * c["shadow_rays"]'
holds 'times' 'c["build_ms"] > 0 && c["primary_ms"] > 0 && c["shadow_ms"] > 0 && c["ao_ms"] > 0 && c["random_ms"] > 0'
holds 'primitives' 'c["primitives"] == 2000 && c["threads"] == 1'
holds 'nodes and leaves' 'c["chosen"] !~ /^kd/ ? c["nodes_per_ray"] == "-" && c["kd_nodes"] == 0 :
    c["kd_nodes"] == 2 * c["kd_leaves"] - 1 && c["kd_depth"] > 3 && c["kd_cost"] > 0 &&
    c["random_leaves_per_ray"] > 0.05'
holds 'bytes of trees' 'c["kd_nodes"] == 0 || c["bytes"] >= 8 * c["kd_nodes"]'
holds 'tests' 'c["tests_per_ray"] > 0 && c["ao_tests_per_ray"] > 0 && c["random_tests_per_ray"] > 0'
holds 'loops of ropes' 'c["rope_loops"] == 0 && (c["config"] ~ /^kd-ropes/ ? c["rope_steps"] > 0 : 1)'
holds 'what was chosen' 'c["config"] ~ /^auto/ ? c["chosen"] != "none" : c["config"] ~ ("^" c["chosen"] ",")'
# The same tree in other traversals: its size is the same, and one ray at a time tests fewer primitives than packets.
holds 'the tree of a scene' 'c["config"] !~ /^kd/ ? 1 :
    (c["scene"] in nodes) ? nodes[c["scene"]] == c["kd_nodes"] : (nodes[c["scene"]] = c["kd_nodes"]) > 0'
is 'rows as JSON' "$(grep -c '"config"' "$tmp/rows.json")" 22

# Structures by name, in the order of the command line; a traversal alone; settings in the name.
run 0 structures "$tmp/cloud.frames" $small -S kd -S grid-queue -S kd --kd-traversal packet --kd-layout mixed \
    --kd-break 5 --variant portable -t 2 -r 2
is 'rows by name' "$(column config)" \
    "kd,traversal=packet,layout=mixed,break=5,builder=binned,variant=portable grid-queue,variant=portable \
grid-queue,variant=portable,loop=flattened"
holds 'threads' 'c["threads"] == 2'
holds 'rays that are not asked for' 'c["shadow_ms"] == 0 && c["ao_rays"] == 0 && c["ao_tests_per_ray"] == "-"'

# A loose grid by packets alone, where their size is asked for.
run 0 structures "$tmp/cloud.frames" $small -n 1 -S loose-grid -k 8 --variant portable
is 'packets of a size' "$(column config)" 'loose-grid,variant=portable,packet=8'

# All layouts by both builders: one tree per builder, whatever the layout.
run 0 structures "$tmp/blobs.frames" $small --all -S kd -n 1
is 'rows of all layouts' "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" 12
holds 'one tree for all layouts' '(b = c["config"]) && sub(/.*builder=/, "", b) && sub(/,.*/, "", b) &&
    ((b in size) ? size[b] == c["kd_nodes"] " " c["bytes"] : (size[b] = c["kd_nodes"] " " c["bytes"]) != "")'

# ---- Transfers ------------------------------------------------------------------------------------------------------

# A ray reads the same nodes in every layout; a larger memory of least recently used blocks never misses more often; a
# ray's own lines are at least one and at most its nodes; bytes follow from the transfers, the last of which may be cut.
run 0 structures "$tmp/blobs.frames" $small --fetch -l 3,4,-5 -a 4
is 'kinds of rays' "$(column rays)" 'primary shadow ao random'
is 'memories' "$(column memory)" 'direct lru window top ray'
is 'layouts' "$(column config | sed 's/kd,layout=//g; s/,builder=binned,variant=[a-z0-9]*//g')" \
    'depth-first breadth-first mixed,break=8'
holds 'nodes of a ray' '(c["rays"] in read) ? read[c["rays"]] == c["nodes_per_ray"] :
    (read[c["rays"]] = c["nodes_per_ray"]) > 1'
in_memory='c["memory"] == "top" && c["memory_bytes"] >= 8 * (c["kd_nodes"] + 1)'
holds 'misses' "c[\"misses_per_ray\"] <= c[\"nodes_per_ray\"] && (c[\"misses_per_ray\"] > 0 || $in_memory)"
holds 'bytes' 'c["bytes_per_ray"] <= 1.00001 * c["misses_per_ray"] * c["block_bytes"] &&
    c["bytes_per_ray"] >= 0.1 * c["misses_per_ray"] * c["block_bytes"]'
holds 'larger memories' 'c["memory"] != "lru" ? 1 :
    !((k = c["config"] c["rays"] c["block_bytes"]) in last) || c["misses_per_ray"] + 0 <= last[k] + 0 ?
    (last[c["config"] c["rays"] c["block_bytes"]] = c["misses_per_ray"]) != "" : 0'
holds 'a memory of one block' 'c["memory_bytes"] != c["block_bytes"] || c["memory"] == "window" ? 1 :
    c["memory"] == "direct" ? (one[c["config"] c["rays"]] = c["misses_per_ray"]) != "" :
    one[c["config"] c["rays"]] == c["misses_per_ray"]'

# ---- A scene of its own ---------------------------------------------------------------------------------------------

run 0 make stadium "$tmp/stadium.frames" -n 1
is 'the size of a stadium' "$(wc -c <"$tmp/stadium.frames" | tr -d ' ')" \
    $((24 + 22000 * 12 + 4 + (101 * 100 + 26 * 40) * 12))
run 0 structures "$tmp/stadium.frames" -c 2,1.5,-3,0,0,0,0,1,0,45 -s 16x9 --random 50 -S kd -S auto
holds 'the stadium' 'c["primitives"] == 22000 && c["tests_per_ray"] > 0'

# ---- frame ----------------------------------------------------------------------------------------------------------

for structure in kd kd-ropes grid-queue loose-grid; do
    run 0 frame "$tmp/cloud.frames" $camera -s 40x22 -a 1 -S $structure -o "$tmp/$structure.hits"
    says out "^$structure	"
    cmp -s "$tmp/$structure.hits" "$tmp/kd.hits" || fail "$structure: other hits than kd"
done
run 0 frame "$tmp/cloud.frames" $camera -s 40x22 -S kd --kd-builder sweep --kd-layout breadth-first \
    --kd-traversal single
says out '^kd,traversal=single,layout=breadth-first,builder=sweep	'
refuses 2 'one more' frame "$tmp/cloud.frames" -S kd -S auto
refuses 2 'not hash' frame "$tmp/cloud.frames" -S hash

# ---- Errors ---------------------------------------------------------------------------------------------------------

refuses 2 'FILE' structures
refuses 1 'missing\.frames' structures "$tmp/missing.frames"
refuses 1 'no/folder' structures "$tmp/cloud.frames" -j "$tmp/no/folder/x.json"
refuses 2 'not octree' structures "$tmp/cloud.frames" -S octree
refuses 2 'kd-builder' structures "$tmp/cloud.frames" --kd-builder slow
refuses 2 'kd-layout' structures "$tmp/cloud.frames" --kd-layout heap
refuses 2 'kd-traversal' structures "$tmp/cloud.frames" --kd-traversal swarm
refuses 2 'only with' structures "$tmp/cloud.frames" --kd-break 5
refuses 2 'kd-break' structures "$tmp/cloud.frames" --kd-layout mixed --kd-break 51
refuses 2 'leave out' structures "$tmp/cloud.frames" --all --kd-layout mixed
refuses 2 'leave out' structures "$tmp/cloud.frames" --fetch -S kd
refuses 2 'random' structures "$tmp/cloud.frames" --random x
refuses 2 '-a' structures "$tmp/cloud.frames" -a 1025
refuses 2 '-l' structures "$tmp/cloud.frames" -l 1,2
refuses 2 'variant' structures "$tmp/cloud.frames" --variant abacus

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cgt-bench structures: command line as described'
