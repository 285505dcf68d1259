#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Runs the commands of docs/guide/pictures.md, with small pictures; those whose models are not installed are left out.
# README.md shows some of their pictures, of which two are drawn again and compared.
#   gallery_cli.sh CGT_RENDER DATA_DIR GUIDE README [EMULATOR...]
render=$1
folder=$2
guide=$3
readme=$4
shift 4
set -- "$render" "$folder" "$@"
. "$(dirname "$0")/../cli.sh"
cp "$data"/*.lammpstrj "$data"/*.xyz "$tmp"
commands=0
sed -n 's/^    cgt-render //p' "$guide" >"$tmp/commands"
while read -r command; do
    input=${command##* }
    case $input in /*) [ -e "$input" ] || continue ;; esac
    case $command in
    *.mp4*) # as numbered pictures, some frames of it, where nothing makes movies; all of them rebuild the scene
        case $command in *--bounces*)
            frames=$(echo "$command" | sed 's|-o \([a-z]*\)\.mp4|-o frame_%02d.png --last 7|; s|--rate [0-9]* ||')
            rm -f "$tmp"/frame_*.png
            eval "run 0 -q $frames -s 48x36 -a 1" </dev/null
            [ "$(find "$tmp" -name 'frame_*.png' | wc -l)" -eq 4 ] || fail "not four frames: cgt-render $frames"
            [ "$(cat "$tmp"/frame_*.png | wc -c)" -gt 4000 ] || fail "empty frames: cgt-render $frames"
            for a in "$tmp"/frame_*.png; do
                for b in "$tmp"/frame_*.png; do
                    [ "$a" = "$b" ] || ! cmp -s "$a" "$b" || fail "nothing moves: cgt-render $frames"
                done
            done
            moving=1
            ;;
        esac
        command -v ffmpeg >/dev/null 2>&1 || continue
        ;;
    *--title* | *--time* | *--colorbar* | *--legend* | *--axes*)
        (cd "$tmp" && $emulator "$program" -q -n --title A caffeine.xyz) >/dev/null 2>&1 || continue ;; # no font
    esac
    rm -f "$tmp"/*.png "$tmp"/*.mp4
    eval "run 0 -q $command -s 64x48 -a 1" </dev/null
    case $command in
    *.mp4*) [ -s "$(find "$tmp" -name '*.mp4')" ] || fail "no movie: cgt-render $command" ;;
    *--print-settings*) says out '^style = paper' ;;
    *) [ "$(find "$tmp" -name '*.png' | wc -l)" -eq 1 ] || fail "no picture: cgt-render $command" ;;
    esac
    commands=$((commands + 1))
done <"$tmp/commands"
[ $commands -ge 4 ] || fail "only $commands commands in $guide"
[ -n "${moving:-}" ] || fail "no movie of glass and mirrors in $guide"

# Each picture that README.md shows is made by a command of the guide.
pictures=0
for picture in $(grep -o '](docs/images/gallery/[a-z0-9_]*\.png)' "$readme" | tr -d ']()'); do
    name=${picture##*/}
    grep -q -e "-o $name " "$tmp/commands" || fail "README.md shows $picture, which no command of the guide makes"
    [ "$(wc -c <"${readme%README.md}$picture")" -lt 200000 ] || fail "$picture has 200 KB or more"
    pictures=$((pictures + 1))
done
[ $pictures -ge 3 ] || fail "README.md shows $pictures pictures"

# As the commands draw them: all but one of a thousand pixels within two steps of 255, since the C library's powers and
# logarithms may differ in the last place. The third takes seconds, and bounce_cli covers what it shows.
if command -v oiiotool >/dev/null 2>&1 && [ -z "$slow" ]; then
    for name in soft molecule; do
        rm -f "$tmp/$name.png"
        eval "run 0 -q $(grep -e "-o $name.png " "$tmp/commands")" </dev/null
        oiiotool --fail 0.008 --failpercent 0.1 --diff "$tmp/$name.png" "${readme%README.md}docs/images/gallery/$name.png" \
            >"$tmp/diff" 2>&1 || fail "docs/images/gallery/$name.png is not what its command draws: $(cat "$tmp/diff")"
    done
fi
[ $failures -eq 0 ] || exit 1
echo "$commands commands"
