#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# A run of cgt-render in parts that mpirun starts at once, as docs/guide/movies.md says: the pictures and names, byte for
# byte, as in one process; movies of parts, joined; a process that fails leaves the others alone.
#   parts_cli.sh CGT_RENDER DATA_DIR
. "$(dirname "$0")/../cli.sh"
command -v mpirun >/dev/null 2>&1 || { echo "no mpirun"; exit 77; }
mpirun --version 2>/dev/null | grep -q 'Open MPI' || { echo "not Open MPI: its variables are not known here"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 # containers' only user
export TMPDIR=$tmp                                               # sockets' names have a limit of length
camera=0,0,12,0,0,0,0,1,0,45
i=0
while [ $i -lt 30 ]; do
    printf '2\nframe %s\nC 0 0 0\nO %s.%s 2 0\n' $i $((i / 10)) $((i * i % 10))
    i=$((i + 1))
done >"$tmp/run.xyz"

# parts N CODE ARGUMENTS...: N processes in the folder `many`; in the arguments PART is the number of the part.
parts() {
    processes=$1
    wanted=$2
    shift 2
    rm -rf "$tmp/many"
    mkdir "$tmp/many"
    # shellcheck disable=SC2016 # the processes' own variables
    (cd "$tmp/many" && exec timeout 100 mpirun --oversubscribe -n "$processes" sh -c '
        k=$((OMPI_COMM_WORLD_RANK + 1))
        program=$1
        shift
        exec "$program" -q -s 64x36 -t 1 --part $k/$OMPI_COMM_WORLD_SIZE $(printf "%s " "$@" | sed "s/PART/$k/g")' \
        sh "$program" "$@") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
    got=$?
    [ "$got" -eq "$wanted" ] || fail "exit code $got, not $wanted: $processes parts, $*: $(head -n 5 "$tmp/stderr")"
}

# Automatic camera and colours, speeds from the frame before; a choice of frames; trails, which reach back into frames
# of other parts, and a legend of all frames.
for look in "-k speed --orbit 90" "-c $camera -k type --first 3 --every 3" "-k type --legend --trails 9"; do
    rm -rf "$tmp/one"
    mkdir "$tmp/one"
    # shellcheck disable=SC2086 # options
    run 0 -q -s 64x36 -t 1 -o one/f_%03d.png $look "$tmp/run.xyz"
    # shellcheck disable=SC2086
    parts 4 0 -o f_%03d.png $look "$tmp/run.xyz"
    diff -r "$tmp/one" "$tmp/many" >"$tmp/difference" || fail "4 parts, $look: $(head -n 3 "$tmp/difference")"
done
[ "$(find "$tmp/one" -name 'f_*.png' | wc -l)" -eq 30 ] || fail "not all pictures: $(ls "$tmp/one")"

# Movies of parts hold all frames, once they are joined.
if command -v ffmpeg >/dev/null 2>&1; then
    parts 3 0 -c $camera -k type -o partPART.mp4 ../run.xyz
    printf "file 'part%d.mp4'\n" 1 2 3 >"$tmp/many/list"
    (cd "$tmp/many" && ffmpeg -v error -f concat -i list -c copy run.mp4 &&
        ffmpeg -v error -i run.mp4 -f framemd5 -) </dev/null >"$tmp/frames" || fail "the parts cannot be joined"
    frames=$(grep -vc '^#' "$tmp/frames")
    [ "$frames" -eq 30 ] || fail "$frames frames in the movies of all parts, not 30"
fi

# One part cannot write a picture, and says so: the others make theirs.
mkdir -p "$tmp/blocked/f_007.png"
for k in 1 2 3; do
    wanted=0
    [ $k -ne 1 ] || wanted=1
    run $wanted -q -s 64x36 -t 1 --part $k/3 -c $camera -k type -o blocked/f_%03d.png run.xyz
    [ $k -ne 1 ] || says err 'f_007.png: cannot write: not a regular file'
done
[ "$(find "$tmp/blocked" -name 'f_*.png' -type f | wc -l)" -ge 20 ] || fail "pictures of other parts are missing"

[ $failures -eq 0 ] || exit 1
echo "all good"
