#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench cliffs: its rows, its summaries, errors and exit codes.
#   cliffs_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

small="--primitives 100 --steps 1 --limit 1"

# every call, through every structure; rays alone where rays alone are disturbed
run 0 cliffs $small --worst 0 --scene "stray 1e3, spheres" --no-embree
is "calls" "$(column call)" "commit camera light single rays occluded"
is "structures" "$(column structure)" "auto loose-grid bvh bih"
holds "rows" 'c["primitives"] == 100 && c["ms"] >= 0 && c["twin_ratio"] > 0 && c["embree_ms"] == "-" &&
    (c["call"] == "commit" ? c["rays"] == 0 : c["call"] == "light" ? c["rays"] <= 192 : c["rays"] == 192) &&
    c["hits"] <= c["rays"]'
run 0 cliffs $small --worst 0 --scene "dead rays" --no-embree
is "calls" "$(column call)" "single rays occluded"
holds "dead rays" 'c["hits"] == 0'
run 0 cliffs $small --worst 0 -S bvh --call rays --scene "fan" --no-embree
is "structure" "$(column structure)" "bvh"
is "call" "$(column call)" "rays"

# with Embree, where it is there
run 0 cliffs $small --worst 0 -S auto --scene "invalid 2/3"
holds "rows" 'c["embree_ms"] == "-" || c["embree_ms"] >= 0'

# summaries
run 0 cliffs $small -S auto --worst 2 --scene "stray 1e3, spheres" --no-embree
is "worst rows" "$(grep -c '^# stray' "$tmp/stdout")" 2
says out '^# worst against the twin'

run 0 cliffs --list
is "names" "$(sort "$tmp/stdout" | uniq -d | wc -l | tr -d ' ')" 0
[ "$(wc -l <"$tmp/stdout")" -ge 60 ] || fail "fewer than 60 scenes"

refuses 2 'primitives' cliffs --primitives 10
refuses 2 'steps' cliffs --steps 8
refuses 2 'call' cliffs --call no
refuses 2 '-S' cliffs -S no
refuses 2 'no FILE' cliffs some.frames
refuses 2 'scene' cliffs --scene nothing-of-this-name

[ "$failures" -eq 0 ]
