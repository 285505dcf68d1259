# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The tab-separated results of scripts/performance.sh as figures for performance.gnuplot. part: growth, limit, fields or
# embree.

function column(name) { return name in at ? $(at[name]) : "" }

FNR == 1 {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    next
}
/^#/ { next }

# sweep, kind, what grows, shortest ms: bounds, build, primary, frame; bytes a primitive: all, structure
part == "growth" {
    sweep = column("sweep")
    printf "%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n", sweep, column("kind"), column(sweep), column("bounds_min_ms"),
        column("build_min_ms"), column("primary_min_ms"), column("frame_min_ms"), column("bytes_per_primitive"),
        column("structure_bytes_per_primitive")
}

# the scenes in their order, and what each has
part == "limit" && column("part") == "limit" || part == "fields" && column("part") == "fields" {
    scene = column("scene")
    if (!(scene in seen)) { seen[scene] = 1; scenes[++count] = scene }
    value[scene, column("item")] = column("value")
}

# scene, the factor of the best Embree row, and of the best one for each quality
part == "embree" && column("config") ~ /^embree/ {
    scene = column("scene")
    if (!(scene in seen)) { seen[scene] = 1; scenes[++count] = scene }
    quality = column("config")
    sub(/^embree-/, "", quality)
    sub(/[-,].*/, "", quality)
    if (!((scene, quality) in value) || column("faster") + 0 < value[scene, quality])
        value[scene, quality] = column("faster") + 0
}

function get(scene, item) { return (scene, item) in value && value[scene, item] != "-" ? value[scene, item] : "NaN" }

END {
    for (i = 1; i <= count; i++) {
        scene = scenes[i]
        if (part == "limit")
            printf "%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n", scene, get(scene, "limit:empty"), get(scene, "limit:read"),
                get(scene, "limit:scatter"), get(scene, "limit:tests"), get(scene, "limit:objects"),
                get(scene, "resolve"), get(scene, "measured:frame")
        if (part == "fields")
            printf "%s\t%s\t%s\t%s\t%s\t%s\t%s\n", scene, get(scene, "planes:t"), get(scene, "planes:t,id"),
                get(scene, "planes:t,id,normal"), get(scene, "visitor:t"), get(scene, "visitor:t,id"),
                get(scene, "visitor:t,id,normal")
        if (part == "embree")
            printf "%s\t%s\t%s\t%s\n", scene, get(scene, "low"), get(scene, "medium"), get(scene, "refit")
    }
}
