#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# abi.sh [--write]
# Compares the binary interface of the public headers with the descriptions of releases in tests/repository/abi, by
# abidiff. Where there is one of this version's soname, what breaks it fails: that needs a new soname, which a minor
# version before 1.0.0 is. Where there is none, the version is not released yet: what differs from the last release is
# listed, and may. --write, at a release, describes this version.
# The description is of a library of empty functions, made from the headers: the test `symbols` checks that the real ones
# export just these, and no debug information of theirs is needed. Left out are <cgt/research.h>, which may change at
# any time (docs/stability.md), and <cgt/mpi.h>, whose types are those of the MPI at hand.
# Exit code 0: nothing breaks, 1: something does, 2: no abidiff, or it cannot run.
set -euo pipefail
source=$(cd "$(dirname "$0")/.." && pwd)
descriptions=$source/tests/repository/abi
cc=${CC:-cc}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v abidiff >/dev/null || { echo "abi.sh: no abidiff: apt-get install abigail-tools" >&2; exit 2; }

# describe INCLUDE_DIR FILE: the description of all its headers together.
describe() {
    local header
    for header in cgt all_hits bounces picture figure trajectory; do
        [ ! -f "$1/cgt/$header.h" ] || echo "#include <cgt/$header.h>"
    done >"$work/headers.c"
    "$cc" -E -P -DCGT_SHARED -I"$1" "$work/headers.c" | tr '\n' ' ' | awk -v RS=';' '
        { # a statement: braces may hold semicolons
            text = text $0
            opened += gsub(/{/, "{") - gsub(/}/, "}")
            if (opened) { text = text ";"; next }
            if (text !~ /typedef/ && text ~ /visibility.*[ *]cgt_[a-z0-9_]+\(/) print text " { __builtin_trap(); }"
            text = ""
        }' | cat "$work/headers.c" - >"$work/cgt.c"
    (cd "$work" && "$cc" -DCGT_SHARED -g -fPIC -shared -w -I"$1" -o libcgt.so cgt.c)
    # types are named once; numbers of types and lines would change with every edit
    abidw --no-corpus-path --no-comp-dir-path --no-show-locs --type-id-style hash --headers-dir "$1" \
        --drop-private-types "$work/libcgt.so" >"$2"
}

version=$(sed -nE 's/^#define CGT_VERSION_STRING "([0-9.]+)"$/\1/p' "$source/include/cgt/version.h")
case $version in 0.*) soname=${version%.*} ;; *) soname=${version%%.*} ;; esac
describe "$source/include" "$work/now.abi"
if [ "${1:-}" = --write ]; then
    mkdir -p "$descriptions"
    cp "$work/now.abi" "$descriptions/$soname.abi"
    echo "abi.sh: $soname is described"
    exit
fi
[ $# -eq 0 ] || { sed -nE 's/^# (abi\.sh .*)/usage: \1/p' "$0" >&2; exit 2; }
last=$(ls "$descriptions" | sed 's/\.abi$//' | sort -V | tail -n 1)
[ -n "$last" ] || { echo "abi.sh: no description in $descriptions" >&2; exit 2; }

# abidiff sets bits 0 and 1 where it cannot run, 2 where something changed; structs are the caller's, so that breaks.
status=0
abidiff --no-added-syms "$descriptions/$last.abi" "$work/now.abi" >"$work/report" || status=$?
[ $((status & 3)) -eq 0 ] || { cat "$work/report" >&2; exit 2; }
if [ $status -eq 0 ]; then
    echo "abi.sh: $version keeps what $last has"
elif [ "$last" = "$soname" ]; then
    cat "$work/report"
    echo "FAILED: this breaks programs that were linked with $last: undo it, or raise include/cgt/version.h"
    exit 1
else
    echo "abi.sh: $version is not released yet, and its soname not that of $last, the last release: it may differ"
    head -n 2 "$work/report"
fi
