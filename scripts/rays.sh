#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# rays.sh [FOLDER]
# Which structure for which rays: remakes the scenes, tables and plots of that part of docs/reports/ray_kinds.md from a release
# build (scripts/test.sh release leaves one), and prints the tables as Markdown. FOLDER: for scenes and results; default
# out/rays. Figures from a busy machine mean little.
#   SIZE     pixels of the picture; default 640x360
#   RAYS     of a set, at most; default 131072
#   ROUNDS   default 3
#   THREADS  default 1
#   SCENES   default cloud20k cloud1m blobs2k blob100k
#   STRUCTURES, KINDS, ORDERS, BATCHES  lists with commas; default: all, AUTO and the frame excepted; powers of four
#   QUERIES  a list with commas; default: those that are usual for a kind
#   IMAGES   folder that also gets the plot of one scene, as rays.png; default: none (docs/reports/images for the
#            document)
#   PLOT     that scene; default: the last one
#   BIN      folder of the programs; default build/release/bin
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${BIN:-build/release/bin}
out=${1:-out/rays}
read -r -a scenes <<<"${SCENES:-cloud20k cloud1m blobs2k blob100k}"
options=(-s "${SIZE:-640x360}" --rays "${RAYS:-131072}" -r "${ROUNDS:-3}" -t "${THREADS:-1}"
    -S "${STRUCTURES:-queue-grid,loose-grid,kd,kd-ropes,bvh}" -K "${KINDS:-camera,shadow,ao,bounce,random}"
    -O "${ORDERS:-camera,tile,shuffled}" -B "${BATCHES:-1,16,64,256,1024,4096,16384,65536,all}")
[ -z "${QUERIES:-}" ] || options+=(-Q "$QUERIES")
mkdir -p "$out"
[ -x "$bin/cgt-bench" ] || { echo "rays.sh: no $bin/cgt-bench: run scripts/test.sh release first" >&2; exit 1; }
command -v gnuplot >/dev/null || { echo "rays.sh: no gnuplot: apt-get install gnuplot-nox" >&2; exit 1; }

tables=()
for name in "${scenes[@]}"; do
    [ -s "$out/$name.frames" ] || "$bin/cgt-bench" make "$name" "$out/$name.frames" -n 1 >&2
    echo "rays.sh: $name" >&2
    "$bin/cgt-bench" rays "$out/$name.frames" "${options[@]}" >"$out/$name.tsv.part" # whole or not there at all
    mv "$out/$name.tsv.part" "$out/$name.tsv"
    tables+=("$out/$name.tsv")
done
gnuplot -e "folder = '$out'; scenes = '${scenes[*]}'" scripts/reports/rays.gnuplot
if [ -n "${IMAGES:-}" ]; then
    for ending in png; do
        cp "$out/${PLOT:-${scenes[-1]}}.$ending" "$IMAGES/rays.$ending"
    done
fi
exec awk -F'\t' -f scripts/reports/columns.awk -f scripts/reports/rays_tables.awk "${tables[@]}"
