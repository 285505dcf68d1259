#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# performance.sh [FOLDER]
# Remakes the scenes, tables and plots of docs/reports/performance.md from a release build with its tests (scripts/test.sh
# release leaves one), and prints the tables as Markdown. FOLDER: for scenes and results; default out/performance.
# Figures from a busy machine mean little. Embree's columns are made where the build has compare-embree.
#   STRUCTURE   default auto, the library's default
#   SIZE        pixels of the pictures; default 1280x720
#   FRAMES      of each scene; default 6
#   THREADS     numbers of threads; default: 1 and all CPUs
#   SCENES      default: all
#   ISAS        instruction sets to compare with Embree, in addition to the widest; default: avx2 sse4.2 where the CPU
#               has them
#   PRIMITIVES  range of the sweep; default 1000,10000000
#   PIXELS      range of the sweep; default 100000,33000000
#   AT          primitives in the other sweeps; default 200000
#   STEPS       points for each factor of ten; default 2
#   ROUNDS      of frames and of limits; default 9
#   COMPARES    rounds of the comparison with Embree; default 3
#   RAYS        shadow and ambient-occlusion rays that are compared; default -l 2,3,-2.5 -a 4
#   IMAGES      folder that also gets the plots; default: none (docs/images for the document)
#   BIN         folder of the programs; default build/release/bin
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${BIN:-build/release/bin}
out=${1:-out/performance}
structure=${STRUCTURE:-auto}
size=${SIZE:-1280x720}
frames=${FRAMES:-6}
rounds=${ROUNDS:-9}
steps=${STEPS:-2}
read -r -a threads <<<"${THREADS:-1 $(nproc)}"
read -r -a scenes <<<"${SCENES:-cloud2k cloud20k cloud200k cloud1m clusters1m blobs2k blob100k blobs1m}"
camera=0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46
mkdir -p "$out"
[ -x "$bin/cgt-bench" ] || { echo "performance.sh: no $bin/cgt-bench: run scripts/test.sh release first" >&2; exit 1; }
command -v gnuplot >/dev/null || { echo "performance.sh: no gnuplot: apt-get install gnuplot-nox" >&2; exit 1; }

# table RESULT COMMAND...: a table, complete or not there
table() {
    local result=$out/$1
    shift
    echo "performance.sh: $(basename "$result" .tsv)" >&2
    "$@" >"$result.part"
    mv "$result.part" "$result"
}

# the rows of an instruction set's variant: "avx2" of "avx2", "sse" of "sse4.2"
variant_of() {
    case $1 in
    sse*) echo sse ;;
    *) echo "$1" ;;
    esac
}

files=()
for name in "${scenes[@]}"; do
    [ -s "$out/$name.frames" ] || "$bin/cgt-bench" make "$name" "$out/$name.frames" -n "$frames" >&2
    files+=("$out/$name.frames")
done

# ---- Growth and limits ----------------------------------------------------------------------------------------------

table scaling.tsv "$bin/cgt-bench" scaling -S "$structure" -s "$size" --steps "$steps" --at "${AT:-200000}" \
    --primitives "${PRIMITIVES:-1000,10000000}" --pixels "${PIXELS:-100000,33000000}"
parts=(part=scaling "$out/scaling.tsv")
floors=()
distinct=$(printf '%s\n' "${threads[@]}" | sort -nu)
for count in $distinct; do
    table "floor-$count.tsv" "$bin/cgt-bench" floor "${files[@]}" -S "$structure" -s "$size" -n "$frames" -r "$rounds" \
        -t "$count" -c "$camera"
    floors+=("$out/floor-$count.tsv")
    parts+=(part=floor "$out/floor-$count.tsv")
done

# ---- Against Embree -------------------------------------------------------------------------------------------------

compare() { # PART RESULT THREADS CGT_OPTIONS EMBREE_OPTIONS OPTION...
    local part=$1 result=$2 count=$3 file head=1
    export CGT_OPTIONS=$4 EMBREE_OPTIONS=$5
    shift 5
    export STRUCTURE=$structure BIN=$bin ROUNDS=${COMPARES:-3}
    [ "$part" = embree ] || ROUNDS=1 # each of its frames has as many rays as several of the camera's
    : >"$result.part"
    for file in "${files[@]}"; do
        echo "performance.sh: $(basename "$result" .tsv): $(basename "$file" .frames)" >&2
        scripts/compare_embree.sh "$file" -c "$camera" -s "$size" -n "$frames" -t "$count" "$@" |
            tail -n "+$head" >>"$result.part"
        head=2
    done
    mv "$result.part" "$result"
    parts+=("part=$part" "$result")
    compared+=("$result")
}

compared=()
if [ -x "$bin/compare-embree" ]; then
    here=$(grep -o -w -e avx2 -e sse4_2 /proc/cpuinfo | sort -u | sed 's/_/./')
    read -r -a rays <<<"${RAYS:--l 2,3,-2.5 -a 4}"
    for count in $distinct; do
        compare embree "$out/embree-$count.tsv" "$count" "" ""
        compare rays "$out/rays-$count.tsv" "$count" "" "" -n 3 "${rays[@]}"
    done
    compare rays "$out/nearest-1.tsv" 1 "" "" -n 3 "${rays[@]}" --nearest
    for isa in ${ISAS-$here}; do
        compare embree "$out/embree-1-$isa.tsv" 1 "--variant $(variant_of "$isa")" "-i $isa"
        compare rays "$out/rays-1-$isa.tsv" 1 "--variant $(variant_of "$isa")" "-i $isa" -n 3 "${rays[@]}"
    done
fi

# ---- Plots ----------------------------------------------------------------------------------------------------------

figures() { # PART FILE...: what gnuplot draws
    local part=$1
    shift
    awk -F'\t' -v part="$part" -f scripts/reports/performance_figures.awk "$@"
}
figures growth "$out/scaling.tsv" >"$out/growth.dat"
figures limit "${floors[0]}" >"$out/limit.dat"
figures fields "${floors[0]}" >"$out/fields.dat"
: >"$out/embree.dat"
[ ${#compared[@]} -eq 0 ] || figures embree "${compared[0]}" >"$out/embree.dat"
gnuplot -e "folder = '$out'" scripts/reports/performance.gnuplot
if [ -n "${IMAGES:-}" ]; then
    for plot in growth memory limit fields embree; do
        [ ! -s "$out/$plot.png" ] || cp "$out/$plot.png" "$IMAGES/performance_$plot.png"
    done
fi
exec awk -F'\t' -f scripts/reports/performance_tables.awk "${parts[@]}"
