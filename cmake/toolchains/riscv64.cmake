# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
set(CMAKE_SYSTEM_PROCESSOR riscv64)
set(cgt_triplet riscv64-linux-gnu)
set(cgt_qemu qemu-riscv64)
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
