#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# messages.sh SOURCE PROGRAM...
# Looks whether the tests bring out every sentence of the readers. Sentences are the string constants of
# programs/trajectory and programs/mesh that have two words. The programs, tests of the readers, write what they get
# from them to the file that CGT_TEST_MESSAGES names. messages.tsv holds those that no test can bring out, and why.
set -eu
source=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for program in "$@"; do
    CGT_TEST_MESSAGES=$work/said "$program" >"$work/output" 2>&1 || {
        cat "$work/output"
        exit 1
    }
done
sed 's/^[^ ]*cgt-test-[^:]*//' "$work/said" | LC_ALL=C sort -u >"$work/sentences"
find "$source/programs/trajectory" "$source/programs/mesh" -name '*.[ch]' -o -name '*.cpp' |
    LC_ALL=C sort >"$work/files"
LC_ALL=C awk -F '\t' -v files="$work/files" -v root="$source/" '
    # A constant: its longest part without a conversion, and a regular expression for the whole.
    function look(file, text,    count, part, i, longest, pattern) {
        gsub(/\\"/, "\"", text)
        gsub(/%%/, "%", text)
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
        gsub(/#include[^\n]*/, " ", text)
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
            if (!used[i]) { printf "messages.tsv: a test brings out, or nothing says: %s\n", exception[i]; bad = 1 }
        print said " sentences from the tests"
        exit bad
    }' "$work/sentences" "$source/tests/readers/messages.tsv"
