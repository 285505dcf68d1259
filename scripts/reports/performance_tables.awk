# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The tab-separated results of scripts/performance.sh as Markdown. `part` names what the next file is: scaling, floor,
# embree or rays.

function column(name) { return name in at ? $(at[name]) : "" }
function ms(value) {
    if (value == "-" || value == "") return "-"
    return sprintf(value < 0.1 ? "%.3f" : value < 10 ? "%.2f" : "%.1f", value)
}
function short(value) { return value == "-" || value == "" ? "-" : sprintf("%.2f", value) }

FNR == 1 {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    scene = ""
    files[part]++
    next
}
# the second table of scaling: exponents over whole sweeps
part == "scaling" && /^# / {
    sub(/^# /, "")
    if ($2 == "sweep" || NF < 9) next
    exponents = exponents sprintf("| %s | %s | %g to %g | %s | %s | %s | %s |\n", $2, $3, $4, $5, short($6), short($7),
        short($8), short($9))
    next
}
/^#/ { next }

part == "scaling" {
    sweep = column("sweep")
    growth[sweep] = growth[sweep] sprintf("| %s | %d | %sx%s | %d | %s | %s | %s | %s | %s | %s | %s |\n",
        column("kind"), column("primitives"), column("width"), column("height"), column("threads"),
        ms(column("bounds_ms")), ms(column("build_ms")), ms(column("primary_ms")), ms(column("frame_ms")),
        short(column("bytes_per_primitive")), short(column("structure_bytes_per_primitive")),
        column("steady_allocations"))
    allocations += column("steady_allocations")
    next
}

part == "floor" {
    threads = column("threads")
    item = column("item")
    kind = column("part")
    if (kind == "memory" || kind == "tests" && files["floor"] == 1) # tests are of one thread in any run
        machine = machine sprintf("| %s | %s%s | %s | %s | %s |\n", kind,
            column("scene") == "-" ? "" : column("scene") ": ", item, threads, short(column("value")), column("unit"))
    key = threads SUBSEP column("scene")
    if ((kind == "limit" || kind == "fields" || kind == "empty") && !((kind, key) in known)) {
        known[kind, key] = 1
        order[kind, ++lines[kind]] = key
    }
    value[kind, key, item] = column("value")
    next
}

part == "embree" {
    if (!(FILENAME in compared)) { compared[FILENAME] = 1; compare_files[++compare_count] = FILENAME }
    row = sprintf("| %s | %s | %d | %s | %s | %s | %s | %s | %d |\n", column("scene"),
        column("config"), column("threads"), ms(column("build_ms")), ms(column("primary_ms")), ms(column("frame_ms")),
        column("best") == 1 && column("faster") != "-" ? "**" column("faster") "**" : column("faster"),
        column("hit_pixels"), column("other_pixels"))
    if (compare_count == 1 || column("best") == 1) # all rows of the first run; of the others what counts
        rows[FILENAME] = rows[FILENAME] row
}

# each side's best build with the rays of a column: the least sum
function best_rays(rays,   key, sum) {
    if (column(rays "_ms") + 0 == 0) return
    key = FILENAME SUBSEP column("scene") SUBSEP rays SUBSEP (column("config") ~ /^embree/ ? "embree" : "cgt")
    sum = column("build_ms") + column(rays "_ms")
    if (key in rays_ms && rays_ms[key] <= sum) return
    rays_ms[key] = sum
    rays_text[key] = column("config") ": " ms(column("build_ms")) " + " ms(column(rays "_ms"))
}
part == "rays" {
    if (!((FILENAME, column("scene")) in rays_known)) {
        rays_known[FILENAME, column("scene")] = 1
        if (FILENAME != rays_last) rays_file[++rays_files] = rays_last = FILENAME
        rays_scene[FILENAME, ++rays_scenes[FILENAME]] = column("scene")
    }
    rays_threads[FILENAME] = column("threads")
    best_rays("shadow")
    best_rays("ao")
    next
}
function print_rays(file, scene, rays,   ours, theirs, nearest) {
    ours = file SUBSEP scene SUBSEP rays SUBSEP "cgt"
    theirs = file SUBSEP scene SUBSEP rays SUBSEP "embree"
    if (!(ours in rays_ms) || !(theirs in rays_ms)) return
    nearest = name_of(file) ~ /^nearest/ # the same rays with more fields requested; shadows are in another table
    if (nearest && rays != "ao") return
    printf "| %s | %s | %d | %s | %s | **%.2f** |\n", scene, nearest ? "nearest" : rays == "ao" ? "ambient occlusion" : rays,
        rays_threads[file], rays_text[theirs], rays_text[ours], rays_ms[theirs] / rays_ms[ours]
}

function get(kind, key, item) { return (kind, key, item) in value ? value[kind, key, item] : "-" }

function fields_of(kind, key, target,   line, i, n, set) {
    n = split("t;t,id;t,id,normal;t,id,uv;t,id,normal,uv", set, ";")
    line = ""
    for (i = 1; i <= n; i++) line = line " | " ms(get(kind, key, target ":" set[i]))
    return line
}

function print_fields(kind,   i, key, piece, name) {
    for (i = 1; i <= lines[kind]; i++) {
        key = order[kind, i]
        split(key, piece, SUBSEP)
        name = kind == "empty" ? "empty" : piece[2]
        printf "| %s | %s | planes%s |\n", name, piece[1], fields_of(kind, key, "planes")
        printf "| %s | %s | visitor%s |\n", name, piece[1], fields_of(kind, key, "visitor")
    }
}

END {
    print "## Growth\n"
    n = split("primitives pixels threads", sweeps, " ")
    for (i = 1; i <= n; i++) {
        if (!(sweeps[i] in growth)) continue
        print "| kind | primitives | pixels | threads | bounds, ms | build, ms | primary, ms | frame, ms |" \
              " bytes a primitive | structure | allocations |"
        print "|---|---|---|---|---|---|---|---|---|---|---|"
        print growth[sweeps[i]]
    }
    printf "Allocations in all frames that count: %d.\n\n", allocations
    print "| what grows | kind | from, to | bounds | build | primary | frame |\n|---|---|---|---|---|---|---|"
    print exponents
    print "## The machine\n"
    print "| part | what | threads | value | unit |\n|---|---|---|---|---|"
    print machine
    print "## Limits\n"
    print "| scene | threads | objects | seen | empty | read | scatter | tests | objects | limit | resolve | build |" \
          " primary | frame | over the limit | over limit and resolve | primary of what is seen |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    for (i = 1; i <= lines["limit"]; i++) {
        key = order["limit", i]
        split(key, piece, SUBSEP)
        printf "| %s | %s | %d | %d | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | **%s** | %s | %s |\n", piece[2],
            piece[1], get("limit", key, "objects"), get("limit", key, "objects seen"),
            ms(get("limit", key, "limit:empty")), ms(get("limit", key, "limit:read")),
            ms(get("limit", key, "limit:scatter")), ms(get("limit", key, "limit:tests")),
            ms(get("limit", key, "limit:objects")), ms(get("limit", key, "limit")), ms(get("limit", key, "resolve")),
            ms(get("limit", key, "measured:build")), ms(get("limit", key, "measured:primary")),
            ms(get("limit", key, "measured:frame")), short(get("limit", key, "measured over limit")),
            short(get("limit", key, "measured over limit and resolve")),
            ms(get("limit", key, "measured:primary of what is seen"))
    }
    print "\n## What a frame asks for\n"
    print "| scene | threads | to | t | t, id | t, id, normal | t, id, u v | t, id, normal, u v |"
    print "|---|---|---|---|---|---|---|---|"
    print_fields("empty")
    print_fields("fields")
    if (!compare_count && !rays_files) exit
    print "\n## Against Embree"
    for (i = 1; i <= compare_count; i++) {
        printf "\n`%s`\n\n", name_of(compare_files[i])
        print "| scene | configuration | threads | build, ms | primary, ms | frame, ms | Embree's over the library's |" \
              " pixels hit | other primitives |"
        print "|---|---|---|---|---|---|---|---|---|"
        printf "%s", rows[compare_files[i]]
    }
    for (i = 1; i <= rays_files; i++) {
        printf "\n`%s`\n\n", name_of(rays_file[i])
        print "| scene | rays | threads | Embree: build + rays, ms | the library | Embree's over the library's |"
        print "|---|---|---|---|---|---|"
        for (j = 1; j <= rays_scenes[rays_file[i]]; j++) {
            print_rays(rays_file[i], rays_scene[rays_file[i], j], "shadow")
            print_rays(rays_file[i], rays_scene[rays_file[i], j], "ao")
        }
    }
}

function name_of(path) { sub(/.*\//, "", path); sub(/\.tsv$/, "", path); return path }
