# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# What the cross toolchains share. The file that includes this one sets cgt_triplet, and cgt_qemu or cgt_runner: the
# emulator, or a command that runs a program as it is.
# Compilers and C libraries are Debian's: gcc-<triplet>, libc6-dev-<arch>-cross; programs run by qemu-user.
if(NOT CMAKE_SYSTEM_NAME)
    set(CMAKE_SYSTEM_NAME Linux)
endif()
if(NOT cgt_compiler)
    set(cgt_compiler ${cgt_triplet}-gcc)
endif()
find_program(CMAKE_C_COMPILER ${cgt_compiler} REQUIRED)
find_program(cgt_cross_cxx ${cgt_triplet}-g++)
if(cgt_cross_cxx)
    set(CMAKE_CXX_COMPILER "${cgt_cross_cxx}")
endif()

# Libraries built for the target by cmake/toolchains/cross_cmocka.sh lie in build/sysroot-<preset>.
if(NOT cgt_preset)
    set(cgt_preset ${CMAKE_SYSTEM_PROCESSOR})
endif()
set(cgt_cross_sysroot "${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot-${cgt_preset}")
get_filename_component(cgt_cross_sysroot "${cgt_cross_sysroot}" ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH "${cgt_cross_sysroot}" "/usr/${cgt_triplet}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)

if(cgt_qemu)
    find_program(cgt_cross_emulator ${cgt_qemu})
    if(cgt_cross_emulator)
        set(CMAKE_CROSSCOMPILING_EMULATOR "${cgt_cross_emulator};-L;/usr/${cgt_triplet}")
    endif()
elseif(cgt_runner)
    set(CMAKE_CROSSCOMPILING_EMULATOR "${cgt_runner}")
endif()
