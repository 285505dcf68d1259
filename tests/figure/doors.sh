#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The same options and frames give the same bytes through cgt-render and through <cgt/figure.h>, whose frames are those of
# a file, or a program's columns, and may be kept; and through Python's cgt.Figure, where CGT_FIGURE_PYTHON has it.
#   doors.sh CGT_RENDER DATA_DIR FIGURE_RAW [EMULATOR...]
here=$(cd "$(dirname "$0")" && pwd)
raw=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
render=$1 folder=$2
shift 3
set -- "$render" "$folder" "$@"
. "$(dirname "$0")/../programs/cli.sh"

# Grains that move in a periodic box, the same far from 0; a closed mesh.
awk 'BEGIN {
    for (k = 0; k < 4; k++) {
        printf "ITEM: TIMESTEP\n%d\nITEM: NUMBER OF ATOMS\n60\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n", 10 * k
        print "ITEM: ATOMS id type x y z radius c_pe"
        for (i = 0; i < 60; i++)
            printf "%d %d %g %g %g %g %g\n", i + 1, 1 + i % 3, (i % 4 * 2.1 + 0.2 * k * (i % 5)) % 9, \
                int(i / 4) % 4 * 2.2 + 0.1 * k, int(i / 16) * 2.3, 0.4 + 0.1 * (i % 4), (i * 7 + k) % 11
    }
}' >"$tmp/grains.lammpstrj"
awk '/^0 9$/ { $1 = 1000000; $2 = 1000009 }
    NF == 7 { for (c = 3; c < 6; c++) $c = sprintf("%.10g", $c + 1000000) }
    { print }' "$tmp/grains.lammpstrj" >"$tmp/far.lammpstrj"
cat >"$tmp/cube.obj" <<'END'
v 0 0 0
v 1 0 0
v 0 1 0
v 1 1 0
v 0 0 1
v 1 0 1
v 0 1 1
v 1 1 1
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
END

# draw_by DOOR FILE [NAME[=VALUE]...]: pictures on standard output
draw_by() {
    case $1 in
    PYTHON) shift && "$CGT_FIGURE_PYTHON" "$here/figure_door.py" "$@" ;;
    *) $emulator "$raw" "$@" ;;
    esac
}

# both FILE [NAME[=VALUE]...]
both() {
    file=$1
    shift
    (
        cd "$tmp" || exit 1
        for option in "$@"; do # each goes to the end with its dashes
            shift
            set -- "$@" "--$option"
        done
        exec $emulator "$program" -q -s 96x64 -o - "$@" "$file"
    ) >"$tmp/render.rgb" 2>"$tmp/render.err" || fail "cgt-render $*: $(head -n 2 "$tmp/render.err")"
    [ -s "$tmp/render.rgb" ] || fail "cgt-render $*: no pictures"
    for door in FRAMES COLUMNS KEPT ${CGT_FIGURE_PYTHON:+PYTHON}; do
        (cd "$tmp" && draw_by "$door" "$file" "$@") >"$tmp/figure.rgb" 2>"$tmp/figure.err" ||
            fail "$door $*: $(head -n 2 "$tmp/figure.err")"
        cmp -s "$tmp/render.rgb" "$tmp/figure.rgb" || fail "$door: other bytes than cgt-render's: $file $*"
    done
}

# refused PATTERN NAME[=VALUE]...: a sentence of the figure.
refused() {
    pattern=$1
    shift
    (cd "$tmp" && exec $emulator "$raw" COLUMNS grains.lammpstrj "$@") >"$tmp/figure.rgb" 2>"$tmp/figure.err" &&
        fail "not refused: $*"
    [ ! -s "$tmp/figure.rgb" ] || fail "pictures of what is refused: $*"
    grep -q -e "$pattern" "$tmp/figure.err" || fail "no \"$pattern\": $(head -n 2 "$tmp/figure.err")"
}

# Words and numbers of atoms that come and go.
for k in 0 1 2; do
    printf '%s\nProperties=species:S:1:pos:R:3:site_of:S:1:mol:I:1\n' $((9 + k))
    awk -v n=$((9 + k)) 'BEGIN { for (i = n - 1; i >= 0; i--)
        print "C", i % 3 * 2, int(i / 3) * 2, 0, substr("abcdefghijkl", i + 1, 1) "x", i - 2 }'
done >"$tmp/words.xyz"

{
    printf '# vtk DataFile Version 3.0\nA surface of a run.\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n'
    printf '0 0 0 8 0 0 4 8 0 4 4 6\nPOLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n'
} >"$tmp/surface.vtk"
cp "$data/caffeine.xyz" "$tmp"
both grains.lammpstrj
both grains.lammpstrj color=c_pe range=1,9 style=paper antialias=2
both grains.lammpstrj color=speed orbit=90
both grains.lammpstrj color=type type-color=2=red hide=3 images=2,1,1 box bonds=1.7
both grains.lammpstrj 'show=c_pe > 3' 'radius-by=c_pe/20' color=height view=front zoom=1.5 ortho
both grains.lammpstrj trails=2 arrows=1,0,c_pe/9 arrow-color=blue
both grains.lammpstrj floor light-size=3 lamp=4,4,20,0.5,ff8000 depth-cue
both grains.lammpstrj bounces=3 material=2=mirror material=all=glass floor=teal
both grains.lammpstrj camera=30,4,4,4,4,4,0,0,1,30 style=plain color=red
both grains.lammpstrj mesh=cube.obj mesh-opacity=0.5 mesh-color=ff8800
both far.lammpstrj
both far.lammpstrj box floor color=c_pe
both far.lammpstrj camera=1000030,1000004,1000004,1000004,1000004,1000004,0,0,1,30
both cube.obj
both surface.vtk
both surface.vtk color=red camera=9,-9,9,4,4,2,0,0,1,40
both cube.obj bounces=4 material=all=glass floor
both caffeine.xyz bonds radius-scale=0.3 outline
both words.xyz color=site_of type-color=kx=black
both grains.lammpstrj type-element=1=Cs,2=K type-element=3=Ba bonds radius-by=0.3 hide=Ba
both grains.lammpstrj opacity=2=0.3 'opacity=c_pe > 4=0.5' bonds=1.9 images=2,1,1 hide=1
both grains.lammpstrj opacity=1=0.25 opacity=bonds=0.5 bonds=1.9 trails=2 radius-scale=0.5 box outline
both grains.lammpstrj opacity=3=0.5 mesh=cube.obj mesh-opacity=0.4 style=plain
both words.xyz category=mol type-color=1=black range=0,1 camera=2,3,20,2,3,0,0,1,0,30
if ! $emulator "$program" -q -n -s 8x8 --title A "$tmp/cube.obj" 2>&1 | grep -q 'FreeType\|DejaVu'; then
    both grains.lammpstrj title=Grains 'time=step {step}' color=c_pe colorbar=energy axes
    both grains.lammpstrj color=type legend=kinds type-name=2=water
    both words.xyz color=site_of legend type-name=ax=first hide='mol > 6'
    both words.xyz category='mol * 3' colorbar
    both grains.lammpstrj scale-bar=2,m 'label=id < 9' 'label-text=#{id}' 'show=id > 2'
fi

refused 'there is no option "colour"' colour=red
refused 'ortho: the option takes no value' ortho=1
refused 'color: the option takes a value' color
refused 'antialias: 3 is not 1, 2 or 4' antialias=3
refused 'has no column "c_ke"' color=c_ke
refused 'material is for --bounces' material=all=glass
refused 'the file has no bonds' bonds

# Numbers have a point where the locale has a comma.
if [ -z "$emulator" ] && localedef -i de_DE -f UTF-8 "$tmp/de_DE.UTF-8" >/dev/null 2>&1 &&
    [ "$(LOCPATH=$tmp LC_ALL=de_DE.UTF-8 locale decimal_point)" = , ]; then
    german() { LOCPATH=$tmp LC_ALL=de_DE.UTF-8 "$raw" COLUMNS grains.lammpstrj "$@"; }
    for options in 'slice=1,0.5,0,4.5 color=c_pe*1.5 range=1.5,9.25 colorbar' 'camera=30.5,4,4,4,4,4,0,0,1,30.5 lamp=4.5,4,9' \
        'cut=0.5,0.5,0,7.5,9,9 text-size=0.055 time={time} title=A zoom=1.25'; do
        (cd "$tmp" && "$raw" COLUMNS grains.lammpstrj $options) >"$tmp/plain.rgb" 2>"$tmp/plain.err"
        (cd "$tmp" && german $options) >"$tmp/german.rgb" 2>"$tmp/german.err"
        [ -s "$tmp/plain.rgb" ] || fail "no picture: $options: $(head -n 2 "$tmp/plain.err")"
        cmp -s "$tmp/plain.rgb" "$tmp/german.rgb" && cmp -s "$tmp/plain.err" "$tmp/german.err" ||
            fail "other bytes in a German locale: $options: $(head -n 2 "$tmp/german.err")"
    done
else
    echo "no German locale: not tried"
fi

[ "$failures" -eq 0 ] || exit 1
