#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cgt-view by scripts of events, in SDL's window without a display.
#   view_cli.sh CGT_VIEW DATA_DIR CGT_RENDER GUIDE
render=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
guide=$4
set -- "$1" "$2"
. "$(dirname "$0")/../programs/cli.sh"
SDL_VIDEODRIVER=dummy SDL_AUDIODRIVER=dummy
export SDL_VIDEODRIVER SDL_AUDIODRIVER
size='-s 160x90'
pour=$data/pour2k.lammpstrj

# view CODE OPTIONS...: runs the script on standard input.
view() {
    wanted=$1
    shift
    cat >"$tmp/script"
    run "$wanted" $size --script script "$@"
}

# talk CODE FUNCTION OPTIONS...: runs the script that a function prints meanwhile, which may wait for what is said.
talk() {
    wanted=$1
    rm -f "$tmp/script" "$tmp/stdout"
    mkfifo "$tmp/script"
    "$2" >"$tmp/script" &
    shift 2
    run "$wanted" $size --script script "$@"
    wait
    rm "$tmp/script"
}

# ask PATTERN: prints a script that says how it is until that was said, a minute at most.
ask() {
    for tries in $(seq 600); do
        printf 'say\n'
        sleep 0.05
        ! grep -q "$1" "$tmp/stdout" 2>/dev/null || return 0
        printf 'wait 0.05\n'
    done
}

# color_by_last ARGUMENT...: chooses the last of the file's columns from the list of the key l, and writes the picture.
color_by_last() {
    view 0 "$@" <<'END'
settle
key l
key Up
key Up
key Return
settle
key s
settle
END
}

# same FILE: the printed command line of cgt-render, under another name, makes the bytes of FILE.
same() {
    grep '^cgt-render ' "$tmp/stdout" | tail -n 1 |
        sed "s|^cgt-render|'$render' -q|; s|--output=view|--output=again|" >"$tmp/command"
    [ -s "$tmp/command" ] || fail "no command line is printed for $1"
    rm -f "$tmp"/again*
    (cd "$tmp" && sh ./command) >"$tmp/again.log" 2>&1 || fail "the command fails: $(head -n 2 "$tmp/again.log")"
    again=$(ls "$tmp"/again_* 2>/dev/null | head -n 1)
    cmp -s "$tmp/$1" "${again:-none}" || fail "$1 is not what cgt-render writes: $(cat "$tmp/command")"
}

# What s writes is cgt-render's, whatever was done before.
view 0 "$pour" <<'END'
key End
settle
press 1 80 45
move 90 50
release 1 95 50
wheel 2 80 60
key l
key Down
key Return
settle
key s
settle
say
END
same view_0075.png
says out '^frame 75, full, 1/1, color id, '
view 0 -k 'sqrt(x^2+y^2)' --box --title 'Grains' --time='{step}' --colorbar=d --outline=1.5 "$pour" <<'END'
key Left
key End
key Left
settle
key p
key z
key Shift+X
key s
settle
END
same view_0074.png
view 0 --style plain -a 1 -k height "$data/caffeine.xyz" <<'END'
settle
key s
settle
END
same view_0000.png
view 0 --bonds --radius-scale 0.3 --style paper --light-size 5 "$data/caffeine.xyz" <<'END'
settle
key s
settle
END
same view_0000-2.png

# What the panel sets is in the picture; without the panel in the build o says so, and the rest is for the picture.
if "$program" --help | grep -q 'o opens a panel'; then
    view 0 -s 700x400 --style plain -a 1 "$data/caffeine.xyz" <<'END'
settle
key o
settle
text radius-sc
key Return
text 0.4
key Return
settle
key Escape
settle
key s
settle
shot panel.png
END
    same view_0000-3.png
    grep -q -e '--radius-scale=0.4' "$tmp/command" || fail "the panel sets nothing: $(cat "$tmp/command")"
    # the option size is the picture's, and the window follows
    view 0 -s 700x400 --style plain -a 1 "$data/caffeine.xyz" <<'END'
settle
key o
settle
text size
key Return
key Ctrl+A
text 300x200
key Return
settle
key Escape
key s
settle
END
    same view_0000-4.png
    grep -q -e '--size=300x200' "$tmp/command" || fail "the panel does not set the size: $(cat "$tmp/command")"
    rm "$tmp/view_0000-3.png" "$tmp/view_0000-4.png" # names are those of a build without a panel
fi

# A window without a file; files that are dropped on it, read anew, with settings that are saved and loaded.
XDG_DATA_HOME=$tmp/data\ home
export XDG_DATA_HOME
head -n 14 "$data/caffeine.xyz" | sed '1s/.*/12/' >"$tmp/few.xyz"
cp "$data/caffeine.xyz" "$tmp/later.xyz"
view 0 --style plain -a 1 <<END
wait 0.1
key o
key s
drop few.xyz
settle
key p
key Ctrl+S
drop missing.xyz
drop $pour
settle
say
drop few.xyz
drop view.settings
settle
key r
settle
key s
settle
END
same view_0000-3.png
says out '^frame 3, full, 1/1, color type, '
says err '^cgt-view: missing.xyz: No such file or directory$'
[ "$(grep -c missing "$tmp/stderr")" -eq 1 ] || fail "a file that is not there is opened twice"
grep -q -e '--ortho' "$tmp/command" || fail "settings are not loaded: $(cat "$tmp/command")"
[ "$(sed 's|.*/||' "$XDG_DATA_HOME/cgt/recent" | paste -sd' ')" = "few.xyz pour2k.lammpstrj" ] ||
    fail "recent files: $(cat "$XDG_DATA_HOME/cgt/recent")"
printf 'style = soft\nwhole = 1\n' >"$tmp/wrong.settings"
view 0 --style plain -a 1 few.xyz <<'END'
settle
drop wrong.settings
wait 0.1
say
END
says err 'wrong.settings:2: whole: the option takes no value'
says out '^frame 0, '
# a file that is written anew
write_anew() {
    printf 'settle\n'
    ask '^frame 0, '
    mv "$tmp/later.xyz" "$tmp/few.xyz"
    printf 'key r\nsettle\nkey s\nsettle\n'
}
talk 0 write_anew --style plain -a 1 few.xyz
same view_0000-4.png # by the file that is there now

# Looks of the command line are also for the next file, where the first cannot be opened.
rm -f "$tmp"/view_*
view 0 --style plain -a 1 --radius 0.1 missing.xyz <<END
wait 0.1
drop few.xyz
settle
key s
settle
END
same view_0000.png
grep -q -e '--style=plain' "$tmp/command" || fail "options are lost with a file: $(cat "$tmp/command")"
# What cgt-render refuses is not written, and no command line is printed for it.
printf 'transparent\n' >"$tmp/clear.settings"
view 0 --style plain -a 1 -o 'clear_%04d.jpg' few.xyz <<'END'
settle
drop clear.settings
settle
key s
key Shift+C
wait 0.1
END
says err 'clear_%04d.jpg" holds no opacity'
grep -q '^cgt-render' "$tmp/stdout" || [ -e "$tmp/clear_0000.jpg" ] && fail "a .jpg that is to be transparent"

# A movie is cgt-render's, and one that is ended leaves nothing; Python for a picture.
mkdir "$tmp/temporary"
TMPDIR=$tmp/temporary
export TMPDIR
rm -f "$tmp"/view*.settings
view 0 --style plain -a 1 --type-color 1=red --type-color '2=blue' --title 'It'"'"'s "so" \' "$pour" <<'END'
key End
settle
key Ctrl+S
key Shift+C
key m
key m
settle
key m
settle
say
END
grep -q 'view.mp4' "$tmp/stderr" && fail "a movie that was ended is told as one that failed: $(cat "$tmp/stderr")"
if command -v ffmpeg >/dev/null; then
    (cd "$tmp" && "$render" --settings view.settings -q -o again.mp4 "$pour") >/dev/null 2>&1
    cmp -s "$tmp/view.mp4" "$tmp/again.mp4" || fail "m does not write what cgt-render does"
    [ "$(cd "$tmp" && ls view*.mp4)" = view.mp4 ] || fail "a movie that was ended is there: $(ls "$tmp")"
fi
[ -z "$(ls "$TMPDIR")" ] || fail "temporary files stay: $(ls "$TMPDIR")"
unset TMPDIR
view_python() { # of the panel's button; printed, too
    view 0 -s 900x300 --style plain -a 1 "$@" <<'END'
settle
key o
wait 0.2
click 780 43
wait 0.2
END
}
if command -v python3 >/dev/null && "$program" --help | grep -q 'o opens a panel'; then
    view_python --type-color 1=red --type-color '2=blue' --title 'It'"'"'s "so" \' --bonds "$data/caffeine.xyz"
    cp "$tmp/stdout" "$tmp/lines.py"
    python3 -m py_compile "$tmp/lines.py" 2>"$tmp/python.log" || fail "Python's lines: $(cat "$tmp/lines.py" "$tmp/python.log")"
    for line in '    type_color=["1=red", "2=blue"],' '    title="It'"'"'s \"so\" \\",' '    bonds=True,'; do
        grep -qxF "$line" "$tmp/lines.py" || fail "Python's lines lack $line: $(cat "$tmp/lines.py")"
    done
    [ "$(grep -c '^    type_color=' "$tmp/lines.py")" = 1 ] || fail "a keyword comes twice: $(cat "$tmp/lines.py")"
    # The frame before, for speeds; a mesh, with the origin of the run.
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$tmp/-wall.obj"
    (cd "$tmp" && view_python --first=5 --mesh ./-wall.obj --origin=1,2,3 --color speed "$pour")
    grep -qxF 'for frame in run[4:6]:' "$tmp/stdout" || fail "Python's lines: $(cat "$tmp/stdout")"
    grep -qxF 'figure.set_mesh(cgt.read("./-wall.obj", origin=(1, 2, 3))[0])' "$tmp/stdout" ||
        fail "Python's lines: $(cat "$tmp/stdout")"
    # How files are read: molecules that are made whole need bonds.
    printf '2\nLattice="9 0 0 0 9 0 0 0 9" Properties=species:S:1:pos:R:3\nO 0 0 0\nH 0 0 8\n' >"$tmp/box.xyz"
    view_python --whole box.xyz
    grep -qxF 'run = cgt.read("box.xyz", all_bonds=True, leave_out_sites=True)' "$tmp/stdout" ||
        fail "Python's lines: $(cat "$tmp/stdout")"
    view_python --fps 60 --no-limit ./-wall.obj
    grep -qxF 'run = cgt.read("./-wall.obj", leave_out_sites=True, fps=60, no_limit=True)' "$tmp/stdout" ||
        fail "Python's lines: $(cat "$tmp/stdout")"
fi

# The sky of mirrors is cgt-render's, by the same options, though the way up of a hand is orthogonal to its view.
for with in --floor '--view 0,0.5,0.8' '-c 12,-9,10,0,0,0,0.2,0.3,1,60'; do
    rm -f "$tmp"/view_* "$tmp"/again*
    # shellcheck disable=SC2086 # options
    view 0 --no-metadata --material all=mirror --bounces 4 $with "$data/caffeine.xyz" <<'END'
settle
key s
settle
END
    # shellcheck disable=SC2086 # options
    (cd "$tmp" && "$render" -q $size --no-metadata --material all=mirror --bounces 4 $with -o again.png \
        "$data/caffeine.xyz") >"$tmp/again.log" 2>&1 || fail "cgt-render fails: $(head -n 2 "$tmp/again.log")"
    cmp -s "$tmp/view_0000.png" "$tmp/again.png" || fail "the sky of mirrors is another, $with"
done

# Mirrors and glass, a floor, a transparent background; also after colours, hiding and the camera's up have changed.
rm -f "$tmp"/view_*
view 0 --material 'C=glass' --material 'all=mirror' --bounces 4 --floor "$data/caffeine.xyz" <<'END'
settle
key f
key z
key x
settle
click 80 45
wait 0.1
say
key Shift+D
settle
key l
key Down
key Return
settle
key s
settle
say
END
same view_0000.png
says out 'selected sphere [0-9]*, type [0-9], [CHNO]'
says out '--bounces=4 .*--show=.*--floor-axis=z .*--floor-place='
rm -f "$tmp"/view_*
view 0 --style plain --floor=red --floor-height -1 --transparent --title T --up y -a 1 "$data/caffeine.xyz" <<'END'
settle
key z
click 80 45
wait 0.1
key d
settle
key s
settle
END
same view_0000.png
rm -f "$tmp"/view_*
printf 'v 0 0 0\nv 8 0 0\nv 4 8 0\nv 4 4 6\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >"$tmp/closed.obj"
view 0 --bounces 3 --material all=glass:1.3 --floor -k red closed.obj <<'END'
settle
key f
key z
settle
click 80 45
wait 0.1
say
key s
settle
END
same view_0000.png
says out 'selected triangle'

# Hidden spheres are hidden in the written picture, too; a picture is never overwritten.
rm -f "$tmp"/view_*
view 0 "$data/caffeine.xyz" <<'END'
settle
key f
key z
settle
click 80 45
wait 0.1
say
key Shift+D
settle
say
key s
settle
key s
settle
END
says out 'selected sphere'
same view_0000-2.png
cmp -s "$tmp/view_0000.png" "$tmp/view_0000-2.png" || fail "two pictures of one state differ"
says out '--show='

# A column that is chosen is coloured between its quantiles, as cgt-render does: one value far off is not seen.
awk 'BEGIN { print 300; print "Properties=species:S:1:pos:R:3:q:R:1"
    for (i = 0; i < 300; i++) print "C", i % 20, int(i / 20), 0, i == 7 ? 1e6 : i }' >"$tmp/far.xyz"
rm -f "$tmp"/view_*
color_by_last --style plain far.xyz
same view_0000.png
says out '--color=q --range=[0-9],29[0-9] '
# Words have the colours that they have in cgt-render, with a legend; numbers and what is seen through, too.
awk 'BEGIN { print 60; print "Properties=species:S:1:pos:R:3:part:S:1"
    for (i = 0; i < 60; i++) print "C", i % 10, int(i / 10), i % 3, substr("hbx", int(i / 20) + 1, 1) }' >"$tmp/parts.xyz"
rm -f "$tmp"/view_*
color_by_last --style plain parts.xyz --colorbar --opacity 'part == b=0.4'
same view_0000.png
says out '--color=part '
rm -f "$tmp"/view_*
view 0 --category 'floor(x / 4)' --type-color 1=red --legend --bonds=1.5 --opacity C=0.5 parts.xyz <<'END'
settle
key s
settle
END
same view_0000.png
says out "'--category=floor(x / 4)' --first"

# Time: it begins with frame 3, the first that has something; steps, jumps: each is the frame that was asked for.
view 0 "$pour" <<'END'
settle
key Right
settle
say
key Shift+Right
settle
say
key PageDown
settle
say
key Home
settle
say
click 159 85
settle
say
key Space
wait 0.3
key Space
settle
END
grep -o '^frame [0-9]*' "$tmp/stdout" | tr '\n' ' ' >"$tmp/frames"
[ "$(cat "$tmp/frames")" = 'frame 4 frame 14 frame 22 frame 0 frame 75 ' ] || fail "frames $(cat "$tmp/frames")"

# The state: what is drawn over a picture is none of its own; the clock and the CPU's time go on.
view 0 --style plain "$pour" <<'END'
settle
say
key h
wait 0.2
say
key End
settle
say
END
sed -n 's/.* \([0-9]*\) pictures, at \([0-9.]*\) s, \([0-9.]*\) s of CPU.*/\1 \2 \3/p' "$tmp/stdout" |
    awk '{ n[NR] = $1; at[NR] = $2; cpu[NR] = $3 }
        END { exit !(NR == 3 && n[2] == n[1] && n[3] > n[2] && at[2] > at[1] && at[3] > at[2] && cpu[3] > cpu[2]) }' ||
    fail "the state: $(cat "$tmp/stdout")"

# Key frames: in order, each frame once, and cgt-render takes them; those of before stay.
printf '# keys\n50 1,2,3,4,5,6,0,0,1,30 hold\n' >"$tmp/camera.keys"
view 0 "$pour" <<'END'
key End
settle
key k
key Home
settle
key k
key x
key k
settle
END
[ "$(cut -d ' ' -f 1 "$tmp/camera.keys" | tr '\n' ' ')" = '# 0 50 75 ' ] || fail "keys $(cat "$tmp/camera.keys")"
(cd "$tmp" && "$render" -q -s 16x9 --camera-keys camera.keys --first 3 --last 3 -o keyed.png "$pour") >/dev/null ||
    fail "cgt-render does not take the keys"

# The camera that c prints is the one of the next start.
view 0 "$data/caffeine.xyz" <<'END'
press 1 80 45
move 70 50
release 1 60 50
key c
settle
say
END
sed -n 's/^-c //p' "$tmp/stdout" >"$tmp/camera"
sed -n 's/.* eye \([^ ]*\), .*/\1/p' "$tmp/stdout" >"$tmp/eye"
view 0 -c "$(cat "$tmp/camera")" "$data/caffeine.xyz" <<'END'
settle
say
END
says out "eye $(cat "$tmp/eye"), "

# Files that cannot be read: the window says why, and the program ends with an error; a file that ends in the middle
# shows the frames before.
printf 'no frames' >"$tmp/bad.lammpstrj"
view 1 bad.lammpstrj <<'END'
wait 0.2
shot bad.png
key q
END
says err 'bad.lammpstrj'
[ -s "$tmp/bad.png" ] || fail "no picture of the error"
view 1 "$tmp/none.xyz" <<'END'
wait 0.1
END
says err 'none.xyz'
head -c 30000 "$pour" >"$tmp/cut.lammpstrj"
view 0 cut.lammpstrj <<'END'
settle
key End
settle
say
key Right
key Space
wait 0.2
say
END
says out '^frame [1-9]'

# A run that is being written goes on at its end; the first frame does not come again.
frame() { printf '3\nframe %d\nC %d 0 0\nO 3 %d 0\nN 0 0 4\n' "$1" "$1" "$1"; }
grow() {
    printf 'settle\nkey Space\n'
    ask '^frame 1, '
    frame 2 >>"$tmp/grows.xyz"
    ask '^frame 2, '
    printf 'key Space\nsettle\nsay\n'
}
for survey in 90 1; do # with the second the window counts frames by itself
    { frame 0; frame 1; } >"$tmp/grows.xyz"
    talk 0 grow --follow 90 --survey $survey grows.xyz
    sed -n 's/^frame \([0-9]*\),.*/\1/p' "$tmp/stdout" | uniq >"$tmp/frames"
    sort -c -u "$tmp/frames" && [ "$(tail -n 1 "$tmp/frames")" = 2 ] || fail "a run that grows: $(cat "$tmp/stdout")"
done

# Options: what is left out is refused in words, what is shared has the sentences of cgt-render.
view 2 --orbit 3 "$pour" </dev/null
says err 'orbit: the hand moves the camera'
view 2 --cell native "$pour" </dev/null
says err 'cell: an emulated Cell takes seconds'
view 2 --transparent -o a.jpg "$pour" </dev/null
says err 'a.jpg. holds no opacity'
view 2 --ambient 999 "$pour" </dev/null
says err '0 to 256'
view 2 -o 'x.exr' "$pour" </dev/null
says err '\.png'
run 0 $size --script /dev/null
run 0 --help
says out '--style'
says out '--memory'
for option in output contact-sheet orbit part cell; do
    grep -q -e "--$option\\b" "$tmp/stdout" && fail "--help has --$option"
done
view 1 "$pour" <<'END'
jump 3
END
says err 'script:1: "jump 3" is no event'

# A window that is closed in the middle of a picture or while frames are read; little memory.
for wait in 0 0.02 0.1; do
    view 0 -a 4 --ambient 256 "$pour" <<END
key End
wait $wait
close
END
done
view 0 --memory 16 --trails 5 "$pour" <<'END'
key Space
wait 0.3
key Space
key Left
key Left
settle
key s
settle
END
same "$(cd "$tmp" && ls view_*.png | tail -n 1)"

# The guide's commands make its pictures: those of one kind of window have their size.
cp "$data/pour2k.lammpstrj" "$data/caffeine.xyz" "$tmp"
sed -n -e '/^## Scripts/,$s/^    printf/printf/p' -e '/^## Scripts/,$s/^    cgt-view/run 0/p' "$guide" >"$tmp/guide"
[ "$(wc -l <"$tmp/guide")" -eq 8 ] || fail "not eight commands in $guide"
"$program" --help | grep -q 'o opens a panel' || sed -i '/panel/d' "$tmp/guide" # Space would play there
while read -r command; do
    case $command in
    printf*) (cd "$tmp" && eval "$command") ;;
    *) eval "$command" ;;
    esac
done <"$tmp/guide"
for picture in angle colors help; do
    [ "$(od -A n -j 16 -N 8 -t x1 "$tmp/$picture.png" | tr -d ' ')" = 00000280000001e0 ] ||
        fail "no $picture.png of 640x480"
done

if "$program" --help | grep -q 'o opens a panel'; then
    [ "$(od -A n -j 16 -N 8 -t x1 "$tmp/panel.png" | tr -d ' ')" = 000003c00000021c ] || fail "no panel.png of 960x540"
fi

[ $failures -eq 0 ] || exit 1
echo "cgt-view by scripts"
