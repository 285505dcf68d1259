# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# What the tables and figures of cgt-bench share: read before them (awk -f columns.awk -f ...), it takes heads and
# comments of tab-separated files out of their way.

function column(name) { return name in at ? $(at[name]) : "" }

# a value of the configuration: "packet" of "kd,traversal=packet,layout=mixed"
function value_of(config, name) {
    if (!sub("^.*," name "=", "", config)) return ""
    sub(/,.*/, "", config)
    return config
}

function structure_of(config) { sub(/,.*/, "", config); return config }

FNR == 1 {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    next
}
/^#/ { next }
