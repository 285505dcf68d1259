#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# code_hash.sh [--list] [core|readers]
# Prints a short hash of the files as they are, without texts, on which neither fuzzers nor planted bugs depend.
#   core      of the libraries that trace and of their tests alone: what is over them may change
#   readers   of those, and of the programs
#   --list    prints their names instead
set -euo pipefail
cd "$(dirname "$0")/.."
show() { xargs -d '\n' sha256sum | sha256sum | cut -c 1-12; }
[ "${1:-}" != --list ] || { show() { cat; }; shift; }
core='^(CMakeLists\.txt$|cmake/|simd/|src/|backends/|include/cgt/(all_hits|array|bounces|cgt|export|research|version)\.h$)'
core+='|^tests/(CMakeLists\.txt$|(all_hits|api|bih|bvh|cell|clusters|decide|driver|embree|exact|fuzz|grid)/)'
core+='|^tests/(hard_cases|kd|light|oracle|primitive|simd|spu|structures|support|tile)/'
case ${1:-} in
'') chosen=. ;;
core) chosen=$core ;;
readers) chosen="$core|^programs/" ;;
*) sed -nE 's/^# (code_hash\.sh .*)/usage: \1/p' "$0" >&2; exit 2 ;;
esac
if git rev-parse >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard
else
    find . -type f -not -path './build/*' -not -path './out/*' | sed 's#^\./##'
fi | grep -vE '^(docs/|[A-Z]+(\.md)?$)' | grep -E "$chosen" | LC_ALL=C sort |
    while IFS= read -r file; do [ ! -f "$file" ] || echo "$file"; done | show
