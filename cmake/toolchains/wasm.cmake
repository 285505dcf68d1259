# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# WebAssembly with vectors and threads, by Debian's Emscripten; programs run in Node.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_C_FLAGS_INIT "-msimd128 -pthread")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-O1 -sALLOW_MEMORY_GROWTH=1 -Wno-pthreads-mem-growth")
get_filename_component(cgt_wasm_sysroot "${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot-wasm" ABSOLUTE)
list(PREPEND CMAKE_FIND_ROOT_PATH "${cgt_wasm_sysroot}")
find_program(cgt_node NAMES node nodejs)
if(cgt_node) # Emscripten of those years takes any fetch for a browser's
    set(CMAKE_CROSSCOMPILING_EMULATOR "${cgt_node};--no-experimental-fetch")
endif()
