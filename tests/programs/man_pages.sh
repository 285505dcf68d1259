#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The man pages that the build has made: they have what --help says, and man shows them without a warning.
#   man_pages.sh FOLDER_OF_PAGES FOLDER_OF_PROGRAMS PROGRAM...
# FOLDER_OF_PAGES is none where the build had no help2man: exit code 77.
set -u
pages=$1 folder=$2
shift 2
[ "$pages" != none ] || { echo "no help2man"; exit 77; }
failures=0
fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
for program in "$@"; do
    page=$pages/$program.1
    [ -s "$page" ] || { fail "no $page"; continue; }
    # hyphens are written \-, and \fI\,N\/\fR is N in italics
    sed -e 's/\\f[BIR]//g' -e 's/\\[,/]//g' -e 's/\\-/-/g' "$page" >"$work/text"
    for option in $("$folder/$program" --usage | grep -o -e '--[a-z0-9][a-z0-9-]*' | sort -u); do
        grep -q -e "^\\(-., \\)*$option\\(\$\\|[=[]\\)" "$work/text" || fail "$program.1 has no $option"
    done
    for part in NAME SYNOPSIS DESCRIPTION; do
        grep -qx "\\.SH $part" "$page" || fail "$program.1 has no $part"
    done
    "$folder/$program" --help | sed -n 's/^ \([A-Z][^:]*\):$/\1/p' >"$work/groups"
    while read -r group; do
        grep -qxF ".SS \"$group\"" "$page" || fail "$program.1 has no heading $group"
    done <"$work/groups"
    if command -v man >/dev/null 2>&1; then
        LC_ALL=C.UTF-8 man --warnings -l "$page" >"$work/shown" 2>"$work/warnings" </dev/null || fail "man does not show $program.1"
        [ ! -s "$work/warnings" ] || fail "$program.1: $(head -n 3 "$work/warnings")"
        [ "$(wc -l <"$work/shown")" -gt 20 ] || fail "man shows little of $program.1"
    fi
done
[ $failures -eq 0 ] || exit 1
echo "man pages of $*"
