# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
set(CMAKE_SYSTEM_PROCESSOR s390x)
set(cgt_triplet s390x-linux-gnu)
set(cgt_qemu qemu-s390x)
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
