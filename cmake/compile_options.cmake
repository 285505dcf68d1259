# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cgt_compile_options: how every file of this repository is compiled, whatever CFLAGS says. Target options come after
# CFLAGS on the command line, so they win.
include(CheckCCompilerFlag)

add_library(cgt_compile_options INTERFACE)
target_compile_features(cgt_compile_options INTERFACE c_std_11)

# -fno-fast-math       exact decisions rest on IEEE arithmetic; a -ffast-math in CFLAGS must not reach them
# -fno-math-errno      sqrt becomes one instruction; nothing here reads errno after it
# -fno-trapping-math   nothing here reads the exception flags; a selection may then become vector code. Values stay
# -ffp-contract=off    a fused multiply-add that the compiler chose gives the two edges of a pair different roundings,
#                      and different bits on machines with and without the instruction: cracks appear, and results
#                      depend on the variant. Where a kernel wants a fused operation it says so by its name.
# The order matters: -fno-fast-math switches the others back to their defaults.
set(cgt_arithmetic_flags -fno-fast-math -fno-math-errno -fno-trapping-math -ffp-contract=off)
# GCC 12.2 for AArch64 turns the sum of unrolled comparisons (n += a[i] == b) into minus the sum where its straight-line
# vectoriser sees them; a test of the suite met it. Loops are still vectorised.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU" AND CMAKE_C_COMPILER_VERSION VERSION_LESS 13
   AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)")
    list(APPEND cgt_arithmetic_flags -fno-tree-slp-vectorize)
endif()
# GCC 12.2, seen for AArch64 and POWER: what a function that is not inlined stores through a pointer is taken for not
# stored (src/kernel/resolve/resolve_packet.c: values that are computed once more, exactly, were lost). The summaries of what
# functions modify are to blame.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU" AND CMAKE_C_COMPILER_VERSION VERSION_GREATER_EQUAL 11
   AND CMAKE_C_COMPILER_VERSION VERSION_LESS 13)
    list(APPEND cgt_arithmetic_flags -fno-ipa-modref)
endif()
# Where floats are computed in wider registers or types (x87 on i386; s390x as C11 without extensions has it), pairs of
# edges are rounded apart, too. src/core/float_environment.h refuses to compile there.
include(CheckCSourceCompiles)
set(CMAKE_REQUIRED_FLAGS "-std=c11")
check_c_source_compiles("#include <float.h>\n_Static_assert(FLT_EVAL_METHOD == 0, \"wider\");\nint main(void) { return 0; }"
                        CGT_FLOATS_ARE_FLOATS)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT CGT_FLOATS_ARE_FLOATS)
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i.86|x86|AMD64|x86_64)$")
        list(APPEND cgt_arithmetic_flags -msse2 -mfpmath=sse)
    endif()
    if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
        list(APPEND cgt_arithmetic_flags -fexcess-precision=fast)
    endif()
endif()
if(CMAKE_C_COMPILER_ID STREQUAL "GNU" AND CMAKE_SIZEOF_VOID_P EQUAL 4)
    list(APPEND cgt_arithmetic_flags -Wno-psabi) # how vectors are passed is nobody else's: such functions are inlined
endif()
set(cgt_warning_flags -Wall -Wextra -Wshadow)
if(WIN32 AND CMAKE_C_COMPILER_ID STREQUAL "GNU")
    # printf as C has it, and files of any size; GCC checks formats by the rules of Microsoft's all the same
    target_compile_definitions(cgt_compile_options INTERFACE __USE_MINGW_ANSI_STDIO=1 _FILE_OFFSET_BITS=64)
    list(APPEND cgt_warning_flags -Wno-format)
endif()
if(CGT_WERROR)
    list(APPEND cgt_warning_flags -Werror)
endif()
target_compile_options(cgt_compile_options INTERFACE ${cgt_arithmetic_flags} ${cgt_warning_flags})

# Below a project that sets no build type the library would be compiled without optimisation, and be 3 to 6 times slower,
# which nobody is told. It is compiled as in Release then, unless CFLAGS choose for themselves.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT CMAKE_C_FLAGS MATCHES "(^| )-O")
    target_compile_options(cgt_compile_options INTERFACE -O3)
    target_compile_definitions(cgt_compile_options INTERFACE NDEBUG)
endif()

if(CGT_SANITIZE)
    set(cgt_sanitize_flags "-fsanitize=${CGT_SANITIZE}" -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(CGT_SANITIZE MATCHES "address") # it sees these itself; more checks of each access take half the compiler's time
        list(APPEND cgt_sanitize_flags -fno-sanitize=null,object-size)
    endif()
    set(CMAKE_REQUIRED_LINK_OPTIONS "-fsanitize=${CGT_SANITIZE}")
    check_c_compiler_flag("-fsanitize=${CGT_SANITIZE}" CGT_SANITIZE_WORKS)
    unset(CMAKE_REQUIRED_LINK_OPTIONS)
    if(NOT CGT_SANITIZE_WORKS)
        message(FATAL_ERROR "CGT_SANITIZE=${CGT_SANITIZE}: the compiler does not know these sanitizers, "
                            "or their run-time library is not installed")
    endif()
    add_compile_options(${cgt_sanitize_flags}) # all folders, test programs included
    add_link_options(${cgt_sanitize_flags})
endif()

# cgt_use_c11(target...): C11 without extensions, with the options above.
function(cgt_use_c11)
    foreach(target IN LISTS ARGN)
        set_target_properties(${target} PROPERTIES C_STANDARD 11 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
        target_link_libraries(${target} PRIVATE cgt_compile_options)
    endforeach()
endfunction()
