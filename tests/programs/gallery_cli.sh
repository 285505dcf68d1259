#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Runs the commands of docs/guide/pictures.md, with small pictures; those whose models are not installed are left out.
#   gallery_cli.sh CGT_RENDER DATA_DIR GUIDE [EMULATOR...]
render=$1
folder=$2
guide=$3
shift 3
set -- "$render" "$folder" "$@"
. "$(dirname "$0")/cli.sh"
cp "$data"/*.lammpstrj "$data"/*.xyz "$tmp"
commands=0
sed -n 's/^    cgt-render //p' "$guide" >"$tmp/commands"
while read -r command; do
    input=${command##* }
    case $input in /*) [ -e "$input" ] || continue ;; esac
    case $command in
    *--title* | *--time* | *--colorbar* | *--axes*)
        (cd "$tmp" && $emulator "$program" -q -n --title A caffeine.xyz) >/dev/null 2>&1 || continue ;; # no font
    esac
    rm -f "$tmp"/*.png
    eval "run 0 -q -s 64x48 -a 1 $command -s 64x48 -a 1" </dev/null
    case $command in
    *--print-settings*) says out '^style = paper' ;;
    *) [ "$(find "$tmp" -name '*.png' | wc -l)" -eq 1 ] || fail "no picture: cgt-render $command" ;;
    esac
    commands=$((commands + 1))
done <"$tmp/commands"
[ $commands -ge 2 ] || fail "only $commands commands in $guide"
[ $failures -eq 0 ] || exit 1
echo "$commands commands"
