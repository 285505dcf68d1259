#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The command line of compare-embree, and scripts/compare_embree.sh: rows, hits compared with the library's, errors.
#   embree_cli.sh COMPARE_EMBREE CGT_BENCH [EMULATOR...]
bench=$2
tests=$(cd "$(dirname "$0")" && pwd)
set -- "$1" "$(dirname "$0")" # there is no data that the programs read
. "$tests/table_cli.sh"

camera='-c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46'
view="$camera -s 41x23 -n 2"
"$bench" make cloud2k "$tmp/cloud.frames" -n 2 || fail 'no cloud'
"$bench" make blobs2k "$tmp/blobs.frames" -n 2 || fail 'no blobs'
"$bench" frame "$tmp/cloud.frames" $view -o "$tmp/cloud.hits" >"$tmp/cloud.tsv" || fail 'no hits of the cloud'
"$bench" frame "$tmp/blobs.frames" $view -o "$tmp/blobs.hits" >"$tmp/blobs.tsv" || fail 'no hits of the blobs'

# others A B: pixels with other primitives
others() {
    cmp -l "$1" "$2" | awk '{ p = int(($1 - 1) / 8) } ($1 - 1) % 8 >= 4 && !seen[p]++ { n++ } END { print n + 0 }'
}

run 0 --help
says out 'Usage: compare-embree'

# The same columns as cgt-bench frame, and the same hits except for a few at silhouettes.
run 0 "$tmp/cloud.frames" $view -o "$tmp/embree.hits"
is head "$(head -n 1 "$tmp/stdout")" "$(head -n 1 "$tmp/cloud.tsv")"
is spheres "$(column config)" 'embree-low-builtin embree-medium-builtin embree-refit-builtin '\
'embree-low-user embree-medium-user embree-refit-user'
holds times 'c["build_ms"] > 0 && c["primary_ms"] > 0 && c["frame_ms"] > 0 && c["shadow_ms"] == 0 && c["threads"] == 1'
hits=$(awk -F '\t' 'NR == 2 { print $8 }' "$tmp/cloud.tsv")
holds hits "c[\"hit_pixels\"] >= $hits - 2 && c[\"hit_pixels\"] <= $hits + 2"
[ "$(others "$tmp/embree.hits" "$tmp/cloud.hits")" -le 3 ] || fail 'Embree sees other spheres'
for packets in 1 4 8 16; do
    run 0 "$tmp/cloud.frames" $view -m low -G user --packets $packets -t 2 -o "$tmp/embree.hits"
    is 'one row' "$(column config) $(column threads)" 'embree-low-user 2'
    [ "$(others "$tmp/embree.hits" "$tmp/cloud.hits")" -le 3 ] || fail "packets of $packets see other spheres"
done
run 0 "$tmp/blobs.frames" $view -R -o "$tmp/embree.hits"
is triangles "$(column config)" 'embree-low,robust embree-medium,robust embree-refit,robust'
[ "$(others "$tmp/embree.hits" "$tmp/blobs.hits")" -le 3 ] || fail 'Embree sees other triangles'

# Shadow and ambient-occlusion rays are the same rays as the library's: equally many hit nothing.
for ways in '-a 2' '-a 2 --nearest'; do
    "$bench" frame "$tmp/blobs.frames" $view -l 2,3,-2.5 $ways >"$tmp/lit.tsv" || fail 'no rays of the library'
    run 0 "$tmp/blobs.frames" $view -m low -l 2,3,-2.5 $ways
    open=$(awk -F '\t' 'NR == 2 { print $9 }' "$tmp/lit.tsv")
    holds "rays $ways" "c[\"shadow_ms\"] > 0 && c[\"ao_ms\"] > 0 && c[\"ao_open\"] >= $open - 3 && c[\"ao_open\"] <= $open + 3"
    [ "$open" -gt 0 ] || fail 'no ray is open'
done

run 2 "$tmp/cloud.frames" -l 1,2
run 2 "$tmp/cloud.frames" -a 1025
run 2 "$tmp/cloud.frames" -m best
says err 'not best'
run 2 "$tmp/cloud.frames" -G cubes
run 2 "$tmp/cloud.frames" --packets 5
run 2 "$tmp/cloud.frames" -i mmx
says err 'no mmx'
run 2 "$tmp/cloud.frames" -t 0
run 2
run 1 "$tmp/missing.frames"
run 1 "$tmp/cloud.frames" $view -m low -G user -o "$tmp/no/folder/hits"

# ---- Both in turn ---------------------------------------------------------------------------------------------------

if [ "$(dirname "$program")" = "$(cd "$(dirname "$bench")" && pwd)" ] && [ -x /bin/bash ]; then
    ROUNDS=2 STRUCTURE=kd BIN=$(dirname "$program") /bin/bash "$tests/../../../scripts/compare_embree.sh" \
        "$tmp/cloud.frames" $view >"$tmp/stdout" 2>"$tmp/stderr" || fail "compare_embree.sh: $(head -n 3 "$tmp/stderr")"
    is 'rows of both' "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" 7
    holds 'the best of each first' '(rows < 3) == c["best"] && c["scene"] == "cloud" && c["other_pixels"] <= 3'
    holds 'factors' 'c["config"] ~ /^embree/ ? c["faster"] > 0 : c["faster"] == "-"'
    holds 'no rays, no factors' 'c["shadow_faster"] == "-" && c["ao_faster"] == "-"'
    ROUNDS=1 BIN=$(dirname "$program") /bin/bash "$tests/../../../scripts/compare_embree.sh" "$tmp/blobs.frames" $view \
        -l 2,3,-2.5 -a 1 >"$tmp/stdout" 2>"$tmp/stderr" || fail "compare_embree.sh -l: $(head -n 3 "$tmp/stderr")"
    holds 'factors of rays' 'c["config"] ~ /^embree/ ? c["shadow_faster"] > 0 && c["ao_faster"] > 0 : c["ao_ms"] > 0'
fi

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'compare-embree: command line as described'
