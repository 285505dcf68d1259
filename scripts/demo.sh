#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# demo.sh [OPTION OF cgt-render]...
# From a fresh Debian machine to pictures: installs what is missing, builds what they need for this CPU alone, and
# renders the trajectory that is shipped, every sphere moving every frame, into out/demo/: first.png, one numbered PNG
# per frame and contact_sheet.png. Then some frames in which the grains are glass and mirrors, smaller, since they take longer:
# glass_*.png. Where there is a display, and SDL 2 to build cgt-view with, a window shows the run at the end.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/dependencies.sh build demo
jobs=$(nproc)

# The widest variant that the CPU runs; beside it there is always the portable one. Elsewhere than on Linux: all.
case "$(uname -m) $(grep -m1 '^flags' /proc/cpuinfo 2>/dev/null)" in
*\ avx512bw\ *avx512vl\ *) variants=avx512 ;;
*\ avx2\ *) variants=avx2 ;;
*\ sse4_1\ *) variants=sse ;;
aarch64*) variants=neon ;;
*) variants= ;;
esac

echo "demo.sh: building build/demo"
log=build/demo.log
mkdir -p build
rm -f $log
# logged COMMAND...: what it says is shown only where it fails
logged() {
    if ! "$@" >>"$log" 2>&1; then
        tail -n 40 "$log" >&2
        echo "demo.sh: the above failed: $*; the whole log is $log" >&2
        exit 1
    fi
}
# -O1 compiles in half the time of -O3; pictures are the same bytes
logged cmake -S . -B build/demo -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE="-O1 -DNDEBUG" \
    -DCGT_ONLY_VARIANTS="$variants" -DCGT_BUILD_RENDER=ON -DCGT_BUILD_TESTS=OFF -DCGT_BUILD_EXAMPLES=OFF \
    -DCGT_BUILD_BENCH=OFF -DCGT_BUILD_MESHES=OFF -DCGT_BUILD_IMAGES=OFF -DCGT_BUILD_MPI=OFF
logged cmake --build build/demo --target cgt-render -j "$jobs"

rm -rf out/demo
mkdir -p out/demo
render=build/demo/bin/cgt-render run=examples/data/pour2k.lammpstrj
logged $render $run -q -s 1280x720 -a 4 --first 46 --last 46 -c 10,-21,13,10,6,6.2,0,0,1,38 --floor \
    --background e8eef5 --ambient 32 --light -1,-0.6,1.2 --light-size 12 --light-samples 32 -o out/demo/first.png
echo "demo.sh: out/demo/first.png is there after $SECONDS s"
$render $run -s 1280x720 --first 3 --camera-keys examples/data/pour2k.keys -o out/demo/frame_%04d.png \
    --contact-sheet out/demo/contact_sheet.png "$@"
$render $run -s 480x360 --first 8 --last 12 -c -6,-8,5,8,5,2.6,0,0,1,40 \
    --style paper --background e8eef5 --bounces 6 --floor --material 1=glass --material 2=mirror --type-color 1=e6f4ff \
    --type-color 2=ffd98a --type-color 3=2f6690 --type-color 4=d1495b -o out/demo/glass_%04d.png
echo "demo.sh: in out/demo: first.png, $(find out/demo -name 'frame_*.png' | wc -l) frames, contact_sheet.png and" \
    "$(find out/demo -name 'glass_*.png' | wc -l) frames of glass and mirrors"
cat <<END
demo.sh: to try next:
    $render examples/data/caffeine.xyz --style paper --bonds=1.6 -o caffeine.png
    $render YOUR_RUN.lammpstrj -o frame_%04d.png        or .xyz, .gro, .xtc, .pdb, .dcd and others; --help tells
    scripts/test.sh                                     installs and builds all the rest, fast: meshes, tests
END

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    if grep -q 'Left out: cgt-view' "$log"; then
        echo "demo.sh: cgt-view, the window, needs SDL 2: apt-get install libsdl2-dev, then once more"
    else
        logged cmake --build build/demo --target cgt-view -j "$jobs"
        echo "demo.sh: build/demo/bin/cgt-view $run: h tells its keys"
        build/demo/bin/cgt-view $run
    fi
fi
