# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The results of scripts/structures.sh as Markdown, after columns.awk and structures_rows.awk.

function row_name(config,   traversal, rays, loop, packet) {
    traversal = value_of(config, "traversal")
    rays = value_of(config, "rays")
    loop = value_of(config, "loop")
    packet = value_of(config, "packet")
    return structure_of(config) (traversal == "" ? "" : ", " traversal) (rays == "" ? "" : ", " rays) \
        (loop == "" ? "" : ", " loop) (packet == "" ? "" : ", packets of " packet)
}

function layout_of(config,   level) {
    level = value_of(config, "break")
    return value_of(config, "layout") (level == "" ? "" : ", " level)
}

function number(key, name) { return (key, name) in ns ? sprintf("%.0f", ns[key, name]) : "-" }
function seen(key, name) { return (key, name) in visits ? visits[key, name] : "- / - / -" }
function milliseconds(value) { return sprintf(value < 10 ? "%.2f" : "%.0f", value) }
function kilobytes(bytes) { return sprintf("%.0f", bytes / 1024) }

function add_times(key, scene, config,   told) {
    if (!variant) variant = value_of(config, "variant")
    if (!(scene in has_scene)) { has_scene[scene] = 1; scenes[++scene_count] = scene }
    if (structure_of(config) == "auto")
        chosen_line[++chosen] = sprintf("| %s | %s | %s | %s |", scene, row_name(config), value[key, "chosen"],
            value[key, "reason"])
    else
        times_line[++times] = sprintf("| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |", scene, row_name(config),
            milliseconds(value[key, "build_ms"]), number(key, "frame"), number(key, "shadow"), number(key, "ao"),
            number(key, "random"), seen(key, "frame"), seen(key, "ao"), kilobytes(value[key, "bytes"]))
    # the best for each kind of rays, its build included, and what AUTO took for them
    told = value_of(config, "rays")
    add_total(key, scene, config, "camera", ms(key, "frame"), told == "")
    add_total(key, scene, config, "camera, shadow", ms(key, "frame") + ms(key, "shadow"), told == "")
    add_total(key, scene, config, "ambient occlusion, random", ms(key, "ao") + ms(key, "random"), told == "incoherent")
}

# The milliseconds of some rays with the build; told: AUTO knew that they were such.
function add_total(key, scene, config, what, of_rays, told,   total) {
    total = of_rays + value[key, "build_ms"]
    if (structure_of(config) == "auto") {
        if (told) auto_ms[scene, what] = total
    } else if (!((scene, what) in best_ms) || total < best_ms[scene, what]) {
        best_ms[scene, what] = total
        best[scene, what] = row_name(config)
    }
}

# One line for each layout of trees without ropes.
function add_layout(key, scene, config,   layout) {
    if (structure_of(config) != "kd") return
    layout = scene SUBSEP layout_of(config)
    if (!((layout, "known") in layout_ns)) layout_keys[++layouts] = layout
    layout_ns[layout, "known"] = 1
    layout_ns[layout, value_of(config, "traversal")] = number(key, "frame") " / " number(key, "ao") " / " number(key, "random")
}

function print_lines(line, lines,   j) { for (j = 1; j <= lines; j++) print line[j] }

END {
    for (i = 1; i <= key_count; i++) {
        split(keys[i], piece, SUBSEP) # part, scene, config
        if (piece[1] == "times") add_times(keys[i], piece[2], piece[3])
        else add_layout(keys[i], piece[2], piece[3])
    }
    print "## Structures, " variant "\n"
    print "| scene | structure | build, ms | camera, ns | shadow, ns | ambient, ns | random, ns |" \
          " camera: nodes / leaves / tests | ambient: nodes / leaves / tests | KB |"
    print "|---|---|---|---|---|---|---|---|---|---|"
    print_lines(times_line, times)
    printf "\nSteps along ropes that needed exact arithmetic: %d. Loops: %d.\n", exact_steps, loops
    print "\n## What AUTO takes\n"
    print "| scene | told | structure | why |\n|---|---|---|---|"
    print_lines(chosen_line, chosen)
    print "\n| scene | rays | best, with its build | ms | AUTO, ms | over the best |\n|---|---|---|---|---|---|"
    kinds = split("camera/camera, shadow/ambient occlusion, random", kind, "/")
    for (i = 1; i <= scene_count; i++)
        for (k = 1; k <= kinds; k++)
            if (((scenes[i], kind[k]) in best_ms) && ((scenes[i], kind[k]) in auto_ms) && best_ms[scenes[i], kind[k]] > 0)
                printf "| %s | %s | %s | %.1f | %.1f | %.2f |\n", scenes[i], kind[k], best[scenes[i], kind[k]],
                    best_ms[scenes[i], kind[k]], auto_ms[scenes[i], kind[k]],
                    auto_ms[scenes[i], kind[k]] / best_ms[scenes[i], kind[k]]
    if (layouts) {
        print "\n## Layouts: camera / ambient / random, ns a ray\n"
        print "| scene | layout | one ray | packet |\n|---|---|---|---|"
        for (i = 1; i <= layouts; i++) {
            split(layout_keys[i], piece, SUBSEP)
            printf "| %s | %s | %s | %s |\n", piece[1], piece[2], layout_ns[layout_keys[i], "single"],
                layout_ns[layout_keys[i], "packet"]
        }
    }
}
