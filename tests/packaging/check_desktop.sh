#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_desktop.sh SOURCE_DIR
# The desktop entry of cgt-view and its types of files: each ending that a reader takes has a type or is named as one
# that means other things, too; the entry names each type of its own, and no other that nobody has; the tools of the
# desktop, where they are there, accept both.
set -u
desktop=$1/packaging/desktop
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT

endings=$(sed -n '/^#define TRAJECTORY_READERS/,/^$/p' "$1/programs/trajectory/trajectory_formats.h" |
    grep -oE '"[^"]*"' | grep -oE '\.[a-z0-9]+')
[ "$(echo "$endings" | wc -l)" -gt 20 ] || fail "no endings of readers are found"
for ending in $endings; do
    grep -qF "pattern=\"*$ending\"" "$desktop/cgt.xml" || grep -qE "^ .*\\$ending( |\$)" "$desktop/cgt.xml" ||
        fail "$ending has no type in cgt.xml, and is not left out there"
done

types=$(sed -n 's/^MimeType=//p' "$desktop/cgt-view.desktop" | tr ';' ' ')
own=$(sed -n 's/.*<mime-type type="\([^"]*\)".*/\1/p' "$desktop/cgt.xml")
for type in $own; do
    case " $types " in
    *" $type "*) ;;
    *) fail "the entry leaves out $type" ;;
    esac
done
for type in $types; do
    echo "$own" | grep -qxF "$type" && continue
    case $type in
    model/*) ;; # of shared-mime-info
    *) fail "nobody has the type $type" ;;
    esac
done

if command -v desktop-file-validate >/dev/null; then
    desktop-file-validate "$desktop/cgt-view.desktop" >"$tmp/said" 2>&1 && [ ! -s "$tmp/said" ] ||
        fail "the entry: $(cat "$tmp/said")"
fi
if command -v update-mime-database >/dev/null; then
    mkdir -p "$tmp/mime/packages"
    cp "$desktop/cgt.xml" "$tmp/mime/packages"
    update-mime-database "$tmp/mime" >"$tmp/said" 2>&1 || fail "the types: $(cat "$tmp/said")"
    grep -qF 'chemical/x-xyz:*.xyz' "$tmp/mime/globs" || fail "no type of .xyz: $(cat "$tmp/said")"
fi
[ $failures -eq 0 ] || exit 1
echo "$(echo "$own" | wc -l) types of files"
