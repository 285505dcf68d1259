# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(cgt_preset armhf)
set(cgt_triplet arm-linux-gnueabihf)
set(cgt_qemu qemu-arm)
include("${CMAKE_CURRENT_LIST_DIR}/cross.cmake")
