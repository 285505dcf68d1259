#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# compare_embree.sh FILE [OPTION...]
# The library against Embree 3 on one file: cgt-bench frame and compare-embree in turn, from a release build with its
# tests (scripts/test.sh release leaves one). OPTIONs go to both: -c camera, -s size, -t threads, -n frames, -r repeat,
# -l light, -a ambient-occlusion rays, --nearest, --shade.
# Prints tab-separated medians over the rounds, a row for each configuration, the best frame of each side first:
# milliseconds, by what factor the library's best frame is faster than the row's, and in how many pixels the last Embree
# row of the last round shows another primitive. Then, with -l or -a, by what factor the library's best build and shadow
# rays, or build and ambient-occlusion rays, are faster than the row's: what the library builds for such rays while it
# traces them is in their time.
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
      value[key, "shadow"] = value[key, "shadow"] " " $6
      value[key, "ao"] = value[key, "ao"] " " $7
      value[key, "frame"] = value[key, "frame"] " " $8
      hits[key] = $9 }
    END {
        for (i = 1; i <= count; i++) {
            key = keys[i]
            frame[key] = median(key, "frame")
            if (!(side[key] in best) || frame[key] < frame[best[side[key]]]) best[side[key]] = key
            for (c = 1; c <= 2; c++) {
                with[key, c] = median(key, "build") + median(key, c == 1 ? "shadow" : "ao")
                if (side[key] == "cgt" && (!(c in least) || with[key, c] < least[c])) least[c] = with[key, c]
            }
        }
        print "config", "scene", "threads", "build_ms", "primary_ms", "frame_ms", "faster", "hit_pixels", "other_pixels",
            "best", "shadow_ms", "ao_ms", "shadow_faster", "ao_faster"
        for (pass = 1; pass >= 0; pass--)
            for (i = 1; i <= count; i++) {
                key = keys[i]
                if ((best[side[key]] == key) != pass) continue
                for (c = 1; c <= 2; c++) {
                    ratio[c] = "-"
                    if (side[key] == "embree" && median(key, c == 1 ? "shadow" : "ao") > 0)
                        ratio[c] = sprintf("%.2f", with[key, c] / least[c])
                }
                print config[key], scene, threads[key], sprintf("%.3f", median(key, "build")),
                    sprintf("%.3f", median(key, "primary")), sprintf("%.3f", frame[key]),
                    side[key] == "cgt" ? "-" : sprintf("%.2f", frame[key] / frame[best["cgt"]]), hits[key], other, pass,
                    sprintf("%.3f", median(key, "shadow")), sprintf("%.3f", median(key, "ao")), ratio[1], ratio[2]
            }
    }' "$tmp/rows"
