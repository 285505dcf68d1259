#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# speed.sh [FOLDER]
# Remakes the tables of docs/reports/performance.md, embree.md, light.md and bounces.md from a release build
# (scripts/test.sh release leaves one; Embree 3 is needed), and prints them as Markdown: an hour on an idle machine.
# Figures from a busy one mean little. FOLDER: for scenes and results; default out/speed. Results that are there are not
# measured again.
#   PARTS    of them; default frames rays light bounces structures growth
#   SCENES   default all
#   ROUNDS   default 3
#   BIN      folder of cgt-bench; default build/release/bin
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${BIN:-build/release/bin}
out=${1:-out/speed}
rounds=${ROUNDS:-3}
read -r -a scenes <<<"${SCENES:-cloud2k cloud20k cloud200k cloud1m clusters1m blobs2k blob100k blobs1m}"
camera=(-c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46)
mkdir -p "$out"
[ -x "$bin/cgt-bench" ] || { echo "speed.sh: no $bin/cgt-bench: run scripts/test.sh release first" >&2; exit 1; }

# measure RESULT SUBJECT SCENE OPTION...: a table, whole or not there
measure() {
    local result=$out/$1 subject=$2 name=$3
    shift 3
    [ -s "$out/$name.frames" ] || "$bin/cgt-bench" make "$name" "$out/$name.frames" -n 6 >&2
    [ ! -s "$result" ] || return 0
    echo "speed.sh: $(basename "$result" .tsv)" >&2
    "$bin/cgt-bench" "$subject" "$out/$name.frames" "$@" >"$result.part"
    mv "$result.part" "$result"
}

# PART SCENE: its tables, each of which has a name PART.SCENE.SETTING.tsv
measure_part() {
    local ways=(-S auto,embree-all -l 2,3,-2.5)
    case $1 in
    frames)
        measure "frames.$2.1.tsv" frame "$2" "${camera[@]}" "${ways[@]}" -r "$rounds"
        measure "frames.$2.2.tsv" frame "$2" "${camera[@]}" "${ways[@]}" -r "$rounds" -t 2
        measure "frames.$2.avx2.tsv" frame "$2" "${camera[@]}" "${ways[@]}" -r "$rounds" --variant avx2 --isa avx2
        measure "frames.$2.sse4.2.tsv" frame "$2" "${camera[@]}" "${ways[@]}" -r "$rounds" --variant sse --isa sse4.2
        ;;
    rays)
        measure "rays.$2.1.tsv" frame "$2" "${camera[@]}" "${ways[@]}" -a 4 -s 640x360
        measure "rays.$2.2.tsv" frame "$2" "${camera[@]}" "${ways[@]}" -a 4 -s 640x360 -t 2
        measure "rays.$2.nearest.tsv" frame "$2" "${camera[@]}" "${ways[@]}" -a 4 -s 640x360 --nearest
        ;;
    light) measure "light.$2.1.tsv" light "$2" -r "$rounds" ;;
    bounces)
        case $2 in cloud20k|cloud1m|blob100k)
            measure "bounces.$2.1.tsv" bounces "$2" -s 320x180 -r "$rounds" -S bvh,embree-all --order waves ;;
        esac
        ;;
    structures)
        case $2 in cloud20k|cloud1m|blob100k)
            measure "structures.$2.1.tsv" bounces "$2" -s 96x54 -r "$rounds" --no-embree --order waves ;;
        esac
        ;;
    growth)
        case $2 in cloud200k|blob100k)
            for size in 320x180 640x360 1280x720 2560x1440 5120x2880; do
                measure "growth.$2.$size.tsv" frame "$2" "${camera[@]}" -S auto -r "$rounds" -s "$size"
            done ;;
        esac
        ;;
    *) echo "speed.sh: no part $1" >&2; exit 2 ;;
    esac
}

for part in ${PARTS:-frames rays light bounces structures growth}; do
    for name in "${scenes[@]}"; do measure_part "$part" "$name"; done
    files=()
    for name in "${scenes[@]}"; do
        for file in $(ls -v "$out/$part.$name".*.tsv 2>/dev/null); do [ ! -s "$file" ] || files+=("$file"); done
    done
    [ ${#files[@]} -eq 0 ] ||
        awk -F'\t' -v part="$part" -f scripts/reports/columns.awk -f scripts/reports/speed_tables.awk "${files[@]}"
done
