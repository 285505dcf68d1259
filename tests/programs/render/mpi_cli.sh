#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cgt-render in several processes under mpirun: the same pictures, names, movie and contact sheet, byte for byte, as in
# one; what is told where something fails, or a process dies.
#   mpi_cli.sh CGT_RENDER DATA_DIR
. "$(dirname "$0")/../cli.sh"
command -v mpirun >/dev/null 2>&1 || { echo "no mpirun"; exit 77; }
mpirun --version 2>/dev/null | grep -q 'Open MPI' || { echo "not Open MPI: its options are not known here"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 # containers' only user
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"           # MPI's own; the other tests find ours
export TMPDIR=$tmp                                               # sockets' names have a limit of length
mpi="timeout 100 mpirun --oversubscribe"
camera=0,0,12,0,0,0,0,1,0,45
movie=
command -v ffmpeg >/dev/null 2>&1 && movie="-o run.mp4"
i=0
while [ $i -lt 60 ]; do
    printf '2\nframe %s\nC 0 0 0\nO %s.%s 2 0\n' $i $((i / 10)) $((i * i % 10))
    i=$((i + 1))
done >"$tmp/run.xyz"
head -n 238 "$tmp/run.xyz" >"$tmp/cut.xyz"

# share N CODE FOLDER ARGUMENTS...: runs N processes in a folder of their own.
share() {
    processes=$1
    wanted=$2
    folder=$tmp/$3
    shift 3
    rm -rf "$folder"
    mkdir "$folder"
    if [ "$processes" -eq 0 ]; then
        (cd "$folder" && exec "$program" "$@") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
    else
        (cd "$folder" && exec $mpi -n "$processes" "$program" "$@") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
    fi
    got=$?
    [ "$got" -eq "$wanted" ] || fail "exit code $got, not $wanted: $processes processes, $*: $(head -n 5 "$tmp/stderr")"
}
no_parts() {
    [ -z "$(find "$tmp" -name '*.part*')" ] || fail "left behind: $(find "$tmp" -name '*.part*')"
}

# ---- The same bytes
# ---------------------------------------------------------------------------------------------------

# Automatic camera and colours from a look at all frames, speeds from the frame before; then without a look, where
# nobody knows how many frames there are; a choice; a part; a file that is cut off; mirrors; trails, which reach back
# into frames of other processes, and a legend of all frames.
for look in "-k speed --orbit 90 --contact-sheet sheet.png ../run.xyz" "-c $camera -k type ../run.xyz" \
    "-k speed --first 3 --every 7 ../run.xyz" "--part 2/3 -k speed ../run.xyz" "-c $camera -k speed --range 0,1 ../cut.xyz" \
    "-c $camera --bounces 3 --material all=mirror ../run.xyz" "-k type --legend --trails 9 --every 2 ../run.xyz"; do
    code=0
    case $look in *cut.xyz) code=1 ;; esac
    share 0 $code one -q -s 64x36 -t 1 -o f_%03d.png $movie $look
    counts="1 2 5"
    case $look in *first*|*part*|*bounces*|*trails*) counts=3 ;; esac
    for n in $counts; do
        share $n $code many -q -s 64x36 -t 1 -o f_%03d.png $movie $look
        diff -r "$tmp/one" "$tmp/many" >"$tmp/difference" || fail "$n processes, $look: $(head -n 3 "$tmp/difference")"
        [ $code -eq 0 ] && says out '^frames  *[1-9]'
        [ "$(grep -c '^frames  ' "$tmp/stdout")" -le 1 ] || fail "$n processes: more than one summary"
        [ $code -eq 0 ] || [ "$(grep -c 'cut.xyz:238' "$tmp/stderr")" -eq 1 ] ||
            fail "$n processes: the error was told $(grep -c 'cut.xyz:238' "$tmp/stderr") times"
    done
done
share 0 0 one -q -s 64x36 -t 1 -c $camera -k type -o - ../run.xyz
cp "$tmp/stdout" "$tmp/raw"
share 3 0 many -q -s 64x36 -t 1 -c $camera -k type -o - ../run.xyz
cmp -s "$tmp/raw" "$tmp/stdout" || fail "raw frames of three processes are others"
no_parts

# ---- What goes wrong
# --------------------------------------------------------------------------------------------------

share 3 1 many -q -s 64x36 -o f_%03d.png ../missing.xyz
[ "$(grep -c '^cgt-render: ' "$tmp/stderr")" -eq 1 ] || fail "a missing file was told more than once: $(cat "$tmp/stderr")"
share 2 1 many -q -s 64x36 -c $camera --format xyz -o f_%03d.png -
says err 'several processes cannot read from one pipe'
mkdir -p "$tmp/full"
: >"$tmp/file"
share 2 1 many -q -s 64x36 -c $camera -k type -o ../file/f_%03d.png ../run.xyz
says err 'is not a folder'
(cd "$tmp/full" && mkdir -p f_007.png && exec $mpi -n 3 "$program" -q -s 64x36 -t 1 -c $camera -k type -o f_%03d.png $movie ../run.xyz) \
    >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
got=$?
[ $got -eq 1 ] || fail "exit code $got, not 1, where a picture cannot be written"
says err 'f_007.png: cannot write: not a regular file'
[ ! -e "$tmp/full/run.mp4" ] || fail "a movie without one of its frames"
no_parts

# A process dies: rank 0 tells which frames are missing, and nothing half-written stays. Each rank's errors go to a file
# of its own: mpirun, which ends the job meanwhile, does not always pass on what comes last.
i=0
while [ $i -lt 4000 ]; do
    printf '2\n\nC 0 0 0\nO 1 2 0\n'
    i=$((i + 1))
done >"$tmp/long.xyz"
for victim in 1 0; do
    rm -rf "$tmp/dying"
    mkdir "$tmp/dying"
    (cd "$tmp/dying" && exec $mpi -n 3 sh -c 'echo $$ >pid.$OMPI_COMM_WORLD_RANK; exec "$@" 2>said.$OMPI_COMM_WORLD_RANK' sh "$program" -q -s 1280x720 -a 4 -t 1 --style plain \
        -c $camera -k type -o f_%04d.png ../long.xyz) >"$tmp/stdout" 2>"$tmp/stderr" </dev/null &
    running=$!
    while [ ! -f "$tmp/dying/f_0012.png" ] && kill -0 $running 2>/dev/null; do
        sleep 0.1
    done
    kill -KILL "$(cat "$tmp/dying/pid.$victim")"
    wait $running && fail "no error where rank $victim died"
    if [ $victim -eq 1 ]; then
        cp "$tmp/dying/said.0" "$tmp/stderr"
        says err 'interrupted after [0-9]* frames'
        says err 'missing: rank 1 did not finish'
        says err 'on are missing: they were not begun'
        no_parts
    fi
    rm -f "$tmp"/dying/*.part*
done

[ $failures -eq 0 ] || exit 1
echo "all good"
