#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cgt-bench cell: the built-in programs take the cycles counted by hand; files run, or are refused by a sentence.
#   cell_cli.sh CGT_BENCH [EMULATOR...]
bench=$1
shift
set -- "$bench" . "$@"
. "$(dirname "$0")/../cli.sh"

# ---- Built-in programs ----------------------------------------------------------------------------------------------

run 0 cell
awk -F '\t' '
    NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
    /^#/ { exit }
    { rows++; if ($column["cycles"] != $column["by_hand"]) bad = 1 }
    END { exit !(rows > 15) || bad }' "$tmp/stdout" || fail 'cycles that are not those by hand'
for section in simulator pipes constants; do
    grep -qx "# $section" "$tmp/stdout" || fail "no section $section"
done
grep -q '^# MISPREDICT	18	' "$tmp/stdout" || fail 'no constants of the model'

# ---- Files ----------------------------------------------------------------------------------------------------------

# elf WORDS MACHINE: a program at address 0, its two instructions as octal bytes
elf() {
    printf '\177ELF\001\002\001\000\000\000\000\000\000\000\000\000'
    printf "\\000\\002\\000$2"'\000\000\000\001\000\000\000\000\000\000\000\064\000\000\000\000'
    printf '\000\000\000\000\000\064\000\040\000\001\000\050\000\000\000\000'
    printf '\000\000\000\001\000\000\000\124\000\000\000\000\000\000\000\000'
    printf '\000\000\000\010\000\000\000\010\000\000\000\005\000\000\000\004'
    printf "$1"
}
lnop='\000\040\000\000'
elf "$lnop"'\000\000\040\000' '\027' >"$tmp/good.elf"    # stop 0x2000: exit 0
elf "$lnop"'\000\000\040\003' '\027' >"$tmp/exit3.elf"   # stop 0x2003: exit 3
elf "$lnop$lnop" '\027' >"$tmp/code0.elf"              # a stop with code 0 behind it
elf "$lnop"'\170\140\000\000' '\027' >"$tmp/undefined.elf"
elf "$lnop"'\062\177\377\200' '\027' >"$tmp/loop.elf"    # br to itself less one
elf "$lnop$lnop" '\025' >"$tmp/powerpc.elf"

run 0 cell "$tmp/good.elf"
[ "$(awk -F '\t' '$1 == "(all)" { print $2, $4 }' "$tmp/stdout")" = '2 2' ] || fail 'cycles or instructions of a file'
run 1 cell "$tmp/exit3.elf"
says err 'exit status 3'
run 0 cell "$tmp/code0.elf"
says err 'stops at 0x00008 with 0x0'
run 1 cell "$tmp/undefined.elf"
says err 'at 0x00004: instruction 0x78600000'
run 1 cell --cycles 1000 "$tmp/loop.elf"
says err 'does not stop'
run 1 cell "$tmp/powerpc.elf"
says err 'another machine than the SPU'
echo text >"$tmp/text.elf"
run 1 cell "$tmp/text.elf"
says err 'no ELF file'
run 1 cell "$tmp/none.elf"
says err 'No such file'

# ---- Command line ---------------------------------------------------------------------------------------------------

run 0 cell --help
run 2 cell "$tmp/good.elf" "$tmp/good.elf"
says err 'one FILE only'
run 2 cell --bih "$tmp/good.elf" "$tmp/good.elf"
says err '--bih wants --kd'
run 1 cell --kd --section structures "$tmp/good.elf"
says err 'wants --bih'
run 1 cell --kd --bih "$tmp/none.elf" "$tmp/good.elf"
says err 'No such file'
for kind in --frames --kd; do # an endless program ends there, too
    run 1 cell $kind --cycles 100000 "$tmp/loop.elf"
    says err 'the limit of 100000 cycles is reached'
done
run 2 cell --frames
says err 'want the program'
run 2 cell --cycles 0
says err '--cycles'
run 1 cell -j "$tmp/no/folder.json"
run 0 cell -j "$tmp/cell.json" "$tmp/good.elf"
grep -q '"functions"' "$tmp/cell.json" || fail 'no JSON'

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cgt-bench cell: as described'
