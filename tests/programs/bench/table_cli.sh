# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Shared by the tests of cgt-bench's command lines, whose output is a table. Sourced like cli.sh, which it sources
# itself.
. "$(dirname "$0")/../cli.sh"

is() {
    [ "$2" = "$3" ] || fail "$1 is \"$2\", not \"$3\""
}

# refuses CODE PATTERN ARGUMENTS...: an error with a text, and nothing on standard output.
refuses() {
    refused_code=$1
    refused_text=$2
    shift 2
    run "$refused_code" "$@"
    says err "$refused_text"
    [ ! -s "$tmp/stdout" ] || fail "output in addition to an error: cgt-bench $*"
}

# holds NAME CONDITION: every row of the table in $tmp/stdout meets an awk condition on its columns, c["name"].
holds() {
    condition=$(printf '%s' "$2" | tr '\n' ' ') # not every awk takes an expression in several lines
    awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; i++) name[i] = $i; columns = NF; next }
        { for (i = 1; i <= NF; i++) c[name[i]] = $i
          rows++
          if (NF != columns || !('"$condition"')) { bad = 1; print "row " NR ": " $0 } }
        END { exit bad || !rows }' "$tmp/stdout" >"$tmp/bad" || fail "$1: $(head -n 2 "$tmp/bad")"
}

# column NAME: the distinct values of a column, in order.
column() {
    awk -F '\t' -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i; next }
        !seen[$at]++ { printf "%s%s", n++ ? " " : "", $at }' "$tmp/stdout"
}
