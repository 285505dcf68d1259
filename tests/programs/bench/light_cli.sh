#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench light: its rows, errors and exit codes.
#   light_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

small="-s 64x48 -r 1 -t 1"
run 0 make cloud2k "$tmp/cloud2k.frames" -n 1

# every light, every order of points
run 0 light "$tmp/cloud2k.frames" $small --points tiles,frame --no-embree
is "lights" "$(column kind | tr ' ' '\n' | sort -u | wc -l | tr -d ' ')" 14
holds "rows" 'c["rays"] > 0 && c["hits"] <= c["rays"] && c["ms"] >= 0 && c["build_ms"] > 0 && c["ratio_builds"] == "-"'
run 0 light "$tmp/cloud2k.frames" $small --light inside -S auto,loose-grid,bvh
is "points" "$(column order)" "tiles skipping frame shuffled scattered sorted"
holds "the same shadows by each structure" 'c["different"] == 0 &&
    ((k = c["order"]) in hits ? hits[k] == c["hits"] : (hits[k] = c["hits"]) > 0)'

# with Embree, where it is there: the same points are in shadow, but for a few at silhouettes
run 0 light "$tmp/cloud2k.frames" $small --light outside,slanted --points tiles
holds "Embree" 'c["config"] !~ /^embree/ || (c["ms"] >= 0 && c["build_ms"] > 0 && c["ratio"] == 1 && c["ratio_builds"] == 1 &&
    c["different"] < 0.01 * c["rays"])'

refuses 2 'FILE' light
refuses 2 '-K: "nowhere" is not outside' light "$tmp/cloud2k.frames" --light nowhere
refuses 2 '-O: "none" is not tiles' light "$tmp/cloud2k.frames" --points none
refuses 1 'no.frames' light "$tmp/no.frames"

[ "$failures" -eq 0 ]
