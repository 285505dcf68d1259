#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# lint.sh [--fix]
# Looks at every file that git knows or would take: heading, layout (clang-format), spelling (codespell), and the likely
# mistakes of .clang-tidy on what build/release compiles. --fix lets clang-format write.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/dependencies.sh build render tests lint
jobs=$(nproc)
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
for file in "${code[@]}"; do
    head -n 2 "$file" | tr '\n' '~' |
        grep -q '^/\* SPDX-FileCopyrightText: 2026 The libcgt authors~ \* SPDX-License-Identifier: MIT~' ||
        fail "$file: no SPDX heading"
done
for file in "${texts[@]}"; do
    case $file in
    *.sh|*.cmake|*.cmake.in|CMakeLists.txt|*/CMakeLists.txt|.ci/*)
        head -n 3 "$file" | grep -q '^# SPDX-License-Identifier: MIT$' || fail "$file: no SPDX heading" ;;
    esac
done

echo "== layout"
if [ "${1:-}" = --fix ]; then
    clang-format-14 -i "${code[@]}"
fi
clang-format-14 --dry-run -Werror "${code[@]}" || fail "clang-format would write these otherwise; scripts/lint.sh --fix"
if grep -nE '[[:space:]]+$' "${texts[@]}"; then
    fail "space at the end of a line"
fi

echo "== spelling"
codespell --ignore-words=scripts/codespell_ignore.txt "${texts[@]}" || fail "codespell"

echo "== likely mistakes"
mkdir -p build
# the whole tree, so that every file is in the compile database
cmake --preset release -DCGT_BUILD_TESTS=ON -DCGT_BUILD_ORACLE=ON -DCGT_BUILD_MESHES=ON -DCGT_BUILD_RENDER=ON >build/lint.log 2>&1 || {
    tail -n 30 build/lint.log
    exit 1
}
# Each file is looked at in one form: kernels in the widest one, what is compiled per row of the variant table or for
# several programs in its first. Kernels come once more, two of them for every row, so that every mapping is seen; but
# their paths are the same ones, and following them is what takes the time.
# clang-tidy does not know a flag that is for GCC alone.
mkdir -p build/lint build/lint_rows
sed 's/ -fno-ipa-modref//g' build/release/compile_commands.json | awk '
    function put(to) { printf "%s%s}", n[to]++ ? ",\n" : "[\n", substr(entry, 1, index(entry, "\n}")) >to }
    /^\{/ { entry = "" }
    { entry = entry $0 "\n" }
    /"file": / { file = $0 }
    /^\}/ && file !~ /\/src\/kernel\// { if (!seen[file]++) put("build/lint/compile_commands.json") }
    /^\}/ && file ~ /\/src\/kernel\// {
        if (entry ~ /-DCGT_VARIANT=(neon|avx512) /) put("build/lint/compile_commands.json")
        else if (entry ~ /-DCGT_VARIANT=portable / || file ~ /\/(light_tile|loose_grid_traverse)\.c/)
            put("build/lint_rows/compile_commands.json")
    }
    END { for (to in n) print "\n]" >to }'
files_of() { sed -nE 's/^ *"file": "(.*)",?$/\1/p' "build/$1/compile_commands.json" | sort -u; }
[ -n "$(files_of lint)" ] || { echo "lint.sh: empty compile database"; exit 1; }
[ -n "$(files_of lint_rows)" ] || { echo "lint.sh: no kernel found"; exit 1; }
# tidy DATABASE OPTIONS...: the files on standard input, one process per file. The longest come first. What is a list of
# every op has no paths to follow either, and half a minute of them.
kernels=/src/kernel/ ops='/test_spu_(words|constants|literals)|/simd_words' no_paths='--checks=-clang-analyzer-*'
tidy() {
    local database=$1
    shift
    tr '\n' '\0' | xargs -0 -r -n 1 -P "$jobs" clang-tidy-14 --quiet -p "build/$database" "$@" 2>>build/lint_tidy.log
}
: >build/lint_tidy.log
files_of lint | grep -E "$kernels" | tidy lint || fail "clang-tidy: kernels"
files_of lint_rows | tidy lint_rows "$no_paths" || fail "clang-tidy: kernels of other rows"
files_of lint | grep -E "$ops" | tidy lint "$no_paths" || fail "clang-tidy: lists of ops"
files_of lint | grep -vE "$kernels|$ops" | tidy lint || fail "clang-tidy"
if grep -E 'error: ' build/lint_tidy.log; then
    fail "clang-tidy could not read a file"
fi

[ $status = 0 ] && echo "lint.sh: ${#files[@]} files, nothing to say"
exit $status
