#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Runs the commands of docs/guide/simulation_to_movie.md in their order, as they stand but for the size of pictures, in
# a folder with the files that the guide names. Each has to make a file that was not there. Movies are left out without
# ffmpeg, texts on pictures in a build that has none.
#   guide_cli.sh CGT_RENDER DATA_DIR CGT_CONVERT READERS_DATA_DIR GUIDE [EMULATOR...]
render=$1
folder=$2
convert=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
readers=$(cd "$4" && pwd)
guide=$(cd "$(dirname "$5")" && pwd)/$(basename "$5")
shift 5
set -- "$render" "$folder" "$@"
. "$(dirname "$0")/../cli.sh"

work=$tmp/work
mkdir "$work"
cp "$data"/*.lammpstrj "$data"/*.xyz "$readers"/formats.* "$readers"/water.* "$work"
chmod -R u+w "$work"

# The commands' names, wherever they stand in a line. The last --size counts, so that pictures are small.
cgt_render() { $emulator "$program" "$@" -s 64x48 -a 1; }
cgt_convert() { $emulator "$convert" "$@"; }
(cd "$work" && cgt_render -q -n --title A caffeine.xyz) >/dev/null 2>&1 && has_text=yes || has_text=
command -v ffmpeg >/dev/null 2>&1 && has_movies=yes || has_movies=

commands=0
skipped=0
sed -n 's/^    \(cgt-render\|cgt-convert\|awk\|printf\) /\1 /p' "$guide" | sed 's/^cgt-/cgt_/' >"$tmp/commands"
while read -r command; do
    case $command in
    *--time* | *--colorbar* | *--legend* | *--title*) [ -n "$has_text" ] || { skipped=$((skipped + 1)); continue; } ;;
    esac
    case $command in
    *.mp4* | *.webm* | *.gif*) [ -n "$has_movies" ] || { skipped=$((skipped + 1)); continue; } ;;
    esac
    ls "$work" >"$tmp/before"
    (cd "$work" && eval "$command") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null ||
        fail "exit code $?: $command: $(head -n 3 "$tmp/stderr")"
    ls "$work" >"$tmp/after"
    cmp -s "$tmp/before" "$tmp/after" && fail "no new file: $command"
    [ -z "$(find "$work" -size 0)" ] || fail "an empty file: $command"
    commands=$((commands + 1))
done <"$tmp/commands"
[ $((commands + skipped)) -ge 16 ] || fail "only $commands commands in $guide"
[ $failures -eq 0 ] || exit 1
echo "$commands commands, $skipped left out"
