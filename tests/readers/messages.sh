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
LC_ALL=C awk -F '\t' -v files="$work/files" -v root="$source/" -f "$source/tests/support/sentences.awk" \
    "$work/sentences" "$source/tests/readers/messages.tsv"
