#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# abuse.sh SOURCE_DIR LIBRARY_DIR TARGET
# Runs python/tests/test_abuse.py over the libraries of the build, with a package that loads them: nothing is installed.
# TARGET builds them; its name is here for scripts/mutations.sh.
set -eu
source=$1 libraries=$2
. "$source/tests/python/find_python.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/prefix/lib" "$work/prefix/share/cgt" "$work/site"
ln -s "$libraries"/*.so* "$work/prefix/lib/"
ln -s "$libraries"/*.cdef "$work/prefix/share/cgt/"
cp -r "$source/python/cgt" "$work/site/cgt"
export CGT_PREFIX="$work/prefix" CGT_ABI=1 PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$source/python"
"$python" - "$work/site/cgt" <<'END'
import sys
import definitions

for part in definitions.parts():
    ffi = getattr(definitions, part.split(":")[1])()
    ffi.emit_python_code(f"{sys.argv[1]}/{ffi._assigned_source[0].split('.')[1]}.py")
END
export CGT_LIBRARY="$libraries/libcgt.so" PYTHONPATH="$work/site"
cd "$work"
"$python" -m pytest -q --no-header -p no:cacheprovider "$source/python/tests/test_abuse.py"
