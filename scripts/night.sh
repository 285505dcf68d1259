#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# night.sh [--left | --row | PART...]
# Runs what is too long for each change, part by part, and keeps account of it in build/night: a run that was stopped
# goes on where it was, as long as the files are the same that the part tests: the texts are the suites' alone; seeds and
# most fuzzers ask for what traces (scripts/code_hash.sh). So does another machine, after the rows of
# docs/reports/nights.md. Without arguments: all parts that are left.
#   suite-NAME     scripts/test.sh --whole NAME, for each suite of each platform
#   cpu-NAMES      the tests of release with CGT_DISABLE_CPU=NAMES: what a CPU without them runs
#   cpus-N         the tests of release on a machine that claims to have N processors (tests/night/cpus.c)
#   bugs           scripts/mutations.sh: every planted bug
#   seeds          build/release/tests/hits: all profiles again and again, each time by another seed (SEEDS_SECONDS=7200)
#   fuzz-TARGET    scripts/fuzz.sh: an hour of CPU for each target (FUZZ_SECONDS=3600)
#   soak           build/release/tests/soak: pictures for hours (SOAK_SECONDS=7200)
#   --left         prints the parts that are left
#   --row          appends what was run to docs/reports/nights.md, a row
# build/night/PART.log has what a part printed, build/night/parts.tsv what came out: passed, failed, skipped (nothing of it
# can run here) or short (of fewer seconds than above). Exit code 1: some part failed.
set -euo pipefail
cd "$(dirname "$0")/.."
night=build/night account=build/night/parts.tsv table=docs/reports/nights.md
fuzz_seconds=${FUZZ_SECONDS:-3600} soak_seconds=${SOAK_SECONDS:-7200}
seeds_seconds=${SEEDS_SECONDS:-7200}

suites=(release clang native sanitize tsan aarch64 ppc64 spu i686 armhf riscv64 s390x musl windows wasm web packages)
targets=(scene hits cliffs cell cell_kd spe trajectory formats mesh)
parts=("${suites[@]/#/suite-}" cpu-avx512 "cpu-avx512,avx2" cpus-4 cpus-64 bugs seeds "${targets[@]/#/fuzz-}" soak)

[ -z "$(git status --porcelain)" ] || { echo "night.sh: commit first: a night is of a revision" >&2; exit 2; }
revision=$(git log -1 --format=%H -- . ":!$table") # the row of a night is no other revision
mkdir -p $night
touch $account

# Of what files a part's account is.
tree=$(git ls-tree -r HEAD -- . | grep -v "$table" | sha256sum | cut -c 1-12)
code=$(scripts/code_hash.sh) core=$(scripts/code_hash.sh core) readers=$(scripts/code_hash.sh readers)
files_of() {
    case $1 in
    suite-*) echo "$tree" ;;
    fuzz-trajectory|fuzz-formats|fuzz-mesh) echo "$readers" ;;
    seeds|fuzz-*) echo "$core" ;;
    *) echo "$code" ;;
    esac
}

# Files that change meanwhile would be accounted as those of the begin.
is_as_begun() {
    [ -z "$(git status --porcelain -- . ":!$table")" ] && [ "$(git log -1 --format=%H -- . ":!$table")" = "$revision" ]
}

# The account of these files: this machine's, and that of the table's rows.
of_these() { # lines of a part's name, its result, and three columns more, of which the last one has hashes
    local part rest
    while IFS=$'\t' read -r part rest; do
        [[ " ${rest##*$'\t'} " != *" $(files_of "$part") "* ]] || printf '%s\t%s\n' "$part" "$rest"
    done
}
lines() { of_these <$account; }
lines_of_rows() {
    awk -F ' [|] ' '/^[|] 2/ {
        gsub(/`/, "", $3)
        count = split($5, ran, /; /)
        for (k = 1; k <= count; k++) {
            split(ran[k], part, /[: ]/)
            print part[1] "\t" (ran[k] ~ /^[^ ]+ [A-Z]+: / ? tolower(part[2]) : "passed") "\t\t\t" $3
        } }' $table | of_these
}
result_of() { (lines_of_rows; lines) | awk -F '\t' -v part="$1" '$1 == part { result = $2 } END { print result }'; }
is_part() { [[ " ${parts[*]} " == *" $1 "* ]]; }

run_release() { # with variables of the environment
    local build=build/release status=0
    scripts/test.sh quick && cmake --build $build --target all cgt_cpus || return 1
    env "$@" CMAKE_GENERATOR=Ninja ctest --test-dir $build -j "$(nproc)" | tee $night/ctest.log || status=1
    sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)/\1 failed, of \2 passed/p' $night/ctest.log
    return $status
}

# Rounds of the driver, each by a seed that no round had before. A failure prints the line that reruns it. What was run
# is kept after each round: a run that was stopped goes on.
run_seeds() {
    local build=build/release kept=$night/seeds.seconds spent=0 of='' rounds=0 status=0 begin seed
    scripts/test.sh quick && cmake --build $build --target hits || return 1
    [ ! -f $kept ] || read -r spent of rounds <$kept
    [ "$of" = "$core" ] && [ "$spent" -lt "$seeds_seconds" ] || spent=0 rounds=0
    while [ "$spent" -lt "$seeds_seconds" ]; do
        begin=$SECONDS seed=$(date +%s)$rounds
        sed -nE 's/^ *\{?\.name = "([a-z]+)",.*/\1/p' tests/driver/profiles.c |
            CGT_TEST_SEED=$seed CGT_TEST_SCALE=4 xargs -P "$(nproc)" -I {} $build/tests/hits {} || status=1
        spent=$((spent + SECONDS - begin)) rounds=$((rounds + 1))
        [ $status != 0 ] || echo "$spent $core $rounds" >$kept
        echo "$rounds rounds, the last one by the seed $seed"
    done
    return $status
}

run_part() {
    case $1 in
    suite-*) scripts/test.sh --whole "${1#suite-}" ;;
    cpu-*) run_release "CGT_DISABLE_CPU=${1#cpu-}" ;;
    cpus-*) run_release "CGT_TEST_CPUS=${1#cpus-}" "LD_PRELOAD=$PWD/build/release/tests/libcgt_cpus.so" ;;
    bugs) scripts/mutations.sh ;;
    seeds) run_seeds ;;
    fuzz-*) scripts/fuzz.sh "$fuzz_seconds" "${1#fuzz-}" ;;
    soak) scripts/test.sh quick && cmake --build build/release --target soak &&
        build/release/tests/soak "$soak_seconds" ;;
    esac
}

# What a part says of itself, in a few words: its last line that counts something.
amount_of() {
    grep -E '[0-9]+ (passed|caught|inputs|rounds)' "$night/$1.log" | tail -n 1 | sed 's/^soak: //; s/;/,/g' || true
}

case ${1:-} in
--left)
    for part in "${parts[@]}"; do
        [ "$(result_of "$part")" = passed ] || echo "$part"
    done
    exit ;;
--row)
    cpu=$(sed -nE 's/^model name[[:space:]]*: *//p' /proc/cpuinfo | head -n 1)
    ran=$(lines | awk -F '\t' '{ result[$1] = $1 (($2 == "passed") ? "" : " " toupper($2)) ": " $4 " (" $3 " s)" }
                       END { for (part in result) print result[part] }' | sort | paste -sd ';' | sed 's/;/; /g')
    found=$(lines | awk -F '\t' '$2 == "failed" { bad[$1] } END { print length(bad) }') # also where it passed later
    left=$(scripts/night.sh --left | paste -sd ' ')
    # shellcheck disable=SC2016 # those are Markdown's
    printf '| %s | `%s` | `%s` | %s, %s cores | %s | %s | %s |\n' "$(date +%F)" "${revision:0:12}" \
        "$core $readers $code $tree" "$cpu" "$(nproc)" "$ran" \
        "${left:-nothing}" "$([ "$found" = 0 ] && echo nothing || echo "$found parts failed")" >>$table
    tail -n 1 $table
    exit ;;
-*) sed -nE 's/^# (night\.sh .*)/usage: \1/p' "$0" >&2; exit 2 ;;
esac

for part in "$@"; do
    is_part "$part" || { echo "night.sh: no part is named '$part': ${parts[*]}" >&2; exit 2; }
done
status=0
for part in "${@:-${parts[@]}}"; do
    [ "$(result_of "$part")" != passed ] || { echo "night.sh: $part: passed before"; continue; }
    echo "night.sh: $part, $(date '+%F %T')"
    start=$SECONDS result=passed
    is_as_begun || { echo "night.sh: the files have changed: begin again" >&2; exit 2; }
    run_part "$part" >"$night/$part.log" 2>&1 </dev/null || result=failed
    is_as_begun || { echo "night.sh: $part: the files have changed meanwhile" >&2; exit 2; }
    case $result-$part in
    failed-*) status=1 ;;
    *-fuzz-*) [ "$fuzz_seconds" -ge 3600 ] || result=short ;;
    *-seeds) [ "$seeds_seconds" -ge 7200 ] || result=short ;;
    *-soak) [ "$soak_seconds" -ge 7200 ] || result=short ;;
    *) [[ $(amount_of "$part") != '0 passed'* ]] || result=skipped ;;
    esac
    printf '%s\t%s\t%d\t%s\t%s\n' "$part" $result $((SECONDS - start)) "$(amount_of "$part")" \
        "$(files_of "$part")" >>$account
    echo "night.sh: $part: $result, $((SECONDS - start)) s; $(amount_of "$part")"
done
exit $status
