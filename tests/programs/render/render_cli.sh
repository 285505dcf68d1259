#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-render: pictures, their contents where tools to read them exist, errors, exit codes.
#   render_cli.sh CGT_RENDER DATA_DIR [EMULATOR...]
. "$(dirname "$0")/../cli.sh"

# Pictures are compared by their bytes, whatever options made them: the files do not tell.
printf '#!/bin/sh\nexec %s "%s" --no-metadata "$@"\n' "$emulator" "$program" >"$tmp/cgt-render"
chmod +x "$tmp/cgt-render"
program=$tmp/cgt-render
emulator=

refused='-o no/%d.png'

# is_png FILE: begins and ends as a PNG does.
is_png() {
    head_and_tail=$({ head -c 8 "$tmp/$1" && tail -c 8 "$tmp/$1"; } 2>/dev/null | od -An -v -tx1 | tr -d ' \n')
    [ "$head_and_tail" = 89504e470d0a1a0a49454e44ae426082 ] || fail "$1 is no whole PNG"
}

count() {
    [ "$(find "$tmp/$1" -type f 2>/dev/null | wc -l)" -eq "$2" ] || fail "$1 has $(ls "$tmp/$1"), not $2 files"
}

# no_parts: nothing half-written is left.
no_parts() {
    [ -z "$(find "$tmp" -name '*.part*')" ] || fail "left behind: $(find "$tmp" -name '*.part*')"
}

# ---- Inputs ---------------------------------------------------------------------------------------------------------

# A sphere of radius 1 at the origin next to one that moves.
for i in 0 1 2 3 4 5; do
    printf '2\nframe %s\nC 0 0 0\nO %s 2 0\n' $i $i
done >"$tmp/small.xyz"
printf '1\none\nC 0 0 0\n' >"$tmp/one.xyz"
head -n 14 "$tmp/small.xyz" >"$tmp/truncated.xyz"
printf '2\nbad\nC 0 0 0\nO one 2 0\n' >"$tmp/malformed.xyz"
: >"$tmp/empty.xyz"
printf '0\nnothing\n0\nstill nothing\n' >"$tmp/nothing.xyz"
{
    printf 'ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n4\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n'
    printf 'ITEM: ATOMS id type radius x y z\n1 1 1 1 1 1\n2 2 1 nan 1 1\n3 1 -1 5 5 5\n4 2 1 7 7 7\n'
} >"$tmp/odd.lammpstrj"
printf '1\nfar\nC 3e38 0 0\n1\nfar\nC -3e38 0 0\n' >"$tmp/huge.xyz"
camera=0,0,5,0,0,0,0,1,0,45

# A square from -1 to 1 in the plane z = 0, as two triangles, with a third that has no area; in the second frame its
# upper edge has moved. The same as a mesh with normals that lean to the left and to the right.
zero='\000\000\000\000'
one='\001\000\000\000'
two='\002\000\000\000'
three='\003\000\000\000'
four='\004\000\000\000'
f1='\000\000\200\077'  # 1.0f
f2='\000\000\000\100'  # 2.0f
m1='\000\000\200\277'  # -1.0f
square="$zero$one$two$zero$two$three$zero$zero$one"
lower="$m1$m1$zero$f1$m1$zero"
printf "CGTFRAM1$two$two$three$zero$square$four$lower$f1$f1$zero$m1$f1$zero$four$lower$f1$f2$zero$m1$f2$zero" \
    >"$tmp/square.frames"
{
    printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn -0.6 0 0.8\nvn 0.6 0 0.8\n'
    printf 'f 1//1 2//2 3//2\nf 1//1 3//2 4//1\n'
} >"$tmp/leaning.obj"
sed -e '/^vn/d' -e 's|//[12]||g' "$tmp/leaning.obj" >"$tmp/flat.obj"

# ---- Help, version, the wrong command line --------------------------------------------------------------------------

run 0 --help
says out '^Usage: cgt-render'
says out '--contact-sheet=FILE'
run 0 --version
says out '^cgt-render (libcgt [0-9]*\.[0-9]*\.[0-9]*)$'
refuses 2 'no trajectory'
refuses 2 'unrecognized option' --no-such-option small.xyz
for size in 0x0 0x5 5x0 12 x 1280x 65537x1 99999999999999999999x1 -1x5 5x5x5 1e2x5; do
    refuses 2 '--size: ' -s $size small.xyz
done
refuses 2 'pixels of' -s 65536x65536 small.xyz
refuses 2 'pixels of' -s 20000x1000 -a 4 small.xyz
refuses 2 '--antialias: ' -a 3 small.xyz
for wrong in 0,0,0,0,0,0,0,1,0,45 0,0,5,0,0,0,0,0,1,45 0,0,5,0,0,0,0,0,0,45 0,0,5,0,0,0,0,1,0,0 \
    0,0,5,0,0,0,0,1,0,180 0,0,5,0,0,0,0,1,0,-5 1,2,3 nan,0,5,0,0,0,0,1,0,45 0,0,5,0,0,0,0,1,0,45,6 ''; do
    refuses 2 '--camera: ' -c "$wrong" small.xyz
done
refuses 2 '--view: ' --up z --view 0,0,1 small.xyz
refuses 2 '--view: ' --up z --view 0,0,1e30 small.xyz
refuses 2 '--view: ' --view 0,0,0 small.xyz
refuses 2 '--up: ' --up w small.xyz
refuses 2 '--fov: ' --fov 180 small.xyz
refuses 2 'automatic camera' --fov 20 -c $camera small.xyz
refuses 2 '--color: ' -k 'taste +' small.xyz
refuses 1 'no column "taste", but x, y, z' -k 'sqrt(taste)' small.xyz
refuses 2 '--log-scale' --log-scale --range 0,1 small.xyz
refuses 2 '--color: ' -k 12345 small.xyz
refuses 2 '--fps: ' --fps 0 small.xyz
refuses 2 '--colormap: ' --colormap jet small.xyz
refuses 2 '--range: ' --range 2,1 small.xyz
refuses 2 '--background: ' --background 12345g small.xyz
refuses 2 '--light: ' --light 0,0,0 small.xyz
refuses 2 '--every: ' --every 0 small.xyz
refuses 2 '--last is before --first' --first 3 --last 2 small.xyz
refuses 2 '--threads: ' -t 1025 small.xyz
refuses 2 '--radius: ' -r -1 small.xyz
refuses 2 '--sheet-grid: ' --sheet-grid 0x3 small.xyz
refuses 2 '--contact-sheet: ' --contact-sheet sheet.gif small.xyz
refuses 2 'exclude each other' -n small.xyz
refuses 2 '--output: ' -o '%s.png' small.xyz
refuses 2 '--output: ' -o '%n%d.png' small.xyz
refuses 2 '--output: ' -o 'f%04d.bmp' small.xyz
refuses 2 'a movie has all frames' -o 'f%04d.gif' small.xyz
refuses 2 '--rate: ' --rate 0 small.xyz
refuses 2 '--quality: ' --quality 101 small.xyz
refuses 2 '--preset: ' --preset lazy small.xyz
for part in 0/2 3/2 2 /2 1/ 1/0 -1/2; do
    refuses 2 '--part: ' --part "$part" small.xyz
done
refuses 1 'part 1 of 7 of 6 frames has none' --part 1/7 small.xyz

# ---- Bad input ------------------------------------------------------------------------------------------------------

refuses 1 'missing.xyz' missing.xyz
run 1 -s 32x18 -o whole/%d.png truncated.xyz # its three whole frames come out
says err 'truncated.xyz:14'
count whole 3
refuses 1 'malformed.xyz:4' malformed.xyz
refuses 1 'empty.xyz' empty.xyz
refuses 1 'there is no frame' --first 6 small.xyz
refuses 1 'too large for an automatic camera' huge.xyz
refuses 1 'variant' --variant no-such-variant small.xyz
refuses 1 'square.frames: --color type' -k type square.frames
refuses 1 'square.frames: --radius' -r 1 square.frames
refuses 1 'small.xyz: --fps and --clip' --fps 24 small.xyz
refuses 1 'small.xyz: --fps and --clip' --clip walk -k type -c $camera small.xyz
# In one pass the frames before the damage are rendered; the exit code still tells.
run 1 -c $camera -k type -s 32x18 -o pass/%d.png truncated.xyz
says err 'truncated.xyz:14'
count pass 3

# ---- Unwritable output ----------------------------------------------------------------------------------------------

: >"$tmp/file"
refuses 1 'is not a folder' -o file/%d.png small.xyz
refuses 1 'file: is not a folder' --log-file file/log small.xyz
mkdir -p "$tmp/taken/0.png"
run 1 -s 32x18 -o taken/%d.png small.xyz
says err 'taken/0.png: cannot write'
run 1 -s 32x18 -o plain.png small.xyz
says err 'plain.png: the name needs a %04d'
# A disk that fills up: no half picture stays.
if (trap '' XFSZ && ulimit -f 4) 2>/dev/null; then
    mkdir -p "$tmp/full"
    (cd "$tmp" && trap '' XFSZ && ulimit -f 4 && exec $emulator "$program" -o full/%d.png one.xyz) \
        >/dev/null 2>"$tmp/stderr" </dev/null
    got=$?
    [ $got -eq 1 ] || fail "exit code $got, not 1, with a file size limit: $(head -n 3 "$tmp/stderr")"
    says err 'full/0.png: cannot write'
    count full 0
fi
# An output that nobody can read.
if [ -c /dev/full ]; then
    (cd "$tmp" && exec $emulator "$program" -n one.xyz) >/dev/full 2>"$tmp/stderr" </dev/null
    got=$?
    [ $got -eq 1 ] || fail "exit code $got, not 1, where the summary cannot be written"
    run 1 -n --log-file /dev/full one.xyz
    says err '/dev/full: cannot write'
fi
no_parts

# ---- Pictures -------------------------------------------------------------------------------------------------------

run 0 -s 64x36 -o 'new/folder/f_%03d.png' -o new/exr/%d.exr --contact-sheet new/sheet.png --log-file new/log.tsv \
    --orbit 90 -t 2 small.xyz
count new/folder 6
count new/exr 6
is_png new/folder/f_000.png
is_png new/folder/f_005.png
is_png new/sheet.png
says out '^frames  *6$'
says out '^spheres  *2$'
says out '^build .* ms  median'
says out '^trace .* ms  median'
says out '^frames per second '
says out 'with image writing'
[ "$(wc -l <"$tmp/new/log.tsv")" -eq 7 ] || fail "the log has not a head and six lines"
[ "$(awk -F '\t' 'NF != 10' "$tmp/new/log.tsv" | wc -l)" -eq 0 ] || fail "the log has lines without ten columns"
[ "$(awk -F '\t' 'NR > 1 && $5 > 0' "$tmp/new/log.tsv" | wc -l)" -eq 6 ] || fail "a frame without a hit"
grep -q "$(printf '\r')" "$tmp/stderr" && fail "control characters where there is no terminal"
cmp -s "$tmp/new/folder/f_000.png" "$tmp/new/folder/f_005.png" && fail "nothing moved"

# The printed camera gives the same picture again, and the number of threads changes nothing.
automatic=$(sed -n 's/^camera *-c //p' "$tmp/stdout")
run 0 -s 64x36 -c "$automatic" -o again.png --last 0 -k type -t 1 small.xyz
run 0 -s 64x36 --orbit 90 -o first/%d.png --last 5 -k type -t 4 small.xyz
cmp -s "$tmp/again.png" "$tmp/first/0.png" || fail "the camera that was printed shows another picture"
# several files are one run
run 0 -s 64x36 -o both/%d.png small.xyz one.xyz
count both 7
run 0 -s 128x72 -o t1.png -t 1 -a 2 one.xyz
run 0 -s 128x72 -o t3.png -t 3 -a 2 one.xyz
cmp -s "$tmp/t1.png" "$tmp/t3.png" || fail "one and three threads draw different pictures"

# A choice of frames: each has the name, camera and colours that it has in the whole run, in one process or several.
for look in "--orbit 90" "-c $camera -k type" "-k speed" "-k speed -c $camera"; do
    rm -rf "$tmp/all" "$tmp/some" "$tmp/parts"
    run 0 -s 64x36 $look -o all/%d.png small.xyz
    count all 6
    run 0 -s 64x36 $look -o some/%d.png --first 1 --last 4 --every 3 small.xyz
    count some 2
    run 0 -s 64x36 $look -o some/%d.png --part 2/2 --first 1 --every 2 small.xyz # of 1, 3, 5
    count some 4
    for i in 1 3 4 5; do
        cmp -s "$tmp/some/$i.png" "$tmp/all/$i.png" || fail "$look: frame $i is another one when it is chosen"
    done
    for part in 1 2 3 4; do
        run 0 -s 64x36 $look -o parts/%d.png --part $part/4 small.xyz
    done
    count parts 6
    for i in 0 1 2 3 4 5; do
        cmp -s "$tmp/parts/$i.png" "$tmp/all/$i.png" || fail "$look: frame $i is another one in its part"
    done
done
run 0 -s 64x36 -c $camera -k type -o all/%d.png small.xyz
# A look at the first frame alone finds its camera.
head -n 4 "$tmp/small.xyz" >"$tmp/first.xyz"
for look in "first.xyz" "--survey 1 small.xyz" "small.xyz"; do
    run 0 -s 64x36 -n $look
    sed -n 's/^camera *-c //p' "$tmp/stdout" >"$tmp/camera_$(echo "$look" | tr -dc a-z)"
done
cmp -s "$tmp/camera_firstxyz" "$tmp/camera_surveysmallxyz" || fail "--survey 1 looked at more than one frame"
cmp -s "$tmp/camera_firstxyz" "$tmp/camera_smallxyz" && fail "without --survey one frame alone was looked at"
# Where nobody knows how many frames there are, --last ends the run all the same.
for unknown in "--survey 2" "--follow 0.1"; do
    rm -rf "$tmp/last"
    run 0 -s 64x36 $unknown -o last/%d.png --first 1 --every 2 --last 3 small.xyz
    count last 2
    [ -e "$tmp/last/3.png" ] || fail "$unknown: --last leaves its frame out"
done
run 0 -s 64x36 --survey 2 -o beyond/%d.png --first 4 --last 99 small.xyz
count beyond 2

# Speeds need the frame before, chosen or not; the second sphere moves by one in each frame.
run 0 -s 64x36 -c $camera -k speed --range 0,1 -o speed/%d.png --first 3 --last 3 small.xyz
run 0 -s 64x36 -c $camera -k speed --range 0,1 -o every/%d.png small.xyz
cmp -s "$tmp/speed/3.png" "$tmp/every/3.png" || fail "the speeds of a chosen frame are others"
cmp -s "$tmp/every/0.png" "$tmp/all/0.png" && fail "speeds and types have the same colours"

# Empty frames are rendered; what cannot be drawn is counted; odd aspect ratios and the smallest picture.
run 0 -s 64x36 -o nothing/%d.png nothing.xyz
! grep -q 'move by more' "$tmp/stderr" || fail "spheres that are not there move"
count nothing 2
cmp -s "$tmp/nothing/0.png" "$tmp/nothing/1.png" || fail "two empty frames differ"
run 0 -s 64x36 -o odd.png odd.lammpstrj
says out '^skipped  *2 .* 1 not finite, 1 with a negative radius, 0 triangles without an area$'
run 0 -s 1x1 -o tiny.png one.xyz
is_png tiny.png
run 0 -s 5000x1 -o wide.png one.xyz
run 0 -s 1x3000 -a 2 -o tall.png --contact-sheet tall_sheet.png one.xyz
is_png tall_sheet.png
run 0 -n --stats one.xyz
says out '^structure .*loose grid'
says out '^tiles  *[1-9]'
says out '^tests '
no_parts

# ---- Triangles ------------------------------------------------------------------------------------------------------

run 0 -s 64x36 -o triangles/%d.png square.frames
count triangles 2
says out '^triangles  *3$'
says out '^skipped  *2 .* 0 not finite, 0 with a negative radius, 2 triangles without an area$'
says out '^colour  *one for all'
cmp -s "$tmp/triangles/0.png" "$tmp/triangles/1.png" && fail "no triangle moved"
automatic=$(sed -n 's/^camera *-c //p' "$tmp/stdout")
case $automatic in *,0,1,0,30) ;; *) fail "y is not up of triangles: $automatic" ;; esac
run 0 -s 64x36 -o plain.png --last 0 -c "$automatic" -k dcd3c4 square.frames
cmp -s "$tmp/triangles/0.png" "$tmp/plain.png" || fail "-k RRGGBB is not the colour that it says"
for by in height id speed 0000ff; do
    run 0 -s 64x36 -o "by_$by/%d.png" -c "$automatic" -k $by square.frames
    cmp -s "$tmp/by_$by/0.png" "$tmp/plain.png" && fail "-k $by changes nothing"
done
run 0 -s 64x36 -t 3 -o t3.png --last 0 -c "$automatic" square.frames
cmp -s "$tmp/t3.png" "$tmp/plain.png" || fail "three threads draw other triangles"
run 0 -s 64x36 -n --view 0,1,0 square.frames # from above: another axis is up
run 0 -s 64x36 -n --view 0,0,1 small.xyz

# same_view FILE NAME OPTIONS: a side by its name is that by numbers.
same_view() {
    run 0 -s 64x36 --style plain --last 0 -o by_name.png --no-metadata --view "$2" "$1"
    # shellcheck disable=SC2086 # several words
    run 0 -s 64x36 --style plain --last 0 -o by_numbers.png --no-metadata $3 "$1"
    cmp -s "$tmp/by_name.png" "$tmp/by_numbers.png" || fail "--view $2 is not $3"
}
same_view small.xyz top '--view 0,0,1 --up y'
same_view small.xyz front '--view 0,-1,0'
same_view small.xyz back '--view 0,1,0'
same_view small.xyz right '--view 1,0,0'
same_view small.xyz left '--view=-1,0,0'
same_view square.frames front '--view 0,0,1'
same_view square.frames right '--view 1,0,0'
run 0 -s 64x36 -n --last 0 --view bottom square.frames
automatic=$(sed -n 's/^camera *-c //p' "$tmp/stdout")
case $automatic in *,0,0,1,30) ;; *) fail "z is not up from below, where y is: $automatic" ;; esac
refuses 2 '--view: ' --view to small.xyz

run 0 -s 64x36 -o high/%d.png -k height --up y small.xyz

# Both sides look alike; the normals of vertices bend the light, where the build reads meshes.
run 0 -s 65x65 --style plain -o front.png --last 0 -c 0,0,5,0,0,0,0,1,0,45 square.frames
run 0 -s 65x65 --style plain -o back.png --last 0 -c 0,0,-5,0,0,0,0,1,0,45 square.frames
cmp -s "$tmp/front.png" "$tmp/back.png" || fail "the back of a square differs from its front"
if (cd "$tmp" && $emulator "$program" -q -s 65x65 --style plain -o flat.png -c 0,0,5,0,0,0,0,1,0,45 flat.obj) >/dev/null 2>"$tmp/stderr"
then
    cmp -s "$tmp/front.png" "$tmp/flat.png" || fail "the mesh and the .frames of one square differ"
    run 0 -s 65x65 --style plain -o leaning.png -c 0,0,5,0,0,0,0,1,0,45 leaning.obj
    cmp -s "$tmp/leaning.png" "$tmp/flat.png" && fail "the normals of vertices change nothing"
    run 0 -n --fps 24 leaning.obj
else
    says err 'assimp'
fi
no_parts

# ---- A link stays one, what is no file is refused, a full disk leaves nothing ----------------------------------------

mkdir "$tmp/linked"
ln -s linked/target.png "$tmp/link.png"
run 0 -s 64x36 -o link.png one.xyz
[ -h "$tmp/link.png" ] && [ ! -h "$tmp/linked/target.png" ] || fail "a link to a picture was replaced"
is_png linked/target.png
chmod 640 "$tmp/linked/target.png"
run 0 -s 64x36 -o link.png one.xyz
[ "$(ls -l "$tmp/linked/target.png" | cut -c 1-10)" = -rw-r----- ] || fail "the mode of a picture changed"
ln -s /dev/null "$tmp/null.png"
run 1 -s 64x36 -o null.png one.xyz
says err 'null.png: cannot write: not a regular file'
(
    failures=0 # of these lines alone
    ulimit -f 8 2>/dev/null || exit 0
    run 1 -s 640x360 -o full/%d.exr one.xyz
    says err 'full/0.exr: cannot write: File too large'
    exit "$failures"
) || fail "a picture that cannot grow"
count full 0
no_parts

# ---- A signal ends the run after the frame that it is in ------------------------------------------------------------

i=0
while [ $i -lt 2000 ]; do
    printf '2\n\nC 0 0 0\nO 1 2 0\n'
    i=$((i + 1))
done >"$tmp/long.xyz"

# interrupt SIGNAL: sends it once the first picture is there; sets got to the exit code.
interrupt() {
    rm -rf "$tmp/long"
    (cd "$tmp" && exec $emulator "$program" -q -s 320x180 -o long/%d.png long.xyz) >"$tmp/stdout" \
        2>"$tmp/stderr" </dev/null &
    running=$!
    while [ ! -f "$tmp/long/0.png" ] && kill -0 $running 2>/dev/null; do
        sleep 0.1
    done
    kill -"$1" $running
    wait $running
    got=$?
    no_parts
}

for signal in HUP TERM; do
    interrupt $signal
    [ $got -eq 1 ] || fail "exit code $got, not 1, after SIG$signal"
    says err 'interrupted after [0-9]* frames'
done
last=$(find "$tmp/long" -type f | wc -l)
is_png "long/$((last - 1)).png"

# ---- What is in the pictures ----------------------------------------------------------------------------------------

if command -v oiiotool >/dev/null 2>&1; then
    # A sphere of radius 1 seen from 5: in the middle its depth is 4, in the corner there is nothing.
    run 0 -a 1 -s 65x65 -c $camera -r 1 -k type --light 0,0,1 --background ff0000 -o 'look.exr' -o look.png one.xyz
    oiiotool --info -v "$tmp/look.exr" >"$tmp/info" 2>&1 || fail "oiiotool cannot read look.exr"
    grep -q '65 x *65' "$tmp/info" || fail "look.exr is not 65x65: $(head -n 3 "$tmp/info")"
    grep -q 'R (float), G (float), B (float), Z (float), id (uint)' "$tmp/info" ||
        fail "look.exr has other channels: $(grep -i channel "$tmp/info")"
    # pixel X Y: the five values of that pixel; oiiotool shows an id as its share of the largest.
    pixel() {
        oiiotool "$tmp/look.exr" --crop "1x1+$1+$2" -o "$tmp/pixel.exr" &&
            oiiotool --dumpdata "$tmp/pixel.exr" | sed -n 's/.*Pixel.*): //p'
    }
    middle=$(pixel 32 32)
    corner=$(pixel 0 64)
    echo "$middle" | awk '{ exit !($1 > 0.5 && $2 > 0.2 && $3 == 0 && $4 == 4 && $5 == 0) }' ||
        fail "the middle is not a lit orange at depth 4: $middle"
    echo "$corner" | awk '{ exit !($1 == 1 && $2 == 0 && $3 == 0 && $4 == "inf" && $5 == 1) }' ||
        fail "the corner is not background at no depth: $corner"
    # The square from 5: depth 5, and its two triangles meet in the middle, on their common edge: the first one's.
    run 0 -s 65x65 -c $camera --style plain -o look.exr --last 0 square.frames
    middle=$(pixel 32 32)
    echo "$middle" | awk '{ exit !($1 > 0.4 && $4 == 5 && $5 == 0) }' || fail "the square is not at depth 5: $middle"
    oiiotool --info "$tmp/new/folder/f_005.png" | grep -q '64 x *36, 3 channel, uint8 png' ||
        fail "f_005.png is not 64x36 of 8 bits"
    oiiotool --info "$tmp/new/sheet.png" | grep -q '296 x *96' || fail "the contact sheet is not 4x2 of 64x36"
else
    echo "no oiiotool: the contents of the pictures are not looked at"
fi

# ---- The shipped trajectory -----------------------------------------------------------------------------------------

if [ -f "$data/pour2k.lammpstrj" ]; then
    run 0 -s 160x90 --every 10 -n --contact-sheet pour.png "$data/pour2k.lammpstrj"
    is_png pour.png
    says out '^spheres  *0 to [1-9]'
    says out '^colour  *type'
    run 0 -s 160x90 --first 20 --last 21 -k speed -n "$data/pour2k.lammpstrj"
    says out '^colour  *speed from 0 to [0-9.]*[1-9][0-9e-]*, 0 and the 99 % quantile, by change of position, a frame'
else
    fail "no pour2k.lammpstrj in $data"
fi

[ $failures -eq 0 ] || exit 1
echo "all good"
