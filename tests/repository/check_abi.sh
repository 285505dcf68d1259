#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_abi.sh SOURCE_DIR CC
# scripts/abi.sh accepts the headers as they are; and, where they are released, what is added but not what breaks.
set -eu
source=$1
export CC="$2"
"$source/scripts/abi.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/scripts" "$work/tests/repository/abi"
cp -R "$source/include" "$work"
cp "$source/scripts/abi.sh" "$work/scripts"
"$work/scripts/abi.sh" --write >"$work/log"
header=$work/include/cgt/cgt.h

# expect STATUS WORD PATTERN REPLACEMENT: of a header that was changed so
expect() {
    cp "$source/include/cgt/cgt.h" "$header"
    sed -i "s/$3/$4/" "$header"
    ! cmp -s "$source/include/cgt/cgt.h" "$header" || { echo "FAILED: nothing to change: $3"; exit 1; }
    status=0
    "$work/scripts/abi.sh" >"$work/log" 2>&1 || status=$?
    [ $status -eq "$1" ] && grep -q "$2" "$work/log" || { cat "$work/log"; echo "FAILED: $4: $status"; exit 1; }
}
expect 0 keeps '^CGT_API const char \*cgt_get_version(void);' '&\nCGT_API int cgt_new_function(int a);'
expect 1 cgt_get_version '^CGT_API const char \*cgt_get_version(void);' ''
expect 1 cgt_ambient_options '^    uint32_t seed;' '    uint64_t seed;'
expect 1 cgt_get_version '^CGT_API const char \*cgt_get_version(void);' 'CGT_API const char *cgt_get_version(int a);'
expect 1 cgt_result '    CGT_OK = 0,' '    CGT_OK = 0, CGT_ERROR_NEW,'
