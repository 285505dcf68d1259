#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# wheel.sh SOURCE_DIR CC
# One command makes a package that holds the library, without network: a distribution of the source, from it a wheel, and
# the wheel installed elsewhere, where neither the source nor an installed libcgt is. The top of the tree makes the same
# distribution as the folder python. What is missing has a sentence.
set -eu
source=$1 cc=$2
. "$source/tests/python/find_python.sh" # sets python
command -v cmake >/dev/null 2>&1 || { echo "no cmake"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset CGT_PREFIX CGT_LIBRARY PYTHONPATH
export CC="$cc" PYTHONDONTWRITEBYTECODE=1 CGT_CMAKE="-DCGT_ONLY_VARIANTS=sse -DCMAKE_C_FLAGS_RELEASE=-O0" CCACHE_BASEDIR="$work" CCACHE_NOHASHDIR=1

mkdir "$work/temporary" "$work/tree"
export TMPDIR="$work/temporary" # builds below CCACHE_BASEDIR: compiler results are found again
for name in CMakeLists.txt LICENSE pyproject.toml cmake include simd src backends figure picture mpi programs python; do
    cp -r "$source/$name" "$work/tree/"
done
find "$work/tree" | sort >"$work/files"
(cd "$work/tree/python" && "$python" setup.py -q sdist -d "$work/dist") >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
(cd "$work/tree" && PYTHONPATH=python "$python" -c 'import backend, sys; backend.build_sdist(sys.argv[1])' "$work/top") \
    >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
for folder in dist top; do
    tar -tzf "$work/$folder"/cgt-*.tar.gz | sort >"$work/$folder.files"
done
diff "$work/dist.files" "$work/top.files"
find "$work/tree" | sort | diff "$work/files" - || { echo "a distribution leaves files in the source tree"; exit 1; }
rm -r "$work/tree"
tar -xzf "$work"/dist/cgt-*.tar.gz -C "$work"
cd "$work"/cgt-*
"$python" -m pip wheel -q --no-index --no-build-isolation --no-deps -w "$work/wheels" . >"$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
cd "$work"

echo "== what is missing has a sentence"
mkdir bin
for tool in "$python" sh ld as; do
    ln -s "$(command -v "$tool")" bin/
done
lacks() {
    (cd "$work"/cgt-* && PATH="$work/bin" CC=cc "$python" setup.py build) >"$work/error" 2>&1 && exit 1
    tail -n 1 "$work/error" | grep -q "cgt: no $1 to build libcgt with: install it (Debian: apt-get install $2)" ||
        { cat "$work/error"; exit 1; }
}
lacks cc gcc
ln -s "$(command -v "$cc")" bin/cc
lacks cmake cmake
ln -s "$(command -v cmake)" bin/
lacks make make
rm -r "$work"/cgt-*

echo "== the wheel, elsewhere"
set -- wheels/cgt-*-cp39-abi3-linux_*.whl
[ $# -eq 1 ] && [ -e "$1" ] || { ls wheels; exit 1; }
echo "$1"
"$python" -m pip install -q --no-index --no-deps --root-user-action=ignore --target "$work/site" wheels/*.whl
rm -r wheels
env -i PATH=/usr/bin:/bin PYTHONPATH="$work/site" "$python" - "$work/site" <<'END'
import pathlib
import sys

import cgt

picture = cgt.show([[0, 0, 0], [1, 0, 0]], 0.6, ["red", "gold"], size=(64, 48), window=False)
assert len({tuple(p) for p in picture.pixels.reshape(-1, 3)}) > 9
path = pathlib.Path(sys.argv[1]) / "two.xyz"
path.write_text("1\n\nO 0 0 0\n" * 2)
assert len(cgt.read(path)) == 2
loaded = {line.split()[-1] for line in open("/proc/self/maps") if "libcgt" in line}
assert len(loaded) == 4 and all(file.startswith(sys.argv[1]) for file in loaded), loaded
END
