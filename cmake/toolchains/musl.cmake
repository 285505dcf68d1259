# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# musl on this machine's processor. Static programs: Debian has no more of it than this.
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(cgt_preset musl)
set(cgt_triplet x86_64-linux-musl)
set(cgt_compiler musl-gcc)
set(cgt_runner env)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
