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
is "lights" "$(column light | tr ' ' '\n' | sort -u | wc -l | tr -d ' ')" 14
holds "rows" 'c["rays"] > 0 && c["occluded"] <= c["rays"] && c["ms"] >= 0 && c["commit_ms"] > 0 &&
    c["embree_ms"] == "-" && c["ratio_builds"] == "-"'
run 0 light "$tmp/cloud2k.frames" $small --light inside --no-embree
is "points" "$(column points)" "tiles skipping frame shuffled scattered sorted"

# with Embree, where it is there: the same points are in shadow, but for a few at silhouettes
run 0 light "$tmp/cloud2k.frames" $small --light outside,slanted --points tiles
holds "Embree" 'c["embree_ms"] == "-" || (c["embree_ms"] >= 0 && c["embree_build_ms"] >= 0 &&
    c["ratio_builds"] > 0 && c["commit_ms"] + c["ms"] > 0 &&
    c["ratio_builds"] / (c["embree_ms"] + c["embree_build_ms"]) * (c["ms"] + c["commit_ms"]) > 0.999 &&
    c["ratio_builds"] / (c["embree_ms"] + c["embree_build_ms"]) * (c["ms"] + c["commit_ms"]) < 1.001 &&
    c["embree_occluded"] - c["occluded"] < 0.01 * c["rays"] && c["occluded"] - c["embree_occluded"] < 0.01 * c["rays"])'

refuses 2 'FILE' light
refuses 2 'light' light "$tmp/cloud2k.frames" --light nowhere
refuses 2 'points' light "$tmp/cloud2k.frames" --points none
refuses 1 'no.frames' light "$tmp/no.frames"

[ "$failures" -eq 0 ]
