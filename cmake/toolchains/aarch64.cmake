# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(cgt_triplet aarch64-linux-gnu)
set(cgt_qemu qemu-aarch64)
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
