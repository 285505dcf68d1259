# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The tables of cgt-bench rays, after columns.awk, with all kinds of rays of a configuration under one key: part,
# scene, config. Random rays are those that search for the nearest hit. The part of the next file is in `part`.

{
    key = part SUBSEP column("scene") SUBSEP column("config")
    if (!(key in known)) { known[key] = 1; keys[++key_count] = key }
    name = column("kind")
    if (name != "random" || column("query") == "nearest") {
        rays[key, name] = column("rays")
        ns[key, name] = column("ns_per_ray")
        visits[key, name] = rounded("nodes_per_ray") " / " rounded("leaves_per_ray") " / " rounded("tests_per_ray")
    }
    for (cell in at) value[key, cell] = column(cell) # the structure's are the same in all rows
    exact_steps += column("exact_steps")
    loops += column("rope_loops")
}

function rounded(name) { return column(name) == "-" ? "-" : sprintf("%.3g", column(name)) }
function ms(key, name) { return ns[key, name] * rays[key, name] * 1e-6 }
