#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Pictures by libcgt-mpi have the bytes of one process, for any number of ranks and leaders, any distribution, and any
# size of the rounds in which machines exchange what they have; mistakes are told on all ranks; a rank that dies ends
# the job at once.
#   mpi_pictures.sh MPI_PICTURES MPI_MISTAKES EXAMPLE
pictures=$1 mistakes=$2 example=$3
command -v mpirun >/dev/null 2>&1 || { echo "no mpirun"; exit 77; }
mpirun --version 2>/dev/null | grep -q 'Open MPI' || { echo "not Open MPI: its options are not known here"; exit 77; }
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 # containers' only user
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"           # MPI's own
export TMPDIR=$tmp                                               # sockets' names have a limit of length
fail() { echo "FAILED: $1"; exit 1; }
# ranks N COMMAND...
ranks() {
    n=$1
    shift
    timeout 100 mpirun --oversubscribe -n "$n" "$@" </dev/null
}

# Plain, all lights and lines, mirrors and glass, by one process.
for shading in 0 1 2; do
    "$pictures" one $shading "$tmp/one$shading" || fail "one process, shading $shading"
done
# compare RANKS WAY SHADING RANKS_PER_LEADER EXCHANGE_BYTES DEAL
compare() {
    ranks "$1" "$pictures" "$2" "$3" "$tmp/many" "$4" "$5" "$6" >"$tmp/out" 2>&1 || { cat "$tmp/out"; fail "$*"; }
    cmp "$tmp/one$3" "$tmp/many" || fail "$*: other bytes"
    rm "$tmp/many"
}
compare 1 ids 1 0 0 1
compare 2 deal 0 0 0 0
compare 3 ids 2 1 20000 3
compare 5 ids 1 2 20000 1
compare 8 ids 1 3 0 3
compare 8 rows 0 1 50000 2
compare 3 rows 2 2 0 1
compare 5 deal 1 0 20000 2

for n in 1 2 3; do
    ranks $n "$mistakes" >"$tmp/out" 2>&1 || { cat "$tmp/out"; fail "mistakes of $n ranks"; }
done

# The job ends, and says who died, without waiting for it.
ranks 3 "$pictures" die 1 "$tmp/dead" 1 0 1 >"$tmp/out" 2>&1
code=$?
[ $code -ne 0 ] && [ $code -ne 124 ] || fail "a rank that dies: exit code $code"
grep -q 'rank 2.*signal 9' "$tmp/out" || { cat "$tmp/out"; fail "nobody says which rank has died"; }

# The example draws the same for any number of ranks.
for n in 1 3; do
    (cd "$tmp" && ranks $n "$example" 2 "balls$n") >"$tmp/out" 2>&1 || { cat "$tmp/out"; fail "the example, $n ranks"; }
done
cmp "$tmp/balls1_1.png" "$tmp/balls3_1.png" || fail "the example: other bytes"
cmp -s "$tmp/balls1_0.png" "$tmp/balls1_1.png" && fail "nothing moves in the example"
exit 0
