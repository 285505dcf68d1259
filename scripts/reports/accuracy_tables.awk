# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The results of scripts/accuracy.sh as Markdown. The part of the next file is in `part`.

function column(name) { return name in at ? $(at[name]) : "" }
function larger(a, b) { return a + 0 > b + 0 ? a : b }

# "exact", "fast,test=accelerated": what a row's configuration says after its variant
function mode_of(config) { sub(/^.*precision=/, "", config); return config }
function variant_of(config) { sub(/^.*variant=/, "", config); sub(/,.*$/, "", config); return config }

FNR == 1 { section = ""; header = 1 }

# comments before the table
part == "embree" && /^#/ { header = 1; next }

# commented sections behind the table: "# name", then "# columns", then "# rows"
/^#$/ { next }
/^# [a-z]+$/ { section = substr($0, 3); header = 1; next }
/^# / { sub(/^# /, "") }

header {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    header = 0
    next
}

part == "hard" && section == "" {
    config = column("config")
    if (variant_of(config) != variant) next
    row = column("case")
    sub(/: .*/, "", row)
    mode = mode_of(config)
    if (!(row in rows)) { rows[row] = 1; order[++count] = row }
    rays[row, mode] += column("rays")
    missed[row, mode] += column("missed"); invented[row, mode] += column("invented"); wrong[row, mode] += column("wrong")
    if (mode == "exact") {
        t_worst[row] = larger(t_worst[row], column("t_ulp_worst"))
        uv_worst[row] = larger(uv_worst[row], column("uv_ulp_worst"))
        ambiguous[row] += column("ambiguous") * column("rays")
        exact[row] += column("exact_share") * column("rays")
    }
    next
}

part == "real" && section == "" {
    config = column("config")
    if (variant_of(config) != variant) next
    name = column("case")
    sub(/^.*\//, "", name)
    sub(/\.frames$/, "", name)
    real[++real_count] = sprintf("| %s | %s | %.0f | %s/%s/%s | %.2f / %.2f / %.2f | %s | %.2g | %.2g %% |", name,
        mode_of(config), column("ns_per_ray"), column("missed"), column("invented"), column("wrong"),
        column("t_ulp_median"), column("t_ulp_p99"), column("t_ulp_worst"), column("uv_ulp_worst"),
        column("normal_angle_worst"), 100 * column("ambiguous"))
    next
}

(part == "spheres" || part == "triangles") && section == "" {
    price[++price_count] = sprintf("| %s | %s | %s | %s | %.3f | %.1f | %.2f | %s | %s |", column("scene"), column("variant"),
        column("precision"), column("test"), column("ms"), column("cost_percent"), column("wrong_share") * 1e6,
        column("t_ulp_p99"), column("t_ulp_worst"))
    next
}

part == "embree" && section == "" {
    row = column("row")
    config = column("config")
    key = row SUBSEP config
    if (!(row in embree_rows)) { embree_rows[row] = 1; embree_order[++embree_count] = row }
    e_rays[key] += column("rays")
    e_missed[key] += column("missed"); e_invented[key] += column("invented"); e_wrong[key] += column("wrong")
    e_t[key] = larger(e_t[key], column("t_ulp_worst"))
    next
}

function errors(row, mode) {
    if (!((row, mode) in rays)) return "-"
    return missed[row, mode] "/" invented[row, mode] "/" wrong[row, mode]
}

function embree_errors(row, config) {
    return e_missed[row, config] + 0 "/" e_invented[row, config] + 0 "/" e_wrong[row, config] + 0
}

function print_lines(line, lines,   i) { for (i = 1; i <= lines; i++) print line[i] }

END {
    print "## Hard cases, " variant "\n"
    print "| row | rays | watertight | Möller-Trumbore | accelerated | FAST | EXACT | t, ulp | u, v, ulp |" \
          " ambiguous | exact |"
    print "|---|---|---|---|---|---|---|---|---|---|---|"
    for (i = 1; i <= count; i++) {
        row = order[i]
        printf "| %s | %d | %s | %s | %s | %s | %s | %s | %s | %.2g %% | %.2g %% |\n", row, rays[row, "exact"],
            errors(row, "fast,test=watertight"), errors(row, "fast,test=moller-trumbore"),
            errors(row, "fast,test=accelerated"), errors(row, "fast"), errors(row, "exact"), t_worst[row], uv_worst[row],
            100 * ambiguous[row] / rays[row, "exact"], 100 * exact[row] / rays[row, "exact"]
    }
    if (embree_count) {
        print "\n## Against Embree\n"
        print "| row | Embree: rays | errors | t worst, ulp | Embree robust: errors | t worst, ulp | libcgt: rays |" \
              " errors | t worst, ulp |\n|---|---|---|---|---|---|---|---|---|"
    }
    for (i = 1; i <= embree_count; i++) {
        row = embree_order[i]
        printf "| %s | %d | %s | %s | %s | %s | %d | %s | %s |\n", row, e_rays[row, "embree"],
            embree_errors(row, "embree"), e_t[row, "embree"], embree_errors(row, "embree,robust"), e_t[row, "embree,robust"],
            e_rays[row, "libcgt"], embree_errors(row, "libcgt"), e_t[row, "libcgt"]
    }
    print "\n## Real scenes\n"
    print "| scene | precision | ns a ray | missed/invented/wrong | t: median / 99 % / worst, ulp | u, v worst, ulp |" \
          " normal worst, rad | ambiguous |"
    print "|---|---|---|---|---|---|---|---|"
    print_lines(real, real_count)
    print "\n## The price, whole frames\n"
    print "| scene | variant | precision | test | ms | % over FAST | wrong pixels per million | t 99 %, ulp | t worst, ulp |"
    print "|---|---|---|---|---|---|---|---|---|"
    print_lines(price, price_count)
}
