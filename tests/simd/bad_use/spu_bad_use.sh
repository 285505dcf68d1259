#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# spu_bad_use.sh SOURCE_DIR CC [own]
# Wrong uses of the vocabulary (spu_bad_use/cases.txt) do not compile, and the message speaks of the word or of types;
# the right use next to each compiles without a warning, so the error is the wrong type and not a typo. Checks the
# machine's own mapping and the portable one; own: only the former, which is all that another machine adds.
set -eu
source=$1 cc=$2 portable=-DCGT_SPU_PORTABLE least=100 # cases, of all mappings
[ "${3:-}" != own ] || portable='' least=50
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C
failed=0 count=0 lax=0

# compile EXPRESSION FLAGS...
compile() {
    expression=$1
    shift
    cat >"$work/use.c" <<END
#include <spu_intrinsics.h>
struct structure {
    int a, b, c, d;
};
void use(vec_uchar16 b, vec_char16 c, vec_ushort8 k, vec_short8 h, vec_uint4 u, vec_int4 i, vec_ullong2 v, vec_llong2 l,
         vec_float4 f, vec_double2 d, int n, float x, struct structure s);
void use(vec_uchar16 b, vec_char16 c, vec_ushort8 k, vec_short8 h, vec_uint4 u, vec_int4 i, vec_ullong2 v, vec_llong2 l,
         vec_float4 f, vec_double2 d, int n, float x, struct structure s)
{
    (void)b, (void)c, (void)k, (void)h, (void)u, (void)i, (void)v, (void)l, (void)f, (void)d, (void)n, (void)x, (void)s;
    (void)$expression;
}
END
    # -Wno-psabi: of vectors passed by value, where the machine has no register for them
    "$cc" -std=c11 -fsyntax-only -Wno-psabi -I"$source/simd" "$@" "$work/use.c" >"$work/message" 2>&1
}

fail() {
    echo "FAILED: $1"
    head -n 8 "$work/message" | sed 's/^/    /'
    failed=$((failed + 1))
}

# refused EXPRESSION FLAGS...: does not compile, and says why
refused() {
    if compile "$@"; then
        return 1
    fi
    grep -qE "spu_|_Generic|generic|vec_|vector|incompatible|association|no matching|argument" "$work/message" ||
        fail "$1: the message does not say what is wrong"
}

# check KIND WRONG RIGHT FLAGS...
check() {
    kind=$1 wrong=$2 right=$3
    shift 3
    count=$((count + 1))
    compile "$right" -Wall -Wextra -Werror "$@" || fail "$right does not compile"
    refused "$wrong" "$@" && return
    if [ "$kind" = strict ] && refused "$wrong" -fno-lax-vector-conversions "$@"; then
        lax=$((lax + 1))
        return
    fi
    fail "$wrong compiles"
}

sed 's/ *| */|/g' "$source/tests/simd/bad_use/cases.txt" >"$work/cases"
for mapping in "" $portable; do
    while IFS='|' read -r kind wrong right; do
        case $kind in
        always|strict) check "$kind" "$wrong" "$right" ${mapping:+"$mapping"} ;;
        '#'*|'') ;;
        *) echo "cases.txt: neither always nor strict: $kind|$wrong|$right"; exit 2 ;;
        esac
    done <"$work/cases"
done
[ $count -gt $least ] || { echo "only $count cases found"; exit 1; }
echo "$count wrong uses, $failed failures; $lax need -fno-lax-vector-conversions with $cc"
[ $failed -eq 0 ]
