#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_components.sh BUILD_DIR CMAKE SOURCE_DIR
# Each component of an installation, alone in a prefix, has what components.txt lists, and nothing else; together they are
# what is installed without a component; the programs work without the others; and the links of the texts hold there.
build=$1 cmake=$2 source=$3
. "$source/tests/repository/findings.sh"
soname=$(sed -nE 's/^#define CGT_VERSION_STRING "([0-9]+\.[0-9]+)\.[0-9]+"$/\1/p' "$source/include/cgt/version.h")
libdir=$(sed -nE 's/^CMAKE_INSTALL_LIBDIR:[A-Z]+=//p' "$build/CMakeCache.txt")

# files PREFIX: the paths of its files and links, as components.txt writes them
files() {
    (cd "$work/$1" && find . ! -type d) | sed -E "s|^\./||; s|^$libdir/|lib/|; s/$soname(\.[0-9]+)?/VERSION/" | sort -u
}

"$cmake" --install "$build" --prefix "$work/all" >"$work/log" || fail "cmake --install" "$work/log"
files all >"$work/all.files"
for component in library programs documentation; do
    "$cmake" --install "$build" --component $component --prefix "$work/$component" >"$work/log" ||
        fail "cmake --install --component $component" "$work/log"
    files $component | tee "$work/$component.files" | awk -v component=$component '
        FNR == NR {
            if ($1 == component) { pattern[++n] = "^" $NF "$"; optional[n] = $2 == "?" }
            next
        }
        {
            for (i = 1; i <= n && $0 !~ pattern[i]; i++) { }
            if (i > n) print "not of this component: " $0
            else seen[i]
        }
        END { for (i = 1; i <= n; i++) if (!(i in seen) && !optional[i]) print "missing: " pattern[i] }
        ' "$source/tests/packaging/components.txt" - >"$work/wrong"
    [ ! -s "$work/wrong" ] || fail "component $component" "$work/wrong"
done
cd "$work"
sort -u library.files programs.files documentation.files | diff all.files - >wrong ||
    fail "all (<) and the components together (>)" wrong

# every link between the texts holds where library and documentation are installed, and the example is the tree's
cp -r library/share documentation/
doc=documentation/share/doc/cgt
[ -s $doc/README.md ] && [ -s $doc/docs/guide/api.md ] && [ -s $doc/LICENSE ] && [ -s $doc/NEWS ] &&
    cmp $doc/examples/simulate.c "$source/examples/simulate.c" >log 2>&1 &&
    cmp $doc/examples/data/pour2k.lammpstrj "$source/examples/data/pour2k.lammpstrj" >>log 2>&1 || fail "texts in $doc" log
(cd $doc && find . -name '*.md' | while read -r text; do
    tr '\n' ' ' <"$text" | grep -o '](\([^)]*\))' | sed -e 's/^](//' -e 's/[)#].*$//' | grep -v '^https*:' | while read -r link; do
        [ -z "$link" ] || [ -e "$(dirname "$text")/$link" ] || echo "$text: no file for the link $link"
    done
done) >wrong
[ ! -s wrong ] || fail "links of the installed texts" wrong

if [ -e programs/bin/cgt-render ]; then
    programs/bin/cgt-render -q -s 64x48 -o picture.png "$source/examples/data/caffeine.xyz" >log 2>&1 && [ -s picture.png ] ||
        fail "cgt-render, alone" log
fi
[ $status -ne 0 ] || wc -l library.files programs.files documentation.files | sed '$d'
exit $status
