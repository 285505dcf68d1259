#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_includes.sh SOURCE_DIR
# Allowed includes between folders: include <- simd <- src <- backends. picture/ and mpi/ see the public API, figure/
# also how picture/ fits cameras. Programs see the public API, figure/ and each other's common parts; one file of
# cgt-render sees the simulated Cell's pictures, cgt-bench the libraries' inside, and the hard cases and the oracle of the tests, and Embree; tests see
# all. The library includes only C and POSIX headers from outside. Within src and in backends/cell, a table lists the
# folders that a folder may include; no two include each other.
set -eu
cd "$1"
bad=$(mktemp)
trap 'rm -f "$bad"' EXIT

standard='assert|ctype|errno|fenv|float|inttypes|iso646|limits|locale|math|setjmp|signal|stdalign|stdarg|stdatomic'
standard="$standard|stdbool|stddef|stdint|stdio|stdlib|stdnoreturn|string|time"
posix='pthread|sched|unistd|fcntl|strings|sys/[a-z]+|malloc|poll' # malloc.h: Windows, Emscripten
intrinsics='[a-z]mmintrin|immintrin|arm_neon|wasm_simd128|altivec'

# check FOLDER "folders that its quoted includes may lie in" "angled includes that it may have"
check() {
    [ -d "$1" ] || return 0
    find "$1" -name '*.[ch]' -o -name '*.cpp' | LC_ALL=C sort |
        xargs awk -v top="$1" -v folders="$2" -v angled="^($3)\$" '
        function exists(path,   line, there) {
            there = (getline line <path) >= 0
            close(path)
            return there
        }
        # the path without "." and "..", or "" where it leaves the tree
        function plain(path,   part, n, i, out, count) {
            n = split(path, part, "/")
            count = 0
            for (i = 1; i <= n; i++) {
                if (part[i] == "..") { if (count-- == 0) return "" }
                else if (part[i] != "." && part[i] != "") out[++count] = part[i]
            }
            path = out[1]
            for (i = 2; i <= count; i++) path = path "/" out[i]
            return path
        }
        # the file that a quoted include finds lies in one of the folders
        function allowed(name, file,   n, i, folder, path, base) {
            sub(/[^\/]*$/, "", file)
            n = split(file " " folders, folder, " ")
            for (i = 1; i <= n; i++) {
                path = plain(folder[i] "/" name)
                if (path != "" && exists(path)) {
                    base = path
                    sub(/\/.*/, "", base)
                    return index(" " folders " ", " " base " ") > 0
                }
            }
            return 0
        }
        /^[ \t]*#[ \t]*include/ {
            text = $0
            good = 0
            if (match(text, /"[^"]+"/)) good = allowed(substr(text, RSTART + 1, RLENGTH - 2), FILENAME)
            else if (match(text, /<[^>]+>/)) good = substr(text, RSTART + 1, RLENGTH - 2) ~ angled
            if (!good) print FILENAME ":" FNR ": " top "/ may not have this: " text
        }' >>"$bad"
}

check include "" "cgt/[a-z_]+\\.h|($standard|mpi)\\.h"
check simd "simd" "cgt/[a-z_]+\\.h|($standard|$intrinsics)\\.h|spu_(intrinsics|mfcio)\\.h"
check src "src simd" "cgt/[a-z_]+\\.h|($standard|$posix)\\.h"
check backends "backends src simd" "cgt/[a-z_]+\\.h|($standard|$posix)\\.h"
check picture "picture" "cgt/[a-z_]+\\.h|($standard|pthread)\\.h"
check figure "figure picture" "cgt/[a-z_]+\\.h|($standard|pthread)\\.h|(fontconfig/fontconfig|freetype/freetype)\\.h"
check mpi "mpi" "cgt/(mpi|picture)\\.h|($standard|sched|mpi)\\.h"
check examples "examples programs" "cgt/[a-z_]+\\.h|($standard|getopt|lammps/library|mpi)\\.h"
check programs "programs backends picture figure" \
    "cgt/(bounces|cgt|color|figure|picture|research|trajectory|version)\\.h|[a-z]+|($standard|$posix|dlfcn|emscripten|spawn|direct|io|windows)\\.h|freetype/freetype\\.h|OpenImageIO/[a-z]+\\.h|tiny_gltf\\.h|assimp/[a-z]+\\.h|archive(_entry)?\\.h|isa-l/[a-z_]+\\.h|(libdeflate|zlib|mpi)\\.h|SDL2/SDL\\.h|imgui\\.h"
check bench "bench backends picture figure src simd programs tests" \
    "cgt/[a-z_]+\\.h|($standard|$posix)\\.h|embree3/rtcore\\.h"

# The layers of src, the calls first: each folder, and the other folders that it may include.
layers='
trace: builders/bvh core dispatch query scene trace/bands trace/order
trace/bands: builders/bvh core dispatch exact query scene
trace/bounce: dispatch exact exact/integer model query scene trace
trace/order: core dispatch query scene
builders: builders/bands core dispatch model scene
builders/bands: core exact scene
builders/bvh: builders builders/order core dispatch scene
builders/grid: builders builders/order core dispatch model
builders/order: builders core dispatch model scene
scene: core model
dispatch: core model query
query: exact model
exact: exact/integer model
exact/integer: model
model: core
core:
papers/build: builders core exact model papers/model scene
papers/build/bih: builders core papers/build papers/model
papers/build/kd: builders core model papers/build papers/model
papers/build/kd/split: papers/build papers/build/kd
papers/build/queue_grid: builders papers/build papers/kernel papers/model
papers/model: core exact/integer model
papers/kernel: dispatch kernel kernel/packet kernel/moved papers/model
papers/kernel/bih: kernel kernel/packet kernel/primitive papers/kernel papers/kernel/kd papers/model
papers/kernel/kd: kernel/packet kernel/primitive papers/kernel papers/kernel/packet papers/model
papers/kernel/grid: exact kernel kernel/builders kernel/packet kernel/primitive papers/kernel papers/kernel/packet papers/model
papers/kernel/packet: kernel/packet kernel/primitive model papers/kernel
kernel/entry: dispatch exact kernel/bvh kernel/light kernel/packet kernel/primitive kernel/resolve query
kernel/tile_frame: kernel/packet kernel/primitive kernel/resolve kernel/tile kernel/tile_draw query
kernel/tile_draw: exact exact/integer kernel/primitive kernel/resolve kernel/tile
kernel/moved: exact kernel/bvh kernel/primitive model query
kernel/light: dispatch kernel kernel/bvh kernel/packet kernel/primitive kernel/tile kernel/tile_draw query
kernel/tile: kernel/primitive
kernel/stream: exact kernel kernel/bvh kernel/packet kernel/primitive query
kernel/builders/bvh: core dispatch kernel/builders kernel/bvh kernel/primitive model
kernel/builders: dispatch exact kernel kernel/primitive model
kernel/bvh: dispatch exact kernel kernel/packet kernel/primitive model query
kernel/resolve: exact kernel/packet kernel/primitive
kernel/primitive: dispatch exact kernel kernel/packet model
kernel/packet: dispatch kernel query
kernel:
'
# The same for the simulated Cell, as its files write their includes: from backends on.
cell_layers='
cell/ppe/kd: cell/image cell/machine cell/ppe cell/spu
cell/ppe/grid: cell/image cell/machine cell/ppe cell/spu
cell/ppe: cell/image cell/machine cell/spu
cell/programs/kd: cell/image cell/machine cell/programs
cell/programs/grid: cell/image cell/machine cell/programs
cell/programs: cell/image cell/machine
cell/image:
cell/machine: cell/mfc cell/spu
cell/mfc/dma: cell/mfc
cell/mfc: cell/spu
cell/spu/execute: cell/spu cell/spu/isa cell/spu/timing
cell/spu/store: cell/spu cell/spu/isa cell/spu/timing
cell/spu/timing: cell/spu cell/spu/isa
cell/spu/isa: cell/spu cell/spu/isa/rows
cell/spu/isa/rows:
cell/spu:
'

# check_layers FOLDER TABLE
check_layers() {
    find "$1" -name '*.[ch]' | LC_ALL=C sort | xargs awk -v top="$1" -v layers="$2" '
        function exists(path,   line, there) {
            there = (getline line <path) >= 0
            close(path)
            return there
        }
        BEGIN {
            n = split(layers, line, "\n")
            for (i = 1; i <= n; i++) {
                m = split(line[i], word, "[: ]+")
                known[word[1]]
                for (k = 2; k <= m; k++) if (word[k] != "") allowed[word[1], word[k]]
            }
        }
        /^[ \t]*#[ \t]*include "/ {
            split($0, quoted, "\"")
            if (!exists(top "/" quoted[2])) next # of a layer below
            from = FILENAME
            from = substr(from, length(top) + 2)
            sub(/\/[^\/]*$/, "", from)
            to = quoted[2]
            sub(/\/[^\/]*$/, "", to)
            if (from == to) next
            if (!((from, to) in allowed)) print FILENAME ":" FNR ": " from "/ may not include " to "/"
            pair[from, to] = FILENAME
        }
        END {
            for (p in pair) {
                split(p, folder, SUBSEP)
                if ((folder[2], folder[1]) in pair && folder[1] < folder[2])
                    print folder[1] "/ and " folder[2] "/ include each other: " pair[p] ", " pair[folder[2], folder[1]]
            }
        }' >>"$bad"
}
check_layers src "$layers"
check_layers backends "$cell_layers"

# Of the simulated Cell, programs see what makes pictures, in one file.
grep -rnE '#[ \t]*include "cell/' programs --include='*.[ch]' |
    grep -vE '^programs/render/render_cell\.c:[0-9]+:#include "cell/(ppe/grid/grid_picture|programs/grid/spe_grid)\.h"' |
    sed 's/$/  <- the Cell, outside render_cell.c/' >>"$bad" || true

# Of libcgt-picture's inside, programs see in one file tiles; figure/ sees how cameras are fitted.
grep -rnE '#[ \t]*include "(color/srgb|draw/|whitted/)|#[ \t]*include "picture_' programs figure --include='*.[ch]' |
    grep -vE '^programs/render/render_cell\.c:[0-9]+:#include "picture_tiles\.h"' |
    sed 's/$/  <- the inside of libcgt-picture/' >>"$bad" || true

# What one system alone has stands in one folder of the programs and in a few files of the library.
grep -rnE '\b(_WIN32|__linux__|pipe2|fopencookie|sched_getaffinity|F_SETPIPE_SZ)\b|/proc/|<windows\.h>' \
    include simd src backends picture figure programs bench examples --include='*.[ch]' |
    grep -vE '^(programs/system/|backends/(host_threads\.c|cell/machine/spufs)|src/core/memory\.[ch]|simd/(spu_host|float_mode)\.h)' |
    grep -vE '^bench/common/bench_(clones\.h|table\.c)' |
    sed 's/$/  <- one system alone, outside programs\/system/' >>"$bad" || true

# Only simd names an instruction set.
grep -rnE '\b(_mm(256|512)?_[a-z0-9]+_|v[a-z0-9]+q_(lane_|n_)?[fsu](8|16|32|64)\b)' include src backends programs examples bench \
    --include='*.[ch]' | sed 's/$/  <- an intrinsic outside simd/' >>"$bad" || true

if [ -s "$bad" ]; then
    cat "$bad"
    exit 1
fi
files=$(find include simd src backends figure programs examples bench -name '*.[ch]' | wc -l)
[ "$files" -gt 10 ] || { echo "only $files files found in $1"; exit 1; }
echo "$files files include what they may"
