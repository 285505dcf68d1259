# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The tab-separated results of scripts/structures.sh as figures for scripts/structures.gnuplot, after columns.awk. part:
# times, layouts or fetches.

# "kd single", "grid-queue", "loose-grid 16": structure and traversal of a configuration
function key_of(config,   name) {
    name = structure_of(config)
    if (config ~ /,(traversal|loop|packet)=/) {
        sub(/^.*,(traversal|loop|packet)=/, "", config)
        sub(/,.*/, "", config)
        name = name " " config
    }
    return name
}

function layout_of(config,   level) {
    level = value_of(config, "break")
    return value_of(config, "layout") (level == "" ? "" : " " level)
}

# the order of the bars: depth first, breadth first, mixed by levels
function rank_of(layout) {
    if (layout ~ /^depth/) return -2
    if (layout ~ /^breadth/) return -1
    sub(/^[a-z]* ?/, "", layout)
    return layout + 0
}

function family_of(scene) {
    if (scene ~ /^cloud/) return "clouds"
    if (scene ~ /^blob/) return "blobs"
    return scene
}

function ns(kind,   rays) {
    rays = column(kind "_rays") + 0
    return rays > 0 ? sprintf("%.6g", 1e6 * column(kind "_ms") / rays) : "NaN"
}

# family, key, primitives, build ms, ns a ray: primary, ao, random
part == "times" {
    if (column("config") ~ /rays=/) next # what AUTO took when told of other rays
    printf "%s\t%s\t%s\t%s\t%s\t%s\t%s\n", family_of(column("scene")), key_of(column("config")), column("primitives"),
        column("build_ms"), ns("primary"), ns("ao"), ns("random")
}

# small trees fit in any memory
part != "times" && column("primitives") < 22000 { next }

# scene, rank, layout, ns an ambient-occlusion ray: of the binned builder, single and packet
part == "layouts" && column("config") ~ /^kd,.*builder=binned/ {
    layout = layout_of(column("config"))
    key = column("scene") "\t" rank_of(layout) "\t" layout
    value[key, key_of(column("config"))] = ns("ao")
    keys[key] = 1
}

# scene, rank, layout, per ambient-occlusion ray: lines of 64 bytes read; transfers of 128 bytes into 16 KB; of
# 16 KB, one run of nodes
part == "fetches" && column("rays") == "ao" {
    layout = layout_of(column("config"))
    key = column("scene") "\t" rank_of(layout) "\t" layout
    what = column("memory") " " column("block_bytes") " " column("memory_bytes")
    value[key, what] = column("misses_per_ray")
    keys[key] = 1
}

END {
    for (key in keys) {
        if (part == "layouts")
            printf "%s\t%s\t%s\n", key, value[key, "kd single"], value[key, "kd packet"]
        else
            printf "%s\t%s\t%s\t%s\n", key, value[key, "ray 64 0"], value[key, "lru 128 16384"],
                value[key, "window 16384 16384"]
    }
}
