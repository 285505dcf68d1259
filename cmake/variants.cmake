# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The variant table. All of src/kernel/ is compiled once per row, with the row's flags and
#     -DCGT_VARIANT=<name>  -DCGT_VARIANT_<NAME>=1  -DCGT_LANES=<lanes>
# and src/dispatch/variant.c learns of the row by -DCGT_HAVE_<NAME>=1. Adding a width is adding a row here and one in the
# table of src/dispatch/variant.c. Rows go from narrow to wide.
#
#   NAME     of the variant and of its object library, cgt_kernel_<name>
#   LANES    floats in a vector
#   WHERE    a condition of the preprocessor that the compiler must meet; absent: any machine
#   FLAGS    of the compiler; they come after CFLAGS, so a -march there does not take them away
#   DEFINES  further definitions
#
# The row `spu` is no machine's that runs the library: its kernels are compiled by the SPU's own compiler alone
# (spu_programs.cmake), for programs of an SPE, and no host has it.
#
# CGT_ONLY_VARIANTS leaves rows out that a build does not want, but never the portable one: any machine runs that.
include(CheckCCompilerFlag)
include(CheckCSourceCompiles)

set(CGT_ONLY_VARIANTS "" CACHE STRING "Rows of the variant table to build in addition to portable; empty: all that the compiler can")
set(CGT_VARIANTS "") # the rows that are built
set(cgt_known_variants "")

function(cgt_variant)
    cmake_parse_arguments(row "" "NAME;LANES;WHERE" "FLAGS;DEFINES" ${ARGN})
    if(row_UNPARSED_ARGUMENTS OR NOT row_NAME MATCHES "^[a-z0-9_]+$" OR NOT row_LANES MATCHES "^[0-9]+$")
        message(FATAL_ERROR "cmake/variants.cmake: bad row: ${ARGN}")
    endif()
    set(cgt_known_variants ${cgt_known_variants} ${row_NAME} PARENT_SCOPE)
    string(TOUPPER "${row_NAME}" upper)
    set(CGT_VARIANT_${row_NAME}_FLAGS ${row_FLAGS} PARENT_SCOPE)
    set(CGT_VARIANT_${row_NAME}_DEFINES ${row_DEFINES} CGT_VARIANT=${row_NAME} CGT_VARIANT_${upper}=1
                                        CGT_LANES=${row_LANES} PARENT_SCOPE)
    set(CGT_VARIANT_${row_NAME}_HAVE CGT_HAVE_${upper}=1 PARENT_SCOPE)
    if(CGT_ONLY_VARIANTS AND NOT row_NAME STREQUAL portable AND NOT row_NAME IN_LIST CGT_ONLY_VARIANTS)
        return()
    endif()
    set(CMAKE_REQUIRED_QUIET ON) # a row that is not for this machine is no failure
    if(row_WHERE)
        check_c_source_compiles("#if !(${row_WHERE})\n#error not this machine\n#endif\nint main(void) { return 0; }"
                                CGT_MACHINE_HAS_${upper})
        if(NOT CGT_MACHINE_HAS_${upper})
            return()
        endif()
    endif()
    if(row_FLAGS)
        string(REPLACE ";" " " flags "${row_FLAGS}")
        check_c_compiler_flag("${flags}" CGT_COMPILER_HAS_${upper})
        if(NOT CGT_COMPILER_HAS_${upper})
            message(STATUS "Variant ${row_NAME}: left out, the compiler refuses ${flags}")
            return()
        endif()
    endif()
    set(CGT_VARIANTS ${CGT_VARIANTS} ${row_NAME} PARENT_SCOPE)
endfunction()

# GCC for Windows stores wide vectors on the stack as if it were aligned to them, which it is not there (GCC bug 54412):
# the assembler turns such moves into those that need no alignment.
set(cgt_wide_stack "")
if(WIN32 AND CMAKE_C_COMPILER_ID STREQUAL "GNU")
    set(cgt_wide_stack -Wa,-muse-unaligned-vector-move)
endif()

# ---- The table --------------------------------------------------------------------------------------------------

# A WebAssembly module that has vectors anywhere loads only where they run: -msimd128 in CFLAGS decides which row there
# is.
cgt_variant(NAME portable LANES 4 WHERE "!defined(__wasm_simd128__)" DEFINES CGT_SPU_PORTABLE)
cgt_variant(NAME sse      LANES 4 WHERE "defined(__x86_64__)"  FLAGS -msse4.1)
cgt_variant(NAME neon     LANES 4 WHERE "defined(__aarch64__)")
cgt_variant(NAME wasm     LANES 4 WHERE "defined(__wasm_simd128__)")
cgt_variant(NAME spu      LANES 4 WHERE "defined(__SPU__)")
cgt_variant(NAME avx2     LANES 8 WHERE "defined(__x86_64__)"  FLAGS -mavx2 -mfma -mbmi ${cgt_wide_stack})
cgt_variant(NAME avx512   LANES 16 WHERE "defined(__x86_64__)" FLAGS -mavx2 -mfma -mbmi -mavx512f -mavx512bw -mavx512dq
                                                                     -mavx512vl -mprefer-vector-width=512 ${cgt_wide_stack})

# ---- Its use ----------------------------------------------------------------------------------------------------

# cgt_use_variant(target row): compiles the target as the row says.
function(cgt_use_variant target row)
    target_compile_options(${target} PRIVATE ${CGT_VARIANT_${row}_FLAGS})
    target_compile_definitions(${target} PRIVATE ${CGT_VARIANT_${row}_DEFINES})
    if(CGT_SANITIZE MATCHES "undefined" AND NOT CGT_SANITIZE_ALL) # half the compiler's time; what is used ASan sees
        target_compile_options(${target} PRIVATE -fno-sanitize=pointer-overflow)
    endif()
endfunction()

# cgt_list_variants(target): tells the target which rows exist.
function(cgt_list_variants target)
    foreach(row IN LISTS CGT_VARIANTS)
        target_compile_definitions(${target} PRIVATE ${CGT_VARIANT_${row}_HAVE})
    endforeach()
endfunction()

foreach(name IN LISTS CGT_ONLY_VARIANTS)
    if(NOT name IN_LIST cgt_known_variants)
        message(FATAL_ERROR "CGT_ONLY_VARIANTS: no row is named ${name}; there are: ${cgt_known_variants}")
    endif()
endforeach()
string(REPLACE ";" ", " cgt_variants_text "${CGT_VARIANTS}")
message(STATUS "Variants: ${cgt_variants_text}")
