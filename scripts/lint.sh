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
# A file is looked at once per entry of the database. Kernels stay in their four-lane form without intrinsics and in the
# widest, two of them once per row of the variant table, so that every mapping is seen; tests and benchmarks that are
# compiled per row, or for several programs, are seen once.
# clang-tidy does not know a flag that is for GCC alone.
mkdir -p build/lint
sed 's/ -fno-ipa-modref//g' build/release/compile_commands.json | awk '
    /^\{/ { entry = "" }
    { entry = entry $0 "\n" }
    /"file": / { file = $0 }
    /^\}/ && (!seen[file]++ || file ~ /\/src\/kernel\/(light_tile|loose_grid_traverse)\.c/ ||
               file ~ /\/src\/kernel\// && entry ~ /-DCGT_VARIANT=(neon|avx512) /) {
        printf "%s%s}", n++ ? ",\n" : "[\n", substr(entry, 1, index(entry, "\n}"))
    }
    END { print "\n]" }' >build/lint/compile_commands.json
sed -nE 's/^ *"file": "(.*)",?$/\1/p' build/lint/compile_commands.json | sort -u >build/lint_files.txt
[ -s build/lint_files.txt ] || { echo "lint.sh: empty compile database"; exit 1; }
# One process per file, the longest first. What is a list of every op has no paths to follow, and half a minute of them.
kernels=/src/kernel/ ops='/test_spu_(words|constants|literals)|/simd_words'
tidy() { tr '\n' '\0' | xargs -0 -r -n 1 -P "$jobs" clang-tidy-14 --quiet -p build/lint "$@" 2>>build/lint_tidy.log; }
: >build/lint_tidy.log
grep -E "$kernels" build/lint_files.txt | tidy || fail "clang-tidy: kernels"
grep -E "$ops" build/lint_files.txt | tidy --checks='-clang-analyzer-*' || fail "clang-tidy: lists of ops"
grep -vE "$kernels|$ops" build/lint_files.txt | tidy || fail "clang-tidy"
if grep -E 'error: ' build/lint_tidy.log; then
    fail "clang-tidy could not read a file"
fi

[ $status = 0 ] && echo "lint.sh: ${#files[@]} files, nothing to say"
exit $status
