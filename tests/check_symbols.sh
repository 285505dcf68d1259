#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_symbols.sh SOURCE_DIR STATIC_LIBRARY SHARED_LIBRARY NM OBJDUMP LIST_OF_BASELINE_OBJECTS cflags=CFLAGS
#   1. every symbol that the static library offers begins with cgt_
#   2. the shared library exports exactly what cgt.h declares
#   3. the library has no variable that can change: there is no global state
#   4. x86-64: no instruction beyond SSE in the baseline objects
set -eu
source=$1 static=$2 shared=$3 nm=$4 objdump=$5 baseline=$6 cflags=${7#cflags=}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C
status=0
fail() {
    echo "FAILED: $1"
    sed 's/^/    /' "$2"
    status=1
}

"$nm" --defined-only --extern-only "$static" | awk 'NF == 3 { print $3 }' | sort -u >"$work/static"
grep -v '^cgt_' "$work/static" >"$work/alien" && fail "symbols without cgt_ in $static" "$work/alien"
[ "$(wc -l <"$work/static")" -gt 10 ] || fail "hardly any symbol in $static" "$work/static"

"$nm" -D --defined-only "$shared" | awk 'NF == 3 { print $3 }' | sort -u >"$work/exported"
tr '\n' ' ' <"$source/include/cgt/cgt.h" | tr ';' '\n' | sed -nE 's/.*CGT_API [^(]*[ *](cgt_[a-z0-9_]+)\(.*/\1/p' |
    sort -u >"$work/declared"
[ -s "$work/declared" ] || fail "no CGT_API found in cgt.h" "$work/declared"
cmp -s "$work/exported" "$work/declared" || {
    diff "$work/declared" "$work/exported" >"$work/difference" || true
    fail "cgt.h (<) and the exports of $shared (>) differ" "$work/difference"
}

# Constants that hold addresses lie in .data.rel.ro, which the loader locks: only the sections below can change.
"$objdump" -t "$static" | awk -F '\t' 'NF == 2 {
    n = split($1, left, " "); section = left[n]
    split($2, right, " ")
    if (section ~ /^(\.(data|bss|tdata|tbss|sdata|sbss)(\.|$)|\*COM\*)/ &&
        section !~ /^\.data\.rel\.ro/ && right[1] !~ /^0+$/)
        print section, $2
}' >"$work/variables"
[ -s "$work/variables" ] && fail "variables that can change in $static" "$work/variables"

# With a -march in CFLAGS the machine is the user's choice.
case " $cflags " in
*-march*|*-mavx*|*-mfma*) echo "instructions not checked: CFLAGS has $cflags" ;;
*)  if "$objdump" -f "$static" | grep -q 'architecture: i386:x86-64'; then
        tr '\n' '\0' <"$baseline" | xargs -0 "$objdump" -d --no-show-raw-insn >"$work/code"
        grep -qE 'mulps|mulss|addps|addss' "$work/code" || fail "no SSE arithmetic found: wrong objects" "$baseline"
        grep -E '[[:space:]]v[a-z0-9]+[[:space:]].*%[xyz]mm|%k[0-7]|%[yz]mm' "$work/code" >"$work/avx" &&
            fail "AVX in the baseline" "$work/avx"
    fi ;;
esac

[ $status = 0 ] && echo "$(wc -l <"$work/exported") exports, $(wc -l <"$work/static") symbols, no variables"
exit $status
