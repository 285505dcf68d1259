#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_archive.sh NM OBJDUMP STATIC_LIBRARY
#   1. every symbol that a static library offers begins with cgt_
#   2. its functions are hidden: what links them does not export them
#   3. it has no mutable variable: there is no global state
set -eu
nm=$1 objdump=$2 static=$3
. "${0%/*}/findings.sh"

"$nm" --defined-only --extern-only "$static" | awk 'NF == 3 { print $3 }' | sort -u >"$work/static"
grep -v '^cgt_' "$work/static" >"$work/alien" && fail "symbols without cgt_ in $static" "$work/alien"
[ "$(wc -l <"$work/static")" -gt 2 ] || fail "hardly any symbol in $static" "$work/static"

"$objdump" -t "$static" | awk '$2 == "g" && !/\.hidden/ && !/\*UND\*/' >"$work/visible"
[ -s "$work/visible" ] && fail "symbols of $static that are not hidden" "$work/visible"

# Constants that hold addresses lie in .data.rel.ro, which the loader locks: only the sections below can change.
"$objdump" -t "$static" | awk -F '\t' 'NF == 2 {
    n = split($1, left, " "); section = left[n]
    split($2, right, " ")
    if (section ~ /^(\.(data|bss|tdata|tbss|sdata|sbss)(\.|$)|\*COM\*)/ &&
        section !~ /^\.data\.rel\.ro/ && right[1] !~ /^0+$/)
        print section, $2
}' >"$work/variables"
[ -s "$work/variables" ] && fail "variables that can change in $static" "$work/variables"
exit $status
