#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cgt-render --cell: the pictures of the shipped trajectory are byte for byte those of an ordinary run; what does not
# fit is refused by a sentence.
#   render_cell_cli.sh CGT_RENDER DATA_DIR SPE_GRID_ELF
# SPE_GRID_ELF: the SPEs' program; "none" where there is no compiler for it.
render=$1
data_dir=$2
elf=$3
[ "$elf" = none ] || elf=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
set -- "$render" "$data_dir"
. "$(dirname "$0")/../cli.sh"
pour=$data/pour2k.lammpstrj
plain="--style plain --no-metadata"

# same ARGUMENTS...: the pictures of $tmp/plain again, with these options more
same() {
    rm -rf "$tmp/cell"
    run 0 -q $plain $picture -o cell/%d.png "$@" "$pour"
    says out '^Cell  '
    diff -r "$tmp/plain" "$tmp/cell" || fail "other pictures: $picture $*"
}

refused="-q -n $plain"

for picture in '-s 96x54 --every 20' '-s 1x1 --first 60 --last 60' '-s 31x13 -a 4 --first 75 --last 76 -k id' \
    '-s 5x61 -a 2 --first 70 --last 70 -c 10,6,5,3,2,1,0,0,1,70'; do
    rm -rf "$tmp/plain"
    run 0 -q $plain $picture -o plain/%d.png "$pour"
    same --cell native
    same --spes 3 --cell-assignment dynamic
    same --cell native --spes 16 --cell-assignment hybrid
    [ -n "$slow" ] || [ "$elf" = none ] || same --cell sim --spes 2 --cell-program "$elf"
done
says out 'doubts a frame'

# ---- What is refused ------------------------------------------------------------------------------------------------

awk 'BEGIN { print "2049\nmany"; for (i = 0; i < 2049; i++) print "C", i % 13, i % 17, i % 19 }' >"$tmp/many.xyz"
awk 'BEGIN { print "600\nheap"; for (i = 0; i < 600; i++) print "C 0 0 0"; print "1\nbad\nC 0 0" }' >"$tmp/heap.xyz"
printf '1\nfar\nC 2e12 0 0\n' >"$tmp/far.xyz"
printf '2\nsome\nC 0 0 0\nC nan 0 0\n0\nnone\n' >"$tmp/some.xyz"
zero='\000\000\000\000'
one='\001\000\000\000'
two='\002\000\000\000'
three='\003\000\000\000'
f1='\000\000\200\077' # 1.0f
printf "CGTFRAM1$two$one$one$zero$zero$one$two$three$zero$zero$zero$f1$zero$zero$zero$f1$zero" >"$tmp/triangle.frames"
refuses 1 'many.xyz: frame 0: the Cell cannot trace it: 2049 spheres take 32784 bytes.*room for 2048' --cell native many.xyz
refuses 1 'too many spheres share cells' --cell native --last 0 heap.xyz
refuses 1 'beyond 2^40' --cell native --origin 0,0,0 far.xyz
refuses 1 'this is a file of triangles' --cell native triangle.frames
refuses 1 'edge has 1 to 32768' --cell native -s 40000x1 some.xyz
refuses 1 'takes --style plain' --cell native --style soft some.xyz
refuses 1 'stats counts' --cell native --stats some.xyz
refuses 1 'none.elf: No such file' --cell sim --cell-program none.elf some.xyz
refuses 1 'no ELF file' --cell sim --cell-program some.xyz some.xyz
refuses 2 'not native, sim or real' --cell ppe some.xyz
[ "$elf" = none ] || [ -d /spu ] || refuses 1 'there are no SPEs' --cell real --cell-program "$elf" some.xyz
refuses 2 '--spes: ' --spes 17 some.xyz
refuses 2 '--spes: ' --spes 0 some.xyz
refuses 2 '--cell-assignment: ' --cell native --cell-assignment best some.xyz
refuses 2 'are for --cell' --cell-assignment static some.xyz
refuses 2 'are for --cell' --cell-program some.elf some.xyz
refuses 2 'has its program built in' --cell native --cell-program some.elf some.xyz
run 0 -q -n $plain --cell native some.xyz
says out '^skipped .*1'

[ $failures -eq 0 ] || exit 1
echo 'cgt-render --cell: as described'
