#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# fuzz.sh [SECONDS] [TARGET]...
# SECONDS: 600, of CPU; TARGET: scene, hits, cliffs, cell, cell_kd, spe, trajectory, formats, mesh; without any: all.
# Builds the fuzz targets of tests/fuzz with clang, libFuzzer and the address and undefined-behaviour sanitizers in
# build/fuzz, and runs one after another for the given time each, from the corpus of the repository. What is found new
# goes to build/fuzz/corpus; an input that fails goes to build/fuzz/findings, ends the run with exit code 1, and is tried
# first the next time, until it is right or removed. What a target was run for is kept in build/fuzz/TARGET.seconds: a run
# that was stopped goes on, one of other code starts anew.
#   again       build/fuzz/fuzz/fuzzer_scene build/fuzz/findings/scene-crash-...
#   smaller     build/fuzz/fuzz/fuzzer_scene -minimize_crash=1 -runs=10000 build/fuzz/findings/scene-crash-...
#   to keep     build/fuzz/fuzz/fuzzer_scene -merge=1 tests/fuzz/corpus/scene build/fuzz/corpus/scene
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-600}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "fuzz.sh: '$seconds' is no number of seconds" >&2; exit 2; }
shift $(($# > 0 ? 1 : 0))
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(scene hits cliffs cell cell_kd spe trajectory formats mesh)
for target in "${targets[@]}"; do
    [ -d "tests/fuzz/corpus/$target" ] || { echo "fuzz.sh: unknown target '$target'" >&2; exit 2; }
done

scripts/dependencies.sh build render tests clang
build=build/fuzz
kernels="" # all rows of the variant table, or few where no ray is traced
[[ " ${targets[*]} " =~ \ (scene|hits|cliffs|cell|cell_kd|spe)\  ]] || kernels=neon
cmake -S . -B $build -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
    "-DCMAKE_C_FLAGS_DEBUG=-O2 -g" "-DCGT_SANITIZE=address,undefined" -DCGT_BUILD_FUZZERS=ON -DCGT_BUILD_TESTS=ON \
    "-DCGT_ONLY_VARIANTS=$kernels" -DCGT_BUILD_MESHES=ON -DCGT_BUILD_ORACLE=OFF -DCGT_BUILD_RENDER=OFF -DCGT_BUILD_BENCH=OFF
cmake --build $build -j "$(nproc)" --target "${targets[@]/#/fuzzer_}"
mkdir -p $build/findings
[ -n "${TMPDIR:-}" ] || [ ! -w /dev/shm ] || export TMPDIR=/dev/shm # the readers' targets write files all the time
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1

# Sets `used` to the CPU seconds of this script's children that have ended; not by a subshell, which has none.
count_seconds() {
    times >$build/times
    used=$(sed -n 2p $build/times | awk '{ for (k = 1; k <= 2; k++) { split($k, t, /[ms]/); sum += 60 * t[1] + t[2] } }
                                         END { printf "%d\n", sum }')
}

core=$(scripts/code_hash.sh core) readers=$(scripts/code_hash.sh readers)
slice=300 # seconds of a run of the fuzzer, after which the account is written
status=0
for target in "${targets[@]}"; do
    found=$build/corpus/$target account=$build/$target.seconds
    case $target in trajectory|formats|mesh) revision=$readers ;; *) revision=$core ;; esac
    mkdir -p "$found"
    spent=0 of='' runs=0
    [ ! -f "$account" ] || read -r spent of runs <"$account"
    [ "$of" = "$revision" ] && [ "$spent" -lt "$seconds" ] || spent=0 runs=0
    for finding in "$build/findings/$target"-*; do
        if [ -e "$finding" ] && ! $build/fuzz/fuzzer_"$target" -timeout=20 -rss_limit_mb=2048 "$finding" \
            >"$build/$target.log" 2>&1; then
            tail -n 60 "$build/$target.log"
            echo "$target: $finding fails"
            status=1
            continue 2
        fi
    done
    echo "==== $target: $((seconds - spent)) s of CPU"
    while [ "$spent" -lt "$seconds" ]; do
        left=$((seconds - spent))
        count_seconds
        before=$used
        options=(-max_total_time=$((left < slice ? left : slice)) -max_len=2048 -timeout=20 -rss_limit_mb=2048
                 -print_final_stats=1 -artifact_prefix="$build/findings/$target-")
        [ ! -f "tests/fuzz/$target.dict" ] || options+=(-dict="tests/fuzz/$target.dict")
        if ! $build/fuzz/fuzzer_"$target" "${options[@]}" "$found" "tests/fuzz/corpus/$target" \
            >"$build/$target.log" 2>&1; then
            status=1
            grep -vE '^#[0-9]|^[[:space:]]*NEW_FUNC' "$build/$target.log" | tail -n 60
            break
        fi
        count_seconds
        spent=$((spent + used - before))
        runs=$((runs + $(sed -nE 's/^stat::number_of_executed_units: *//p' "$build/$target.log")))
        echo "$spent $revision $runs" >"$account"
    done
    echo "$target: $runs inputs in $spent s of CPU"
done
[ $status -ne 0 ] || echo "fuzz.sh: nothing found"
exit $status
