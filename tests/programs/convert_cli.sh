#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-convert: what it writes, what it refuses, and that a failed run leaves nothing behind.
#   convert_cli.sh CGT_CONVERT DATA_DIR [EMULATOR...]
. "$(dirname "$0")/cli.sh"
out=$tmp/out # the folder that the program writes to
mkdir "$out" || exit 1

# refuses CODE PATTERN ARGUMENTS...: an error with a text, nothing on standard output, the output's folder untouched.
refuses() {
    refused_code=$1
    refused_text=$2
    shift 2
    before=$(ls -l "$out")
    run "$refused_code" "$@"
    says err "$refused_text"
    [ -s "$tmp/stdout" ] && fail "text on standard output: cgt-convert $*"
    [ "$(ls -l "$out")" = "$before" ] || fail "the output's folder changed: cgt-convert $*: $(ls "$out")"
}

# holds FILE BYTES
holds() {
    size=$(wc -c <"$1")
    [ "$size" -eq "$2" ] || fail "$1 holds $size bytes, not $2"
}

# ---- What it writes ------------------------------------------------------------------------------------------------

shipped=$data/pour2k.lammpstrj
run 0 "$shipped" "$out/all.frames"
says out '76 frames, 0 to 2000 spheres'
spheres=$(awk '/^ITEM: NUMBER/ { getline; n += $1 } END { print n }' "$shipped")
holds "$out/all.frames" $((24 + 4 * 76 + 16 * spheres))
[ -e "$out/all.frames" ] && [ "$(ls "$out" | wc -l)" -eq 1 ] || fail "more than the output: $(ls "$out")"

run 0 -q "$out/all.frames" "$out/again.frames"
[ -s "$tmp/stdout" ] && fail "-q prints"
cmp -s "$out/all.frames" "$out/again.frames" || fail "a .frames file changes on its way through"

# Frames 0, 2, 4 of five; each has its number plus one spheres.
for n in 1 2 3 4 5; do
    printf '%d\n\n' "$n"
    i=0
    while [ "$i" -lt "$n" ]; do
        echo "C $i $n 0"
        i=$((i + 1))
    done
done >"$tmp/five.xyz"
run 0 --every=2 "$tmp/five.xyz" "$out/five.frames"
holds "$out/five.frames" $((24 + 4 * 3 + 16 * 9))
run 0 --first=1 --last=2 "$tmp/five.xyz" "$out/five.frames"
says out '2 frames, 2 to 3 spheres'
holds "$out/five.frames" $((24 + 4 * 2 + 16 * 5))

# The radius, as bytes: 1.7 of carbon, and 0.25 as requested.
radius() { od -A n -t x1 -j 40 -N 4 "$1" | tr -d ' \n'; }
run 0 --last=0 "$tmp/five.xyz" "$out/radius.frames"
[ "$(radius "$out/radius.frames")" = 9a99d93f ] || fail "radius of carbon: $(radius "$out/radius.frames")"
run 0 -r 0.25 --last=0 "$tmp/five.xyz" "$out/radius.frames"
[ "$(radius "$out/radius.frames")" = 0000803e ] || fail "radius 0.25: $(radius "$out/radius.frames")"

# A link stays a link, a mode stays as it was, and a new file gets the usual one.
ln -s five.frames "$out/link.frames"
chmod 640 "$out/five.frames"
ln -s link.frames "$out/chain.frames"
ln -s "$out/later.frames" "$out/early.frames"
ln -s loop.frames "$out/loop.frames"
run 0 "$tmp/five.xyz" "$out/chain.frames"
[ -h "$out/chain.frames" ] && [ -h "$out/link.frames" ] || fail "a link to a link was replaced"
holds "$out/five.frames" $((24 + 4 * 5 + 16 * 15))
run 0 "$tmp/five.xyz" "$out/early.frames"
[ -h "$out/early.frames" ] && [ ! -h "$out/later.frames" ] || fail "the link to a new file was replaced"
holds "$out/later.frames" $((24 + 4 * 5 + 16 * 15))
run 1 "$tmp/five.xyz" "$out/loop.frames"
says err 'symbolic links'
run 0 "$tmp/five.xyz" "$out/link.frames"
[ -h "$out/link.frames" ] || fail "the link was replaced"
holds "$out/five.frames" $((24 + 4 * 5 + 16 * 15))
[ "$(ls -l "$out/five.frames" | cut -c 1-10)" = -rw-r----- ] || fail "the mode changed"
(umask 022 && run 0 "$tmp/five.xyz" "$out/new.frames" && [ "$failures" -eq 0 ]) || fail "a new file"
[ "$(ls -l "$out/new.frames" | cut -c 1-10)" = -rw-r--r-- ] || fail "the mode of a new file"

# ---- Meshes --------------------------------------------------------------------------------------------------------

# A square that a build without assimp can read, too: two triangles, frames of four and five vertices. Bytes in octal.
frames_mesh() {
    printf 'CGTFRAM1\002\000\000\000\002\000\000\000\002\000\000\000\000\000\000\000'
    printf '\000\000\000\000\001\000\000\000\002\000\000\000\000\000\000\000\002\000\000\000\003\000\000\000'
    printf '\004\000\000\000' && head -c 48 /dev/zero
    printf '\005\000\000\000' && head -c 60 /dev/zero
}
frames_mesh >"$tmp/square.frames"
run 0 "$tmp/square.frames" "$out/square.frames"
says out '2 frames, 2 triangles, 4 to 5 vertices'
cmp -s "$tmp/square.frames" "$out/square.frames" || fail "a .frames file of triangles changes on its way through"
run 0 --first=1 "$tmp/square.frames" "$out/square.frames"
holds "$out/square.frames" $((24 + 24 + 4 + 60))

printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nl 1 2\n' >"$tmp/square.obj"
run_any() { (cd "$tmp" && exec $emulator "$program" "$@") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null; }
if ! run_any "$tmp/square.obj" "$out/obj.frames" && grep -q 'assimp, which this build does not have' "$tmp/stderr"; then
    echo "this build has no assimp: meshes are refused"
else
    run 0 "$tmp/square.obj" "$out/obj.frames"
    says out '1 meshes shown 1 times, 0 bones, 0 clips'
    says out ': 1 lines left out'
    says out ': vertex normals left out'
    says out '1 frames, 2 triangles, 4 to 4 vertices'
    holds "$out/obj.frames" $((24 + 24 + 4 + 48))
    run 0 -q "$tmp/square.obj" "$out/obj.frames"
    [ -s "$tmp/stdout" ] && fail "-q prints"
    rm "$out/obj.frames"
    refuses 1 "no clip 'walk': the file has no animation" --clip=walk "$tmp/square.obj" "$out/obj.frames"
    walker=/usr/share/assimp/models/X/Testwuson.X
    if [ -r "$walker" ]; then
        run 0 --clip=Wuson_Walk --fps=10 --every=2 "$walker" "$out/walk.frames"
        says out '19 frames, 3732 triangles'
        refuses 1 "there are 0 'Wuson_Run'" --clip=fly "$walker" "$out/fly.frames"
    else
        echo "not here: $walker"
    fi
fi

# ---- What it refuses ------------------------------------------------------------------------------------------------

head -n 500 "$shipped" >"$tmp/cut.lammpstrj"
head -n 6 "$tmp/five.xyz" >"$tmp/cut.xyz"
head -n 2 "$tmp/five.xyz" >"$tmp/cut_at_once.xyz"
run 1 "$tmp/cut.xyz" "$out/cut.frames"
says err 'cut.xyz:6: the file ends after 1 of 2 spheres'
says err 'the frame before that is written'
holds "$out/cut.frames" $((24 + 4 + 16))
refuses 1 'cut_at_once.xyz:2: the file ends after 0 of 1' "$tmp/cut_at_once.xyz" "$out/cut.frames"
refuses 1 'no frames to convert' --first=5 "$tmp/five.xyz" "$out/none.frames"
: >"$tmp/empty.xyz"
refuses 1 'empty.xyz: no frames to convert' "$tmp/empty.xyz" "$out/none.frames"
refuses 1 ' -: no frames to convert: the file is empty' - "$out/none.frames"
refuses 1 'missing.xyz: No such file' "$tmp/missing.xyz" "$out/none.frames"
echo odd >"$tmp/five.odd"
refuses 1 'the ending is not one of' "$tmp/five.odd" "$out/none.frames"
refuses 1 'No such file' "$tmp/five.xyz" "$out/no/folder/x.frames"
mkdir "$out/folder.frames"
refuses 1 'not a regular file' "$tmp/five.xyz" "$out/folder.frames"
refuses 2 'must end in .frames' "$tmp/five.xyz" "$out/five.lammpstrj"
refuses 2 'an input and an output are needed' "$tmp/five.xyz"
refuses 2 'an input and an output are needed'
refuses 1 'a.frames: not of the format of the files before it' "$tmp/five.xyz" "$out/a.frames" "$out/b.frames"
refuses 1 'missing.xyz: No such file' "$tmp/five.xyz" "$tmp/missing.xyz" "$out/b.frames"
refuses 1 'the format is not one of lammps, ' --format=odd "$tmp/five.xyz" "$out/b.frames"
echo odd >"$tmp/dump.melt"
refuses 1 'other names need a format' "$tmp/dump.melt" "$out/b.frames"
refuses 2 '--follow: .*is not a number' --follow=0 "$tmp/five.xyz" "$out/b.frames"

# ---- Names, series, standard input ----------------------------------------------------------------------------------

cp "$tmp/five.xyz" "$tmp/run.9.txt"
printf '1\n\nC 9 9 9\n' >"$tmp/run.10.txt"
run 0 --format=xyz "$tmp/run.10.txt" "$tmp/run.9.txt" "$out/series.frames"
says out '6 frames, 1 to 5 spheres'
cp "$tmp/five.xyz" "$tmp/both.xyz"
cat "$tmp/run.10.txt" >>"$tmp/both.xyz"
run 0 "$tmp/both.xyz" "$out/both.frames"
cmp -s "$out/series.frames" "$out/both.frames" || fail "a series differs from one file"
(cd "$tmp" && exec $emulator "$program" -q --format=xyz - "$out/piped.frames" <both.xyz) || fail "standard input"
cmp -s "$out/piped.frames" "$out/both.frames" || fail "standard input differs from the file"
cat "$tmp/both.xyz" | $emulator "$program" -q --format=xyz - "$out/piped.frames" || fail "a pipe"
cmp -s "$out/piped.frames" "$out/both.frames" || fail "a pipe differs from the file"
# A run that grows while it is read. On a busy machine the rest may come later than one waits for: again, with more time.
for patience in 2 20 200; do
    cp "$tmp/five.xyz" "$tmp/growing.xyz"
    (sleep 0.3 && cat "$tmp/run.10.txt" >>"$tmp/growing.xyz") &
    run 0 --follow=$patience "$tmp/growing.xyz" "$out/followed.frames"
    wait
    cmp -s "$out/followed.frames" "$out/both.frames" && break
done
cmp -s "$out/followed.frames" "$out/both.frames" || fail "a growing file differs from the whole one"

refuses 2 '-r: .*is not a number' -r 0 "$tmp/five.xyz" "$out/a.frames"
refuses 2 '--every: .*is not a whole number' --every=0 "$tmp/five.xyz" "$out/a.frames"
refuses 2 '--fps: .*is not a number' --fps=0 "$tmp/five.xyz" "$out/a.frames"
refuses 2 '--first 3 is after --last 2' --first=3 --last=2 "$tmp/five.xyz" "$out/a.frames"
refuses 2 'unrecognized option .--nonsense' --nonsense "$tmp/five.xyz" "$out/a.frames"

# The command line as GNU's programs read it.
refuses 2 "option '--fo' is ambiguous; possibilities: '--format' '--follow'" --fo=xyz "$tmp/five.xyz" "$out/a.frames"
refuses 2 "option '--quiet' doesn't allow an argument" --quiet=1 "$tmp/five.xyz" "$out/a.frames"
refuses 2 "option '--radius' requires an argument" "$tmp/five.xyz" "$out/a.frames" --radius
refuses 2 "option requires an argument -- 'r'" "$tmp/five.xyz" "$out/a.frames" -qr
refuses 2 "invalid option -- 'Z'" -qZ "$tmp/five.xyz" "$out/a.frames"
refuses 2 "an input and an output are needed" -- -q
refuses 2 "^Try .cgt-convert --help' or .cgt-convert --usage' for more information"
cp "$tmp/five.xyz" "$tmp/-q.xyz"
run 0 -q -r 2 "$tmp/five.xyz" "$out/apart.frames"
run 0 "$tmp/five.xyz" -qr2 "$out/letters.frames"
run 0 --rad=2 --qui -- -q.xyz "$out/short.frames"
run 0 --radius 2 "$tmp/five.xyz" "$out/operands.frames" -q
for made in letters short operands; do
    cmp -s "$out/$made.frames" "$out/apart.frames" || fail "the command line of $made.frames"
done
run 0 --__words=format
says out '^lammps .* frames$'

# No room: a limit on the size of files, at which writing fails.
(
    failures=0 # of these lines alone
    ulimit -f 8 2>/dev/null || exit 0
    refuses 1 'File too large' "$shipped" "$out/big.frames"
    exit "$failures"
) || fail "a file that cannot grow"

# Signals leave nothing behind. The input is a pipe that stays open, so that the output is unfinished when they come.
for signal in HUP TERM; do
    mkfifo "$tmp/slow.xyz" || break
    $emulator "$program" "$tmp/slow.xyz" "$out/slow.frames" >"$tmp/stdout" 2>"$tmp/stderr" &
    running=$!
    exec 3>"$tmp/slow.xyz"
    head -c 100 "$tmp/five.xyz" >&3
    tries=0
    while ! ls "$out"/slow.frames.part.* >/dev/null 2>&1 && [ $tries -lt 100 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
    [ $tries -lt 100 ] || fail "no temporary file appeared"
    kill -$signal $running
    wait $running
    [ $? -gt 128 ] || fail "SIG$signal does not end the program"
    exec 3>&-
    rm -f "$tmp/slow.xyz"
    ls "$out"/slow.frames* >/dev/null 2>&1 && fail "SIG$signal leaves $(ls "$out"/slow.frames*)"
done

run 0 --help
says out '^Usage: cgt-convert \[OPTION...\] INPUT... OUTPUT.frames$'
says out '^  -r, --radius=R             Radius of spheres where the file has none, in$'
says out '^                             world units (default: the element'
[ "$(grep -c '^.\{80\}' "$tmp/stdout")" -eq 0 ] || fail "--help has lines of more than 79 columns"
CGT_HELP_WIDTH=1000 run 0 --help
says out 'has none, in world units (default'
run 0 --usage
says out '^Usage: cgt-convert \[-q?V\] \[-r R\] \[--clip=NAME\]'
run 0 --version
says out '^cgt-convert (libcgt [0-9]*\.[0-9]*\.[0-9]*)$'
if [ -w /dev/full ]; then
    $emulator "$program" --last=0 "$tmp/five.xyz" "$out/five.frames" >/dev/full 2>"$tmp/stderr"
    [ $? -eq 1 ] || fail "standard output that cannot be written"
fi

[ "$failures" -eq 0 ] || exit 1
