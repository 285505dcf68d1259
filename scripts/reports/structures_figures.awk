# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The results of scripts/structures.sh as figures for structures.gnuplot, after columns.awk and
# structures_rows.awk. part: times, layouts or fetches.

# structure and traversal of a configuration: "kd single", "queue-grid", "loose-grid 16"
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

function number(key, name) { return (key, name) in ns ? sprintf("%.6g", ns[key, name]) : "NaN" }

# small trees fit in any memory
function is_small(primitives) { return primitives + 0 < 22000 }

# per ambient-occlusion ray
part == "fetches" && column("kind") == "ao" && !is_small(column("primitives")) {
    layout = layout_of(column("config"))
    line = column("scene") "\t" rank_of(layout) "\t" layout
    misses[line, column("memory") " " column("block_bytes") " " column("memory_bytes")] = column("misses_per_ray")
    lines[line] = 1
}

END {
    for (i = 1; i <= key_count; i++) {
        key = keys[i]
        split(key, piece, SUBSEP) # part, scene, config
        # family, structure, primitives, build ms, ns a ray: frame, ao, random; not what AUTO took for other rays
        if (part == "times" && piece[3] !~ /rays=/)
            printf "%s\t%s\t%s\t%s\t%s\t%s\t%s\n", family_of(piece[2]), key_of(piece[3]), value[key, "primitives"],
                value[key, "build_ms"], number(key, "frame"), number(key, "ao"), number(key, "random")
        if (part == "layouts" && piece[3] ~ /^kd,/ && !is_small(value[key, "primitives"])) {
            layout = layout_of(piece[3])
            line = piece[2] "\t" rank_of(layout) "\t" layout
            of_ao[line, key_of(piece[3])] = number(key, "ao")
            lines[line] = 1
        }
    }
    for (line in lines) {
        # scene, rank, layout, ns an ambient-occlusion ray: single, packet
        if (part == "layouts")
            printf "%s\t%s\t%s\n", line, of_ao[line, "kd single"], of_ao[line, "kd packet"]
        # scene, rank, layout, transfers: lines of 64 bytes read; of 128 bytes into 16 KB; of 16 KB, one run of nodes
        else
            printf "%s\t%s\t%s\t%s\n", line, misses[line, "ray 64 0"], misses[line, "lru 128 16384"],
                misses[line, "window 16384 16384"]
    }
}
