#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# mutations.sh [--jobs N] [--build DIR] [ID-REGEX]
# mutations.sh --check
# Checks that the tests notice bugs. Applies the deliberate bugs of tests/mutations.tsv, one at a time, to a copy of the
# tree in DIR/tree (build/mutations without --build), builds what the tests of that row need, and runs them. Prints a
# line for each bug:
#   caught          a test failed or did not end
#   SURVIVED        all its tests passed: one is missing
#   does not build  the compiler noticed: correct the table
#   not here        this machine has none of the tests
# DIR/results.tsv has the same. A bug that has a result there is not tried again as long as its row is the same and no
# file has changed; where only what traces and its tests are concerned, no file of theirs (scripts/code_hash.sh).
# ID-REGEX selects bugs by their whole id. Exit code 0: every bug was caught or is not for
# this machine, 1: one was not, 2: the tests fail without a bug.
# --check checks the table alone: every file exists and has each pattern exactly once.
set -euo pipefail
cd "$(dirname "$0")/.."
table=tests/mutations.tsv
usage() {
    sed -nE 's/^# (mutations\.sh .*)/usage: \1/p' "$0" >&2
    exit 2
}

check_table() {
    LC_ALL=C awk -F '\t' '
        function fail(text) { printf "%s:%d: %s\n", FILENAME, FNR, text; bad = 1 }
        function occurrences(file, pattern,    line, at, count, state) {
            while ((state = (getline line <file)) > 0)
                while ((at = index(line, pattern)) > 0) {
                    count++
                    line = substr(line, at + 1)
                }
            close(file)
            return state < 0 ? -1 : count + 0
        }
        /^#/ || /^$/ { next }
        {
            rows++
            if (NF != 6) { fail("six columns, not " NF); next }
            for (k = 1; k <= 6; k++)
                if ($k == "") fail("column " k " is empty")
            if ($1 !~ /^[a-z0-9-]+$/) fail("id " $1 ": a-z, 0-9 and -")
            if (seen[$1]++) fail("id " $1 " comes twice")
            if ($3 == $4) fail($1 ": the replacement is the pattern")
            if ((n = occurrences($2, $3)) < 0) fail($1 ": no file " $2)
            else if (n != 1) fail($1 ": " $2 " has the pattern " n " times: " $3)
        }
        END {
            if (!rows) fail("no bug in the table")
            if (!bad) printf "mutations.sh: %d bugs, each has its place\n", rows
            exit bad
        }' "$table"
}

jobs=$(nproc) dir=build/mutations ids=.\*
while [ $# -gt 0 ]; do
    case $1 in
    --check) check_table; exit ;;
    --jobs|--build) [ $# -ge 2 ] || usage; [ "$1" = --jobs ] && jobs=$2 || dir=$2; shift 2 ;;
    -*) usage ;;
    *) ids=$1; shift ;;
    esac
done
check_table >/dev/null || { check_table; exit 2; }
rows=()
while IFS= read -r row; do
    case $row in \#*|'') continue ;; esac
    [[ ! ${row%%$'\t'*} =~ ^($ids)$ ]] || rows+=("$row")
done <$table
[ ${#rows[@]} -gt 0 ] || { echo "mutations.sh: no id matches $ids" >&2; exit 2; }

variant=$(scripts/widest_row.sh)
scripts/dependencies.sh build render tests

# ---- the copy ----

mkdir -p "$dir/tree"
dir=$(cd "$dir" && pwd) tree=$dir/tree
# Only files that differ, so that little is built again; those that a run left mutated are among them.
git ls-files --cached --others --exclude-standard | while IFS= read -r file; do
    [ -f "$file" ] || continue
    cmp -s "$file" "$tree/$file" || { mkdir -p "$tree/$(dirname "$file")"; cp "$file" "$tree/$file"; }
done
# and those that are no more: tests read whole folders
(cd "$tree" && find . -type f | sed 's#^\./##' | sort) >"$dir/files_there"
git ls-files --cached --others --exclude-standard | sort | comm -13 - "$dir/files_there" |
    (cd "$tree" && xargs -r -d '\n' rm && find . -mindepth 1 -type d -empty -delete)
generator=()
! command -v ninja >/dev/null || generator=(-G Ninja)
cmake "${generator[@]}" -S "$tree" -B "$dir/build" -DCMAKE_BUILD_TYPE=Release "-DCGT_ONLY_VARIANTS=$variant" \
    -DCGT_BUILD_TESTS=ON -DCGT_BUILD_MESHES=ON >"$dir/configure.log" 2>&1 || { tail -n 30 "$dir/configure.log"; exit 2; }

# ---- tests and what builds them ----

# The tests of a row, by name; one that runs once per variant is named without it for all variants.
ctest --test-dir "$dir/build" -N | sed -nE 's/^ *Test +#[0-9]+: (.*)$/\1/p' >"$dir/test_names"
tests_of() { grep -E "^($1)(_portable|_$variant)?\$" "$dir/test_names" || true; }

# The programs in the build that the commands of tests run; each is a target of that name. ctest shows no command whose
# program was not built yet.
targets_of() {
    local names
    names=$(printf '|%s' "$@")
    find "$dir/build" -name CTestTestfile.cmake -exec grep -hE "^add_test\((\[=*\[)?(${names#|})(\]=*\])? " {} + |
        grep -oE "$dir/build/(bin|tests)/[^\" )]+" | while IFS= read -r program; do
        [ -d "$program" ] || basename "$program"
    done | sort -u
}

build_tests() {
    local targets
    mapfile -t targets < <(targets_of "$@")
    [ ${#targets[@]} -gt 0 ] || return 0 # a script over sources
    cmake --build "$dir/build" -j "$jobs" --target "${targets[@]}" >"$dir/build.log" 2>&1
}

run_tests() {
    local names
    names=$(printf '|%s' "$@")
    ctest --test-dir "$dir/build" -j "$jobs" -R "^(${names#|})\$" --no-tests=error --stop-on-failure \
        </dev/null >"$dir/test.log" 2>&1
}

# The last test.log's, with what is not just a failure: a time-out may be that of a busy machine.
failed_tests() {
    sed -nE 's/^[[:space:]]+[0-9]+ - ([^ ]+) \(Failed\).*/\1/p; s/^[[:space:]]+[0-9]+ - ([^ ]+) \(([^)]*)\).*/\1 (\2)/p' \
        "$dir/test.log"
}

# Whether no test has run: the machine lacks what they need.
are_skipped() { [ "$(grep -cE '^[[:space:]]+[0-9]+ - [^ ]+ \(Skipped\)' "$dir/test.log")" -eq $# ]; }

# ---- what is left ----

# The folder of tests/ that each test is of.
find "$dir/build/tests" -name CTestTestfile.cmake -exec grep -HE '^add_test\(' {} + |
    sed -E 's#.*/build/tests/([^/:]+)[^:]*:add_test\((\[=*\[)?([^] ]+).*#\3\t\1#' >"$dir/folders.tsv"
code=$(scripts/code_hash.sh) core=$(scripts/code_hash.sh core)
scripts/code_hash.sh --list core >"$dir/core_files"

# A hash of a row and of the files on which its result depends.
state_of() { # ROW FILE TEST...
    local row=$1 file=$2 files=$core folder
    shift 2
    while read -r folder; do
        grep -qxF "tests/$folder/CMakeLists.txt" "$dir/core_files" || files=$code
    done < <(printf '%s\n' "$@" | awk -F '\t' 'NR == FNR { folder[$1] = $2; next } { print folder[$0] }' "$dir/folders.tsv" - | sort -u)
    grep -qxF "$file" "$dir/core_files" || files=$code
    sha256sum <<<"$files $row" | cut -c 1-12
}

result_of() { # ID STATE
    awk -F '\t' -v id="$1" -v state="$2" '$1 == id && $5 == state { result = $2 } END { print result }' "$dir/results.tsv"
}

touch "$dir/results.tsv"
caught=0 survived=0 broken=0 absent=0 left=()
for row in "${rows[@]}"; do
    IFS=$'\t' read -r id file pattern replacement tests note <<<"$row"
    mapfile -t names < <(tests_of "$tests")
    state=$(state_of "$row" "$file" "${names[@]}")
    case $(result_of "$id" "$state") in
    caught) caught=$((caught + 1)) ;;
    SURVIVED) survived=$((survived + 1)) ;;
    "not here") absent=$((absent + 1)) ;;
    *) left+=("$row") ;;
    esac
done
rows=("${left[@]}")

# ---- without a bug ----

echo "mutations.sh: ${#rows[@]} bugs; building what they concern, $(date +%T)"
mapfile -t all < <(for row in "${rows[@]}"; do cut -f 5 <<<"$row"; done | sort -u |
    while read -r tests; do tests_of "$tests"; done | sort -u)
[ ${#rows[@]} -eq 0 ] || [ ${#all[@]} -gt 0 ] || { echo "mutations.sh: none of the tests is here" >&2; exit 2; }
[ ${#all[@]} -eq 0 ] || build_tests "${all[@]}" || { tail -n 30 "$dir/build.log"; echo "mutations.sh: the tree does not build"; exit 2; }
[ ${#all[@]} -eq 0 ] || run_tests "${all[@]}" || { tail -n 30 "$dir/test.log"; echo "mutations.sh: tests fail without a bug"; exit 2; }

# ---- with each ----

mutated=""
restore() {
    [ -z "$mutated" ] || cp "$mutated" "$tree/$mutated"
    mutated=""
}
trap restore EXIT

mutate() {
    mutated=$1
    PATTERN=$2 REPLACEMENT=$3 LC_ALL=C awk '
        (at = index($0, ENVIRON["PATTERN"])) {
            $0 = substr($0, 1, at - 1) ENVIRON["REPLACEMENT"] substr($0, at + length(ENVIRON["PATTERN"]))
        }
        { print }' "$1" >"$tree/$1"
}

say() {
    printf '%-15s %-32s %4d s  %s\n' "$1" "$2" "$3" "$4"
    printf '%s\t%s\t%d\t%s\t%s\n' "$2" "$1" "$3" "$4" "$state" >>"$dir/results.tsv"
}
for row in "${rows[@]}"; do
    IFS=$'\t' read -r id file pattern replacement tests note <<<"$row"
    mapfile -t names < <(tests_of "$tests")
    state=$(state_of "$row" "$file" "${names[@]}")
    start=$SECONDS
    if [ ${#names[@]} -eq 0 ]; then
        say "not here" "$id" 0 "$tests"
        absent=$((absent + 1))
        continue
    fi
    mutate "$file" "$pattern" "$replacement"
    if ! build_tests "${names[@]}"; then
        say "does not build" "$id" $((SECONDS - start)) "$(grep -m 1 -E 'error[: ]' "$dir/build.log" || true)"
        broken=$((broken + 1))
    elif run_tests "${names[@]}" && are_skipped "${names[@]}"; then
        say "not here" "$id" $((SECONDS - start)) "$tests"
        absent=$((absent + 1))
    elif grep -q '^100% tests passed' "$dir/test.log"; then
        say SURVIVED "$id" $((SECONDS - start)) "$note"
        survived=$((survived + 1))
    else
        say caught "$id" $((SECONDS - start)) "$(failed_tests | paste -sd ' ')"
        caught=$((caught + 1))
    fi
    restore
done
[ $broken -eq 0 ] || echo "$broken do not build"
[ $absent -eq 0 ] || echo "$absent not here"
echo "$caught caught, $survived survived"
[ $survived -eq 0 ] && [ $broken -eq 0 ]
