#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command lines of cgt-bench scaling and floor: rows, columns, sums that can be recomputed, errors and exit
# codes.
#   performance_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

camera='-c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46'

# comments: the text after "# " in $tmp/stdout, as a table of its own
comments() {
    sed -n 's/^# //p' "$tmp/stdout" | awk -F '\t' 'NF > 1' >"$tmp/comments"
    mv "$tmp/comments" "$tmp/stdout"
}

# ---- Help -----------------------------------------------------------------------------------------------------------

run 0 scaling --help
says out 'Usage: cgt-bench scaling'
for option in --sweep --kind --primitives --pixels --most-threads --steps --at --precision --structure --json \
    --frames; do
    says out "$option"
done
run 0 floor --help
says out 'Usage: cgt-bench floor'
for option in --megabytes --spheres --triangles --precision --structure --json --repeat; do
    says out "$option"
done

# ---- scaling --------------------------------------------------------------------------------------------------------

sizes='--primitives 100,1000 --pixels 400,4000 --most-threads 2 --steps 1 --at 100 -s 32x18 -n 2'
run 0 scaling $sizes -S loose-grid -j "$tmp/rows.json"
cp "$tmp/stdout" "$tmp/whole"
grep -v '^#' "$tmp/whole" >"$tmp/stdout"
is sweeps "$(column sweep)" 'primitives pixels threads'
is kinds "$(column kind)" 'spheres triangles'
is configurations "$(column config)" loose-grid
is threads "$(column threads)" '1 2'
is rows "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" 12
holds 'times' 'c["bounds_ms"] >= 0 && c["build_ms"] > 0 && c["primary_ms"] > 0 && c["frame_ms"] > 0'
holds 'the shortest and the median' 'c["frame_min_ms"] <= c["frame_ms"] && c["build_min_ms"] <= c["build_ms"] &&
    c["primary_min_ms"] <= c["primary_ms"] && c["bounds_min_ms"] <= c["bounds_ms"]'
holds 'a frame is its parts' 'c["frame_min_ms"] + 0.001 >= c["primary_min_ms"]'
holds 'no allocation' 'c["allocations"] > 5 && c["steady_allocations"] == 0'
holds 'pixels' 'c["pixels"] == c["width"] * c["height"] && c["hit_pixels"] > 0 && c["hit_pixels"] <= c["pixels"] &&
    (c["sweep"] == "pixels" || c["pixels"] == 576)'
holds 'primitives' '(c["kind"] == "spheres" ? c["primitives"] == (c["sweep"] == "primitives" &&
    c["frame_exponent"] != "-" ? 1000 : 100) : c["primitives"] > 80 && c["primitives"] < 1200)'
holds 'memory' 'c["bytes"] >= c["structure_bytes"] && c["structure_bytes"] > 3.5 * c["primitives"]'
holds 'bytes of each' '(d = c["bytes_per_primitive"] * c["primitives"] / c["bytes"]) > 0.999 && d < 1.001 &&
    (d = c["structure_bytes_per_primitive"] * c["primitives"] / c["structure_bytes"]) > 0.999 && d < 1.001'
# an exponent is what the two rows' times say; the first row of a sweep has none
holds 'exponents' '(k = c["sweep"] c["kind"]) in size ?
    ((x = c[c["sweep"]]) > size[k]) &&
    (d = c["frame_exponent"] - log(c["frame_min_ms"] / ms[k]) / log(x / size[k])) < 0.01 && d > -0.01 :
    c["frame_exponent"] == "-" && (size[k] = c[c["sweep"]]) > 0 && (ms[k] = c["frame_min_ms"]) > 0'
cp "$tmp/whole" "$tmp/stdout"
comments
is 'exponents of sweeps' "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" 6
holds 'their ranges' 'c["to"] > c["from"] && c["frame"] != "-"'
is 'rows as JSON' "$(grep -c '"config"' "$tmp/rows.json")" 18

# Parts of it, another structure and precision.
run 0 scaling -w primitives -o triangles --primitives 50,50 -s 16x9 -n 1 -S kd -p exact -t 2
is 'one row' "$(grep -v '^#' "$tmp/stdout" | sed 1d | wc -l | tr -d ' ')" 1
is 'its name' "$(grep -v '^#' "$tmp/stdout" >"$tmp/table"; mv "$tmp/table" "$tmp/stdout"; column config)" \
    'kd,precision=exact'
holds 'threads' 'c["threads"] == 2 && c["sweep"] == "primitives" && c["kind"] == "triangles"'

# Steps between: a factor of ten in four, ends included.
run 0 scaling -w primitives -o spheres --primitives 10,100 --steps 4 -s 8x8 -n 1
grep -v '^#' "$tmp/stdout" >"$tmp/table"
mv "$tmp/table" "$tmp/stdout"
is 'sizes between' "$(column primitives)" '10 18 32 56 100'

# ---- floor ----------------------------------------------------------------------------------------------------------

run 0 make cloud2k "$tmp/cloud.frames" -n 2
run 0 floor "$tmp/cloud.frames" $camera -S loose-grid -s 48x27 -n 2 -r 2 --megabytes 1 -j "$tmp/rows.json"
is parts "$(column part)" 'memory empty tests limit fields'
is scenes "$(column scene)" '- spheres triangles cloud'
is units "$(column unit)" 'GB/s ms ns count ratio'
is threads "$(column threads)" 1
holds 'measured values' 'c["part"] == "tests" || c["value"] >= 0'
holds 'bandwidth and times' 'c["unit"] != "GB/s" && c["part"] != "fields" && c["part"] != "empty" || c["value"] > 0'
is 'fields' "$(awk -F '\t' '$2 == "empty" && $4 !~ /median/ { n++ } END { print n }' "$tmp/stdout")" 10
holds 'objects' 'c["item"] != "objects" || c["value"] == 2000'
holds 'what is seen' 'c["item"] != "objects seen" || c["value"] > 50 && c["value"] < 2000'
holds 'pixels' 'c["item"] != "pixels hit" || c["value"] > 500 && c["value"] <= 48 * 27'
# the limit is the sum of its terms, and the ratios are of it
holds 'sums' 'c["part"] != "limit" ? 1 : c["item"] ~ /^limit:/ ? (sum += c["value"]) >= 0 :
    c["item"] == "limit" ? (limit = c["value"]) > 0.999 * sum && limit < 1.001 * sum :
    c["item"] == "resolve" ? (resolve = c["value"]) >= 0 : c["item"] == "measured:frame" ? (frame = c["value"]) > 0 :
    c["item"] == "measured over limit" ? (d = c["value"] * limit / frame) > 0.999 && d < 1.001 :
    c["item"] == "measured over limit and resolve" ?
        (d = c["value"] * (limit + resolve) / frame) > 0.999 && d < 1.001 : 1'
is 'rows as JSON' "$(grep -c '"config"' "$tmp/rows.json")" "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')"

# Scenes made in memory, threads.
run 0 floor $camera -S queue-grid -s 32x18 -n 1 -r 1 --megabytes 1 --spheres 100 --triangles 100 -t 2
is 'scenes in memory' "$(awk -F '\t' '$2 == "limit" && !seen[$3]++ { printf "%s ", $3 }' "$tmp/stdout")" \
    'spheres triangles '
holds 'threads' 'c["part"] == "tests" ? c["threads"] == 1 : c["threads"] == 2'
run 0 floor -s 16x9 -n 1 -r 1 --megabytes 1 --spheres 0 --triangles 0
is 'the machine alone' "$(column part)" 'memory empty tests'

# ---- Errors ---------------------------------------------------------------------------------------------------------

refuses 2 'takes no FILE' scaling file.frames
refuses 2 'no hash' scaling -w hash
refuses 2 'no cubes' scaling -o cubes
refuses 2 'comma' scaling --primitives 100
refuses 2 'above the second' scaling --primitives 100,10
refuses 2 'primitives' scaling --primitives 0,10
refuses 2 'pixels' scaling --pixels 1,999999999999
refuses 2 'steps' scaling --steps 0
refuses 2 'most-threads' scaling --most-threads 5000
refuses 2 'too many frames' scaling -n 18446744073709551615
refuses 2 'not slow' scaling -p slow
refuses 2 'not octree' scaling -S octree
refuses 1 'no/folder' scaling -j "$tmp/no/folder/x.json"
refuses 2 'megabytes' floor --megabytes 0
refuses 2 'spheres' floor --spheres x
refuses 2 'not slow' floor -p slow
run 1 floor -s 16x9 -r 1 --megabytes 1 "$tmp/missing.frames"
says err 'missing\.frames'

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cgt-bench scaling, floor: command lines as described'
