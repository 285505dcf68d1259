#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Runs the blocks of commands of docs/guide/while_it_runs.md as they stand, in a folder with the files that it names.
# Each has to make pictures, none of them empty. Blocks are left out without LAMMPS, ffmpeg, MPI, or Python's package,
# which the test `python` has. Then lammps-live draws a chain that crosses its box.
#   live_cli.sh PROGRAMS_DIR DATA_DIR GUIDE
set -eu
programs=$1 data=$2 guide=$3
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
mkdir "$tmp/work"
cp "$data/melt.in" "$data/chains.in" "$tmp/work"
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
[ $((ran + left)) -eq 7 ]
[ "$ran" -ge 1 ] || exit 77

if command -v lammps-live >/dev/null 2>&1; then
    # Four beads, two at either side of the boundary: three bonds as long as they should be, and nothing between.
    cat >chain.in <<'END'
atom_style bond
units lj
region box block 0 20 0 20 0 20
create_box 1 box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 4
create_atoms 1 single 18.0 10 10
create_atoms 1 single 19.0 10 10
create_atoms 1 single 0.2 10 10
create_atoms 1 single 1.2 10 10
mass * 1.0
bond_style harmonic
bond_coeff 1 30.0 1.1
pair_style zero 3.0
pair_coeff * *
special_bonds lj 0 1 1
create_bonds many all all 1 0.9 1.3
fix 1 all nve
timestep 0.0001
END
    lammps-live chain.in 10 5 480 360 >chain.ppm 2>chain.txt
    grep -qx '3 bonds, the longest 1.2' chain.txt || { cat chain.txt; exit 1; }
    tail -c $((480 * 360 * 3)) chain.ppm | od -An -v -tu1 -w1440 | awk '
        { for (i = 1; i <= NF; i++) if ($i != 245) i > 600 && i <= 840 ? between++ : beads++ }
        END { print beads + 0, "bytes of beads,", between + 0, "between"; exit !(beads > 100 && !between) }'
    echo 'nonsense' >wrong.in
    lammps-live wrong.in 10 5 >wrong.ppm 2>wrong.txt && exit 1
    grep -q 'the end of log.lammps tells why' wrong.txt
    grep -q 'Unknown command: nonsense' log.lammps
fi
echo "$ran blocks, $left left out"
