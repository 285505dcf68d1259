#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench bounces: its rows, errors and exit codes; the paths of cgt-bench accuracy.
#   bounces_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

# Keeps the first table alone.
first() { grep -v '^#' "$tmp/stdout" | sed '/^$/d' >"$tmp/rows" && mv "$tmp/rows" "$tmp/stdout"; }

small="-s 48x32 -r 1 -t 1"
run 0 make cloud2k "$tmp/cloud2k.frames" -n 1
run 0 make blobs2k "$tmp/blobs2k.frames" -n 1

# every material, bounce, order and structure; hits do not depend on the structure or the order
run 0 bounces "$tmp/cloud2k.frames" $small --no-embree
first
is "materials" "$(column material)" "mirror glass"
is "bounces" "$(column bounce | cut -d ' ' -f 1-4)" "1 2 3 4"
is "orders" "$(column order)" "waves made octant wave-morton origin octant-morton"
case $(column structure) in
"bvh loose-grid kd"*) ;;
*) fail "structures: $(column structure)" ;;
esac
awk -F '\t' 'NR > 1 && !/^#/ { key = $2 " " $3; if (key in hits && hits[key] != $8) bad = 1; hits[key] = $8; n++ }
    END { exit bad || n < 100 }' "$tmp/stdout" || fail "hits differ by order"
holds "rows" 'c["rays"] > 0 && c["left_out"] == 0 && c["hits"] <= c["rays"] && c["ns"] >= 0 && c["embree_ns"] == "-"'

# with Embree, where it is there; triangles
run 0 bounces "$tmp/blobs2k.frames" $small --order waves --structure bvh --material glass
grep -q '^# whole' "$tmp/stdout" || fail "no table of whole frames"
first
is "one order" "$(column order)" "waves"
holds "Embree" 'c["embree_ns"] == "-" || c["embree_ns"] >= 0'

# the error of paths between mirrors, by bounce: at most a unit a bounce between planes
run 0 accuracy -w paths --rays 100 --variant portable
holds "paths" 'c["mirrors"] != "planes" || (c["worst_ulp"] <= 1 + c["bounce"] && c["parted"] == 0 && c["paths"] > 20)'
is "mirrors" "$(column mirrors)" "planes balls"

refuses 2 'FILE' bounces
refuses 2 'material' bounces "$tmp/cloud2k.frames" --material water
refuses 2 'order' bounces "$tmp/cloud2k.frames" --order none
refuses 2 'structure' bounces "$tmp/cloud2k.frames" --structure none
refuses 1 'no.frames' bounces "$tmp/no.frames"

[ "$failures" -eq 0 ]
