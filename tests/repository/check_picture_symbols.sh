#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_picture_symbols.sh HEADER STATIC_LIBRARY SHARED_LIBRARY NM OBJDUMP
# libcgt-picture, or libcgt-mpi, exports exactly what its header declares; every symbol of the archive begins with cgt_ and is hidden,
# and none can change: check_symbols.sh has the reasons.
set -eu
header=$1 static=$2 shared=$3 nm=$4 objdump=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C
status=0
fail() {
    echo "FAILED: $1"
    sed 's/^/    /' "$2"
    status=1
}

sh "${0%/*}/check_exports.sh" "$nm" "$shared" "$header" || status=1

"$nm" --defined-only --extern-only "$static" | awk 'NF == 3 && $3 !~ /^cgt_/ { print $3 }' >"$work/alien"
[ -s "$work/alien" ] && fail "symbols without cgt_ in $static" "$work/alien"
"$objdump" -t "$static" | awk '$2 == "g" && !/\.hidden/ && !/\*UND\*/' >"$work/visible"
[ -s "$work/visible" ] && fail "symbols of $static that are not hidden" "$work/visible"
"$objdump" -t "$static" | awk '/ O \.(data|bss)[^.]/' >"$work/variables"
[ -s "$work/variables" ] && fail "variables that can change in $static" "$work/variables"
exit $status
