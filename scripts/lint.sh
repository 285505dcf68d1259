#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# lint.sh [--fix] [--all]
# Checks every file that git knows or would take: heading, layout (clang-format), spelling (codespell), the patterns of
# tests/mutations.tsv, and clang-tidy on what build/release compiles. --fix lets clang-format write.
# clang-tidy does not look again at a file that it passed before, as long as the file, its headers, its command line and
# .clang-tidy are the same. What passed is kept in ${XDG_CACHE_HOME:-~/.cache}/libcgt/lint.
# Most of the time without such a cache is the analyzer's, which looks for paths that nobody runs. It leaves out tests and
# examples, which are run, under the sanitizers. Without --all it also leaves out kernels, for the same reason, and the
# modules in C++, which are mostly headers of others; and it follows 10,000 states of a function, of clang's own 225,000.
# --all, for releases, looks at everything again, and gives the analyzer all the time it wants.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/dependencies.sh build render tests lint
jobs=$(nproc)
! command -v ninja >/dev/null || export CMAKE_GENERATOR=Ninja # as scripts/test.sh
fix=no again=no
for option in "$@"; do
    case $option in
    --fix) fix=yes ;;
    --all) again=yes ;;
    *) echo "usage: lint.sh [--fix] [--all]" >&2; exit 2 ;;
    esac
done
status=0
fail() {
    echo "lint.sh: $1"
    status=1
}

mapfile -t files < <(git ls-files --cached --others --exclude-standard | LC_ALL=C sort -u |
    while read -r file; do [ ! -f "$file" ] || echo "$file"; done)
texts=() code=()
for file in "${files[@]}"; do
    case $file in
    *.c|*.h|*.cpp) code+=("$file") texts+=("$file") ;;
    *.md|*.sh|*.cmake|*.in|*.txt|.ci/*|NEWS|LICENSE) texts+=("$file") ;;
    esac
done
[ ${#code[@]} -gt 0 ] || { echo "lint.sh: no source file found"; exit 1; }

echo "== heading"
scripts=()
for file in "${texts[@]}"; do
    case $file in
    *.sh|*.cmake|*.cmake.in|CMakeLists.txt|*/CMakeLists.txt|.ci/*) scripts+=("$file") ;;
    esac
done
awk 'function judge() { if (file && !good) { print "lint.sh: " file ": no SPDX heading"; bad = 1 } }
    FNR == 1 { judge(); file = FILENAME; good = 0 }
    FNR <= 3 && $0 == "# SPDX-License-Identifier: MIT" { good = 1 }
    FNR == 1 { owner = $0 == "/* SPDX-FileCopyrightText: 2026 The libcgt authors" }
    FNR == 2 && owner && /^ \* SPDX-License-Identifier: MIT/ { good = 1 }
    END { judge(); exit bad }' "${code[@]}" "${scripts[@]}" || status=1

echo "== layout"
if [ $fix = yes ]; then
    clang-format-14 -i "${code[@]}"
fi
clang-format-14 --dry-run -Werror "${code[@]}" || fail "clang-format would write these otherwise; scripts/lint.sh --fix"
if grep -nE '[[:space:]]+$' "${texts[@]}"; then
    fail "space at the end of a line"
fi
! grep -nE '^ +\* \*/$' "${code[@]}" || fail "comments that end on a line of their own"
! grep -nE '^    ([a-z_0-9]+|[a-z_0-9 ]+,|[a-z_0-9 ]+ \(\*[a-z]+\)\()$' include/cgt/*.h ||
    fail "declarations that are broken in two: put a long comment above the member"
awk 'length > 120 { print FILENAME ":" FNR ": " length " columns"; bad = 1 } END { exit bad }' "${code[@]}" ||
    fail "lines beyond 120 columns"

echo "== spelling"
codespell --ignore-words=scripts/codespell_ignore.txt "${texts[@]}" || fail "codespell"

if [ -e tests/mutations.tsv ]; then
    echo "== mutations"
    scripts/mutations.sh --check || fail "tests/mutations.tsv does not fit the sources"
fi

echo "== lines by product, and what each should keep to"
count_lines() { git ls-files -- "${@:3}" | grep -E '\.(c|h|cpp|py|sh|js|awk|cmake)$|CMakeLists.txt$' | xargs cat 2>/dev/null | wc -l |
    awk -v name="$1" -v budget="$2" '{ printf "%-28s %6d of %6d\n", name, $1, budget }'; }
count_lines "library" 40000 include src simd backends/threads ':!src/papers'
count_lines "papers, Cell" 22000 src/papers backends/cell
count_lines "picture, MPI" 6000 picture mpi
count_lines "figure" 9500 figure
count_lines "programs" 28000 programs
count_lines "Python" 6000 python
count_lines "bench" 8000 bench
count_lines "tests" 60000 tests ':!tests/fuzz/corpus'

echo "== likely mistakes"
mkdir -p build
# the whole tree, so that every file is in the compile database
cmake --preset release -DCGT_BUILD_TESTS=ON -DCGT_BUILD_ORACLE=ON -DCGT_BUILD_MESHES=ON -DCGT_BUILD_RENDER=ON \
    -DCGT_TEST_LABELS= >build/lint.log 2>&1 || {
    tail -n 30 build/lint.log
    exit 1
}
# Each file is analysed in one form: a kernel in the widest variant, anything else that is compiled several times in its
# first form. Kernels are checked again, without the analyzer, as the portable variant compiles them; two kernels in all
# variants, so that every mapping of the vector words is seen.
# clang-tidy does not know a flag that only GCC has, and the compiler cache is no part of a command.
mkdir -p build/lint build/lint_rows
sed -E 's/ -fno-ipa-modref//g; s/("command": ")[^ ]*ccache /\1/' build/release/compile_commands.json | awk '
    function put(to) { printf "%s%s}", n[to]++ ? ",\n" : "[\n", substr(entry, 1, index(entry, "\n}")) >to }
    /^\{/ { entry = "" }
    { entry = entry $0 "\n" }
    /"file": / { file = $0 }
    /^\}/ && file !~ /\/src\/(papers\/)?kernel\// { if (!seen[file]++) put("build/lint/compile_commands.json") }
    /^\}/ && file ~ /\/src\/(papers\/)?kernel\// {
        if (entry ~ /-DCGT_VARIANT=(neon|avx512) /) put("build/lint/compile_commands.json")
        else if (entry ~ /-DCGT_VARIANT=portable / || file ~ /\/light_grid\.c/)
            put("build/lint_rows/compile_commands.json")
    }
    END { for (to in n) print "\n]" >to }'
files_of() { sed -nE 's/^ *"file": "(.*)",?$/\1/p' "build/$1/compile_commands.json" | sort -u; }
[ -n "$(files_of lint)" ] || { echo "lint.sh: empty compile database"; exit 1; }
[ -n "$(files_of lint_rows)" ] || { echo "lint.sh: no kernel found"; exit 1; }

passed=${XDG_CACHE_HOME:-$HOME/.cache}/libcgt/lint
mkdir -p "$passed"
tidy_version=$(clang-tidy-14 --version | sha256sum)
# the analyzer's limit for the states of a function
budget=()
[ $again = yes ] || for word in -Xclang -analyzer-config -Xclang max-nodes=10000; do budget+=("--extra-arg=$word"); done
export passed again tidy_version

# tidy_file DATABASE FILE OPTION...: runs clang-tidy unless the same text has passed. The key of a file are all commands
# that the database has for it, and the content of the file and of the headers of this repository that it includes.
tidy_file() {
    local database=build/$1 file=$2 key directory command
    shift 2
    key=$(
        echo "$tidy_version $* ${file#"$PWD"}"
        grep -B1 -F "\"file\": \"$file\"" "$database/compile_commands.json" | grep '"command"' |
            sed "s#$PWD##g"
        {
            grep -B2 -F "\"file\": \"$file\"" "$database/compile_commands.json" |
                sed -nE 's/^ *"directory": "(.*)",$/\1/p; s/^ *"command": "(.*)",$/\1/p' |
                while read -r directory && read -r command; do
                    # shellcheck disable=SC2001
                    command=$(sed -E 's/ -o [^ ]+( -c)?/ -MM/; s/\\"/"/g' <<<"$command")
                    (cd "$directory" && eval "$command" 2>/dev/null) | tr ' \\' '\n\n' | grep "^$PWD/" || true
                done
            find . -name .clang-tidy -not -path './build/*'
        } | sort -u | xargs sha256sum | sed "s#$PWD##g"
    )
    key=$(sha256sum <<<"$key" | cut -d' ' -f1)
    if [ "$again" = no ] && [ -e "$passed/$key" ]; then
        return 0
    fi
    clang-tidy-14 --quiet -p "$database" "$@" "$file" 2>>build/lint_tidy.log || return 1
    : >"$passed/$key"
}
export -f tidy_file

# tidy DATABASE OPTION...: the files on standard input, one process per file, the longest first.
kernels='/src/(papers/)?kernel/'
run="^$PWD/(tests|examples)/" no_paths='--checks=-clang-analyzer-*' modules='\.cpp$'
paths=("$no_paths") # of kernels and modules
[ $again = no ] || paths=()
tidy() {
    # shellcheck disable=SC2016 # the inner shell expands
    tr '\n' '\0' | xargs -0 -r -n 1 -P "$jobs" bash -c 'tidy_file "$1" "${@: -1}" "${@:2:$#-2}"' tidy "$@" "${budget[@]}"
}
: >build/lint_tidy.log
files_of lint | grep -E "$kernels|$modules" | tidy lint "${paths[@]}" || fail "clang-tidy: kernels and modules"
files_of lint_rows | tidy lint_rows "$no_paths" || fail "clang-tidy: kernels of other variants"
files_of lint | grep -E "$run" | tidy lint "$no_paths" || fail "clang-tidy: tests and examples"
files_of lint | grep -vE "$kernels|$modules|$run" | tidy lint || fail "clang-tidy"
if grep -E 'error: ' build/lint_tidy.log; then
    fail "clang-tidy could not read a file"
fi
find "$passed" -type f -mtime +60 -delete

[ $status = 0 ] && echo "lint.sh: ${#files[@]} files, nothing to report"
exit $status
