# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The tab-separated results of scripts/rays.sh as Markdown, after columns.awk: the shortest times.

function rounded(value) { return sprintf(value < 100 ? "%.3g" : "%.0f", value) }

{
    name = structure_of(column("config"))
    if (!variant) variant = value_of(column("config"), "variant")
    if (!(name in known)) { known[name] = 1; structure[++structures] = name }
    set = column("scene") " | " column("kind") " | " column("order") " | " column("query")
    if (!(set in rays)) { rays[set] = column("rays"); sets[++set_count] = set }
    batch = column("batch") == column("rays") ? "all" : column("batch")
    if (!(batch in known)) {
        known[batch] = 1
        for (i = ++batches; i > 1 && batch != "all" && (size[i - 1] == "all" || size[i - 1] + 0 > batch + 0); i--)
            size[i] = size[i - 1]
        size[i] = batch
    }
    ns[set, batch, name] = column("ns_per_ray_min")
    build[set, name] = column("build_min_ms")
    rate[set, name] = column("mrays_with_build") # of the last row of a set: all
    different += column("different")
}

function print_head(columns, count, last,   i, line, rule) {
    for (i = 1; i <= count; i++) { line = line " " columns[i] " |"; rule = rule "---|" }
    if (last != "") { line = line " " last " |"; rule = rule "---|" }
    print "| scene | rays | order | query |" line "\n|---|---|---|---|" rule
}

# a value for each structure, the best one bold
function values(value, best,   i, cell, line) {
    for (i = 1; i <= structures; i++) {
        cell = value[structure[i]] == "" ? "-" : rounded(value[structure[i]])
        line = line " " (structure[i] == best ? "**" cell "**" : cell) " |"
    }
    return line
}

# the structure with the least time of a set in calls of a size
function fastest(set, batch,   i, best) {
    for (i = 1; i <= structures; i++)
        if ((set, batch, structure[i]) in ns &&
            (best == "" || ns[set, batch, structure[i]] + 0 < ns[set, batch, best] + 0)) best = structure[i]
    return best
}

# to two digits
function about(count,   unit) {
    for (unit = 1; count >= 100 * unit; unit *= 10) continue
    return sprintf("%.0f", int(count / unit + 0.5) * unit)
}

# What is fastest with its build, from how many rays on: "loose-grid, kd from 95000". Of the lines build + rays * ns the
# lowest one, up to a billion rays.
function from_how_many(set,   i, name, now, following, at, from, text) {
    for (i = 1; i <= structures; i++) {
        name = structure[i]
        if ((set, name) in build && (now == "" || build[set, name] + 0 < build[set, now] + 0)) now = name
    }
    for (text = now; now != ""; now = following) {
        following = ""
        for (i = 1; i <= structures; i++) {
            name = structure[i]
            if (!((set, name) in build) || ns[set, "all", name] + 0 >= ns[set, "all", now] + 0) continue
            at = 1e6 * (build[set, name] - build[set, now]) / (ns[set, "all", now] - ns[set, "all", name])
            if (at < 1e9 && (following == "" || at < from)) { following = name; from = at }
        }
        if (following != "") text = text ", " following " from " about(from)
    }
    return text
}

END {
    print "## One call for all rays, nanoseconds a ray, " variant "\n"
    print_head(structure, structures, "with its build, from how many rays on")
    for (s = 1; s <= set_count; s++) {
        split("", value)
        for (i = 1; i <= structures; i++) value[structure[i]] = ns[sets[s], "all", structure[i]]
        print "| " sets[s] " |" values(value, fastest(sets[s], "all")) " " from_how_many(sets[s]) " |"
    }
    print "\n## Build and one call for all rays, millions of rays a second\n"
    print_head(structure, structures, "")
    for (s = 1; s <= set_count; s++) {
        split("", value)
        best = structure[1]
        for (i = 1; i <= structures; i++) {
            value[structure[i]] = rate[sets[s], structure[i]]
            if (value[structure[i]] + 0 > value[best] + 0) best = structure[i]
        }
        print "| " sets[s] " |" values(value, best)
    }
    print "\n## The fastest structure by rays in a call, nanoseconds a ray\n"
    print_head(size, batches, "")
    for (s = 1; s <= set_count; s++) {
        line = ""
        for (b = 1; b <= batches; b++) {
            best = fastest(sets[s], size[b])
            line = line " " (best == "" ? "-" : best " " rounded(ns[sets[s], size[b], best])) " |"
        }
        print "| " sets[s] " |" line
    }
    printf "\nRays that found other hits than in the first structure: %d.\n", different
}
