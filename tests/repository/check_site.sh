#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_site.sh SOURCE_DIR
# scripts/site.sh builds the site, all links of which hold; and its check sees a heading and a file that are not there, and
# a script from elsewhere.
set -eu
source=$1
command -v mkdocs >/dev/null || { echo "skipped: no mkdocs (Debian: apt-get install mkdocs)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$source/scripts/site.sh" "$work/site"
for link in '<a href="docs/guide/api.html#no-such-heading">' '<img src="no_such_file.png">' '<script src="https://example.org/x.js">'; do
    echo "$link" >"$work/site/added.html"
    if python3 "$source/scripts/site/check_pages.py" "$work/site" "$source/include/cgt" >"$work/log"; then
        echo "FAILED: nothing said of $link"
        exit 1
    fi
    [ "$(grep -c '^added.html: ' "$work/log")" -eq 1 ] && [ "$(wc -l <"$work/log")" -eq 1 ] || { cat "$work/log"; exit 1; }
done
