#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cgt-view in a window of an X server, by xdotool's pointer and keys.
#   view_window.sh CGT_VIEW DATA_DIR
# Without Xvfb or xdotool: exit code 77.
command -v Xvfb >/dev/null && command -v xdotool >/dev/null || { echo "no Xvfb or no xdotool"; exit 77; }
. "$(dirname "$0")/../programs/cli.sh"
server= viewer=
trap '[ -z "$viewer$server" ] || kill $viewer $server 2>/dev/null; rm -rf "$tmp"' EXIT

Xvfb -displayfd 3 -screen 0 800x600x24 -nolisten tcp -noreset 3>"$tmp/display" >/dev/null 2>&1 &
server=$!
for i in 1 2 3 4 5 6 7 8 9 10; do
    [ -s "$tmp/display" ] && break
    sleep 1
done
[ -s "$tmp/display" ] || { echo "Xvfb does not start"; exit 77; }
DISPLAY=:$(head -n 1 "$tmp/display")
SDL_VIDEODRIVER=x11
ASAN_OPTIONS=${ASAN_OPTIONS:-}:detect_leaks=0 # D-Bus, which SDL loads beside X, keeps some memory
export DISPLAY SDL_VIDEODRIVER ASAN_OPTIONS

# waits FOR SECONDS: until the command is true
waits() {
    seconds=$1
    shift
    for i in $(seq $((seconds * 5))); do
        "$@" && return 0
        sleep 0.2
    done
    return 1
}

(cd "$tmp" && exec "$program" -s 320x180 -a 1 "$data/pour2k.lammpstrj") >"$tmp/stdout" 2>"$tmp/stderr" &
viewer=$!
opened() { window=$(xdotool search --name pour2k 2>/dev/null | head -n 1) && [ -n "$window" ]; }
waits 30 opened || { fail "no window: $(cat "$tmp/stderr")"; exit 1; }
# the first frame that has something
titled() { xdotool getwindowname "$window" | grep -q "frame $1\$"; }
waits 30 titled 3 || fail "the title is $(xdotool getwindowname "$window")"
xdotool windowfocus "$window"
# the last frame by a key, one back by another, then a drag, the wheel, a picture, a copy of the camera, the end
xdotool key --window "$window" End
waits 30 titled 75 || fail "End: the title is $(xdotool getwindowname "$window")"
xdotool key --window "$window" Left
waits 30 titled 74 || fail "Left: the title is $(xdotool getwindowname "$window")"
xdotool key --window "$window" c
xdotool mousemove --window "$window" 160 90 mousedown 1 mousemove_relative 20 5 mousemove_relative 20 5 mouseup 1
xdotool mousemove --window "$window" 160 100 click 4 click 4
xdotool key --window "$window" c
cameras() { [ "$(grep -c '^-c ' "$tmp/stdout")" -eq "$1" ]; }
waits 30 cameras 2 || fail "c printed $(cat "$tmp/stdout")"
[ "$(sort -u "$tmp/stdout" | wc -l)" -eq 2 ] || fail "the pointer does not move the camera"
# the panel, where there is one, by its button, with an option by its name
if "$program" --help | grep -q 'o opens a panel'; then
    xdotool mousemove --window "$window" 290 20 click 1
    sleep 0.5
    xdotool type --window "$window" --delay 30 radius-scale
    xdotool key --window "$window" Return
    xdotool type --window "$window" --delay 30 0.5
    xdotool key --window "$window" Return Escape
    sleep 0.5
fi
xdotool key --window "$window" s
written() { [ -s "$tmp/view_0074.png" ]; }
waits 60 written || fail "s wrote nothing"
"$program" --help | grep -q 'o opens a panel' && ! grep -q -e '--radius-scale=0.5' "$tmp/stdout" &&
    fail "the panel sets nothing: $(cat "$tmp/stdout")"
xdotool key --window "$window" q 2>/dev/null # its end may come before the key is up
gone() { ! kill -0 $viewer 2>/dev/null; }
waits 30 gone || fail "q does not end it"
wait $viewer || fail "it ended with $?: $(cat "$tmp/stderr")"
viewer=
[ $failures -eq 0 ] || exit 1
echo "cgt-view in a window"
