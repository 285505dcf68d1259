# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Windows on x86-64, by MinGW-w64 with POSIX threads; programs run by Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(cgt_preset windows)
set(cgt_triplet x86_64-w64-mingw32)
set(cgt_compiler ${cgt_triplet}-gcc-posix)
find_program(cgt_wine NAMES wine64 PATHS /usr/lib/wine)
if(cgt_wine)
    get_filename_component(cgt_wine_prefix "${CMAKE_CURRENT_LIST_DIR}/../../build/wine" ABSOLUTE)
    set(cgt_runner env WINEDEBUG=-all "WINEPREFIX=${cgt_wine_prefix}" "${cgt_wine}")
endif()
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CGT_z_LIBRARY /usr/${cgt_triplet}/lib/libz.a CACHE FILEPATH "not that of a DLL")
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
