#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Every sentence of cgt-render and cgt-convert, with a command that brings it out (rows.tsv), and whether the source has
# others: those that no command can bring out are in exceptions.tsv. The readers' sentences, and those
# of <cgt/figure.h>, have tests of their own.
#   messages.sh CGT_RENDER DATA_DIR CGT_CONVERT SOURCE
convert_program=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
source=$4
here=$(cd "$(dirname "$0")" && pwd)
set -- "$1" "$2"
. "$here/../cli.sh"
work=$tmp/work
mkdir "$tmp/in" "$work"
cd "$tmp/in" || exit 2

# ---- Inputs ---------------------------------------------------------------------------------------------------------

xyz() { # xyz FILE ROW...: a frame
    file=$1
    shift
    { printf '%s\n\n' $# && printf '%s\n' "$@"; } >>"$file"
}
xyz one.xyz 'C 0 0 0'
for i in 0 1 2; do xyz run.xyz '1 0 0 0' "1 $i 2 0"; done
for i in 0 1 2; do xyz jump.xyz '1 0 0 0' "1 $((i % 2 * 50)) 0 0" "1 $i 1 0"; done
awk 'BEGIN {
    for (f = 0; f < 2; f++) { print "300\n"; for (i = 0; i < 300; i++) print "C", i % 20, int(i / 20), i || f } }' >rest.xyz
awk 'BEGIN { for (f = 0; f < 2; f++) { print "200\n"; for (i = 0; i < 200; i++) print "C", i + f, 0, 0 } }' >drift.xyz
xyz far.xyz 'C 5000000 0 0' 'C 5000003 1 0'
xyz huge.xyz 'Q 3e38 0 0' 'Q -3e38 0 0'
printf '2\nProperties=species:S:1:pos:R:3:radius:R:1\nC nan 0 0 1\nC 0 0 0 -1\n' >odd.xyz
printf '1\nProperties=species:S:1:pos:R:3:name:I:1:resname:I:1\nC 0 0 0 1 1\n' >named.xyz
printf '1\nLattice="9 0 0 0 9 0 0 0 9"\nC 0 0 0\n' >box.xyz
sed '3s/C/1/' box.xyz >typed_box.xyz
printf '%s\n' 'HETATM    1  C1  LIG A   1       0.000   0.000   0.000' 'HETATM    2  O1  LIG A   1       1.400   0.000   0.000' \
    'CONECT    1    2' END >conect.pdb
printf 'ring\n\n3 atoms\n3 bonds\n1 atom types\n0 9 xlo xhi\n\nAtoms # atomic\n\n1 1 1 0 0\n2 1 4 0 0\n3 1 7 0 0\n' >ring.data
printf '\nBonds\n\n1 1 1 2\n2 1 2 3\n3 1 3 1\n' >>ring.data
awk 'BEGIN { print "3000\n"; for (i = 0; i < 3000; i++) print "C", i % 60, int(i / 60), 0 }' >many.xyz
sed '2s/.*/Lattice="60 0 0 0 60 0 0 0 9"/' many.xyz >many_box.xyz
awk 'BEGIN { print "201\n\n1 1e6 0 0"; for (i = 0; i < 200; i++) print 1, i % 6, int(i / 6) % 6, int(i / 36) }' >stray.xyz
{ cat one.xyz; printf '2\n\nC 0 0 0\n'; } >cut.xyz
{ cat run.xyz one.xyz | head -n 14; } >cut3.xyz
: >empty.lammpstrj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >tri.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n' >flat.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n' >normals.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\np 3\n' >lines.obj
printf 'ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS id x y z vx vy vz\n1 1 1 1 1 0 0\n' \
    >velocity.lammpstrj
dump_of() { # dump_of COLUMNS ROW
    printf 'ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS id %s\n%s\n' "$1" "$2"
}
{ dump_of 'x y z ix iy iz' '1 1 1 1 0 0 0' && dump_of 'x y z' '1 1 1 1'; } >flags_end.lammpstrj
dump_of 'type x y z' '1 70000 1 1 1' >high_types.lammpstrj
echo '0 0,0,9,0,0,0,0,1,0,30' >good.keys
echo '0' >bad.keys
echo '0 0,0,9,0,0,0,0,1,0,30 fast' >pace.keys
cat good.keys good.keys >order.keys
: >lines.keys
printf '# a map\n0 0 0\n0.5 0.5 -1\n' >bad.map
printf '0 0 0\n#ffffff\n' >both.map
yes '1 2 3' | head -n 4097 >many.map
printf '\n#ff0000\n\n' >one.map
yes '#' | head -n 1000001 >lines.txt
awk 'BEGIN { for (i = 0; i < 65537; i++) print i, "0,0,9,0,0,0,0,1,0,30" }' >many.keys
echo 'colour = red' >bad.txt
echo 'no-metadata = 1' >plain.txt
echo title >title.txt
yes 'style = soft' | head -n 100001 >many.txt
awk 'BEGIN { printf "title = "; for (i = 0; i < 9000; i++) printf "a"; print "" }' >long.txt
head -c 20000000 /dev/zero >big.elf
mkdir folder.png
ln -s loop.png loop.png

render() { "$program" -q -n -s 8x8 "$@"; }
pictures() { "$program" -q -s 8x8 "$@"; }
convert() { "$convert_program" "$@"; }
long() { head -c "$1" /dev/zero | tr '\0' a; } # a word of N letters
sum() { yes '+1' | head -n "$1" | tr -d '\n'; }
nested() { yes '(' | head -n "$1" | tr -d '\n'; }
fake() { # fake COMMANDS ...: the rest with an ffmpeg of these commands
    mkdir -p fake
    printf '#!/bin/sh\n%s\n' "$1" >fake/ffmpeg
    chmod +x fake/ffmpeg
    shift
    PATH=$tmp/in/fake:$PATH "$@"
}

if render --title A one.xyz 2>&1 | grep -q 'FreeType\|DejaVu'; then
    echo "no text on pictures: other sentences"
    exit 0
fi

# ---- Rows -----------------------------------------------------------------------------------------------------------

tab=$(printf '\t')
grep -v '^#' "$here/rows.tsv" >"$work/rows"
while IFS=$tab read -r code sentence command; do
    rm -rf a.png a.frames out
    (eval "$command") >"$work/stdout" 2>"$work/stderr" </dev/null
    got=$?
    cat "$work/stderr" "$work/stdout" >>"$work/sentences"
    [ "$got" -eq "$code" ] || fail "exit code $got, not $code: $command: $(head -n 2 "$work/stderr")"
    grep -qF -e "$sentence" "$work/stderr" "$work/stdout" ||
        fail "no \"$sentence\": $command: $(head -n 2 "$work/stderr" "$work/stdout" | cut -c1-300)"
done <"$work/rows"

# ---- The source -----------------------------------------------------------------------------------------------------

for folder in figure programs/common programs/convert programs/picture programs/playback programs/render; do
    find "$source/$folder" -name '*.[ch]' -o -name '*.cpp'
done | grep -vE '/(option_table|option_rows|figure(_data|_frame|_settings|_steps|_tell)?)\.c$' >"$work/files"
LC_ALL=C awk -F '\t' -v files="$work/files" -v root="$source/" -f "$source/tests/support/sentences.awk" \
    "$work/sentences" "$here/exceptions.tsv" || failures=$((failures + 1))

[ "$failures" -eq 0 ] || exit 1
