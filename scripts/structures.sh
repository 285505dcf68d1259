#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# structures.sh [FOLDER]
# Compares the structures: remakes the scenes, tables and plots of docs/reports/grids_and_trees.md from a release build
# (scripts/test.sh release leaves one), and prints the tables as Markdown. FOLDER: for scenes and results; default
# out/structures. Figures from a busy machine mean little. Grids take minutes over the stadium: a small object in a huge
# space is not what they are for.
#   SIZE     pixels of the pictures; default 640x360
#   FRAME    of each scene, from 1; default 3
#   ROUNDS   default 3
#   THREADS  default 1
#   RAYS     random rays; default 50000
#   SCENES   default: all
#   STRUCTURES  to compare; default: all
#   BIN      folder of the programs; default build/release/bin
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${BIN:-build/release/bin}
out=${1:-out/structures}
size=${SIZE:-640x360}
frame=${FRAME:-3}
threads=${THREADS:-1}
rays=${RAYS:-50000}
read -r -a scenes <<<"${SCENES:-cloud2k cloud20k cloud200k cloud1m clusters1m blobs2k stadium blob100k blobs1m}"
of_structures=()
for name in ${STRUCTURES:-}; do of_structures+=(-S "$name"); done
layout_scenes=" cloud20k cloud200k blobs2k blob100k stadium " # in all layouts
mkdir -p "$out"
[ -x "$bin/cgt-bench" ] || { echo "structures.sh: no $bin/cgt-bench: run scripts/test.sh release first" >&2; exit 1; }
command -v gnuplot >/dev/null || { echo "structures.sh: no gnuplot: apt-get install gnuplot-nox" >&2; exit 1; }

camera_of() { # NAME
    case $1 in
    stadium) echo 2,1.5,-3,0,-0.2,0,0,1,0,45 ;;
    *) echo 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46 ;;
    esac
}

# measure NAME RESULT OPTION...: a table of one scene, complete or not there
measure() {
    local name=$1 result=$out/$2
    shift 2
    echo "structures.sh: $(basename "$result" .tsv)" >&2
    "$bin/cgt-bench" rays "$out/$name.frames" -c "$(camera_of "$name")" -s "$size" -t "$threads" -n "$frame" \
        -r "${ROUNDS:-3}" -l 3,4,-5 -a 4 --rays 100000000 --random "$rays" "$@" >"$result.part"
    mv "$result.part" "$result"
}

kinds=(--traversals -K "frame,shadow,ao,random")
tables=() layouts=()
for name in "${scenes[@]}"; do
    [ -s "$out/$name.frames" ] || "$bin/cgt-bench" make "$name" "$out/$name.frames" -n "$frame" >&2
    measure "$name" "$name.tsv" "${kinds[@]}" ${of_structures[@]+"${of_structures[@]}"}
    tables+=("$out/$name.tsv")
    case $layout_scenes in
    *" $name "*)
        measure "$name" "$name.layouts.tsv" "${kinds[@]}" --layouts -S kd,kd-ropes
        layouts+=("$out/$name.layouts.tsv")
        ;;
    esac
done

tab=$(printf '\t')
readers=(-f scripts/reports/columns.awk -f scripts/reports/structures_rows.awk)
figures() { # PART FILE...: what gnuplot draws
    local part=$1
    shift
    awk -F'\t' -v part="$part" "${readers[@]}" -f scripts/reports/structures_figures.awk "$@"
}
# points joined by a line are neighbours, and bars are in order
figures times "${tables[@]}" | LC_ALL=C sort -t "$tab" -k1,1 -k2,2 -k3,3g >"$out/times.dat"
: >"$out/layouts.dat"
if [ ${#layouts[@]} -gt 0 ]; then
    figures layouts "${layouts[@]}" | LC_ALL=C sort -t "$tab" -k1,1 -k2,2g >"$out/layouts.dat"
fi
gnuplot -e "folder = '$out'" scripts/reports/structures.gnuplot

parts=()
for file in "${tables[@]}"; do parts+=(part=times "$file"); done
for file in "${layouts[@]}"; do parts+=(part=layouts "$file"); done
exec awk -F'\t' "${readers[@]}" -f scripts/reports/structures_tables.awk "${parts[@]}"
