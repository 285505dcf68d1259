#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# view.sh [SECONDS [PICTURES]]
# How fast cgt-view is at 1280x720, SDL's window without a display: prints the tables of docs/reports/view.md, in five
# minutes on an idle machine. Frames are in memory before. A row for each scene and number of threads:
#   plain, shadows   pictures a second, and milliseconds of CPU for each, while the run plays as fast as it can, each
#                    picture another frame, nothing left out (--budget 1e6), one ray a pixel
#   to rest          milliseconds of CPU until the picture in style soft is complete
#   event            milliseconds from an event to its picture, mean and longest, while a drag turns the scene, with the
#                    default budget
# Then resident memory over PICTURES small pictures (default 10,000) of frames that are read again and again.
#   BIN     folder of cgt-view, cgt-bench and cgt-convert; default build/release/bin
set -euo pipefail
seconds=${1:-3} pictures=${2:-10000}
bin=${BIN:-build/release/bin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export SDL_VIDEODRIVER=dummy LC_ALL=C

# number WORDS LINE: what stands before WORDS in line LINE of what "say" has printed; after: what stands behind them.
number() { sed -n "$2p" "$work/said" | grep -oE "[0-9.]+ $1" | grep -oE '^[0-9.]+'; }
after() { sed -n "$2p" "$work/said" | grep -oE "$1 [0-9.]+" | grep -oE '[0-9.]+$'; }

# view OPTIONS...: runs the script on standard input over the scene at hand.
view() {
    cat >"$work/script"
    "$bin/cgt-view" -a 1 --script "$work/script" "$@" "$work/run.frames" >"$work/said"
}

# play STYLE THREADS: "pictures a second / ms of CPU"; to_rest gets the ms until the picture is complete.
play() {
    printf '%s\n' settle 'key End' settle 'key Home' settle 'key Space' 'wait 1' say "wait $seconds" say 'key Space' say \
        settle say | view -t "$2" --style "$1" --rate 1000 --budget 1e6
    local count cpu time
    count=$(($(number pictures 2) - $(number pictures 1)))
    cpu=$(echo "$(number 's of CPU' 1) $(number 's of CPU' 2)" | awk '{ print 1e3 * ($2 - $1) }')
    time=$(echo "$(after at 1) $(after at 2)" | awk '{ print $2 - $1 }')
    to_rest=$(echo "$(number 's of CPU' 3) $(number 's of CPU' 4)" | awk '{ printf "%.0f", 1e3 * ($2 - $1) }')
    played=$(echo "$count $time $cpu" | awk '{ printf "%.0f, %.1f", $1 / $2, $3 / ($1 ? $1 : 1) }')
}

# drag THREADS: "mean, longest" ms from an event to its picture.
drag() {
    {
        printf '%s\n' settle 'press 1 640 360'
        for i in $(seq 60); do printf 'move %d %d\nwait 0.05\n' $((640 + 5 * i)) $((360 + i)); done
        printf '%s\n' 'release 1 940 420' say
    } | view -t "$1" --style soft
    dragged="$(after 'event to picture' 1), $(after longest 1)"
}

# 32,000 spheres that move about the places of a lattice.
make_32k() {
    awk 'BEGIN {
        srand(1)
        for (i = 0; i < 96000; i++) phase[i] = 6.2831853 * rand()
        for (f = 0; f < 6; f++) {
            print 32000; print "frame " f
            for (i = 0; i < 32000; i++)
                printf "C %.4f %.4f %.4f\n", i % 40 + 0.3 * sin(phase[3 * i] + f / 5),
                    int(i / 40) % 40 + 0.3 * sin(phase[3 * i + 1] + f / 5),
                    int(i / 1600) + 0.3 * sin(phase[3 * i + 2] + f / 5)
        } }' >"$work/run.xyz"
    "$bin/cgt-convert" -q -r 0.45 "$work/run.xyz" "$work/run.frames" >/dev/null
}

printf '| moving | threads | plain: pictures a second, CPU ms | hard shadows | to rest, soft: CPU ms | event to picture: mean, longest ms |\n'
printf '|---|---|---|---|---|---|\n'
for scene in cloud2k 32k cloud1m blobs1m; do
    case $scene in
    cloud2k) name='2,000 spheres' ;;
    32k) name='32,000 spheres' ;;
    cloud1m) name='1,000,000 spheres' ;;
    *) name='a mesh of 1,000,000 triangles' ;;
    esac
    if [ $scene = 32k ]; then make_32k; else "$bin/cgt-bench" make "$scene" "$work/run.frames" -n 6 >/dev/null; fi
    for threads in 1 2; do
        play plain $threads
        plain=$played
        play soft $threads
        drag $threads
        printf '| %s | %d | %s | %s | %s | %s |\n' "$name" $threads "$plain" "$played" "$to_rest" "$dragged"
    done
done

# ---- Memory over many pictures ----

make_32k
{
    printf '%s\n' settle 'key Space'
    for i in $(seq 1000); do printf 'wait 1\nsay\n'; done
} >"$work/script"
"$bin/cgt-view" -s 160x90 --style plain -a 1 --memory 2 --rate 1000 --budget 1e6 --script "$work/script" \
    "$work/run.frames" >"$work/said" &
pid=$!
trap 'kill $pid 2>/dev/null; rm -rf "$work"' EXIT
printf '\n| pictures | resident MB |\n|---|---|\n'
for share in 10 4 2 1; do
    until [ "$(number pictures '$')" -ge $((pictures / share)) ] 2>/dev/null; do sleep 0.2; done
    printf '| %d | %s |\n' "$(number pictures '$')" "$(awk '/VmRSS/ { printf "%.1f", $2 / 1e3 }' /proc/$pid/status)"
done
