# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The results of scripts/structures.sh as figures for structures.gnuplot, after columns.awk and
# structures_rows.awk. part: times or layouts.

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
    # scene, rank, layout, ns an ambient-occlusion ray: single, packet
    for (line in lines)
        printf "%s\t%s\t%s\n", line, of_ao[line, "kd single"], of_ao[line, "kd packet"]
}
