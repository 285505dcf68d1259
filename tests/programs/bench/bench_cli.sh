#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of cgt-bench: tables, counts that can be worked out by hand, hits files, errors and exit codes.
#   bench_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/../cli.sh"

# refuses CODE PATTERN ARGUMENTS...: an error with a text, and nothing on standard output but a table's head.
refuses() {
    refused_code=$1
    refused_text=$2
    shift 2
    run "$refused_code" "$@"
    says err "$refused_text"
    says err '^cgt-bench'
    [ "$(grep -c -v '^config' "$tmp/stdout")" -eq 0 ] || fail "output in addition to an error: cgt-bench $*"
}

# cell COLUMN [ROW]: a cell of the table in $tmp/stdout; rows count from 1 below the head.
cell() {
    awk -F '\t' -v name="$1" -v row="${2:-1}" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) column = i }
        NR == row + 1 { print $column }' "$tmp/stdout"
}

is() {
    [ "$2" = "$3" ] || fail "$1 is \"$2\", not \"$3\""
}

# ---- Scenes ---------------------------------------------------------------------------------------------------------

one='\001\000\000\000'
two='\002\000\000\000'
zero='\000\000\000\000'
f1='\000\000\200\077'  # 1.0f
f2='\000\000\000\100'  # 2.0f
nan='\000\000\300\177'
unit_sphere="$one$zero$zero$zero$f1"
three='\003\000\000\000'
four='\004\000\000\000'
m1='\000\000\200\277'  # -1.0f

# Two frames of a unit sphere at the origin; the same with a sphere that is not a number; an empty frame, then a sphere.
printf "CGTFRAM1$one$two$zero$zero$unit_sphere$unit_sphere" >"$tmp/unit.frames"
printf "CGTFRAM1$one$one$zero$zero$unit_sphere" >"$tmp/single.frames"
printf "CGTFRAM1$one$one$zero$zero$two$nan$zero$zero$f2$zero$zero$zero$f1" >"$tmp/nan.frames"
printf "CGTFRAM1$one$two$zero$zero$zero$unit_sphere" >"$tmp/empty_first.frames"
printf "CGTFRAM1$one$zero$zero$zero" >"$tmp/no_frame.frames"
printf "CGTFRAM1$one$two$zero$zero$unit_sphere$one$zero" >"$tmp/short.frames"
printf '2\ncomment\nC 0 0 0\nC 1 here 0\n' >"$tmp/bad.xyz"
# A square from -1 to 1 in the plane z = 0, as two triangles; the same with a vertex that is not a number.
square="$zero$one$two$zero$two$three"
corners="$m1$m1$zero$f1$m1$zero$f1$f1$zero"
printf "CGTFRAM1$two$two$two$zero$square$four$corners$m1$f1$zero$four$corners$m1$f1$zero" >"$tmp/square.frames"
printf "CGTFRAM1$two$one$two$zero$square$four$corners$nan$f1$zero" >"$tmp/square_nan.frames"
printf "CGTFRAM1$two$one$two$zero$zero$one$two$zero$two$four$four$corners$m1$f1$zero" >"$tmp/square_index.frames"
printf 'XYZ' >"$tmp/what.unknown"

head='config	threads	build_ms	primary_ms	shadow_ms	ao_ms	frame_ms	hit_pixels	ao_open'
front='-c 0,0,-5,0,0,0,0,1,0,45 -s 63x47'

# ---- Help and version -----------------------------------------------------------------------------------------------

run 0 --version
says out '^cgt-bench (libcgt [0-9]*\.[0-9]*\.[0-9]*)$'
run 0 --help
says out 'frame'
says out 'rays'
run 0 frame --help
says out 'Usage: cgt-bench frame'
for option in --camera --size --threads --frames --repeat --packet --grid --variant; do says out "$option"; done
refuses 2 'a subject is missing'
refuses 2 'no subject dance' dance
refuses 2 'FILE' frame

# ---- frame ----------------------------------------------------------------------------------------------------------

# A unit sphere from five units away: a pixel hits where its ray passes the centre within one unit.
expected=$(awk 'BEGIN {
    width = 63; height = 47; slope = sin(atan2(0, -1) / 8) / cos(atan2(0, -1) / 8)
    for (y = 0; y < height; y++) for (x = 0; x < width; x++) {
        u = (2 * (x + 0.5) / width - 1) * slope * width / height; v = (1 - 2 * (y + 0.5) / height) * slope
        if (25 * (u * u + v * v) <= 1 + u * u + v * v) hits++
    }
    print hits }')
run 0 frame "$tmp/unit.frames" $front
is 'the head of the table' "$(head -n 1 "$tmp/stdout")" "$head"
is 'the number of lines' "$(wc -l <"$tmp/stdout" | tr -d ' ')" 2
is config "$(cell config)" loose-grid
is threads "$(cell threads)" 1
is hit_pixels "$(cell hit_pixels)" "$expected"
is shadow_ms "$(cell shadow_ms)" 0
is ao_ms "$(cell ao_ms)" 0
is ao_open "$(cell ao_open)" 0

# From outside a lone sphere no ambient-occlusion ray meets anything; with one frame the columns add up.
run 0 frame "$tmp/single.frames" $front -l 3,4,-5 -a 16 -t 2 -o "$tmp/hits.bin"
is threads "$(cell threads)" 2
is ao_open "$(cell ao_open)" $((16 * expected))
awk -F '\t' 'NR == 2 { sum = $3 + $4 + $5 + $6; exit !($3 >= 0 && $4 > 0 && $5 > 0 && $6 > 0 &&
    sum - $7 < 0.003 && $7 - sum < 0.003) }' "$tmp/stdout" || fail "times do not add up: $(tail -n 1 "$tmp/stdout")"

# The hits file: eight bytes a pixel; t within the sphere, primitive 0, or infinity and all ones.
is 'the size of the hits file' "$(wc -c <"$tmp/hits.bin" | tr -d ' ')" $((63 * 47 * 8))
counted=$(od -An -v -tu1 "$tmp/hits.bin" | awk '
    { for (i = 1; i <= NF; i++) { b[n++] = $i; if (n == 8) { n = 0; pixel() } } }
    function pixel(  t) {
        if (b[4] + b[5] + b[6] + b[7] == 4 * 255) { if (b[3] != 127 || b[2] != 128 || b[1] || b[0]) bad++; return }
        if (b[4] || b[5] || b[6] || b[7]) bad++
        t = (b[2] % 128 + 128 + b[1] / 256 + b[0] / 65536) / 128 * 2 ^ (b[3] * 2 + int(b[2] / 128) - 127)
        if (t < 3.99 || t > 5) bad++
        hits++
    }
    END { print hits + 0, bad + 0 }')
is 'hits and bad pixels of the hits file' "$counted" "$expected 0"

# From inside the sphere every pixel hits it, and no ray gets out.
run 0 frame "$tmp/unit.frames" -c 0,0,-0.5,0,0,0,0,1,0,90 -s 32x24 -a 4 -l 0,0,0
is hit_pixels "$(cell hit_pixels)" $((32 * 24))
is ao_open "$(cell ao_open)" 0

# Threads, packets, tiles and loops change no bit of the hits.
run 0 frame "$tmp/unit.frames" $front -o "$tmp/reference.bin"
for options in '-t 2' '-k 4' '-k 8' '-k 16' '--tile strip' '--loop nested' '--loop flattened' '--cull off' '--cull frustum' \
    '--no-mailbox' '-g 3,4,5' '-r 2'; do
    run 0 frame "$tmp/unit.frames" $front $options -o "$tmp/hits.bin"
    cmp -s "$tmp/reference.bin" "$tmp/hits.bin" || fail "different hits with $options"
done
is config "$(cell config)" loose-grid
run 0 frame "$tmp/unit.frames" $front -k 8 -g 3,4,5 --loop nested --cull off --no-mailbox
is config "$(cell config)" 'queue-grid,packet=8,loop=nested,cull=off,mailbox=off,grid=3x4x5'

# --all: the library's choice, then packets and tiles; the same pixels hit in every row.
run 0 frame "$tmp/unit.frames" $front -a 2 --all
is 'the number of rows' "$(grep -c '^loose-grid' "$tmp/stdout")" 5
agree=$(awk -F '\t' -v e="$expected" 'NR > 1 && $8 == e && $9 == 2 * e { n++ } END { print n + 0 }' "$tmp/stdout")
is 'rows that agree' "$agree" 5

# Odd scenes: a sphere that is not a number is skipped; an empty frame is a frame.
run 0 frame "$tmp/nan.frames" $front -v
is hit_pixels "$(cell hit_pixels)" "$expected"
says err '2 primitives, 1 skipped'
run 0 frame "$tmp/empty_first.frames" $front -a 1 -l 0,9,0
is hit_pixels "$(cell hit_pixels)" "$expected"
run 0 frame "$tmp/empty_first.frames" $front -n 1 -a 1 -l 0,9,0
is hit_pixels "$(cell hit_pixels)" 0

# Triangles: the square hides the pixels whose rays pass the plane within it, edges and the diagonal included; from one
# side as from the other. Nothing is next to it: no ambient-occlusion ray hits anything.
in_square=$(awk 'BEGIN {
    width = 63; height = 47; slope = sin(atan2(0, -1) / 8) / cos(atan2(0, -1) / 8)
    for (y = 0; y < height; y++) for (x = 0; x < width; x++) {
        u = (2 * (x + 0.5) / width - 1) * slope * width / height; v = (1 - 2 * (y + 0.5) / height) * slope
        if (5 * u <= 1 && 5 * u >= -1 && 5 * v <= 1 && 5 * v >= -1) hits++
    }
    print hits }')
for camera in 0,0,-5,0,0,0,0,1,0,45 0,0,5,0,0,0,0,1,0,45; do
    run 0 frame "$tmp/square.frames" -c $camera -s 63x47 -a 4 -l 0,0,-9 -o "$tmp/square.bin"
    is hit_pixels "$(cell hit_pixels)" "$in_square"
    is ao_open "$(cell ao_open)" $((4 * in_square))
done
# Parallel rays see as much of the target's plane, by tiles as by packets.
for options in '' '-k 8' '-S kd'; do
    run 0 frame "$tmp/square.frames" -O -c 0,0,-5,0,0,0,0,1,0,45 -s 63x47 $options
    is hit_pixels "$(cell hit_pixels)" "$in_square"
done
for options in '-t 2' '-k 4' '-k 16' '--tile strip' '--loop flattened' '--cull off' '--no-mailbox' '-g 3,4,5' '-p exact'; do
    run 0 frame "$tmp/square.frames" -c $camera -s 63x47 $options -o "$tmp/hits.bin"
    cmp -s "$tmp/square.bin" "$tmp/hits.bin" || fail "different hits of triangles with $options"
done
run 0 frame "$tmp/square.frames" $front -p exact
is config "$(cell config)" 'loose-grid,precision=exact'
for test in watertight moller-trumbore accelerated; do
    run 0 frame "$tmp/square.frames" $front -p fast --test $test
    [ "$(cell hit_pixels)" -gt $((in_square * 9 / 10)) ] || fail "only $(cell hit_pixels) hits with -p fast --test $test"
done
is config "$(cell config)" 'loose-grid,precision=fast,test=accelerated'
run 0 frame "$tmp/square_nan.frames" $front -v
says err '2 primitives, 1 skipped'
[ "$(cell hit_pixels)" -gt $((in_square * 4 / 10)) ] || fail "half a square has $(cell hit_pixels) pixels"
refuses 1 'square_index\.frames' frame "$tmp/square_index.frames"

# ---- make -----------------------------------------------------------------------------------------------------------

run 0 make cloud2k "$tmp/cloud.frames" -n 2
is 'the size of a cloud' "$(wc -c <"$tmp/cloud.frames" | tr -d ' ')" $((24 + 2 * (4 + 2000 * 16)))
run 0 frame "$tmp/cloud.frames" -c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46 -s 64x36
[ "$(cell hit_pixels)" -gt 1800 ] || fail "a cloud that hides only $(cell hit_pixels) of 2304 pixels"
run 0 make blobs2k "$tmp/blobs.frames" -n 2
is 'the size of blobs' "$(wc -c <"$tmp/blobs.frames" | tr -d ' ')" $((24 + 2000 * 12 + 2 * (4 + 20 * 10 * 6 * 12)))
run 0 frame "$tmp/blobs.frames" -c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46 -s 64x36
[ "$(cell hit_pixels)" -gt 800 ] || fail "blobs that hide only $(cell hit_pixels) of 2304 pixels"

refuses 2 'no scene nowhere' make nowhere "$tmp/nowhere.frames"
refuses 2 'SCENE and FILE' make cloud2k
refuses 1 'no/folder' make cloud2k "$tmp/no/folder/cloud.frames"
refuses 2 'must end in .frames' make cloud2k "$tmp/cloud.bin"
mkdir "$tmp/device.frames" # what is no file is neither written nor removed
refuses 1 'not a regular file' make cloud2k "$tmp/device.frames" -n 1
[ -d "$tmp/device.frames" ] || fail 'make removed what it could not write'

# ---- output files ---------------------------------------------------------------------------------------------------

# A run that fails leaves the files of the one before alone, and no part of its own.
echo before >"$tmp/rows.json"
echo before >"$tmp/hits.bin"
head -c 100 "$tmp/cloud.frames" >"$tmp/cut.frames"
run 1 frame "$tmp/cut.frames" -s 8x8 -j "$tmp/rows.json" -o "$tmp/hits.bin"
for file in rows.json hits.bin; do is "$file after a failure" "$(cat "$tmp/$file")" before; done
run 0 frame "$tmp/cloud.frames" -s 8x8 -j "$tmp/rows.json" -o "$tmp/hits.bin"
is 'the size of the hits' "$(wc -c <"$tmp/hits.bin" | tr -d ' ')" $((8 * 8 * 8))
grep -q '"frame"' "$tmp/rows.json" || fail 'no rows as JSON'
is 'files left behind' "$(find "$tmp" -name '*.part.*')" ''

# Why a context is refused, and names that there are, are told; a file that is not there, before anything is measured.
CGT_DISABLE_CPU=nonsense run 1 frame "$tmp/cloud.frames" -s 8x8
says err 'CGT_DISABLE_CPU.*nonsense'
refuses 2 '-K: "sun" is not outside, near' light "$tmp/cloud.frames" --light sun
refuses 2 '-w frames: FILE is missing' accuracy -w frames
refuses 1 'nowhere.frames: No such file' rays "$tmp/nowhere.frames"
refuses 1 'nowhere.frames: No such file' accuracy "$tmp/nowhere.frames"
printf 'A\033[2J\n' >"$tmp/steered.xyz"
run 1 frame "$tmp/steered.xyz"
says err "'A?\[2J'"

# ---- accuracy -------------------------------------------------------------------------------------------------------

run 0 accuracy --help
says out 'Usage: cgt-bench accuracy'
for option in --part --rays --case --seed --camera --frames --repeat --variant --json; do says out "$option"; done

# Hard cases: EXACT is right about every ray, and the same rows go to JSON.
run 0 accuracy -w cases --rays 200 -r 1 --variant portable --case slab -j "$tmp/accuracy.json"
says out 'precision=exact'
awk -F'\t' '/^#/ { exit } $2 ~ /precision=exact/ { rows++; wrong += $6 + $7 + $8 }
    END { exit !(rows > 0 && wrong == 0) }' "$tmp/stdout"
is 'decisions of EXACT' $? 0
for text in '"cpu": "' '"cases": \[' '"missed"'; do grep -q "$text" "$tmp/accuracy.json" || fail "no $text in JSON"; done

# A file: rays of its first frame, judged by exact arithmetic.
run 0 accuracy -w cases --case square --rays 100 -r 1 --variant portable $front "$tmp/square.frames" "$tmp/unit.frames"
is 'rows of a file' "$(sed 1d "$tmp/stdout" | cut -f 1 | sort | uniq -c | tr -s ' ')" " 5 $tmp/square.frames"

# Whole frames: every variant, precision and test, relative to EXACT.
size=64x36 pixels=2304
[ -z "$slow" ] || size=32x18 pixels=576
run 0 accuracy -w frames "$tmp/cloud.frames" "$tmp/blobs.frames" -s $size -r 1 -n 1 \
    -c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46
grep -v '^#' "$tmp/stdout" >"$tmp/frames.tsv"
is 'the head of the table' "$(head -n 1 "$tmp/frames.tsv")" "scene	config	variant	precision	test	threads	build_ms	trace_ms	ms	\
rays	hits	missed	invented	wrong	wrong_share	t_ulp_median	t_ulp_p99	t_ulp_worst	cost_percent	trace_cost_percent"
variants=$(cut -f 3 "$tmp/frames.tsv" | sed 1d | sort -u | wc -l)
is 'rows of spheres' "$(grep -c '^cloud	' "$tmp/frames.tsv")" $((2 * variants))
is 'rows of triangles' "$(grep -c '^blobs	' "$tmp/frames.tsv")" $((5 * variants))
awk -F '\t' -v pixels=$pixels '
    NR > 1 { if (NF != 20 || $10 != pixels || !($8 > 0) || !($9 > 0)) bad++ }
    $4 == "exact" { if ($12 + $13 + $14 + $15 || $18 > 1) bad++ }
    $4 == "fast" && ($5 == "-" || $5 == "auto") { if ($12 + $13 + $14 + $15) bad++ }
    $4 == "exact" { if ($18 != 0) bad++ }
    $4 == "fast" && ($5 == "-" || $5 == "auto") { if ($19 != 0 || $20 != 0) bad++ }
    $4 == "fast" { if ($12 + $13 + $14 > pixels / 10) bad++ }
    END { exit bad }' "$tmp/frames.tsv" || fail "frames of cgt-bench accuracy: $(cat "$tmp/frames.tsv")"
run 0 accuracy -w frames "$tmp/blobs.frames" -S loose-grid -s 32x18 -r 1 -n 1 --variant portable
says out '	loose-grid,variant=portable,precision=fast,test=watertight	'
refuses 2 'one structure of the library' accuracy "$tmp/blobs.frames" -S kd,bvh
refuses 2 '"speed" is not cases, frames or paths' accuracy -w speed
refuses 2 '--rays' accuracy --rays 0
refuses 2 '--seed' accuracy --seed x
refuses 1 'no/folder' accuracy -w frames "$tmp/unit.frames" -j no/folder/x
refuses 1 'missing\.frames' accuracy -w frames "$tmp/missing.frames" $front

# ---- Errors ---------------------------------------------------------------------------------------------------------

unit=$tmp/unit.frames
refuses 1 'missing\.frames' frame "$tmp/missing.frames"
refuses 1 'no_frame\.frames' frame "$tmp/no_frame.frames"
refuses 1 'short\.frames' frame "$tmp/short.frames"
refuses 1 'bad\.xyz:4' frame "$tmp/bad.xyz"
refuses 1 'what\.unknown' frame "$tmp/what.unknown"
refuses 2 '-s' frame "$unit" -s 0x0
refuses 2 '-s' frame "$unit" -s 64
refuses 2 '-s' frame "$unit" -s 99999999999x99999999999
refuses 2 'pixels' frame "$unit" -s 65536x65536
refuses 2 '-c' frame "$unit" -c 0,0,0,0,0,0,0,1,0,45
refuses 2 '-c' frame "$unit" -c 0,0,5,0,0,0,0,0,1,45
refuses 2 '-c' frame "$unit" -c 0,0,5,0,0,0,0,1,0,180
refuses 2 '-c' frame "$unit" -c 0,0,5,0,0,0,0,1,0,0
refuses 2 '-k' frame "$unit" -k 5
refuses 2 '-g' frame "$unit" -g 4,4
refuses 2 '-g' frame "$unit" -g 4,4,4,4
refuses 2 '-g' frame "$unit" -g 0,4,4
refuses 1 '' frame "$unit" -g 1024,1024,1024
refuses 2 '-t' frame "$unit" -t 100000
refuses 2 '-n' frame "$unit" -n 0
refuses 2 '-r' frame "$unit" -r 0
refuses 2 'variant' frame "$unit" --variant abacus
refuses 2 'one FILE' frame "$unit" "$unit"
refuses 2 '' frame "$unit" --nonsense
refuses 2 '-a' frame "$unit" -a 1025
refuses 2 '-a' frame "$unit" -a -1
refuses 2 '-l' frame "$unit" -l 1,2
refuses 2 '--loop' frame "$unit" --loop round
refuses 2 'only primary rays' frame "$unit" -O -a 1
refuses 2 '--tile' frame "$unit" --tile round
refuses 2 '--all' frame "$unit" --all -k 4
refuses 2 '-p: "vague" is not exact or fast' frame "$unit" -p vague
refuses 2 '--test' frame "$unit" -p fast --test hasty
refuses 2 'only with -p fast' frame "$unit" --test accelerated
refuses 1 'no/such/folder' frame "$unit" -o "$tmp/no/such/folder/hits.bin"
if [ -c /dev/full ]; then
    run 1 frame "$unit" $front -o /dev/full
    says err '/dev/full'
    $emulator "$program" frame "$unit" $front >/dev/full 2>"$tmp/stderr"
    is 'exit code with a full disk' $? 1
fi

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cgt-bench: command line as described'
