# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The tables of scripts/speed.sh as Markdown, after columns.awk: `part` is one of its parts, files are named
# PART.SCENE.SETTING.tsv. Of Embree the row counts that is the fastest for what a table compares.

function ms(value) { return sprintf(value < 0.1 ? "%.3f" : value < 100 ? "%.2f" : "%.1f", value) }
function is_embree(config) { return config ~ /^embree/ }
function rule(columns,   line) { line = "|"; while (columns-- > 0) line = line "---|"; return line }
function least(key, value) { if (!(key in low) || value < low[key]) { low[key] = value; return 1 } return 0 }

# the build and one kind of rays of a row: the shortest of a side is its time
function take(kind, rays,   key, build) {
    build = column("build_ms")
    key = scene SUBSEP setting SUBSEP kind SUBSEP (is_embree(column("config")) ? "embree" : "libcgt")
    if (least(key, build + rays)) { text[key] = ms(build) " + " ms(rays); name[key] = column("config") }
}

function ratio(kind, setting,   a, b) {
    a = at_scene SUBSEP setting SUBSEP kind SUBSEP "libcgt"
    b = at_scene SUBSEP setting SUBSEP kind SUBSEP "embree"
    return (a in low) && (b in low) ? sprintf("%.2f", low[b] / low[a]) : "-"
}

function compare(title, kind, settings,   count, each, i, k, line, key) {
    count = split(settings, each, " ")
    print "\n## " title "\n"
    line = "| scene | libcgt: build + rays, ms | Embree's best | its way |"
    for (k = 1; k <= count; k++) line = line " " label[each[k]] " |"
    print line "\n" rule(4 + count)
    for (i = 1; i <= scenes; i++) {
        at_scene = scene_of[i]
        key = at_scene SUBSEP each[1] SUBSEP kind SUBSEP
        line = "| " at_scene " | " text[key "libcgt"] " | " text[key "embree"] " | " substr(name[key "embree"], 8) " |"
        for (k = 1; k <= count; k++) line = line " " (k == 1 ? "**" ratio(kind, each[k]) "**" : ratio(kind, each[k])) " |"
        print line
    }
}

FNR == 2 {
    count = split(FILENAME, path, "/")
    split(path[count], piece, ".")
    scene = piece[2]
    setting = piece[3] == "sse4" ? "sse4.2" : piece[3]
    if (!(scene in known)) { known[scene] = 1; scene_of[++scenes] = scene }
}

part == "frames" { take("camera", column("primary_ms")); take("shadow", column("shadow_ms")) }
part == "rays" && setting != "nearest" { take("ao", column("ao_ms")) }
part == "rays" && setting == "nearest" { take("nearest", column("ao_ms")) }

part == "growth" {
    at_scene = scene
    if (!(setting in known)) { known[setting] = 1; size_of[++sizes] = setting }
    text[scene, setting] = ms(column("build_ms")) " + " ms(column("primary_ms"))
}

# lights: the library's rows, with the ratio to Embree's fastest
part == "light" && !is_embree(column("config")) {
    order = column("order")
    if (!(order in known)) { known[order] = 1; order_of[++orders] = order }
    key = scene SUBSEP order
    goal = column("kind") == "outside" ? 2 : scene == "blobs1m" ? 1.5 : 1.3
    short[key] += column("ratio") < goal
    rows++
    if (column("ratio_builds") < 1.3)
        below[++below_count] = scene ", `" column("kind") "`, " order ": " sprintf("%.2f", column("ratio_builds"))
    if (least(key, column("ratio"))) name[key] = column("kind")
    least(key SUBSEP "builds", column("ratio_builds"))
    if (column("kind") == "outside") outside[key] = column("ratio")
}

# bounces: of every wave and material; of Embree each setting is a way, with its own build
part == "bounces" || part == "structures" {
    split(column("kind"), piece, "-")
    key = scene " | " piece[1]
    if (!(key in known)) { known[key] = 1; wave_of[++waves] = key }
    way = column("config")
    if (!is_embree(way)) way = structure_of(way)
    if (!(way in known)) { known[way] = 1; way_of[++ways] = way }
    least(key SUBSEP (is_embree(way) ? "embree" : way) SUBSEP piece[2], column("ns_per_ray"))
    all_ms[key, way] += column("ms")
    build[key, way] = column("build_ms")
    if (way == way_of[1]) { rays[key] += column("rays"); wave_rays[key, piece[2]] = column("rays") }
}

function whole(key, way) { return build[key, way] + all_ms[key, way] }
function both(key, way) { return ms(build[key, way]) " + " ms(all_ms[key, way]) }

function embree_of(key,   k, best, time) {
    for (k = 1; k <= ways; k++) {
        if (!is_embree(way_of[k]) || !((key, way_of[k]) in build)) continue
        if (!best || whole(key, way_of[k]) < time) { best = k; time = whole(key, way_of[k]) }
    }
    return way_of[best]
}

function light_table(title, kind,   i, k, key, line) {
    print "\n## " title "\n"
    line = "| scene |"
    for (k = 1; k <= orders; k++) line = line " " order_of[k] " |"
    print line "\n" rule(1 + orders)
    for (i = 1; i <= scenes; i++) {
        line = "| " scene_of[i] " |"
        for (k = 1; k <= orders; k++) {
            key = scene_of[i] SUBSEP order_of[k]
            if (kind == "least") line = line sprintf(" %.2f `%s`, %d |", low[key], name[key], short[key])
            if (kind == "builds") line = line sprintf(" %.2f |", low[key, "builds"])
            if (kind == "outside") line = line sprintf(" %.2f |", outside[key])
        }
        print line
    }
}

END {
    label[1] = "1 thread"; label[2] = "2 threads"; label["nearest"] = "ratio"
    label["avx2"] = "AVX2"; label["sse4.2"] = "SSE4.2"
    if (part == "frames") {
        compare("Frames: build and camera rays", "camera", "1 2 avx2 sse4.2")
        compare("Shadow rays, with the build", "shadow", "1 2 avx2 sse4.2")
    }
    if (part == "rays") {
        compare("Ambient-occlusion rays, any hit, with the build", "ao", "1 2")
        compare("The same rays, nearest hit", "nearest", "nearest")
    }
    if (part == "light") {
        light_table("Lights: the least ratio, its light, and how many are short of the goal", "least")
        light_table("Lights: the least ratio with builds", "builds")
        printf "\n%d of %d rows below 1.3.\n", below_count, rows
        for (i = 1; i <= below_count; i++) print "- " below[i]
        light_table("A light outside", "outside")
    }
    if (part == "bounces") {
        print "\n## Bounces: ns a ray, libcgt / Embree, ratio\n"
        print "| scene | material | bounce 1 | bounce 2 | bounce 3 | bounce 4 |\n" rule(6)
        for (i = 1; i <= waves; i++) {
            key = wave_of[i]
            line = "| " key " |"
            for (b = 1; b <= 4; b++)
                line = line (wave_rays[key, b] < 1000 ? " - |" : sprintf(" %.0f / %.0f, %.2f |", low[key, "bvh", b], \
                    low[key, "embree", b], low[key, "embree", b] / low[key, "bvh", b]))
            print line
        }
        print "\n## Bounces with builds, ms\n"
        print "| scene | material | rays | build + rays | Embree's best | ratio |\n" rule(6)
        for (i = 1; i <= waves; i++) {
            key = wave_of[i]
            way = embree_of(key)
            printf "| %s | %d | %s | %s | %.2f |\n", key, rays[key], both(key, "bvh"), both(key, way),
                whole(key, way) / whole(key, "bvh")
        }
    }
    if (part == "structures") {
        line = "| scene | material | rays |"
        for (k = 1; k <= ways; k++) line = line " " way_of[k] " |"
        print "\n## Bounces by structure: build + rays, ms\n\n" line "\n" rule(3 + ways)
        for (i = 1; i <= waves; i++) {
            line = "| " wave_of[i] " | " rays[wave_of[i]] " |"
            for (k = 1; k <= ways; k++) line = line " " both(wave_of[i], way_of[k]) " |"
            print line
        }
    }
    if (part == "growth") {
        line = "| scene |"
        for (k = 1; k <= sizes; k++) line = line " " size_of[k] " |"
        print "\n## Growth by pixels: build + camera rays, ms\n\n" line "\n" rule(1 + sizes)
        for (i = 1; i <= scenes; i++) {
            line = "| " scene_of[i] " |"
            for (k = 1; k <= sizes; k++) line = line " " text[scene_of[i], size_of[k]] " |"
            print line
        }
    }
}
