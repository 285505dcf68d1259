#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# accuracy.sh [FOLDER]
# Remakes the tables and plots of docs/reports/accuracy.md from a release build with its tests (scripts/test.sh release leaves
# one), and prints the tables as Markdown. FOLDER: for scenes and results; default out/accuracy. Takes about ten minutes
# on a quiet machine; figures from a busy one mean little.
#   VARIANT  the instruction set whose hard cases are listed; default: the widest that this CPU runs
#   RAYS     of each case and scene; default 4000
#   ROUNDS   default 5
#   IMAGES   folder that also gets the plots; default: none (docs/reports/images for the document)
#   BUILD    default build/release
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${BUILD:-build/release}/bin
tests=${BUILD:-build/release}/tests
options=(--rays "${RAYS:-4000}" -r "${ROUNDS:-5}")
out=${1:-out/accuracy}
mkdir -p "$out"

models=/usr/share/assimp/models
bunny=/usr/share/glmark2/models/bunny.obj
[ -x "$bin/cgt-bench" ] || { echo "accuracy.sh: no $bin/cgt-bench: run scripts/test.sh release first" >&2; exit 1; }
[ -r "$bunny" ] || { echo "accuracy.sh: no $bunny: apt-get install glmark2-data assimp-testmodels" >&2; exit 1; }
command -v gnuplot >/dev/null || { echo "accuracy.sh: no gnuplot: apt-get install gnuplot-nox" >&2; exit 1; }

scene() { # NAME COMMAND...
    local file=$out/$1.frames
    shift
    [ -s "$file" ] || "$@" "$file" >&2
}
scene cloud2k "$bin/cgt-bench" make cloud2k
scene blobs2k "$bin/cgt-bench" make blobs2k
scene bunny "$bin/cgt-convert" "$bunny"
scene house "$bin/cgt-convert" "$models/IFC/AC14-FZK-Haus.ifc"

cloud_camera=0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46
bunny_camera=0.9,0.9,4.4,-0.02,-0.06,0,0,1,0,30
house_camera=8.6,1.65,-0.9,5,1.35,-5,0,1,0,72

echo "accuracy.sh: hard cases" >&2
"$bin/cgt-bench" accuracy -w cases "${options[@]}" -j "$out/hard.json" >"$out/hard.tsv"
variant=${VARIANT:-$(sed -n 's/.*variant=\([a-z0-9]*\),precision=exact.*/\1/p' "$out/hard.tsv" | tail -n 1)}

echo "accuracy.sh: real scenes" >&2
{
    "$bin/cgt-bench" accuracy -w cases --case=cloud2k "${options[@]}" -c "$cloud_camera" "$out/cloud2k.frames"
    "$bin/cgt-bench" accuracy -w cases --case=bunny "${options[@]}" -c "$bunny_camera" "$out/bunny.frames"
    "$bin/cgt-bench" accuracy -w cases --case=house "${options[@]}" -c "$house_camera" "$out/house.frames"
} | awk -F'\t' '/^#/ { next } $1 == "case" && seen++ { next } { print }' >"$out/real.tsv"

echo "accuracy.sh: time against error" >&2
frames() { # NAME SCENE CAMERA
    "$bin/cgt-bench" accuracy -w frames -n 8 -r "${ROUNDS:-5}" -c "$3" "$out/$2.frames" >"$out/pareto_$1.tsv"
    gnuplot -e "table = '$out/pareto_$1.tsv'; plot = '$out/pareto_$1'" scripts/reports/accuracy.gnuplot
}
frames spheres cloud2k "$cloud_camera"
frames triangles blobs2k 0,0,-5,0,0,0,0,1,0,45
if [ -n "${IMAGES:-}" ]; then
    for plot in spheres triangles; do cp "$out/pareto_$plot.png" "$IMAGES/"; done
fi

echo "accuracy.sh: against Embree" >&2
: >"$out/embree.tsv"
if [ -x "$tests/oracle_embree" ]; then
    CGT_TABLE=$out/embree.tsv "$tests/oracle_embree" >/dev/null 2>&1
fi

exec awk -F'\t' -v variant="$variant" -f scripts/reports/accuracy_tables.awk \
    part=hard "$out/hard.tsv" part=real "$out/real.tsv" part=spheres "$out/pareto_spheres.tsv" \
    part=triangles "$out/pareto_triangles.tsv" part=embree "$out/embree.tsv"
