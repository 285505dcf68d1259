#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench bounces: its rows, errors and exit codes; the paths of cgt-bench accuracy.
#   bounces_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

small="-s 48x32 -r 1 -t 1"
run 0 make cloud2k "$tmp/cloud2k.frames" -n 1
run 0 make blobs2k "$tmp/blobs2k.frames" -n 1

# every material, bounce, order and structure; hits do not depend on the structure or the order
run 0 bounces "$tmp/cloud2k.frames" $small --no-embree
is "materials and bounces" "$(column kind)" "mirror-1 mirror-2 mirror-3 mirror-4 glass-1 glass-2 glass-3 glass-4"
is "orders" "$(column order)" "waves made octant wave-morton origin octant-morton"
is "structures" "$(column chosen)" "bvh loose-grid kd bih"
holds "rows" 'c["rays"] > 0 && c["hits"] <= c["rays"] && c["ns_per_ray"] >= 0 && c["ratio"] == "-" && c["different"] == 0 &&
    (c["order"] ~ /^(waves|octant|wave-morton)$/ || c["batch"] == c["rays"]) &&
    ((k = c["kind"]) in hits ? hits[k] == c["hits"] : (hits[k] = c["hits"]) >= 0)'

# with Embree, where it is there; triangles
run 0 bounces "$tmp/blobs2k.frames" $small --order waves --material glass
is "one order" "$(column order)" "waves"
holds "Embree" 'c["config"] ~ /^embree/ ? c["ratio"] == 1 && c["different"] <= 0.02 * c["rays"] + 3 : c["ratio"] == "-" || c["ratio"] > 0'

# the error of paths between mirrors, by bounce: at most a unit a bounce between planes
run 0 accuracy -w paths --rays 100 --variant portable
holds "paths" 'c["mirrors"] != "planes" || (c["worst_ulp"] <= 1 + c["bounce"] && c["parted"] == 0 && c["paths"] > 20)'
is "mirrors" "$(column mirrors)" "planes balls"

refuses 2 'FILE' bounces
refuses 2 '-K: "water" is not mirror or glass' bounces "$tmp/cloud2k.frames" --material water
refuses 2 '-O: "none" is not waves' bounces "$tmp/cloud2k.frames" --order none
refuses 2 '-S: "none" is not auto' bounces "$tmp/cloud2k.frames" --structure none
refuses 1 'no.frames' bounces "$tmp/no.frames"

[ "$failures" -eq 0 ]
