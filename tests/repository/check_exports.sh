#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_exports.sh NM|OBJDUMP SHARED_LIBRARY HEADER...      OBJDUMP for a DLL
# A shared library exports exactly what its headers declare with CGT_API, as of a version where it has such.
set -eu
nm=$1 library=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C
case $library in
*.dll) "$nm" -p "$library" | sed -nE '/^\[Ordinal/,$s/^[[:space:]]+\[ *[0-9]+\] ([A-Za-z_].*)/\1/p' ;;
*) "$nm" -D --defined-only "$library" | awk 'NF == 3 && $2 != "A" { sub(/@.*/, "", $3); print $3 }' ;;
esac | sort -u >"$work/exported"
cat "$@" | tr '\n' ' ' | tr ';' '\n' | sed -nE 's/.*CGT_API [^(]*[ *](cgt_[a-z0-9_]+)\(.*/\1/p' | sort -u >"$work/declared"
[ -s "$work/declared" ] || { echo "FAILED: no CGT_API in $*"; exit 1; }
if ! diff "$work/declared" "$work/exported"; then
    echo "FAILED: the headers (<) and the exports of $library (>) differ"
    exit 1
fi
echo "$(wc -l <"$work/exported") exports"
