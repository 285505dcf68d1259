#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# demo.sh [OPTION OF cgt-render]...
# From a fresh Debian machine to pictures: installs what is missing, builds, and renders the trajectory that is shipped,
# every sphere moving every frame, into out/demo/: one numbered PNG per frame and contact_sheet.png. Then some frames in
# which the grains are glass and mirrors, smaller, since they take longer: glass_*.png.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/dependencies.sh build render
jobs=$(nproc)

echo "demo.sh: building build/release"
log=build/demo.log
mkdir -p build
if ! { cmake --preset release -DCGT_BUILD_EXAMPLES=ON -DCGT_BUILD_MESHES=ON -DCGT_BUILD_RENDER=ON &&
    cmake --build --preset release --target cgt-render -j "$jobs"; } >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "demo.sh: the build failed; the whole log is $log" >&2
    exit 1
fi

rm -rf out/demo
mkdir -p out/demo
build/release/bin/cgt-render examples/data/pour2k.lammpstrj -s 1280x720 --camera-keys examples/data/pour2k.keys \
    -o out/demo/frame_%04d.png --contact-sheet out/demo/contact_sheet.png "$@"
build/release/bin/cgt-render examples/data/pour2k.lammpstrj -s 480x360 --first 8 --last 12 -c -6,-8,5,8,5,2.6,0,0,1,40 \
    --style paper --background e8eef5 --bounces 6 --floor --material 1=glass --material 2=mirror --type-color 1=e6f4ff \
    --type-color 2=ffd98a --type-color 3=2f6690 --type-color 4=d1495b -o out/demo/glass_%04d.png
echo "demo.sh: $(find out/demo -name 'frame_*.png' | wc -l) frames, contact_sheet.png and" \
    "$(find out/demo -name 'glass_*.png' | wc -l) frames of glass and mirrors in out/demo"
