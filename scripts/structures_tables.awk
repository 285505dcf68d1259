# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The tab-separated results of scripts/structures.sh as Markdown, after columns.awk. `part` names what the next file is.

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

function ns(kind,   rays) {
    rays = column(kind "_rays") + 0
    return rays > 0 ? sprintf("%.0f", 1e6 * column(kind "_ms") / rays) : "-"
}

function milliseconds(value) { return sprintf(value < 10 ? "%.2f" : "%.0f", value) }
function rounded(name) { return column(name) == "-" ? "-" : sprintf("%.3g", column(name)) }
function visits(kind) {
    return rounded(kind "nodes_per_ray") " / " rounded(kind "leaves_per_ray") " / " rounded(kind "tests_per_ray")
}
function kilobytes(bytes) { return sprintf("%.0f", bytes / 1024) }

part == "times" {
    if (!times) variant = value_of(column("config"), "variant")
    if (structure_of(column("config")) != "auto")
        times_line[++times] = sprintf("| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |", column("scene"),
            row_name(column("config")), milliseconds(column("build_ms")), ns("primary"), ns("shadow"), ns("ao"), ns("random"),
            visits(""), visits("ao_"), kilobytes(column("bytes")))
    exact_steps += column("exact_steps")
    loops += column("rope_loops")
    if (structure_of(column("config")) == "auto")
        chosen_line[++chosen] = sprintf("| %s | %s | %s | %s |", column("scene"), row_name(column("config")),
            column("chosen"), column("reason"))
    # the best for each kind of rays, its build included, and what AUTO took for them
    scene = column("scene")
    if (!(scene in seen)) { seen[scene] = 1; scenes[++scene_count] = scene }
    told = value_of(column("config"), "rays")
    whole("camera", column("primary_ms"), told == "")
    whole("camera, shadow", column("primary_ms") + column("shadow_ms"), told == "")
    whole("ambient occlusion, random", column("ao_ms") + column("random_ms"), told == "incoherent")
    next
}

# one line for each layout of the binned builder's trees, and for each builder: trees without ropes
part == "layouts" {
    if (structure_of(column("config")) != "kd") next
    builder = value_of(column("config"), "builder")
    key = column("scene") SUBSEP (builder == "binned" ? layout_of(column("config")) : builder)
    what = value_of(column("config"), "traversal")
    if (builder == "binned" && !((key, "nodes") in layout_ns)) layout_keys[++layouts] = key
    layout_ns[key, "nodes"] = 1
    layout_ns[key, what] = ns("primary") " / " ns("ao") " / " ns("random")
    if (layout_of(column("config")) != "depth-first" || what != "packet") next
    builder_line[++builders] = sprintf("| %s | %s | %s | %.1f | %s / %s / %s | %s |", column("scene"), builder,
        milliseconds(column("build_ms")), column("kd_cost"), ns("primary"), ns("ao"), ns("random"), kilobytes(column("bytes")))
    next
}

# one line for each layout and kind of ray, a column for each of some memories
part == "fetches" {
    key = column("scene") SUBSEP column("rays") SUBSEP layout_of(column("config"))
    if (!(key in fetch_seen)) { fetch_seen[key] = 1; fetch_keys[++fetches] = key }
    what = column("memory") " " column("block_bytes") " " column("memory_bytes")
    fetch[key, what] = column("misses_per_ray")
    fetch_nodes[key] = column("nodes_per_ray")
    next
}

# One row's milliseconds of some rays with its build; told: AUTO knew that they were such.
function whole(rays, ms, told,   total) {
    total = ms + column("build_ms")
    if (structure_of(column("config")) == "auto") {
        if (told) auto_ms[scene, rays] = total
    } else if (!((scene, rays) in best_ms) || total < best_ms[scene, rays]) {
        best_ms[scene, rays] = total
        best[scene, rays] = row_name(column("config"))
    }
}

function print_lines(line, lines,   j) { for (j = 1; j <= lines; j++) print line[j] }

function fetched(key, what) { return (key, what) in fetch ? sprintf("%.3g", fetch[key, what]) : "-" }

END {
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
        print "\n## Builders\n"
        print "| scene | builder | build, ms | cost | packets: camera / ambient / random, ns a ray | KB |"
        print "|---|---|---|---|---|---|"
        print_lines(builder_line, builders)
    }
    if (!fetches) exit
    print "\n## Transfers of nodes, per ray\n"
    print "| scene | rays | layout | nodes read | lines of 64 B | 128 B, LRU 4 KB | 128 B, LRU 16 KB |" \
          " 128 B, direct 16 KB | 1 KB, LRU 16 KB | 4 KB, LRU 32 KB |" \
          " run of 4 KB | run of 16 KB | 8 KB of top, run of 8 KB |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    for (i = 1; i <= fetches; i++) {
        key = fetch_keys[i]
        split(key, piece, SUBSEP)
        printf "| %s | %s | %s | %.1f | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", piece[1], piece[2], piece[3],
            fetch_nodes[key], fetched(key, "ray 64 0"), fetched(key, "lru 128 4096"), fetched(key, "lru 128 16384"),
            fetched(key, "direct 128 16384"), fetched(key, "lru 1024 16384"), fetched(key, "lru 4096 32768"),
            fetched(key, "window 4096 4096"), fetched(key, "window 16384 16384"), fetched(key, "top 8192 16384")
    }
}
