#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_picture_symbols.sh HEADER STATIC_LIBRARY SHARED_LIBRARY NM OBJDUMP
# libcgt-picture, libcgt-figure or libcgt-mpi exports exactly what its header declares, with color.h; its archive is as
# check_archive.sh wants it.
set -eu
header=$1 static=$2 shared=$3 nm=$4 objdump=$5
status=0
case $header in
*/picture.h) more=${header%picture.h}color.h ;;
*) more= ;;
esac
sh "${0%/*}/check_exports.sh" "$nm" "$shared" "$header" ${more:+"$more"} || status=1
sh "${0%/*}/check_archive.sh" "$nm" "$objdump" "$static" || status=1
exit $status
