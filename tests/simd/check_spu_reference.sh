#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_spu_reference.sh SOURCE_DIR CC
# docs/guide/spu.md has a row for every word of the vocabulary, and for nothing else: table rows that begin
#     | `spu_WORD` | OVERLOADS |
# The words that compute, with their overloads, are those of simd/spu/spu_words.h, counted by the preprocessor; the others
# are what simd/spu_channels.h defines, whose second column is free. There are 95 words in all, __align_hint aside.
set -eu
source=$1 cc=$2
. "$source/tests/repository/findings.sh"

cat >"$work/words.c" <<'END'
#include "spu/spu_words.h"
#define ROW(word, ...) @row spu_##word@
CGT_SPU_WORDS(ROW, ROW, ROW)
END
"$cc" -std=c11 -E -P -I"$source/simd" "$work/words.c" | tr '@' '\n' | awk '$1 == "row" { count[$2]++ }
    END { for (word in count) print word, count[word] }' | sort >"$work/words"
awk '{ n += $2 } END { exit !(NR == 72 && n == 455) }' "$work/words" ||
    fail "simd/spu/spu_words.h: not 455 overloads of 72 words" "$work/words"

# what the channels' header defines: macros and functions, not those of its own (cgt_)
sed -nE 's/^#define ((spu_[a-z0-9_]+|__align_hint)).*/\1/p
         s/^[A-Za-z][A-Za-z0-9_ *]*[ *](spu_[a-z0-9_]+)\(.*/\1/p' "$source/simd/spu_channels.h" |
    sort -u >"$work/channels"
grep -c '^spu_' "$work/channels" | grep -qx 23 || fail "simd/spu_channels.h: not 23 words" "$work/channels"

[ -r "$source/docs/guide/spu.md" ] || { echo "no docs/guide/spu.md"; exit 1; }
awk -F '|' '/^\| `(spu_[a-z0-9_]+|__align_hint)` \|/ {
    gsub(/[ `]/, "", $2)
    gsub(/ /, "", $3)
    print $2, $3
}' "$source/docs/guide/spu.md" | sort >"$work/rows"
cut -d ' ' -f 1 "$work/rows" | uniq -d >"$work/twice"
[ -s "$work/twice" ] && fail "docs/guide/spu.md: more than one row" "$work/twice"

cut -d ' ' -f 1 "$work/words" | sort -m - "$work/channels" >"$work/names"
cut -d ' ' -f 1 "$work/rows" | sort -u >"$work/documented"
comm -23 "$work/names" "$work/documented" >"$work/missing"
comm -13 "$work/names" "$work/documented" >"$work/superfluous"
[ -s "$work/missing" ] && fail "docs/guide/spu.md: no row for" "$work/missing"
[ -s "$work/superfluous" ] && fail "docs/guide/spu.md: a row, but no word" "$work/superfluous"

join "$work/words" "$work/rows" | awk '$2 != $3 { print $1 ": " $2 " overloads, docs/guide/spu.md says " $3 }' >"$work/counts"
[ -s "$work/counts" ] && fail "overloads" "$work/counts"

[ $status = 0 ] && echo "$(wc -l <"$work/documented") rows for $(wc -l <"$work/names") words"
exit $status
