#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Movies and raw frames of cgt-render, taken apart frame by frame by ffmpeg; what goes wrong with them.
#   movie_cli.sh CGT_RENDER DATA_DIR [EMULATOR...]
. "$(dirname "$0")/../cli.sh"
camera=0,0,12,0,0,0,0,1,0,45
[ -z "$slow" ] && frames=40 || frames=8
i=0
while [ $i -lt $frames ]; do
    printf '2\nframe %s\nC 0 0 0\nO %s.%s 2 0\n' $i $((i / 10)) $((i % 10))
    i=$((i + 1))
done >"$tmp/run.xyz"

count() {
    [ "$(find "$tmp/$1" -type f 2>/dev/null | wc -l)" -eq "$2" ] || fail "$1 has $(ls "$tmp/$1"), not $2 files"
}
no_parts() {
    [ -z "$(find "$tmp" -name '*.part*')" ] || fail "left behind: $(find "$tmp" -name '*.part*')"
}
bytes() { wc -c <"$1" | tr -d ' '; }

# ---- Raw frames are the pictures
# --------------------------------------------------------------------------------------

run 0 -s 64x36 -c $camera -k type -o - -o png/%03d.png run.xyz
cp "$tmp/stdout" "$tmp/raw"
[ "$(bytes "$tmp/raw")" -eq $((64 * 36 * 3 * frames)) ] || fail "raw frames have $(bytes "$tmp/raw") bytes"
count png $frames
says err '^raw frames  *-$' # the summary, which has no place on standard output
says err '^pictures '

# A reader that goes away, a disk that is full: sentences.
(cd "$tmp" && exec $emulator "$program" -q -s 640x360 -c $camera -k type -o - run.xyz 2>broken) </dev/null | head -c 1 >/dev/null
grep -q 'standard output: Broken pipe' "$tmp/broken" || fail "a broken pipe: $(head -n 3 "$tmp/broken")"
if [ -c /dev/full ]; then
    (cd "$tmp" && exec $emulator "$program" -q -s 64x36 -c $camera -k type -o - run.xyz) >/dev/full 2>"$tmp/stderr" </dev/null
    got=$?
    [ $got -eq 1 ] || fail "exit code $got, not 1, where raw frames cannot be written"
    says err 'standard output: No space left on device'
fi

# ---- Without ffmpeg
# ---------------------------------------------------------------------------------------------------

mkdir "$tmp/nowhere"
path=$PATH
PATH=$tmp/nowhere
run 1 -s 64x36 -c $camera -k type -o absent.mp4 run.xyz
PATH=$path
says err 'absent.mp4: movies need the program ffmpeg, and it cannot be started: it is not installed, or not in PATH'
[ ! -e "$tmp/absent.mp4" ] || fail "a movie without ffmpeg"
no_parts

# One that fails, at once and after some frames; with its own words.
printf '#!/bin/sh\necho "no such codec today" >&2\nexit 3\n' >"$tmp/nowhere/ffmpeg"
chmod +x "$tmp/nowhere/ffmpeg"
PATH=$tmp/nowhere:$path
run 1 -s 640x360 -c $camera -k type -o broken.mp4 run.xyz
says err 'broken.mp4: cannot write: ffmpeg: no such codec today'
printf '#!/bin/sh\nhead -c 3000000 >/dev/null\nkill -9 $$\n' >"$tmp/nowhere/ffmpeg"
run 1 -s 640x360 -c $camera -k type -o broken.mp4 run.xyz
says err 'broken.mp4: cannot write: ffmpeg: '
[ ! -e "$tmp/broken.mp4" ] || fail "a movie of an ffmpeg that failed"
grep -q '^movie ' "$tmp/stdout" && fail "the summary names a movie that is not there"

# One that is content: what it wrote is kept, with its words; having written nothing is no movie.
printf '#!/bin/sh\ncat >/dev/null\n' >"$tmp/nowhere/ffmpeg"
run 1 -s 64x36 -c $camera -k type -o empty.mp4 run.xyz
says err 'empty.mp4: cannot write: ffmpeg: it wrote nothing'
[ ! -e "$tmp/empty.mp4" ] || fail "a movie of an ffmpeg that wrote nothing"
grep -q '^movie ' "$tmp/stdout" && fail "the summary names a movie that is not there"
cat >"$tmp/nowhere/ffmpeg" <<'END'
#!/bin/sh
cat >/dev/null
for last; do :; done
echo frames >"${last#file:}"
echo 'deprecated, but fine' >&2
END
run 0 -s 64x36 -c $camera -k type -o told.mp4 run.xyz
says err 'told.mp4: ffmpeg: deprecated, but fine'
says out '^movie  *told.mp4$'
[ "$(cat "$tmp/told.mp4")" = frames ] || fail "told.mp4 is not what ffmpeg wrote"

# childless CODE MOVIE: a run by a program that ignores SIGCHLD, as dash cannot.
childless() {
    env --ignore-signal=CHLD true 2>/dev/null || return 0
    (cd "$tmp" && exec env --ignore-signal=CHLD $emulator "$program" -q -s 64x36 -c $camera -k type -o "$2" run.xyz) \
        >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
    got=$?
    [ $got -eq "$1" ] || fail "$2: exit code $got, not $1, where SIGCHLD is ignored: $(head -n 3 "$tmp/stderr")"
}
childless 0 told.mp4
echo 'exit 3' >>"$tmp/nowhere/ffmpeg"
childless 1 late.mp4

# stand_in READING THEN: an ffmpeg that reads, writes its number to $tmp/pid, and goes on. start: a run with it.
stand_in() {
    rm -f "$tmp/pid"
    printf '#!/bin/sh\nfor last; do :; done\n%s\necho $$ >"%s/new"\nmv "%s/new" "%s/pid"\n%s\n' "$1" "$tmp" "$tmp" "$tmp" "$2" \
        >"$tmp/nowhere/ffmpeg"
}
start() {
    (cd "$tmp" && exec $emulator "$program" -q -s 640x360 -c $camera -k type -o stuck.mp4 run.xyz) >"$tmp/stdout" 2>"$tmp/stderr" \
        </dev/null &
    running=$!
    while [ ! -f "$tmp/pid" ] && kill -0 $running 2>/dev/null; do
        sleep 0.1
    done
}

# One that does not end, having read all frames, some, or none; and one that is stopped: the first signal ends both.
for reading in 'cat >/dev/null' 'head -c 400000 >/dev/null' :; do
    for going_on in 'exec sleep 600' 'kill -STOP $$'; do
        [ "$going_on" = 'kill -STOP $$' ] && signal=HUP || signal=TERM
        stand_in "$reading" "$going_on"
        start
        kill -$signal $running
        wait $running
        got=$?
        [ $got -eq 1 ] || fail "exit code $got, not 1, after SIG$signal with an ffmpeg: $reading, $going_on"
        says err 'interrupted'
        kill -0 "$(cat "$tmp/pid")" 2>/dev/null && fail "an ffmpeg is left: $reading, $going_on"
        [ ! -e "$tmp/stuck.mp4" ] || fail "a movie of an ffmpeg that did not end"
    done
done

# One that is stopped for a while, and one that is slow: all is well in the end.
stand_in 'head -c 400000 >/dev/null' 'kill -STOP $$; cat >/dev/null; echo frames >"${last#file:}"'
start
while kill -0 $running 2>/dev/null; do
    kill -CONT "$(cat "$tmp/pid")" 2>/dev/null
    sleep 0.2
done
wait $running || fail "exit code $? with an ffmpeg that was stopped for a while: $(head -n 3 "$tmp/stderr")"
stand_in : 'while [ "$(head -c 300000 | wc -c)" -gt 0 ]; do sleep 0.01; done; echo frames >"${last#file:}"'
start
wait $running || fail "exit code $? with a slow ffmpeg: $(head -n 3 "$tmp/stderr")"
[ "$(cat "$tmp/stuck.mp4")" = frames ] || fail "stuck.mp4 is not what ffmpeg wrote"
PATH=$path
no_parts

if ! command -v ffmpeg >/dev/null 2>&1 || ! command -v ffprobe >/dev/null 2>&1; then
    [ $failures -eq 0 ] || exit 1
    echo "no ffmpeg: the rest is not tested"
    exit 77
fi

# ---- PNG files hold the pixels
# ----------------------------------------------------------------------------------------

(cd "$tmp" && ffmpeg -v error -nostdin -i png/%03d.png -f rawvideo -pix_fmt rgb24 -y decoded) || fail "ffmpeg cannot read the PNGs"
cmp -s "$tmp/raw" "$tmp/decoded" || fail "the PNG files hold other pixels than the raw frames"

# ---- Movies
# -----------------------------------------------------------------------------------------------------------

# probe FILE CODEC WIDTHxHEIGHT RATE: what ffprobe counts by decoding.
probe() {
    found=$(ffprobe -v error -count_frames -select_streams v -of csv=p=0 \
        -show_entries stream=codec_name,width,height,r_frame_rate,nb_read_frames "$tmp/$1" | tr -d '\r')
    wanted="$2,${3%x*},${3#*x},$4,$frames"
    [ "$found" = "$wanted" ] || fail "$1 is $found, not $wanted"
}

# close_to FILE LEAST: each frame of the movie is the raw one, up to what the encoder loses: least PSNR in dB.
close_to() {
    ffmpeg -v error -nostdin -f rawvideo -pix_fmt rgb24 -s 64x36 -r 30 -i "$tmp/raw" -r 30 -i "$tmp/$1" -filter_complex \
        "[0:v]format=gbrp[a];[1:v]crop=64:36:0:0,setpts=N/30/TB,scale=in_color_matrix=bt709,format=gbrp[b];[a][b]psnr=stats_file=$tmp/psnr" \
        -f null - 2>"$tmp/stderr" || fail "$1 cannot be compared: $(head -n 2 "$tmp/stderr")"
    [ "$(wc -l <"$tmp/psnr")" -eq $frames ] || fail "$1: $(wc -l <"$tmp/psnr") frames were compared"
    tr ' ' '\n' <"$tmp/psnr" | awk -F: -v least="$2" '$1 == "psnr_avg" && $2 != "inf" && $2 < least { bad++ } END { exit bad > 0 }' ||
        fail "$1: a frame is another one: $(sort -t: -k6 "$tmp/psnr" | head -n 1)"
}

run 0 -s 64x36 -c $camera -k type -o new/run.mp4 -o new/run.mkv -o new/run.webm -o new/run.gif --quality 95 run.xyz
says out '^movie  *new/run.mp4$'
count new 4
probe new/run.mp4 h264 64x36 30/1
probe new/run.mkv h264 64x36 30/1
probe new/run.webm vp9 64x36 30/1
close_to new/run.mp4 30
close_to new/run.mkv 30
close_to new/run.webm 28
close_to new/run.gif 25
run 0 -s 64x36 -c $camera -k type -o again.mp4 --quality 95 run.xyz
cmp -s "$tmp/again.mp4" "$tmp/new/run.mp4" || fail "the same run makes another movie"
run 0 -s 64x36 -c $camera -k type -o worse.mp4 --quality 20 --rate 12.5 --preset ultrafast run.xyz
probe worse.mp4 h264 64x36 25/2
[ "$(bytes "$tmp/worse.mp4")" -lt "$(bytes "$tmp/again.mp4")" ] || fail "low quality makes a larger file"
run 0 -s 63x35 -c $camera -k type -o odd.mp4 run.xyz # a line is added each way
probe odd.mp4 h264 64x36 30/1
run 0 -s 64x36 -c $camera -k type -o './-dash:1.mov' run.xyz
probe ./-dash:1.mov h264 64x36 30/1
long=$(printf '%0251d' 0).mp4 # the longest name that file systems take
run 0 -s 64x36 -c $camera -k type -o "$long" run.xyz
probe "$long" h264 64x36 30/1

# GIFs beyond 50 frames a second leave frames out, and last as long: delays are hundredths, at least 2 of them.
for rate in 50 60 100 1000; do
    run 0 -s 64x36 -c $camera -k type --rate $rate -o fast.gif run.xyz
    [ $rate -eq 50 ] || says err 'fast.gif: players keep at most 50 frames a second'
    ffprobe -v error -of csv=p=0 -show_entries packet=duration_time "$tmp/fast.gif" | tr -d ',\r' |
        awk -v wanted="$(awk "BEGIN { print $frames / $rate }")" '$1 < 0.0199 { bad++ } { sum += $1 }
            END { exit bad > 0 || sum > wanted + 0.04 || sum < wanted - 0.04 }' || fail "a GIF at a rate of $rate"
done
no_parts

# Whole frames before a cut come out, and the exit code tells.
head -n $((4 * (frames - 1) + 3)) "$tmp/run.xyz" >"$tmp/cut.xyz"
run 1 -s 64x36 -c $camera -k type -o cut.mp4 cut.xyz
frames=$((frames - 1))
probe cut.mp4 h264 64x36 30/1

# ---- What goes wrong
# --------------------------------------------------------------------------------------------------

: >"$tmp/file"
run 1 -s 64x36 -c $camera -k type -o file/run.mp4 run.xyz
says err 'is not a folder'
mkdir "$tmp/taken.mp4"
run 1 -s 64x36 -c $camera -k type -o taken.mp4 run.xyz
says err 'taken.mp4: cannot write: not a regular file'
if (trap '' XFSZ && ulimit -f 2) 2>/dev/null; then
    (cd "$tmp" && trap '' XFSZ && ulimit -f 2 && exec $emulator "$program" -q -s 640x360 -c $camera -k type -o full.mp4 --quality 100 \
        run.xyz) >/dev/null 2>"$tmp/stderr" </dev/null
    got=$?
    [ $got -eq 1 ] || fail "exit code $got, not 1, with a file size limit: $(head -n 3 "$tmp/stderr")"
    says err 'full.mp4: cannot write: ffmpeg: '
    [ ! -e "$tmp/full.mp4" ] || fail "a movie beyond the limit of its size"
fi

# An interrupt: no movie, no temporary file, no ffmpeg left.
i=0
while [ $i -lt 3000 ]; do
    printf '2\n\nC 0 0 0\nO 1 2 0\n'
    i=$((i + 1))
done >"$tmp/long.xyz"
(cd "$tmp" && exec $emulator "$program" -q -s 640x360 -c $camera -k type -o long.mp4 -o long/%d.png long.xyz) >"$tmp/stdout" 2>"$tmp/stderr" \
    </dev/null &
running=$!
while [ ! -f "$tmp/long/3.png" ] && kill -0 $running 2>/dev/null; do
    sleep 0.1
done
kill -TERM $running
wait $running
got=$?
[ $got -eq 1 ] || fail "exit code $got, not 1, after SIGTERM"
says err 'interrupted after [0-9]* frames'
[ ! -e "$tmp/long.mp4" ] || fail "a movie of a run that was interrupted"
no_parts

[ $failures -eq 0 ] || exit 1
echo "all good"
