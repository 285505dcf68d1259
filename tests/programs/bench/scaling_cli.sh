#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench scaling: its rows, sums that can be worked out from other rows, errors and exit codes.
#   scaling_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

size=260x180 tiles=15
[ -z "$slow" ] || size=130x70 tiles=6
run 0 make cloud2k "$tmp/cloud.frames" -n 2
run 0 make blobs2k "$tmp/blobs.frames" -n 3

run 0 scaling --help
for option in --camera --size --threads --frames --repeat --variant --structure --ao --light --json; do
    says out "$option"
done

# A row for each phase of each call; phases that are no function of the library's are "all" and "serial".
run 0 scaling "$tmp/cloud.frames" "$tmp/blobs.frames" -s $size -t 1,2,64 -n 2 -a 1 -j "$tmp/rows.json"
is scenes "$(column scene)" 'cloud blobs'
is threads "$(column threads)" '1 2 64'
is calls "$(column call)" 'commit camera shadow ambient rays frame'
is 'rows as JSON' "$(grep -c '"config"' "$tmp/rows.json")" "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')"
holds 'a tile is a task' "c[\"phase\"] != \"trace_frame_tile\" ||
    c[\"call\"] == \"camera\" && (c[\"threads\"] == 64 ? c[\"tasks\"] >= $tiles : c[\"tasks\"] > 1)"
holds 'bounds of a simulation' 'c["longest_ms"] <= c["limit_ms"] * 1.001 && c["limit_ms"] <= c["simulated_ms"] * 1.001 &&
    c["simulated_ms"] <= c["sum_ms"] * 1.001 && c["sum_ms"] <= c["threads"] * c["simulated_ms"] * 1.001'
holds 'one thread has all' 'c["threads"] > 1 || c["sum_ms"] <= c["simulated_ms"] * 1.001'
holds 'efficiency' 'c["efficiency"] == "-" ? c["simulated_ms"] == 0 :
    (d = c["efficiency"] * c["threads"] * c["simulated_ms"] - c["sum_ms"]) < 1e-3 * c["sum_ms"] && -d < 1e-3 * c["sum_ms"]'
holds 'what is serial stays' 'c["phase"] != "serial" || c["tasks"] == 0 && c["limit_ms"] == c["sum_ms"]'
holds 'measured by one thread' 'c["phase"] == "all" ? c["threads"] > 1 || c["measured_ms"] >= 0 : c["measured_ms"] == "-"'

# Of one frame a call is the sum of its phases, and the frame that of its calls.
run 0 scaling "$tmp/cloud.frames" -s $size -n 1 -t 64 -S bvh
awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { sum = $at["sum_ms"]; to = $at["simulated_ms"]; tasks = $at["tasks"] }
    $at["call"] == "frame" { frame = sum; frame_to = to; frame_tasks = tasks; next }
    $at["phase"] == "all" { call += sum; call_to += to; call_tasks += tasks; next }
    { phase += sum; phase_to += to; phase_tasks += tasks }
    function near(a, b) { return a - b <= 1e-4 * a && b - a <= 1e-4 * a }
    END { exit !(near(frame, call) && near(frame, phase) && near(frame_to, call_to) && near(frame_to, phase_to) &&
        frame_tasks == call_tasks && frame_tasks == phase_tasks && frame_tasks > 0) }' "$tmp/stdout" ||
    fail 'a frame is not the sum of its calls, or a call not that of its phases'
is 'the structure' "$(column config)" bvh

refuses 2 'FILE' scaling
refuses 2 '-t' scaling "$tmp/cloud.frames" -t 0
refuses 2 '-t' scaling "$tmp/cloud.frames" -t 1,1025
refuses 2 '-t' scaling "$tmp/cloud.frames" -t some
refuses 2 'more than 8' scaling "$tmp/cloud.frames" -t 1,2,3,4,5,6,7,8,9
refuses 2 '-S: one structure' scaling "$tmp/cloud.frames" -S auto,bvh
refuses 2 '-a: 1 or more' scaling "$tmp/cloud.frames" -a 0
refuses 1 'no.frames' scaling "$tmp/no.frames"

[ "$failures" -eq 0 ]
