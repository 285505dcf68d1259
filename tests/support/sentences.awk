# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Looks whether each sentence of the source was said. Sentences are the string constants that have two words.
#   awk -F '\t' -v files=LIST -v root=SOURCE/ -f sentences.awk SAID/sentences EXCEPTIONS
# LIST names the files of the source; SAID/sentences has what was said, one a line; EXCEPTIONS those that cannot be
# brought out, and why: a part of the sentence as the source has it, a tab, the reason.

# A constant: its longest part without a conversion, and a regular expression for the whole.
function look(file, text,    count, part, i, longest, pattern) {
    gsub(/\\"/, "\"", text)
    gsub(/%%/, "%", text)
    gsub(/\\[nv]/, "\001", text)
    if (text !~ /[A-Za-z0-9][a-z]*,? [a-z]/ || length(text) < 8) return
    count = split(text, part, /%[-+0-9.*]*[a-z]*|\001/)
    for (i = 1; i <= count; i++) {
        if (length(part[i]) > length(longest)) longest = part[i]
        gsub(/[][\\.^$*+?(){}|]/, "[&]", part[i])
        gsub(/\[\\\]/, "\\\\", part[i])
        gsub(/\[\^\]/, "\\^", part[i])
        pattern = pattern (i > 1 ? ".*" : "") part[i]
    }
    if (longest !~ /[a-z][a-z]/) return
    for (i = 1; i <= said; i++)
        if (index(sentence[i], longest) && sentence[i] ~ pattern) return
    for (i = 1; i <= known; i++)
        if (index(text, exception[i])) { used[i] = 1; return }
    printf "%s: no test brings out: %s\n", substr(file, length(root) + 1), text
    bad = 1
}
function constants(file, text,    at, found, gap) {
    gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, " ", text)
    gsub(/[ \n]\/\/[^\n]*/, " ", text)
    gsub(/\047(\\.|[^\\\047])\047/, "0", text)
    gsub(/\n#include[^\n]*/, "\n", text)
    while (match(text, /"([^"\\]|\\.)*"/)) {
        gap = substr(text, 1, RSTART - 1)
        if (at && gap !~ /^[ \n]*((PRI[a-zA-Z0-9]*|INPUT_BLOWN_UP|TRAJECTORY_[A-Z]*)[ \n]*)?$/) {
            look(file, found)
            found = ""
        } else if (gap ~ /[A-Z]/)
            found = found "\001"
        found = found substr(text, RSTART + 1, RLENGTH - 2)
        text = substr(text, RSTART + RLENGTH)
        at = 1
    }
    look(file, found)
}
FILENAME ~ /sentences$/ { sentence[++said] = $0; next }
/^#/ { next }
{ exception[++known] = $1 }
END {
    while ((getline file <files) > 0) {
        text = ""
        while ((getline line <file) > 0) text = text line "\n"
        close(file)
        constants(file, text)
    }
    for (i = 1; i <= known; i++)
        if (!used[i]) { printf "exceptions: a test brings out, or nothing says: %s\n", exception[i]; bad = 1 }
    print said " sentences from the tests"
    exit bad
}
