#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# demo.sh [OPTION OF cgt-render]...
# From a fresh Debian machine to pictures: installs what is missing, builds, and renders the trajectory that is shipped,
# every sphere moving every frame, into out/demo/: one numbered PNG per frame and contact_sheet.png.
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
echo "demo.sh: $(find out/demo -name 'frame_*.png' | wc -l) frames and contact_sheet.png in out/demo"
