# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# 32-bit x86. An x86-64 kernel runs its programs without an emulator, if it was built to.
set(CMAKE_SYSTEM_PROCESSOR i686)
set(cgt_triplet i686-linux-gnu)
set(cgt_runner /usr/${cgt_triplet}/lib/ld-linux.so.2 --library-path /usr/${cgt_triplet}/lib)
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
