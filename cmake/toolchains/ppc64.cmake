# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
set(CMAKE_SYSTEM_PROCESSOR ppc64)
set(cgt_triplet powerpc64-linux-gnu)
set(cgt_qemu qemu-ppc64)
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
