#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# view.sh [SECONDS]
# What a picture of cgt-view takes, at 1280x720, while the run plays as fast as it can and nothing is left out: CPU time
# of all threads for each, with the next frame's build, drawing, and what goes to a window without a display. Frames are
# in memory before. Then the CPU time until the picture at rest is complete. A line a scene, style, number of threads.
#   BIN     folder of cgt-view and cgt-bench; default build/release/bin
set -euo pipefail
seconds=${1:-5}
bin=${BIN:-build/release/bin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export SDL_VIDEODRIVER=dummy

# "say" prints "..., 12 pictures, 3.450 s of CPU, ...": pictures and seconds of line N
number() { sed -n "$2p" "$work/said" | grep -oE "[0-9.]+ $1" | grep -oE '^[0-9.]+'; }

printf 'scene\tstyle\tthreads\tpictures\tms a picture\tms to rest\n'
for scene in cloud2k cloud20k cloud200k cloud1m blobs1m; do
    "$bin/cgt-bench" make "$scene" "$work/run.frames" -n 6 >/dev/null
    printf '%s\n' settle 'key End' settle 'key Home' settle 'key Space' 'wait 1' say "wait $seconds" say \
        'key Space' say settle say >"$work/script"
    for style in plain soft; do
        for threads in 1 2; do
            "$bin/cgt-view" -t $threads --style $style -a 1 --rate 1000 --budget 1e6 --script "$work/script" \
                "$work/run.frames" >"$work/said"
            awk -v p1="$(number pictures 1)" -v p2="$(number pictures 2)" -v c1="$(number 's of CPU' 1)" \
                -v c2="$(number 's of CPU' 2)" -v c3="$(number 's of CPU' 3)" -v c4="$(number 's of CPU' 4)" \
                -v row="$scene\t$style\t$threads" 'BEGIN {
                    printf "%s\t%d\t%.1f\t%.0f\n", row, p2 - p1, 1e3 * (c2 - c1) / (p2 - p1), 1e3 * (c4 - c3) }'
        done
    done
done
