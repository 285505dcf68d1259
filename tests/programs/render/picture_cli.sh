#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The options of cgt-render about how pictures look: styles, light, figures, texts, settings. What each does to pixels
# is checked by unit tests; here that it reaches them, and what is refused.
#   picture_cli.sh CGT_RENDER DATA_DIR [EMULATOR...]
. "$(dirname "$0")/../cli.sh"

# A row of touching spheres over two large ones, in a box that leans, with charges and velocities.
{
    printf '8\nLattice="8 0 0 0 8 0 2 0 8" Properties=species:S:1:pos:R:3:charge:R:1:vel:R:3 Time=2.5\n'
    for i in 1 2 3 4 5 6; do
        printf 'O %s 4 4 %s 0 0 %s\n' $i $((i * i)) $i
    done
    printf 'H 2 2 2 -1 0 0 0\nC 6 2 2 -2 1 0 0\n'
} >"$tmp/row.xyz"
camera=4,-18,8,4,4,4,0,0,1,30
printf 'v 0 6 0\nv 8 6 0\nv 8 6 8\nf 1 2 3\n' >"$tmp/wall.obj"

# ---- The floor ------------------------------------------------------------------------------------------------------

for style in soft paper plain; do
    draw floor_$style -c $camera --style $style --floor row.xyz
    differs $style floor_$style "--floor in $style"
    draw lit_$style -c $camera --style $style --floor --no-shadows row.xyz
    differs floor_$style lit_$style "the floor's shadow in $style"
done
draw red_floor -c $camera --floor=red row.xyz
differs floor_soft red_floor --floor=red
draw height -c $camera --floor --floor-height=0.3 row.xyz # of the ball of 1.7 at 2
same floor_soft height "--floor is not below the lowest ball"
draw axis -c $camera --floor-axis=z row.xyz
same floor_soft axis "up is not the floor's axis"
draw ceiling -c $camera --floor-axis=-z --floor-height=-0.3 row.xyz
same floor_soft ceiling "--floor-axis=-z"
draw wall -c $camera --floor-axis=-y row.xyz
differs floor_soft wall "--floor-axis=-y"
draw tipped --floor --up y row.xyz
draw tipped_axis --floor-axis=y --up y row.xyz
same tipped tipped_axis "--up y is not the floor's axis"
draw transparent -c $camera --floor --mesh wall.obj --mesh-opacity 0.5 --box row.xyz
differs floor_soft transparent "a floor among figures"
# The lowest of all frames counts.
{ cat "$tmp/row.xyz" && sed 's/^C 6 2 2/C 6 2 1/' "$tmp/row.xyz"; } >"$tmp/sinking.xyz"
draw above -c $camera --floor --last 0 sinking.xyz
draw below -c $camera --floor-height=-0.7 --last 0 row.xyz
same above below "the floor of a run is not below its lowest frame"
# Depths are those of each key, which are not all as far away.
far=4,-90,30,4,4,4,0,0,1,12
printf '0 %s\n1 %s\n' $camera $far >"$tmp/cue.keys"
draw cue_key --camera-keys cue.keys --style plain --light 1,-1,1 --depth-cue --first 1 sinking.xyz
draw cue_camera -c $far --style plain --light 1,-1,1 --depth-cue --first 1 sinking.xyz
same cue_key cue_camera "--depth-cue is not that of the frame's camera"
draw place -c $camera --floor-place=0,0,0.3,10 row.xyz
draw placed -c $camera --floor-place=0,0,5,10 --floor-height 0.3 row.xyz
same place placed "--floor-height does not count with --floor-place"
differs floor_soft place "--floor-place"
refuses 2 '--floor-place: .*above 0' --floor-place=1,2,3,0 row.xyz
refuses 2 '--floor: ' --floor=reddish row.xyz
refuses 2 '--floor-axis: ' --floor-axis=w row.xyz
refuses 1 '--cell' --cell native --style plain --floor row.xyz

# ---- What is no atom ------------------------------------------------------------------------------------------------

printf '4\n\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\nM 3 0 0\n' >"$tmp/tip4p.xyz"
sed '/^M/d;1s/4/3/' "$tmp/tip4p.xyz" >"$tmp/water.xyz"
draw atoms -c 0,0,9,0,0,0,0,1,0,60 water.xyz
draw no_site -c 0,0,9,0,0,0,0,1,0,60 tip4p.xyz
says err '1 of 4 spheres are no atoms'
same atoms no_site "a virtual site is drawn"
draw site -c 0,0,9,0,0,0,0,1,0,60 --show 'site >= 0' tip4p.xyz
differs atoms site "--show does not bring virtual sites back"
draw no_column -c 0,0,9,0,0,0,0,1,0,60 --show 'site == 0' water.xyz
same atoms no_column "a file without sites has none to show"

# ---- Periodic boxes and zoom ----------------------------------------------------------------------------------------

# Two molecules that leave a box of 8 through a face and through an edge, as a dump, with bonds in a data file.
dump() { # dump COLUMNS ROW...
    printf 'ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n%s\nITEM: BOX BOUNDS pp pp pp\n0 8\n0 8\n0 8\nITEM: ATOMS id type %s\n' \
        $(($# - 1)) "$1"
    shift
    printf '%s\n' "$@"
}
atoms() { # atoms FORM: a data file
    printf 'data\n\n5 atoms\n3 bonds\n1 atom types\n0 8 xlo xhi\n0 8 ylo yhi\n0 8 zlo zhi\n\nAtoms # %s\n\n' "$1"
    cat
    printf '\nBonds\n\n1 1 1 2\n2 1 2 3\n3 1 5 4\n'
}
dump 'x y z ix iy iz' '1 1 6 2 2 1 0 0' '2 1 7.5 2 2 1 0 0' '3 1 1 2 2 2 0 0' '4 1 7.5 7.5 4 0 -1 0' '5 1 1 1 4 1 0 0' \
    >"$tmp/flags.lammpstrj"
dump 'x y z' '1 1 6 2 2' '2 1 7.5 2 2' '3 1 1 2 2' '4 1 7.5 7.5 4' '5 1 1 1 4' >"$tmp/wrapped.lammpstrj"
dump 'xu yu zu' '1 1 14 2 2' '2 1 15.5 2 2' '3 1 17 2 2' '4 1 7.5 -0.5 4' '5 1 9 1 4' >"$tmp/far.lammpstrj"
dump 'xu yu zu' '1 1 6 2 2' '2 1 7.5 2 2' '3 1 9 2 2' '4 1 7.5 7.5 4' '5 1 9 9 4' >"$tmp/first.lammpstrj"
dump 'xu yu zu' '1 1 6 2 2' '2 1 7.5 2 2' '3 1 9 2 2' '4 1 -0.5 -0.5 4' '5 1 1 1 4' >"$tmp/middle.lammpstrj"
sed -n '/^[1-5] 1/p' "$tmp/flags.lammpstrj" | atoms atomic >"$tmp/flags.data"
sed -n '/^[1-5] 1/p' "$tmp/wrapped.lammpstrj" | atoms atomic >"$tmp/bonds.data"
for way in far first; do
    draw $way --bonds=2 -k id --wrapped $way.lammpstrj
done
draw by_flags --bonds=2 -k id --unwrap flags.lammpstrj
same far by_flags "--unwrap by image flags"
draw by_data --bonds=2 -k id --unwrap flags.data
same far by_data "--unwrap by the flags of a data file"
draw by_bonds --bonds=2 -k id --unwrap --topology bonds.data wrapped.lammpstrj
same first by_bonds "--unwrap by bonds of the topology"
draw by_own_bonds --bonds=2 -k id --unwrap bonds.data
same first by_own_bonds "--unwrap by bonds"
draw unchanged --bonds=2 -k id far.lammpstrj
draw moved --bonds=2 -k id --unwrap far.lammpstrj
same unchanged moved "--unwrap of what is unwrapped"
draw middle --bonds=2 -k id middle.lammpstrj
draw whole --bonds=2 -k id --whole bonds.data
same middle whole "--whole"
draw stale --bonds=2 -k id --unwrap --topology flags.data wrapped.lammpstrj
same first stale "--unwrap by the image flags of another time"
# An ion through the boundary: followed from the file's first frame on, whichever frames are drawn.
for x in 9.0 9.6 0.2 0.8; do
    printf '1\nLattice="10 0 0 0 10 0 0 0 10"\nNa %s 5 5\n' $x
done >"$tmp/ion.xyz"
printf '1\n\nNa 10.8 5 5\n' >"$tmp/gone.xyz"
draw gone -c 10,5,20,10,5,5,0,1,0,30 gone.xyz
draw followed -c 10,5,20,10,5,5,0,1,0,30 --unwrap --first=3 ion.xyz
says err 'no image flags: spheres are followed from frame to frame'
same gone followed "--unwrap of a part of a run"
refuses 1 '--whole: frame 0 has no bonds' --whole flags.lammpstrj
refuses 2 '--unwrap and --whole exclude each other' --unwrap --whole bonds.data

draw usual row.xyz
draw four_rays -a 2 row.xyz
same usual four_rays "-a 2 is not the default"
# Camera, ranges and legend know nothing of what is left out: as of a run without it.
run_of() { # run_of COUNT: spheres 1 to COUNT of a run of two frames
    for frame in 0 1; do
        awk -v count="$1" -v frame=$frame 'BEGIN {
            print "ITEM: TIMESTEP\n" frame "\nITEM: NUMBER OF ATOMS\n" count
            print "ITEM: BOX BOUNDS pp pp pp\n0 99\n0 99\n0 99\nITEM: ATOMS id type x y z q vx vy vz"
            for (i = 1; i <= count; i++)
                print i, i % 5, i * 7 % 13 + frame, i % 7, i * i % 11, i * i, i + frame, 0, 0 }'
    done
}
run_of 400 >"$tmp/crowd.lammpstrj"
run_of 20 >"$tmp/some.lammpstrj"
for colors in 'id' 'q' 'speed' 'height' 'type'; do
    draw some --last=0 -k "$colors" --colorbar some.lammpstrj
    draw filtered --last=0 -k "$colors" --colorbar --show 'id <= 20' crowd.lammpstrj
    same some filtered "-k $colors of spheres that --show leaves"
done

draw fitted row.xyz
draw zoom_1 --zoom=1 row.xyz
same fitted zoom_1 "--zoom=1"
draw zoom_2 --zoom=2 row.xyz
differs fitted zoom_2 "--zoom=2"
run 0 -n -s 9x9 --zoom=2 --fov=90 row.xyz # half of tan 45 degrees is tan 26.565
says out '^camera .*,53\.13010'
refuses 2 '--zoom: ' --zoom 0 row.xyz
refuses 2 'is for the automatic camera' --zoom 2 -c $camera row.xyz

# ---- Style and light ------------------------------------------------------------------------------------------------

draw soft -c $camera row.xyz
draw again -c $camera -t 3 row.xyz
same soft again "three threads draw another picture"
draw soft_named -c $camera --style=soft row.xyz
same soft soft_named "soft is not the default style"
for style in paper plain; do
    draw $style -c $camera --style $style row.xyz
    differs soft $style "--style $style"
done
draw by_hand -c $camera --style plain --ambient 5 --shadows --light-strength 0.62 --fill 0.36 --head 0.1 \
    --background 2a2f37 row.xyz
same soft by_hand "soft is not what its options say"
i=0
for option in --ambient=4 --ambient-radius=1 --no-shadows --light-size=10 --light-strength=0.9 --fill=0.1 --head=0.5 \
    --sun=1,-1,0 --lamp=4,-9,9,0.6,ff0000 --background=white --ortho --depth-cue --outline=2 --transparent --axes; do
    i=$((i + 1))
    draw "light_$i" -c $camera "$option" row.xyz
    differs soft "light_$i" "$option"
done
refuses 2 '--style: ' --style oil row.xyz
refuses 2 '--ambient: ' --ambient 1000 row.xyz
refuses 2 '--sun: ' --sun 0,0,0 row.xyz
refuses 2 '--lamp: ' --lamp 1,2 row.xyz
refuses 2 '--lamp: ' --lamp 1,2,3,0.5,purplish row.xyz
refuses 2 '--background: ' --background whitish row.xyz
refuses 2 '--light-size: ' --light-size 90 row.xyz
refuses 2 '--outline: ' --outline=-1 row.xyz

run 2 -q --transparent -o refused.jpg row.xyz
says err '--transparent: .*no opacity'

# ---- What is drawn --------------------------------------------------------------------------------------------------

i=0
for option in --hide=1 --show='charge > 5' --slice=1,0,0,3 --cut=0,0,0,8,3,8 --radius-by='0.2 + charge / 100' \
    --radius-scale=0.5 --type-radius=O=0.2 --type-color=O=blue --images=2,1,1 --box --arrows='0,0,charge/9' \
    --color=charge --color=type --color='vz + 1'; do
    i=$((i + 1))
    draw "drawn_$i" -c $camera "$option" row.xyz
    differs soft "drawn_$i" "$option"
done
draw thin -c $camera --radius-scale=0.2 row.xyz
draw bonded -c $camera --radius-scale=0.2 --bonds=1.1 row.xyz
differs thin bonded --bonds

# Sticks follow the spheres, and an Angstrom where there are elements: the same in nanometres looks the same.
printf 'two\n2\n    1WAT      C    1   0.000   0.000   0.000\n    1WAT      C    2   0.150   0.000   0.000\n9 9 9\n' >"$tmp/nm.gro"
printf '2\nangstrom\nC 0 0 0\nC 1.5 0 0\n' >"$tmp/angstrom.xyz"
draw nanometres -c 0.07,0,1,0.07,0,0,0,1,0,30 --style=plain --radius-scale=0.2 --bonds nm.gro
draw angstrom -c 0.7,0,10,0.7,0,0,0,1,0,30 --style=plain --radius-scale=0.2 --bonds angstrom.xyz
same nanometres angstrom "bonds of a file in nanometres"
{ cat "$tmp/nm.gro" && sed 's/0\.000$/0.050/' "$tmp/nm.gro"; } >"$tmp/nm_run.gro"
{ cat "$tmp/angstrom.xyz" && sed 's/ 0$/ 0.5/' "$tmp/angstrom.xyz"; } >"$tmp/angstrom_run.xyz"
draw nm_run -c 0.07,-1,0.5,0.07,0,0,0,0,1,30 --style=plain --radius-scale=0.2 --arrows 0,0,0.1 --trails 1 --first 1 nm_run.gro
draw angstrom_run -c 0.7,-10,5,0.7,0,0,0,0,1,30 --style=plain --radius-scale=0.2 --arrows 0,0,1 --trails 1 --first 1 \
    angstrom_run.xyz
same nm_run angstrom_run "arrows and trails of a file in nanometres"
draw nm_bare -c 0.07,-1,0.5,0.07,0,0,0,0,1,30 --style=plain --radius-scale=0.2 --arrows 0,0,0.1 --first 1 nm_run.gro
differs nm_run nm_bare "--trails in nanometres"
for scale in 1 1000; do
    printf '2\nProperties=species:S:1:pos:R:3:radius:R:1\n1 0 0 0 %s\n2 %s 0 0 %s\n' $((2 * scale)) $((4 * scale)) \
        $((3 * scale)) >"$tmp/by$scale.xyz"
    draw "sticks$scale" -c "0,0,$((20 * scale)),0,0,0,0,1,0,30" --style=plain --bonds="$((5 * scale))" \
        --arrows=x,y,z "by$scale.xyz"
done
same sticks1 sticks1000 "bonds and arrows of spheres in another unit"
draw hidden -c $camera --show='element != 8' row.xyz
draw sliced -c $camera --cut=-9,-9,-9,9,3,9 row.xyz
same hidden sliced "two ways of leaving out the oxygens differ"
draw no_oxygens -c $camera --hide=O row.xyz
same hidden no_oxygens "--hide of an element"
draw no_charges -c $camera --hide='element == O and charge > 0' row.xyz
same hidden no_charges "--hide of a formula"
draw no_word -c $camera --show='species != "O"' row.xyz
same hidden no_word "--show by a word"
draw no_carbons -c $camera --hide=H,2 row.xyz
differs hidden no_carbons "--hide=H,2"
refuses 2 '--hide: "1,x", at character 2: the formula should end here' --hide 1,x row.xyz
refuses 1 'no column "resname", by which to know water, but x, y, z' --hide water row.xyz
refuses 2 '--show: ' --show 'charge >' row.xyz
refuses 1 'no column "mass", but x, y, z' --show 'mass > 1' row.xyz
refuses 2 '--type-color: ' --type-color Xx=red row.xyz
# Types that are elements: as if the dump had told.
dump 'element x y z' '1 1 O 2 2 2' '2 2 H 2.96 2 2' '3 2 H 1.76 2.93 2' '4 3 Ar 7.7 4 4' >"$tmp/told.lammpstrj"
dump 'x y z' '1 1 2 2 2' '2 2 2.96 2 2' '3 2 1.76 2.93 2' '4 3 7.7 4 4' >"$tmp/typed.lammpstrj"
refuses 1 'has no bonds; give .*, or the elements of its types by --type-element' --bonds typed.lammpstrj
for options in '' '--bonds --radius-scale=0.4' '--hide=H --color=element' '--whole --bonds=1' '-r 0.7'; do
    draw told $options told.lammpstrj
    draw typed $options --type-element 1=O,2=H --type-element 3=Ar typed.lammpstrj
    same told typed "--type-element $options"
done
refuses 2 '--type-element: ' --type-element 1=Xx typed.lammpstrj
refuses 2 '--type-element: ' --type-element O=1 typed.lammpstrj
refuses 2 '--type-element: ' --type-element 1 typed.lammpstrj
# Maps of one's own: from black to white and on to red, in four spellings.
printf '0 0 0\n1,1,1\n1.0\t0\t0\n' >"$tmp/shares.map"
printf '\357\273\277# black, white, red\r\n  0 0 0\r\n\r\n255 255 255\r\n255 0 0' >"$tmp/bytes.map"
printf '#000000\n# a remark\nffFFff \nFF0000\n' >"$tmp/hex.map"
awk 'BEGIN { for (i = 0; i <= 2000; i++) print i < 1000 ? i * .255 : 255, i < 1000 ? i * .255 : (2000 - i) * .255,
    i < 1000 ? i * .255 : (2000 - i) * .255 }' >"$tmp/long.map"
draw viridis -c $camera --color=charge row.xyz
for map in shares bytes hex long; do
    draw map_$map -c $camera --color=charge --style=plain --colormap=$map.map row.xyz
done
differs viridis map_shares "--colormap of a file"
same map_shares map_bytes "colours from 0 to 255"
same map_shares map_hex "colours as RRGGBB"
draw map_types -c $camera --color=type --colormap=hex.map row.xyz
draw map_none -c $camera --color=type row.xyz
same map_types map_none "a map changes the colours of types"
if command -v oiiotool >/dev/null 2>&1; then
    oiiotool --diff --fail 0.01 "$tmp/map_shares.png" "$tmp/map_long.png" >/dev/null || fail "a long map is another one"
fi
# What is seen through: by element, type or formula, the last that fits.
draw faded -c $camera --opacity O=0.4 row.xyz
differs soft faded --opacity
draw faded_as -c $camera --opacity 'vz != 0=0.4' row.xyz
same faded faded_as "--opacity by a formula"
draw faded_again -c $camera --opacity H=1 --opacity O=0.9 --opacity 'charge > 0=0.4' row.xyz
same faded faded_again "the last --opacity does not count"
draw faded_both -c $camera --opacity O=0.4 --opacity H=0.4 row.xyz
draw faded_all -c $camera --opacity 'species != "C"=0.4' row.xyz
same faded_both faded_all "the first of two --opacity does not count"
differs faded faded_both "a second --opacity"
printf '2\n\nO 0 0 0\nC 1.4 0 0\n' >"$tmp/bond.xyz"
for opacity in O=0.4 C=0.4; do
    draw mixed -c 0.7,0,9,0.7,0,0,0,1,0,30 --radius-scale=0.3 --bonds --opacity $opacity bond.xyz
    draw mixed_as -c 0.7,0,9,0.7,0,0,0,1,0,30 --radius-scale=0.3 --bonds --opacity $opacity --opacity bonds=0.4 bond.xyz
    same mixed mixed_as "a bond is not as transparent as the end of $opacity"
done
draw solid -c $camera --opacity O=0.4 --opacity O=1 row.xyz
same soft solid "what is opaque again"
draw unknown -c $camera --opacity 'sqrt(-charge - 9) >= 0=0.4' --opacity 'log(-1)=0.4' row.xyz
same soft unknown "--opacity where nothing is known"
draw joined -c $camera --radius-scale=0.2 --bonds=1.1 --opacity O=0.4 row.xyz
draw joined_as -c $camera --radius-scale=0.2 --bonds=1.1 --opacity O=0.4 --opacity bonds=0.4 row.xyz
same joined joined_as "bonds are not as transparent as their ends"
draw joined_solid -c $camera --radius-scale=0.2 --bonds=1.1 --opacity O=0.4 --opacity bonds=1 row.xyz
differs joined joined_solid "--opacity of bonds"
refuses 2 '--opacity: ' --opacity 2 row.xyz
refuses 2 '--opacity: ' --opacity O=1.5 row.xyz
refuses 2 '--opacity: "charge >", at character' --opacity 'charge >=0.5' row.xyz
refuses 2 '--opacity and --bounces exclude each other' --opacity O=0.5 --bounces 2 row.xyz
refuses 1 'no column "mass", but x, y, z' --opacity 'mass > 1=0.5' row.xyz
# Words and whole numbers in the colours of types, whatever is shown.
draw words -c $camera --color=species row.xyz
draw words_as -c $camera --category='if(element == 8, 1, if(element == 1, 2, 3))' row.xyz
same words words_as "words have not the colours of kinds"
draw one_word -c $camera --color=species --hide=O row.xyz
draw one_word_as -c $camera --color=species --type-color=O=red --hide=O row.xyz
same one_word one_word_as "a colour depends on what is shown"
draw own_word -c $camera --color=species --type-color=O=red row.xyz
differs words own_word "--type-color of a word"
draw looked -c $camera --color=species --survey 1 row.xyz
same words looked "--survey changes the colours of words"
refuses 1 'no column "specie", but x, y, z, species, charge' --category specie row.xyz
refuses 1 'value 0.5: it takes whole numbers' --category 'charge / 2' row.xyz
run 0 -q -n -s 8x8 -c $camera --color=species --type-color=Xx=red row.xyz
says err 'tell nothing apart that is called "Xx"'
refuses 2 '--type-radius: ' --type-radius 1 row.xyz
refuses 2 '--cut: ' --cut 1,1,1,0,0,0 row.xyz
refuses 2 '--images: ' --images 0,1,1 row.xyz
printf '2\n\n1 0 0 0\n2 1 0 0\n' >"$tmp/types.xyz"
refuses 1 'has no bonds' --bonds types.xyz
cp "$data/caffeine.xyz" "$tmp"
draw guessed -c 3,2,14,0,0,0,0,1,0,40 --radius-scale=0.2 --bonds caffeine.xyz
says err 'the file has no bonds: they are guessed'
draw measured -c 3,2,14,0,0,0,0,1,0,40 --radius-scale=0.2 --bonds=1.6 caffeine.xyz
same guessed measured "bonds by covalent radii are not those of caffeine"
refuses 1 '--arrows: ' --arrows 'charge,1' row.xyz
printf '1\nno box\nO 0 0 0\n' >"$tmp/boxless.xyz"
refuses 1 '--box: the file has no box' --box boxless.xyz
# Edges are seen in small pictures: those of a square of 50 pixels in one of 100x100, and of more boxes from afar.
printf '1\nLattice="20 0 0 0 20 0 0 0 0.01"\nO 10 10 0\n' >"$tmp/square.xyz"
for seen in '1,1,1 10,10 149.282 2' '3,1,1 30,10 447.846 1.333' '3,3,1 30,30 447.846 2'; do
    set -- $seen # images, centre, distance, share of the pixels that lie on edges in percent
    run 0 -q -n --style plain -a 1 -s 100x100 -r 1e-4 --box --images "$1" -c "$2,$3,$2,0,0,1,0,15.1893" square.xyz
    sed -n 's/.*; \([0-9.]*\) % of the rays hit/\1/p' "$tmp/stdout" |
        awk -v least="$4" '{ n++ } $1 < 0.95 * least || $1 > 3 * least { bad++ } END { exit n != 1 || bad > 0 }' ||
        fail "edges of $1 boxes: $(grep 'rays hit' "$tmp/stdout")"
done
refuses 1 'has no box' --images 2,1,1 boxless.xyz
# The camera sees all images of a cell whose edges have nothing along x, y and z in turn.
printf '1\nLattice="0 2 2 2 0 2 2 2 0"\nCu 0 0 0\n' >"$tmp/fcc.xyz"
awk 'BEGIN { print "27\n"; for (i = 0; i < 27; i++) { a = i % 3; b = int(i / 3) % 3; c = int(i / 9)
    print "Cu", 2 * (b + c), 2 * (a + c), 2 * (a + b) } }' >"$tmp/fcc27.xyz"
run 0 -n -s 64x64 --images 3,3,3 fcc.xyz
camera_of_images=$(grep '^camera' "$tmp/stdout")
run 0 -n -s 64x64 fcc27.xyz
[ "$camera_of_images" = "$(grep '^camera' "$tmp/stdout")" ] || fail "the camera does not see all images: $camera_of_images"
refuses 1 'row.xyz has no triangles' --mesh row.xyz row.xyz
if (cd "$tmp" && $emulator "$program" -q --no-metadata -s 96x54 -o walled.png -c $camera --mesh wall.obj row.xyz) >/dev/null \
    2>"$tmp/stderr"; then
    differs soft walled --mesh
    draw thin_wall -c $camera --mesh wall.obj --mesh-opacity 0.001 row.xyz
    draw glass -c $camera --mesh wall.obj --mesh-opacity 0.4 row.xyz
    differs glass walled --mesh-opacity
    differs glass soft --mesh-opacity
    if command -v oiiotool >/dev/null 2>&1; then # nothing of it left: the picture without it, but for one step
        oiiotool --diff --fail 0.005 "$tmp/soft.png" "$tmp/thin_wall.png" >/dev/null || fail "a mesh of no opacity is seen"
    fi
    refuses 1 'are for spheres' --radius-scale 2 wall.obj
    # Large triangles that share a corner are no bulk in that corner.
    draw large wall.obj
    [ ! -s "$tmp/stderr" ] || fail "two triangles are no whole: $(cat "$tmp/stderr")"
else
    says err 'assimp'
fi

# A stray does not move the camera: it is told of, and the picture stays nearly the same.
{
    printf '201\nfar\nO 1e6 0 0\n'
    awk 'BEGIN { for (i = 0; i < 200; i++) print "O", i % 6, int(i / 6) % 6, int(i / 36) }'
} >"$tmp/stray.xyz"
sed -e '1s/201/200/' -e 3d "$tmp/stray.xyz" >"$tmp/without.xyz"
draw stray stray.xyz
says err 'follows the bulk'
stray=$(sed -n 's/^camera *-c //p' "$tmp/stdout")
draw without without.xyz
[ ! -s "$tmp/stderr" ] || fail "a warning without a stray: $(cat "$tmp/stderr")"
[ "$stray" = "$(sed -n 's/^camera *-c //p' "$tmp/stdout")" ] || fail "the stray has moved the camera"

# ---- Trails ---------------------------------------------------------------------------------------------------------

# count FILE CONDITION: pixels of a raw picture of 96x54 for which a condition on r, g, b, x and y holds.
count() {
    od -An -v -tu1 -w3 "$tmp/$1" | awk "{ r = \$1; g = \$2; b = \$3; x = (NR - 1) % 96; y = int((NR - 1) / 96) }
        $2 { n++ } END { print n + 0 }"
}

# One sphere goes to the right and through the boundary after frame 5, one up, one rests.
awk 'BEGIN {
    for (f = 0; f < 9; f++) {
        printf "3\nLattice=\"16 0 0 0 16 0 0 0 9\" Properties=species:S:1:pos:R:3\n"
        printf "O %s 8 2\nH 2 8 %s\nC 13 8 7\n", (4.5 + 2 * f) % 16, 1 + 0.5 * f
    }
}' >"$tmp/moving.xyz"
front=8,-40,4.5,8,4,4.5,0,0,1,12
run 0 -q --no-metadata -s 96x54 -c $front --trails 4 -o all_%d.png moving.xyz
for part in '--first 7 --last 7' '--every 7' '--part 2/2' '--first 5 --every 2 -t 3'; do
    run 0 -q --no-metadata -s 96x54 -c $front --trails 4 -o part_%d.png $part moving.xyz
    cmp -s "$tmp/all_7.png" "$tmp/part_7.png" || fail "trails of $part are not those of the whole run"
    rm -f "$tmp"/part_*.png
done
draw still -c $front --first 7 --last 7 moving.xyz
i=0
for option in --trails=4 --trails=2 '--trails=4 --trail-radius=0.6' '--trails=4 --trail-color=red' \
    '--trails=4 --show=element!=1' '--trails=4 --wrapped --type-radius=O=0.1'; do
    i=$((i + 1))
    draw "trail_$i" -c $front --first 7 --last 7 $option moving.xyz
    differs still "trail_$i" "$option"
    [ $i -eq 1 ] || differs trail_1 "trail_$i" "$option"
done
cmp -s "$tmp/all_7.png" "$tmp/trail_1.png" || fail "trails of one frame are not those of the whole run"
# In frame 7 the sphere is at x = 2.5, and was at 0.5, 14.5, 12.5, 10.5: red on both sides, none in between.
run 0 -q -s 96x54 -c $front --style plain --trails 4 --trail-color red --trail-radius 0.5 -k white --first 7 --last 7 -o - moving.xyz
cp "$tmp/stdout" "$tmp/raw"
red='r > 2 * g && r > 60 && y > 30'
[ "$(count raw "$red && x > 58")" -gt 40 ] || fail "no trail before the boundary"
[ "$(count raw "$red && x < 22")" -gt 4 ] || fail "no trail behind the boundary"
[ "$(count raw "$red && x > 26 && x < 56")" -eq 0 ] || fail "a trail through the box: a jump over the boundary"
[ "$(count raw "r > 2 * g && r > 60 && y <= 24 && x > 60")" -eq 0 ] || fail "a trail of a sphere that rests"
refuses 2 '--trails: ' --trails 0 moving.xyz
refuses 2 '--trail-radius: ' --trails 3 --trail-radius=-1 moving.xyz
refuses 1 'without figures' --trails 3 --bounces 2 --last 0 moving.xyz

# Lines thinner than a pixel: whole from one side of the picture, of 96x54, to the other.
awk 'BEGIN {
    for (f = 0; f < 6; f++) {
        printf "2\nLattice=\"20 0 0 3 9 0 0 0 0.5\" Properties=species:S:1:pos:R:3:velo:R:3\n"
        printf "O %s 0 0 20 1 0\nO %s 1 0 0 0 0\n", 4 * f, 4 * f - 20
    }
}' >"$tmp/lines.xyz"
for line in --arrows=-vx,vy,vz\ --arrow-color=red\ --arrow-radius=1e-4 --bonds=21\ --bond-color=red\ --bond-radius=1e-4 \
    --trails=5\ --trail-color=red\ --trail-radius=1e-4 --box=1e-4; do
    for how in '-c 10,0.3,45,10,0.3,0,0,1,0,30' '--ortho -c 10,0.3,45,10,0.3,0,0,1,0,30' '-a 2 -c 10,9,40,10,0.3,0,0,1,0,30'; do
        run 0 -q -s 96x54 --style plain -k black --type-radius=O=1e-4 $how $line --first 5 --last 5 -o - lines.xyz
        cp "$tmp/stdout" "$tmp/raw"
        seen='r > 2 * g && r > 60'
        [ "$line" != --box=1e-4 ] || seen='y > 20 && y < 45 && r > 60'
        columns=$(od -An -v -tu1 -w3 "$tmp/raw" | awk "{ r = \$1; g = \$2; x = (NR - 1) % 96; y = int((NR - 1) / 96) }
            $seen && !was[x]++ { n++ } END { print n + 0 }")
        [ "$columns" -ge 43 ] || fail "$columns columns of a line of 45: $line $how"
    done
done

# ---- Texts ----------------------------------------------------------------------------------------------------------

if (cd "$tmp" && $emulator "$program" -q --no-metadata -s 96x54 -o titled.png -c $camera --title A row.xyz) >/dev/null 2>"$tmp/stderr"
then
    differs soft titled --title
    draw timed -c $camera --time row.xyz
    draw other_time -c $camera '--time={frame}' row.xyz
    differs timed other_time "the format of --time"
    draw bar -c $camera -k charge --colorbar row.xyz
    draw no_bar -c $camera -k charge row.xyz
    differs bar no_bar --colorbar
    draw no_legend -c $camera -k element row.xyz
    draw legend -c $camera -k element --legend row.xyz
    differs legend no_legend --legend
    draw legend_bar -c $camera -k element --colorbar row.xyz
    same legend legend_bar "a legend is not what --colorbar gives elements"
    draw names -c $camera -k element --legend --type-name O=ox row.xyz
    differs legend names --type-name
    draw no_kinds -c $camera -k charge --legend row.xyz
    says err '--legend: '
    refuses 2 '--type-name: ' --type-name Xx=a row.xyz
    # A legend of types: a swatch of each, on the right, in its colour; none of one that is hidden in all frames.
    for hidden in 7 2; do
        run 0 -q -s 96x54 -c 4,-999,8,4,-1999,8,0,0,1,1 -k type --hide $hidden --type-color 1=red --type-color 2=00ff00 \
            --type-color 3=blue --legend --text-size 0.15 --style plain --background black -o - row.xyz
        cp "$tmp/stdout" "$tmp/raw"
        for color in 'r > 200 && g < 30 && b < 30' 'g > 200 && r < 30 && b < 30' 'b > 200 && r < 30 && g < 30'; do
            swatch=$(count raw "$color && x > 40")
            case $hidden$color in
            2g*) [ "$swatch" -eq 0 ] || fail "--legend names a type that is hidden: $swatch" ;;
            *) [ "$swatch" -gt 15 ] || fail "--legend has no swatch where $color: $swatch" ;;
            esac
        done
    done
    draw no_values -c $camera -k red --colorbar row.xyz
    says err '--colorbar: '
    refuses 1 'no-such.ttf: this is no font' --title A --font no-such.ttf row.xyz
else
    says err 'FreeType\|--font'
fi

# ---- Speeds without a box ------------------------------------------------------------------------------------------

# A line of particles that drift through a boundary which the file does not tell, as LAMMPS writes .xyz.
awk 'BEGIN { for (f = 0; f < 4; f++) { print "9\n"; for (i = 0; i < 9; i++) print 1, (10 * i + 4 * f) % 90, i % 3, 0 } }' \
    >"$tmp/drift.xyz"
run 0 -n --contact-sheet sheet.png -s 96x54 --style plain drift.xyz
says err 'the file has no box: colours are not chosen by speed'
says out '^colour  *id '
run 0 -n --contact-sheet sheet.png -s 96x54 --style plain -k speed drift.xyz
says err 'the file has no box: speeds may be false'
sed 's/^$/Lattice="90 0 0 0 9 0 0 0 9"/' "$tmp/drift.xyz" >"$tmp/boxed.xyz"
run 0 -n --contact-sheet sheet.png -s 96x54 --style plain boxed.xyz
says out '^colour  *speed from 0 to 4'
grep -q 'no box' "$tmp/stderr" && fail "a file with a box has none: $(cat "$tmp/stderr")"

# ---- Ranges of formulas ---------------------------------------------------------------------------------------------

# 1,001 values, 0 to 1000 but for one that is hot: ranks 10 and 990.
awk 'BEGIN { print "1001\nProperties=species:S:1:pos:R:3:q:R:1:same:R:1:none:R:1"
    for (i = 0; i <= 1000; i++) print "C", i % 40, int(i / 40), 0, i == 700 ? 1e6 : i, 5, i == 3 ? 1 : "nan" }' \
    >"$tmp/hot.xyz"
draw hot -c 20,12,60,20,12,0,0,1,0,30 -k q hot.xyz
says out '^colour  *q from 10 to 991, the 1 % and the 99 % quantile of values from 0 to 1e+06$'
draw hot_given -c 20,12,60,20,12,0,0,1,0,30 -k q --range 10,991 hot.xyz
says out '^colour  *q from 10 to 991$'
same hot hot_given "the range of a formula is not what is said"
draw hot_symmetric -c 20,12,60,20,12,0,0,1,0,30 -k q-100 --range=symmetric hot.xyz
says out '^colour  *q-100 from -891 to 891, the 1 % and the 99 % quantile of values from -100 to 999900, as far below 0 as above$'
draw hot_about -c 20,12,60,20,12,0,0,1,0,30 -k q-100 --range=-891,891 hot.xyz
same hot_symmetric hot_about "a symmetric range is not what is said"
draw hot_column -c 20,12,60,20,12,0,0,1,0,30 -k 2*q hot.xyz
same hot hot_column "a column and a formula have different rules"
awk 'NR > 2 { $5 = NR == 9 ? -2 : NR == 99 ? 8 : 1 } { print }' "$tmp/hot.xyz" >"$tmp/rare.xyz"
draw rare -c 20,12,60,20,12,0,0,1,0,30 -k q rare.xyz
says out '^colour  *q from -2 to 8, the least and the greatest of values from -2 to 8$'
draw rare_log -c 20,12,60,20,12,0,0,1,0,30 -k q --log-scale rare.xyz
says out '^colour  *q from 1 to 8, the least and the greatest of values from -2 to 8$'
draw same -c 20,12,60,20,12,0,0,1,0,30 -k same hot.xyz
says out '^colour  *same from 5 to 5, which all values are$'
draw none -c 20,12,60,20,12,0,0,1,0,30 -k none hot.xyz
says out '^colour  *none from 1 to 1, which all values are; 1000 more are not finite$'

# ---- Settings -------------------------------------------------------------------------------------------------------

run 0 --print-settings -c $camera --style=paper -a 2 --type-color O=blue --show 'charge < 30' --box row.xyz
cp "$tmp/stdout" "$tmp/paper.txt"
grep -qx 'style = paper' "$tmp/paper.txt" && grep -qx '# lamp = X,Y,Z\[,STRENGTH\[,RRGGBB\]\]' "$tmp/paper.txt" ||
    fail "the settings that are printed: $(cat "$tmp/paper.txt")"
draw given -c $camera --style=paper -a 2 --type-color O=blue --show 'charge < 30' --box row.xyz
draw by_file --settings paper.txt row.xyz
same given by_file "a settings file draws another picture than its command line"
{ printf '\357\273\277' && cat "$tmp/paper.txt"; } >"$tmp/marked.txt" # a byte-order mark, as editors write it
draw by_marked --settings marked.txt row.xyz
same given by_marked "a byte-order mark changes the settings"
draw by_short --se paper.txt row.xyz
same given by_short "--settings that is shortened"
draw by_shorter --setting=paper.txt row.xyz
same given by_shorter "--settings that is shortened, with its value"
draw overridden --settings=paper.txt --style plain row.xyz
differs given overridden "an option after --settings"
# A value may have line feeds: they are blanks, and end no setting.
draw in_lines -c $camera --show 'charge < 30
    && x < 5' row.xyz
draw in_line -c $camera --show 'charge < 30 && x < 5' row.xyz
same in_lines in_line "a value over two lines"
run 0 --print-settings --title 'over
transparent' row.xyz
says out '^title = over transparent$'
says out '^# transparent$'
printf 'style = paper\nno-such-option\n' >"$tmp/wrong.txt"
refuses 2 'no-such-option' --settings wrong.txt row.xyz
printf 'style = paper\n--style plain\n' >"$tmp/wrong.txt"
refuses 2 'wrong.txt:2: ' --settings wrong.txt row.xyz
printf 'bonds\n\nstyle = papr\n' >"$tmp/wrong.txt"
refuses 2 'wrong.txt:3: style: "papr" is not' --settings wrong.txt row.xyz
printf 'first\n' >"$tmp/wrong.txt"
refuses 2 'wrong.txt:1: first: the option takes a value' --settings wrong.txt row.xyz
printf 'settings = wrong.txt\n' >"$tmp/wrong.txt"
refuses 2 'wrong.txt:1: ' --settings wrong.txt row.xyz
printf 'setting = paper.txt\n' >"$tmp/wrong.txt"
refuses 2 'wrong.txt:1: "setting" is no option' --settings wrong.txt row.xyz
refuses 2 'missing.txt: ' --settings missing.txt row.xyz

# A picture says how it was made: by its own text it is made again.
if command -v oiiotool >/dev/null 2>&1; then
    run 0 -q -s 96x54 -o automatic.png --style=paper -k charge --box row.xyz
    oiiotool --info -v "$tmp/automatic.png" |
        awk '/^ *Settings: "/ { sub(/^ *Settings: "/, ""); inside = 1 } inside && /^"$/ { exit } inside' >"$tmp/again.txt"
    [ -s "$tmp/again.txt" ] || fail "the picture does not say how it was made"
    run 0 -q -s 96x54 -o made_again.png --settings again.txt row.xyz
    oiiotool --diff --fail 0 "$tmp/automatic.png" "$tmp/made_again.png" >/dev/null ||
        fail "the settings inside of a picture draw another one: $(cat "$tmp/again.txt")"
    for options in '--view top -k height --floor' '--zoom 2 --up y -k id --log-scale' '-k height --log-scale --radius 0.5'; do
        run 0 -q -s 96x54 -o seen.png $options row.xyz
        oiiotool --info -v "$tmp/seen.png" |
            awk '/^ *Settings: "/ { sub(/^ *Settings: "/, ""); inside = 1 } inside && /^"$/ { exit } inside' >"$tmp/again.txt"
        run 0 -q -s 96x54 -o seen_again.png --settings again.txt row.xyz
        oiiotool --diff --fail 0 "$tmp/seen.png" "$tmp/seen_again.png" >/dev/null ||
            fail "$options: the settings inside draw another picture: $(cat "$tmp/again.txt")"
    done
    # So do EXR, JPEG and TIFF, where there are such files.
    if (cd "$tmp" && $emulator "$program" -q -s 96x54 -o automatic.tif --style=paper -k charge --box row.xyz) \
        >/dev/null 2>&1; then
        run 0 -q -s 96x54 -o automatic.exr -o automatic.jpg --style=paper -k charge --box row.xyz
        for ending in exr jpg tif; do
            oiiotool --info -v "$tmp/automatic.$ending" |
                awk '/^ *(Settings|ImageDescription): "/ { sub(/^[^"]*"/, ""); inside = 1 } inside && /^"$/ { exit } inside' \
                    >"$tmp/again.txt"
            run 0 -q -s 96x54 -o made_again.png --settings again.txt row.xyz
            oiiotool --diff --fail 0 "$tmp/automatic.png" "$tmp/made_again.png" >/dev/null ||
                fail "the settings inside of .$ending draw another picture: $(cat "$tmp/again.txt")"
        done
        # Texts and axes are in linear light, too, and a transparent picture has an opacity.
        for option in --transparent --background=navy; do
            run 0 -q -s 96x54 -c $camera $option --axes --title=A --legend -o over.exr -o over.png row.xyz
            oiiotool "$tmp/over.exr" --ch "R,G,B$([ $option = --transparent ] && echo ,A)" --unpremult --colorconvert linear sRGB \
                -d uint8 -o "$tmp/coded.png" >/dev/null 2>&1
            oiiotool --diff --fail 0.02 --failpercent 0.1 "$tmp/over.png" "$tmp/coded.png" >"$tmp/diff" 2>&1 ||
                fail "$option: what lies over an EXR is not what lies over a PNG: $(cat "$tmp/diff")"
        done
    fi
    # Opacity reaches the file.
    oiiotool --info "$tmp/light_14.png" | grep -q '4 channel' || fail "--transparent: $(oiiotool --info "$tmp/light_14.png")"
fi

[ $failures -eq 0 ] || exit 1
echo "all good"
