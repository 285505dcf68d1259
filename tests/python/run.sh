#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# run.sh SOURCE_DIR BUILD_DIR CMAKE CC
# Installs library and package in a folder of its own, with and without a compiler, as pip does without network. Runs
# tests and docstrings both ways, then each example, which must write its pictures. CGT_PYTHON names another Python than
# Debian's.
set -eu
source=$1 build=$2 cmake=$3 cc=$4
. "$source/tests/python/find_python.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --component library --prefix "$work/prefix" >"$work/log" || { cat "$work/log"; exit 1; }
export CGT_PREFIX="$work/prefix" PYTHONDONTWRITEBYTECODE=1 CC="$cc"

# install MODE: the package in $work/MODE
cp -r "$source/python" "$work/source"
find "$work/source" | sort >"$work/files"
install() {
    "$python" -m pip install -q --no-index --no-build-isolation --no-deps --root-user-action=ignore \
        --target "$work/$1" "$work/source"
}

install linked
CGT_ABI=1 install loaded
[ -e "$work/loaded/cgt/_definitions.py" ]
! [ -e "$work/linked/cgt/_definitions.py" ] || { echo "linked: made without the compiler"; exit 1; }
[ -z "$(find "$work/loaded/cgt" -name '*.so')" ] || { echo "loaded: of the install before it"; exit 1; }
find "$work/source" | sort | diff "$work/files" - || { echo "installing leaves files in the source tree"; exit 1; }
cd "$work"
set --
for mode in linked loaded; do
    echo "== $mode"
    CGT_LIBRARY="$work/prefix/lib/libcgt.so"
    [ -e "$CGT_LIBRARY" ] || CGT_LIBRARY=$(find "$work/prefix" -name libcgt.so)
    export CGT_LIBRARY PYTHONPATH="$work/$mode"
    # abuse.sh runs that file; types are the same
    [ $mode = linked ] || set -- --ignore="$source/python/tests/test_abuse.py" -k 'not type_checker and not have_the_types'
    "$python" -m pytest -q --no-header -p no:cacheprovider "$@" "$source/python/tests"
    "$python" -m pytest -q --no-header -p no:cacheprovider --doctest-modules \
        --doctest-ignore-import-errors --pyargs cgt
done
if [ -e "$build/tests/figure_raw" ] && [ -e "$build/bin/cgt-render" ]; then
    echo "== the bytes of cgt-render"
    CGT_FIGURE_PYTHON=$python PYTHONPATH="$work/linked" sh "$source/tests/figure/doors.sh" "$build/bin/cgt-render" \
        "$source/examples/data" "$build/tests/figure_raw"
fi
echo "== what is missing has a sentence"
CGT_LIBRARY="$work/no/libcgt.so" "$python" -c 'import cgt' 2>"$work/error" && exit 1
grep -q 'set CGT_LIBRARY to the path of libcgt.so' "$work/error"
(cd "$work/source" && CGT_PREFIX="$work/no" "$python" setup.py --version) >"$work/error" 2>&1 && exit 1
grep -q 'install libcgt' "$work/error"

echo "== examples"
mkdir "$work/pictures"
PYTHONPATH="$work/linked"
for example in "$source"/python/examples/*.py; do
    name=$(basename "$example" .py)
    [ "$name" != png ] || continue
    status=0
    "$python" "$example" "$work/pictures" || status=$?
    [ $status -ne 77 ] || continue
    [ $status -eq 0 ] || exit 1
    count=0
    for picture in "$work/pictures/$name"*.png; do
        [ "$(wc -c <"$picture")" -gt 900 ]
        count=$((count + 1))
    done
    echo "$name: $count"
    [ "$name" != lammps_live ] ||
        "$python" "$example" "$work/pictures" "$source/examples/data/chains.in" 40 20 | tee "$work/bonds" |
        grep -qx 'step 40: 1215 bonds' || { cat "$work/bonds"; exit 1; }
done
