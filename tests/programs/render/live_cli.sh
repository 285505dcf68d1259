#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Runs the blocks of commands of docs/guide/while_it_runs.md as they stand, in a folder with the files that it names.
# Each has to make pictures, none of them empty. Blocks are left out without LAMMPS, ffmpeg, MPI, or Python's package,
# which the test `python` has.
#   live_cli.sh PROGRAMS_DIR DATA_DIR GUIDE
set -eu
programs=$1 data=$2 guide=$3
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
mkdir "$tmp/work"
cp "$data/melt.in" "$tmp/work"
PATH=$programs:$PATH
export PATH
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export TMPDIR=$tmp # the length of sockets' names
awk -v to="$tmp/block" '/^```sh$/ { n++; file = to n; next } /^```$/ { file = "" } file { print >file }' "$guide"
ran=0 left=0
for block in "$tmp"/block*; do
    missing=
    for program in lmp ffmpeg lammps-live mpi-balls python3; do
        grep -q "^$program \|| $program \|^mpirun .* $program " "$block" || continue
        command -v "$program" >/dev/null 2>&1 || missing=$program
    done
    case $(cat "$block") in python3*) missing=cgt ;; esac
    if [ -n "$missing" ]; then
        echo "left out, no $missing: $(tail -n 1 "$block")"
        left=$((left + 1))
        continue
    fi
    (cd "$tmp/work" && timeout 100 sh -e "$block") >"$tmp/log" 2>&1 || {
        cat "$tmp/log"
        echo "failed: $(cat "$block")"
        exit 1
    }
    ran=$((ran + 1))
done
cd "$tmp/work"
[ -z "$(find . -size 0 ! -type p)" ] || { find . -size 0; exit 1; }
if command -v lmp >/dev/null 2>&1; then
    [ "$(find . -name 'follow_*.png' | wc -l)" -eq 21 ] # a frame each 20 steps, the first one included
    [ "$(find . -name 'pipe_*.png' | wc -l)" -eq 11 ]
fi
if command -v mpi-balls >/dev/null 2>&1; then
    [ -e balls_1.png ]
fi
[ "$ran" -ge 1 ] && [ $((ran + left)) -eq 6 ]
echo "$ran blocks, $left left out"
