#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_docs.sh SOURCE_DIR
# Everything that the texts refer to exists: the targets of links, their headings, and source files named in
# `backticks`, by path from the root or by name alone; and files that comments of C name with a folder. Files that an
# instruction tells to create, and those of other projects, are excepted below.
set -eu
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fictional='bounds_reduce.c windows_threads.c'
foreign='asm/spu.h runtime/spu/spu_helpers.h'

find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print | sed 's|^\./||' >"$work/files"
grep '\.md$' "$work/files" | LC_ALL=C sort >"$work/texts"

# headings FILE: prints the anchors of its headings
headings() {
    sed -n 's/^##* //p' "$1" | tr -d '`*' | tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9_ -]//g; s/ /-/g'
}

while read -r text; do
    folder=$(dirname "$text")
    # links may be broken over two lines; every "](" begins one
    tr '\n' ' ' <"$text" | grep -o '](\([^)]*\))' | sed 's/^](//; s/)$//' | grep -v '^https*:' | while read -r link; do
        path=${link%%#*}
        target=$text
        [ -z "$path" ] || target=$folder/$path
        [ -e "$target" ] || { echo "$text: no file for the link $link"; continue; }
        case $link in
        *\#*) headings "$target" | grep -qxF -e "${link#*#}" || echo "$text: no heading for the link $link" ;;
        esac
    done
    grep -o '`[A-Za-z0-9_./-]*[A-Za-z0-9_]\.\(c\|h\|cpp\|sh\|cmake\|awk\|gnuplot\)`' "$text" | tr -d '`' | sort -u | while read -r name; do
        case " $fictional " in *" ${name##*/} "*) continue ;; esac
        grep -qE "(^|/)$name\$" "$work/files" || echo "$text: no file $name"
    done
done <"$work/texts" >"$work/missing"

# a name is the end of some path
find src simd include backends bench figure programs examples tests -name '*.[ch]' -exec grep '\.\(c\|h\|md\|sh\)\>' {} + |
    awk -v foreign="$foreign" 'BEGIN { split(foreign, list); for (i in list) known[list[i]] }
    FNR == NR { path = $0; do known[path]; while (sub(/^[^\/]*\//, "", path)); next }
    {
        source = $0
        sub(/:.*/, "", source)
        rest = substr($0, length(source) + 2)
        if (rest ~ /^ *#/)
            next
        while (match(rest, /[A-Za-z0-9_]+(\/[A-Za-z0-9_]+)+\.(c|h|md|sh)([^A-Za-z0-9_]|$)/)) {
            name = substr(rest, RSTART, RLENGTH)
            sub(/[^A-Za-z0-9_]$/, "", name)
            if (!(name in known))
                print source ": no file " name
            rest = substr(rest, RSTART + RLENGTH)
        }
    }' "$work/files" - >>"$work/missing"
! command -v python3 >/dev/null || python3 scripts/drawings.py --check >>"$work/missing" 2>&1 ||
    echo "scripts/drawings.py --check fails" >>"$work/missing"
cat "$work/missing"
[ ! -s "$work/missing" ] || exit 1
echo "$(wc -l <"$work/texts") texts"
