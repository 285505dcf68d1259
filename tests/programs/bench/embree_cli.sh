#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Embree as a way of cgt-bench frame and rays: rows, hits compared with the library's, errors.
#   embree_cli.sh CGT_BENCH DATA_DIR [EMULATOR...]
. "$(dirname "$0")/table_cli.sh"

camera='-c 0.7,0.5,-3.1,0.05,-0.02,0,0.1,1,0.05,46'
view="$camera -s 41x23 -n 2"
run 0 make cloud2k "$tmp/cloud.frames" -n 2
run 0 make blobs2k "$tmp/blobs.frames" -n 2

# compared: the second table, in place of the first one
compared() {
    sed -n 's/^# //p' "$tmp/stdout" | sed 1d >"$tmp/second" && mv "$tmp/second" "$tmp/stdout"
}

# The same columns as the library's, and the same hits except for a few at silhouettes.
run 0 frame "$tmp/cloud.frames" $view -S auto,embree-all -o "$tmp/both.hits"
cp "$tmp/stdout" "$tmp/both.tsv"
grep -v '^#' "$tmp/both.tsv" >"$tmp/stdout"
is spheres "$(column config)" 'loose-grid embree-low-builtin embree-medium-builtin embree-refit-builtin '\
'embree-low-user embree-medium-user embree-refit-user'
holds times 'c["build_ms"] > 0 && c["primary_ms"] > 0 && c["frame_ms"] > 0 && c["shadow_ms"] == 0 && c["threads"] == 1'
hits=$(awk -F '\t' 'NR == 2 { print $8 }' "$tmp/stdout")
holds hits "c[\"hit_pixels\"] >= $hits - 2 && c[\"hit_pixels\"] <= $hits + 2"
cp "$tmp/both.tsv" "$tmp/stdout"
compared
holds 'factors' 'c["config"] == "loose-grid" ? c["faster"] == 1 && c["other_pixels"] == 0 :
    c["faster"] > 0 && c["other_pixels"] <= 3'
holds 'no rays, no factors' 'c["shadow_faster"] == "-" && c["ao_faster"] == "-"'
run 0 frame "$tmp/cloud.frames" $view -o "$tmp/library.hits"
cmp -s "$tmp/both.hits" "$tmp/library.hits" || fail 'other hits than those of the first row'
for packets in 1 4 8 16; do
    run 0 frame "$tmp/cloud.frames" $view -S bvh,embree-low-user --packets $packets -t 2
    says out '^embree-low-user'
    compared
    holds "packets of $packets" 'c["other_pixels"] <= 3'
done
run 0 frame "$tmp/blobs.frames" $view --robust -S kd,embree-all
compared
is triangles "$(column config)" 'kd embree-low,robust embree-medium,robust embree-refit,robust'
holds 'the same triangles' 'c["other_pixels"] <= 3'
run 0 frame "$tmp/cloud.frames" $view -S embree
is 'the fastest alone' "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" 1

# Shadow and ambient-occlusion rays are the same rays as the library's: equally many hit nothing.
for ways in '-a 2' '-a 2 --nearest'; do
    run 0 frame "$tmp/blobs.frames" $view -S auto,embree-low -l 2,3,-2.5 $ways
    cp "$tmp/stdout" "$tmp/both.tsv"
    grep -v '^#' "$tmp/both.tsv" >"$tmp/stdout"
    open=$(awk -F '\t' 'NR == 2 { print $9 }' "$tmp/stdout")
    holds "rays $ways" "c[\"shadow_ms\"] > 0 && c[\"ao_ms\"] > 0 && c[\"ao_open\"] >= $open - 3 && c[\"ao_open\"] <= $open + 3"
    [ "$open" -gt 0 ] || fail 'no ray is open'
    cp "$tmp/both.tsv" "$tmp/stdout"
    compared
    holds 'factors of rays' 'c["shadow_faster"] > 0 && c["ao_faster"] > 0'
done

# In sets of rays each form of packets is a way; the fastest stands for Embree.
run 0 rays "$tmp/cloud.frames" -s 41x23 -S bvh,embree-low-user -K shadow -r 1 --variant portable
is 'forms' "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" 8
holds 'nearly the same hits' 'c["different"] <= 3 && c["ratio"] > 0'
run 0 rays "$tmp/blobs.frames" -s 41x23 -S bvh,embree -r 1
is 'ways' "$(sed 1d "$tmp/stdout" | wc -l | tr -d ' ')" 14
holds 'the fastest' 'c["config"] !~ /^embree/ || c["ratio"] == 1'

refuses 2 '"embree-best" is not auto' frame "$tmp/cloud.frames" -S embree-best
refuses 2 '--packets' frame "$tmp/cloud.frames" --packets 5
refuses 2 'no mmx' frame "$tmp/cloud.frames" --isa mmx
refuses 2 '-O: not of Embree' frame "$tmp/cloud.frames" -O -S embree

[ "$failures" -eq 0 ] || { echo "$failures failures" >&2; exit 1; }
echo 'cgt-bench with Embree: as described'
