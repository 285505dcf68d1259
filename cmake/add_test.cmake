# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# One line per test:
#   cgt_add_test(<name> <sources>... [LIBRARIES <targets>...] [TIMEOUT <seconds>])
#       A cmocka program. It sees the internal headers and links the static library.
#   cgt_add_variant_test(<name> <sources>... [LIBRARIES ...] [TIMEOUT ...])
#       The same, compiled and run once per row of the variant table, as <name>_<row>.
#   cgt_add_cluster_test(<name> [VARIANTS] [LIBRARIES ...] [TIMEOUT ...])
#       A test from above once more, as <name>_clusters[_<row>], with clusters wherever there are triangles alone, however
#       few, and wherever they lie: clusters/always_clusters.c comes before the library's own choice, which stays in the archive.
#       Not with threads watched, nor where the emulator computes in software: there test_cluster_hits has to do.
#   cgt_add_script_test(<name> <script> <arguments>...)
#       A shell script of tests/; it exits 0 for good, 77 for "not here", anything else for bad.
# All get the emulator where the build is a cross build, a time limit, and the sanitizers' settings.
# CGT_DATA_DIR is examples/data, CGT_TESTS_DIR is tests.

set(cgt_time_scale 1)
if(CMAKE_CROSSCOMPILING OR CGT_SANITIZE)
    set(cgt_time_scale 10)
endif()
set(cgt_test_environment
    "ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1"
    "UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1"
    "TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1")

function(cgt_set_test_properties name seconds)
    if(NOT seconds)
        set(seconds 60)
    endif()
    math(EXPR seconds "${seconds} * ${cgt_time_scale}")
    set_tests_properties(${name} PROPERTIES TIMEOUT ${seconds} ENVIRONMENT "${cgt_test_environment}"
                                            SKIP_RETURN_CODE 77)
endfunction()

function(cgt_add_test name)
    cmake_parse_arguments(test "" "TIMEOUT" "LIBRARIES" ${ARGN})
    add_executable(${name} ${test_UNPARSED_ARGUMENTS})
    cgt_use_c11(${name})
    cgt_list_variants(${name})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
    target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests" "${PROJECT_SOURCE_DIR}/src"
                                               "${PROJECT_SOURCE_DIR}/simd" "${PROJECT_SOURCE_DIR}/backends"
                                               "${PROJECT_SOURCE_DIR}/bench")
    target_compile_definitions(${name} PRIVATE "CGT_DATA_DIR=\"${PROJECT_SOURCE_DIR}/examples/data\""
                                               "CGT_TESTS_DIR=\"${PROJECT_SOURCE_DIR}/tests\"")
    target_link_libraries(${name} PRIVATE cgt_static ${test_LIBRARIES} cgt_cmocka Threads::Threads m)
    add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
    cgt_set_test_properties(${name} "${test_TIMEOUT}")
endfunction()

function(cgt_add_variant_test name)
    foreach(row IN LISTS CGT_VARIANTS)
        cgt_add_test(${name}_${row} ${ARGN})
        cgt_use_variant(${name}_${row} ${row})
    endforeach()
endfunction()

function(cgt_add_cluster_test name)
    cmake_parse_arguments(test "VARIANTS" "" "" ${ARGN})
    if(CGT_SANITIZE MATCHES "thread" OR cgt_soft_emulator)
        return()
    endif()
    set(programs ${name})
    if(test_VARIANTS)
        list(TRANSFORM CGT_VARIANTS PREPEND "${name}_" OUTPUT_VARIABLE programs)
    endif()
    foreach(program IN LISTS programs)
        string(REPLACE "${name}" "${name}_clusters" again "${program}")
        cgt_add_test(${again} "$<TARGET_OBJECTS:${program}>" clusters/always_clusters.c ${test_UNPARSED_ARGUMENTS})
        add_dependencies(${again} ${program})
    endforeach()
endfunction()

function(cgt_add_script_test name script)
    add_test(NAME ${name} COMMAND sh "${CMAKE_CURRENT_SOURCE_DIR}/${script}" ${ARGN}
             WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
    cgt_set_test_properties(${name} 240) # many short runs of a program
endfunction()
