#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# man_page.sh HELP2MAN PROGRAM WHAT_IT_DOES PAGE
# Writes a program's man page from its --help and --version. Headings of groups of options, which --help indents by one
# blank, become headings of the page. The date is that of SOURCE_DATE_EPOCH, or today's.
set -eu
help2man=$1 program=$2 summary=$3 page=$4
# one line for each text: it would be broken at 79 columns, and help2man takes some of the rest for paragraphs
export CGT_HELP_WIDTH=1000
LC_ALL=C "$help2man" --no-info --section=1 --name="$summary" --output="$page.part" "$program"
sed -e '/^\.IP$/{' -e 'N' -e 's/^\.IP\n\([A-Z][^:]*\):$/.SS "\1"/' -e '}' "$page.part" >"$page.whole"
rm -f "$page.part"
mv "$page.whole" "$page"
