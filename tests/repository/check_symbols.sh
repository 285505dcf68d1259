#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_symbols.sh SOURCE_DIR STATIC_LIBRARY SHARED_LIBRARY NM OBJDUMP LIST_OF_OBJECTS cflags=CFLAGS
# The list has a line for each object: the row of the variant table that it belongs to, or "common", then its path.
#   1. what check_archive.sh checks of the static library
#   2. the shared library exports exactly what the public headers declare
#   3. an object of a row defines names of its own row only, and nothing that a linker may merge with another object's
#      (weak, common, COMDAT): else a CPU could meet an inline function that was compiled for a wider one
#   4. x86-64: no instruction in a row's objects that its flags do not enable
set -eu
source=$1 static=$2 shared=$3 nm=$4 objdump=$5 objects=$6 cflags=${7#cflags=}
. "${0%/*}/findings.sh"

sh "$source/tests/repository/check_archive.sh" "$nm" "$objdump" "$static" || status=1
(cd "$source/include/cgt" && sh "$source/tests/repository/check_exports.sh" "$nm" "$shared" all_hits.h bounces.h cgt.h \
    research.h) >"$work/exports" || fail "exports of $shared" "$work/exports"

# ---- objects row by row ----

: >"$work/shared_symbols"
while read -r row object; do
    "$nm" --defined-only "$object" | awk -v row="$row" -v object="$object" '
        $2 ~ /[WwVvuCi]/ { print object ": " $0 }
        $2 ~ /[A-Z]/ && row != "common" && $3 !~ "^cgt_[a-z0-9_]+_" row "$" { print object ": not of this row: " $3 }'
    "$objdump" -h "$object" | awk -v object="$object" '/LINK_ONCE/ && last !~ /debug/ { print object ": COMDAT: " last } { last = $0 }'
done <"$objects" >>"$work/shared_symbols"
[ -s "$work/shared_symbols" ] && fail "symbols that objects of several rows may share" "$work/shared_symbols"

# Instructions as patterns of a disassembly, from narrow to wide. Left out is tzcnt, which older CPUs run as bsf: the
# compiler writes it where both give the same.
word='[[:space:]]'
sse41="$word(pshufb|palignr|p?blend[a-z]+|pm(in|ax)(s[bd]|u[wd])|pmulld|pmuldq|ptest|p(insr|extr)[bdq]|insertps|extractps)"
sse41="$sse41|$word(round[sp][sd]|dpp[sd]|pmov[sz]x[a-z]+|packusdw|pcmpeqq|pabs[bwd]|psign[bwd]|ph(add|sub)[a-z]+)"
sse41="$sse41|$word(h(add|sub)p[sd]|addsubp[sd]|mov(ddup|shdup|sldup|ntdqa)|lddqu|phminposuw|mpsadbw|pmaddubsw|pmulhrsw)"
beyond_sse="$word(popcnt|lzcnt|pcmpgtq|pcmp[ei]str[im]|crc32[a-z]*|aes[a-z]+|pclmul[a-z]+|movbe[a-z]*)$word"
avx="${word}v[a-z0-9]+$word.*%[xyz]mm|%[yz]mm"
bmi="$word(andn|bextr|blsi|blsr|blsmsk)[lq]?$word"
bmi2="$word(pdep|pext|mulx|rorx|sarx|shlx|shrx|bzhi)[lq]?$word"
avx512="%zmm|%k[0-7]|%[xy]mm(1[6-9]|2[0-9]|3[01])|\{1to|\{r[nuzd]-sae"
avx512="$avx512|${word}v(pternlog|rndscale|rcp14|rsqrt14|scalef|permt2|permi2|prol|pror|pconflict|plzcnt|fpclass)"
avx512="$avx512|${word}v(range|reduce|getexp|getmant|fixupimm|dbpsadbw|pcompress|pexpand|compressp|expandp|align[dq]$word)"
avx512="$avx512|${word}v(mov(dqa|dqu)(8|16|32|64)|p(and|andn|or|xor)[dq]$word|pmull(q|o)|p(sra|abs|m(in|ax)[su])(q|v?q)$word)"
avx512="$avx512|${word}v((insert|extract|broadcast|shuf)[fi](32|64)x|cvt[a-z0-9]*u(dq|qq|si)|cvtu(dq|qq|si)|pmov[a-z0-9]*2m|pmovm2)"

# check_instructions ROW PATTERN_THAT_MUST_BE_THERE PATTERN_THAT_MUST_NOT
check_instructions() {
    awk -v row="$1" '$1 == row { sub(/^[^ ]* /, ""); print }' "$objects" | tr '\n' '\0' |
        xargs -0 "$objdump" -d --no-show-raw-insn >"$work/code.$1"
    grep -qE -e "$2" "$work/code.$1" || fail "row $1: none of its own instructions found: wrong objects" "$objects"
    grep -nE -e "$3" "$work/code.$1" >"$work/wider" && fail "row $1: instructions of wider CPUs" "$work/wider"
    checked="$checked $1"
}

checked=
case " $cflags " in # where CFLAGS ask for a machine it is the user's choice
*\ -march=*|*\ -m[0-9]*|*\ -mavx*|*\ -mfma*|*\ -msse*|*\ -mssse*|*\ -mbmi*|*\ -mpopcnt*|*\ -mlzcnt*|*\ -mxop*)
    echo "instructions not checked: CFLAGS have $cflags" ;;
*)  if "$objdump" -f "$static" | grep -qE 'architecture: (i386:x86-64|x86_64)'; then
        for row in $(cut -d ' ' -f 1 "$objects" | sort -u); do
            case $row in
            common|portable) check_instructions $row "${word}(mul|add)s[sd]$word" "$sse41|$beyond_sse|$bmi|$bmi2|$avx" ;;
            sse) check_instructions $row "$sse41" "$beyond_sse|$bmi|$bmi2|$avx" ;;
            avx2) check_instructions $row "${word}vfmadd.*%ymm" "$bmi2|$avx512" ;;
            avx512) check_instructions $row "%zmm.*%k[0-7]" "$bmi2" ;;
            *) echo "row $row" >"$work/row" && fail "a row whose instructions this check does not know" "$work/row" ;;
            esac
        done
    fi ;;
esac

[ $status = 0 ] && [ -n "$checked" ] && echo "instructions checked:$checked"
[ $status = 0 ] && echo "$(cat "$work/exports"), no variables"
exit $status
