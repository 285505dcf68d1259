#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# mpi_later.sh SOURCE_DIR CMAKE C_COMPILER
# An MPI of which a part is installed after the first configuration is found by the next one. Its compiler, which CMake
# asks for the libraries, is a script at first, and names one that is not there.
set -eu
source=$1 cmake=$2 compiler=$3
real=$(command -v mpicc) || { echo "no mpicc to install"; exit 77; }
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
export PKG_CONFIG_LIBDIR="$tmp"
cat >"$tmp/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.18)
project(later C)
include("$source/cmake/optional_parts.cmake")
cgt_find_MPI()
message(STATUS "MPI: \${CGT_HAVE_MPI}.")
END

# configure WANTED TEXT
configure() {
    "$cmake" -S "$tmp" -B "$tmp/build" -DCMAKE_C_COMPILER="$compiler" -DMPI_C_COMPILER="$tmp/mpicc" >"$tmp/log" 2>&1 ||
        { cat "$tmp/log"; exit 1; }
    grep -q "MPI: $1\.\$" "$tmp/log" || { cat "$tmp/log"; echo "FAILED: $2"; exit 1; }
}
printf '#!/bin/sh\nexec "%s" "$@" | sed "s/-lmpi/-lno_such_mpi/"\n' "$real" >"$tmp/mpicc"
chmod +x "$tmp/mpicc"
configure '' "an MPI without its library is found"
ln -sf "$real" "$tmp/mpicc"
configure ON "MPI is not found once it is whole"
echo "all good"
