# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Rewrites the vector casts of an SPU source, (vec_uint4)x, as calls, CLIENT_CAST(vec_uint4, x), of which casts.h makes
# what an SPU does on a little-endian host, too. Comments go. Compound literals and casts to qword stay.

{ source = source $0 "\n" }
END { printf "%s", converted(without_comments(source)) }

function without_comments(text,   out, start, end) {
    while (match(text, /\/\*|\/\//)) {
        start = RSTART
        out = out substr(text, 1, start - 1) " "
        if (substr(text, start, 2) == "//") {
            end = index(substr(text, start), "\n")
            text = end ? substr(text, start + end - 1) : ""
        } else {
            end = index(substr(text, start + 2), "*/")
            if (!end) fail("a comment does not end")
            text = substr(text, start + 2 + end + 1)
        }
    }
    return out text
}

# length of "(type)" at the beginning of the text, else 0
function cast_length(text) {
    if (match(text, /^\([ \t]*vec_(u?char16|u?short8|u?int4|u?llong2|float4|double2)[ \t]*\)/)) return RLENGTH
    if (match(text, /^\([ \t]*vector[ \t]+((un)?signed[ \t]+)?(char|short|int|long[ \t]+long|float|double)[ \t]*\)/))
        return RLENGTH
    return 0
}

# length of a group of parentheses at the beginning of the text
function group_length(text,   depth, i, c) {
    for (i = 1; i <= length(text); i++) {
        c = substr(text, i, 1)
        if (c == "(") depth++
        if (c == ")" && --depth == 0) return i
    }
    fail("parentheses do not match")
}

# length of a cast's operand at the beginning of the text, white space before it included; 0 for a compound literal
function operand_length(text,   blank, n, more) {
    match(text, /^[ \t\n\\]*/)
    blank = RLENGTH
    text = substr(text, blank + 1)
    if (substr(text, 1, 1) == "{") return 0
    n = cast_length(text)
    if (n) {
        more = operand_length(substr(text, n + 1))
        if (more) return blank + n + more
        match(substr(text, n + 1), /^[ \t\n]*\{[^}]*\}/)
        return blank + n + RLENGTH
    }
    if (substr(text, 1, 1) == "(") return blank + group_length(text)
    if (!match(text, /^[A-Za-z_][A-Za-z_0-9]*/)) fail("a cast without operand: " substr(text, 1, 40))
    n = RLENGTH
    if (match(substr(text, n + 1), /^[ \t]*\(/)) n += RLENGTH - 1 + group_length(substr(text, n + RLENGTH))
    return blank + n
}

function converted(text,   out, start, n, more, type) {
    while (match(text, /\([ \t]*(vec_|vector[ \t])/)) {
        start = RSTART
        out = out substr(text, 1, start - 1)
        text = substr(text, start)
        n = cast_length(text)
        more = n ? operand_length(substr(text, n + 1)) : 0
        if (more) {
            type = substr(text, 2, n - 2)
            out = out "CLIENT_CAST(" type ", " converted(substr(text, n + 1, more)) ")"
            text = substr(text, n + more + 1)
        } else {
            out = out "("
            text = substr(text, 2)
        }
    }
    return out text
}

function fail(message) {
    print FILENAME ": " message >"/dev/stderr"
    exit 1
}
