#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# compare_embree.sh FILE [OPTION...]
# The library beside Embree 3 on one file: cgt-bench frame and compare-embree in turn, from a release build with its
# tests (scripts/test.sh release leaves one). OPTIONs go to both: -c camera, -s size, -t threads, -n frames, -r repeat.
# Prints tab-separated medians over the rounds, a row for each configuration, the best of each side first: milliseconds,
# by what factor the library's frame is faster, and in how many pixels the last Embree row of the last round shows
# another primitive.
#   ROUNDS          default 3
#   STRUCTURE       of the library; default auto
#   CGT_OPTIONS     further ones for cgt-bench frame (--variant avx2)
#   EMBREE_OPTIONS  further ones for compare-embree (-i avx2)
#   BIN             folder of the programs; default build/release/bin
set -euo pipefail
bin=${BIN:-$(dirname "$0")/../build/release/bin}
rounds=${ROUNDS:-3}
read -r -a of_cgt <<<"-S ${STRUCTURE:-auto} ${CGT_OPTIONS:-}"
read -r -a of_embree <<<"${EMBREE_OPTIONS:-}"
[ $# -ge 1 ] || { echo "compare_embree.sh: FILE is missing" >&2; exit 2; }
for program in cgt-bench compare-embree; do
    [ -x "$bin/$program" ] || { echo "compare_embree.sh: no $bin/$program: run scripts/test.sh release first" >&2; exit 1; }
done
file=$1
shift
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT

for _ in $(seq "$rounds"); do
    "$bin/compare-embree" "$file" "$@" ${of_embree[@]+"${of_embree[@]}"} -o "$tmp/embree.hits" >"$tmp/embree.tsv"
    "$bin/cgt-bench" frame "$file" "$@" "${of_cgt[@]}" -o "$tmp/cgt.hits" >"$tmp/cgt.tsv"
    for side in embree cgt; do
        sed 1d "$tmp/$side.tsv" | sed "s/^/$side	/" >>"$tmp/rows"
    done
done
# the last four bytes of a pixel's eight are its primitive
other=$( (cmp -l "$tmp/embree.hits" "$tmp/cgt.hits" || true) |
    awk '{ pixel = int(($1 - 1) / 8) } ($1 - 1) % 8 >= 4 && (!n || pixel != last) { n++; last = pixel } END { print n + 0 }')

awk -F'\t' -v OFS='\t' -v scene="$(basename "$file" | sed 's/\.[^.]*$//')" -v other="$other" '
    function median(key, field,   i, j, n, t, v) {
        n = split(value[key, field], v, " ")
        for (i = 2; i <= n; i++)
            for (j = i; j > 1 && v[j - 1] + 0 > v[j] + 0; j--) { t = v[j]; v[j] = v[j - 1]; v[j - 1] = t }
        return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
    }
    { key = $1 SUBSEP $2
      if (!(key in side)) { keys[++count] = key; side[key] = $1; config[key] = $2; threads[key] = $3 }
      value[key, "build"] = value[key, "build"] " " $4
      value[key, "primary"] = value[key, "primary"] " " $5
      value[key, "frame"] = value[key, "frame"] " " $8
      hits[key] = $9 }
    END {
        for (i = 1; i <= count; i++) {
            key = keys[i]
            frame[key] = median(key, "frame")
            if (!(side[key] in best) || frame[key] < frame[best[side[key]]]) best[side[key]] = key
        }
        print "config", "scene", "threads", "build_ms", "primary_ms", "frame_ms", "faster", "hit_pixels", "other_pixels",
            "best"
        for (pass = 1; pass >= 0; pass--)
            for (i = 1; i <= count; i++) {
                key = keys[i]
                if ((best[side[key]] == key) != pass) continue
                print config[key], scene, threads[key], sprintf("%.3f", median(key, "build")),
                    sprintf("%.3f", median(key, "primary")), sprintf("%.3f", frame[key]),
                    side[key] == "cgt" ? "-" : sprintf("%.2f", frame[key] / frame[best["cgt"]]), hits[key], other, pass
            }
    }' "$tmp/rows"
