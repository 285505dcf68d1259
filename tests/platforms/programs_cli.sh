#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The programs write the same bytes on every system: frames, pictures before they are compressed, what a movie's encoder
# gets. The sums are those of x86-64 Linux.
#   programs_cli.sh PROGRAM DATA_DIR RENDER|none BENCH FOLDER_OF_FFMPEG [EMULATOR...]
set -u
render=$3 bench=$4 ffmpeg=$5
convert=$1 data_dir=$2
shift 5
set -- "$convert" "$data_dir" "$@"
. "$(dirname "$0")/../programs/cli.sh"

# sum FILE SUM BYTES
sum() {
    found=$(cksum <"$tmp/$1")
    [ "$found" = "$2 $3" ] || fail "$1 has the sum and size $found, not $2 $3"
}

cp "$data/caffeine.xyz" "$tmp/in.xyz"
mkdir -p "$tmp/made/folder"
run 0 -q in.xyz made/folder/out.frames
sum made/folder/out.frames 2332031418 412
run 0 -q in.xyz made/folder/out.frames # in place of the first
sum made/folder/out.frames 2332031418 412
run 0 --version
says out '^cgt-convert (libcgt '
run 2 --nonsense
says err "^cgt-convert: unrecognized option '--nonsense'"
run 1 missing.xyz out.frames
says err 'missing.xyz: No such file'
ls "$tmp"/made/folder/*.part* 2>/dev/null && fail "a temporary file is left"

if [ "$render" != none ]; then
    program=$render name=cgt-render
    run 0 -q -s 32x18 -a 2 -o - in.xyz
    cp "$tmp/stdout" "$tmp/raw"
    sum raw 1428439204 1728
    run 0 -q -s 32x18 -o 'a/b/%02d.png' in.xyz
    [ "$(head -c 4 "$tmp/a/b/00.png" | tail -c 3)" = PNG ] || fail "no PNG"
    (cd "$tmp" && $emulator "$program" -q -s 32x18 --format xyz -o - - <in.xyz >pipe.raw 2>/dev/null) || fail "a pipe"
    run 0 -q -s 32x18 -o - in.xyz
    cmp -s "$tmp/stdout" "$tmp/pipe.raw" || fail "a pipe differs from the file"
    PATH=$ffmpeg:$PATH WINEPATH="Z:$ffmpeg"
    export PATH WINEPATH
    run 0 -q -s 32x18 -a 1 -o movie.mp4 in.xyz
    sum movie.mp4 1166407834 864
    says err '^cgt-render: movie.mp4: ffmpeg: a word from 4[0-9] arguments'
fi

program=$bench name=cgt-bench
run 0 frame -n 2 -s 32x18 "$tmp/made/folder/out.frames"
says out '^loose-grid'
run 0 cell --version
[ "$failures" -eq 0 ] || exit 1
