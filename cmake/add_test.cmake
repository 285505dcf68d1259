# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# One line per test:
#   cgt_add_test(<name> [SLOW] [STATIC] [PROFILES] <sources>... [LABELS <labels>...] [LIBRARIES <targets>...]
#                [TIMEOUT <seconds>])
#       A cmocka program. It may include the internal headers. It links cgt_test_support and the library: the shared
#       object cgt_visible where there is one. STATIC takes the archive, for tests that replace functions of the library
#       or of the system, or measure; a test that includes a .c file replaces what is in it, and is STATIC by itself.
#       PROFILES: by itself it runs a little of each profile (cgt_add_profile_tests). Where CGT_TEST_SCALE shortens tests
#       each profile does no more than that, and it is left out.
#   cgt_add_variant_test(<name> [SLOW] <sources>... [LABELS ...] [LIBRARIES ...] [TIMEOUT ...])
#       The same, compiled and run once per row of the variant table, as <name>_<row>. CGT_TEST_ROWS names the rows, where
#       all are too many; a test with the label `words` is built for every row all the same.
#   cgt_add_cluster_test(<name> [SLOW] [VARIANTS] [LABELS ...] [LIBRARIES ...] [TIMEOUT ...])
#       Runs a test from above again, as <name>_clusters[_<row>]. clusters/always_clusters.c replaces the library's
#       choice, so that every geometry of triangles gets clusters, however small and wherever it lies.
#       Left out with the thread sanitizer and where the emulator computes in software: hits_sheets covers those.
#       CGT_TEST_CLUSTERS=SHORT runs the heavy loops less often, OFF leaves these tests out.
#   cgt_add_profile_tests(<name> <profiles>... [LABELS ...] [TIMEOUT ...])
#       Runs the program of a test from above again, once per profile, which is its argument, as <name>_<profile>.
#   cgt_add_script_test(<name> [SLOW] <script> <arguments>... [LABELS ...] [INPUTS <paths>...])
#       A shell script. Exit code 0: passed, 77: not possible here, anything else: failed. With INPUTS it runs only when
#       one of these has changed since it last passed: tests/repository/when_changed.sh.
# All get the emulator of a cross build, a time limit, and the sanitizers' settings.
# A test with the label `platform`, `system` or `words` belongs to the target platform_tests, too: a system may have no
# more than these need. The target test_programs builds what the tests run, and no program beside that.
# SLOW: takes more than half a second, or runs programs that take long to build. All others get the label `quick`, and
# the target quick_tests builds them.
# CGT_DATA_DIR is examples/data, CGT_TESTS_DIR is tests.
#
# Labels say which builds a test is worth running in. CGT_TEST_LABELS selects by them.
#   threads       the thread sanitizer can find something: several threads share data
#   workers       several threads share data in the ways that another test with the label threads has, and it takes long
#   isa           another instruction set can break it: vector words, kernels, filters
#   endian        the byte order can break it: readers, packed words, integers of several limbs
#   words         the vector words of simd/
#   platform      another processor, C library or compiler can break it
#   system        another operating system or C library can break it: threads, memory, the floating-point environment
#   programs      runs cgt-bench, an example, or the files that they share
#   spu           runs what the SPU's compiler made
#   repository    checks the sources, the build and the installed package
set(CGT_TEST_LABELS "" CACHE STRING "Build and define only tests with one of these labels; empty: all")
set(CGT_TEST_ROWS "" CACHE STRING "Rows of the variant table that tests by row are built for; empty: all")
set(CGT_TEST_CLUSTERS FULL CACHE STRING "Tests that run again with clusters: FULL, SHORT, OFF")

add_custom_target(test_programs)
add_custom_target(quick_tests)
add_custom_target(platform_tests)

set(cgt_time_scale 1)
if(CMAKE_CROSSCOMPILING OR CGT_SANITIZE)
    set(cgt_time_scale 10)
endif()
set(cgt_test_environment
    "ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1"
    "UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1"
    "TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1")

# cgt_test_selected(<variable> <labels>...): whether CGT_TEST_LABELS selects a test with these labels.
function(cgt_test_selected variable)
    set(selected OFF)
    foreach(label IN LISTS ARGN)
        if(NOT label MATCHES "^(threads|workers|isa|endian|words|platform|system|programs|spu|repository)$")
            message(FATAL_ERROR "cmake/add_test.cmake: no test label is named ${label}")
        endif()
        if(label IN_LIST CGT_TEST_LABELS)
            set(selected ON)
        endif()
    endforeach()
    if(NOT CGT_TEST_LABELS)
        set(selected ON)
    endif()
    set(${variable} ${selected} PARENT_SCOPE)
endfunction()

# cgt_set_test_properties(<name> <seconds> <labels>...)
function(cgt_set_test_properties name seconds)
    math(EXPR seconds "${seconds} * ${cgt_time_scale}")
    set_tests_properties(${name} PROPERTIES TIMEOUT ${seconds} ENVIRONMENT "${cgt_test_environment}"
                                            SKIP_RETURN_CODE 77 LABELS "${ARGN}")
    if(CMAKE_CROSSCOMPILING AND WIN32) # two programs that start Wine at once can hang
        set_tests_properties(${name} PROPERTIES RESOURCE_LOCK wine)
    endif()
endfunction()

function(cgt_add_test name)
    cmake_parse_arguments(test "SLOW;STATIC;PROFILES" "TIMEOUT" "LABELS;LIBRARIES" ${ARGN})
    cgt_test_selected(selected ${test_LABELS})
    if(NOT selected)
        return()
    endif()
    add_executable(${name} ${test_UNPARSED_ARGUMENTS})
    cgt_use_c11(${name})
    cgt_list_variants(${name})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests"
                                             BUILD_RPATH "${PROJECT_BINARY_DIR}/modules") # readers load a module
    target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests" "${PROJECT_SOURCE_DIR}/src"
                                               "${PROJECT_SOURCE_DIR}/simd" "${PROJECT_SOURCE_DIR}/backends"
                                               "${PROJECT_SOURCE_DIR}/bench" "${PROJECT_SOURCE_DIR}/picture"
                                               "${PROJECT_SOURCE_DIR}/figure")
    target_compile_definitions(${name} PRIVATE "CGT_DATA_DIR=\"${PROJECT_SOURCE_DIR}/examples/data\""
                                               "CGT_TESTS_DIR=\"${PROJECT_SOURCE_DIR}/tests\"")
    foreach(source IN LISTS test_UNPARSED_ARGUMENTS)
        if(source MATCHES "\\.c$")
            file(STRINGS ${source} lines REGEX "^# *include \".*\\.c\"")
            if(lines)
                set(test_STATIC ON)
            endif()
        endif()
    endforeach()
    if(TARGET cgt_visible AND NOT test_STATIC) # before the archive, of which then nothing is taken
        target_link_libraries(${name} PRIVATE cgt_visible)
    endif()
    target_link_libraries(${name} PRIVATE ${test_LIBRARIES} cgt_test_support)
    add_dependencies(test_programs ${name})
    if(test_PROFILES AND cgt_test_scale)
        return()
    endif()
    add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
    if(NOT test_TIMEOUT)
        set(test_TIMEOUT 60)
    endif()
    if(NOT test_SLOW)
        list(APPEND test_LABELS quick)
        add_dependencies(quick_tests ${name})
    endif()
    if(test_LABELS MATCHES "(^|;)(platform|system|words)(;|$)")
        add_dependencies(platform_tests ${name})
    endif()
    cgt_set_test_properties(${name} ${test_TIMEOUT} ${test_LABELS})
endfunction()

# cgt_run_less(<name>): the heavy loops less often.
function(cgt_run_less name)
    if(NOT cgt_test_scale AND TEST ${name})
        set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT "CGT_TEST_SCALE=0.3")
    endif()
endfunction()

# cgt_shorten_test(<name> <row>): the kernels' text is the same in all rows, and the narrowest and the widest are tested in
# full: rows between them run the heavy loops less often.
function(cgt_shorten_test name row)
    list(GET CGT_VARIANTS 0 first)
    list(GET CGT_VARIANTS -1 last)
    if(NOT row STREQUAL first AND NOT row STREQUAL last)
        cgt_run_less(${name})
    endif()
endfunction()

function(cgt_add_variant_test name)
    set(rows ${CGT_TEST_ROWS})
    if(NOT rows OR "words" IN_LIST ARGN)
        set(rows ${CGT_VARIANTS})
    endif()
    set(sources ${ARGN})
    list(FILTER sources INCLUDE REGEX "\\.c$")
    set(asks "")
    foreach(source IN LISTS sources)
        file(STRINGS ${source} lines REGEX "VARIANT_SUITE|test_variant_runs")
        list(APPEND asks ${lines})
    endforeach()
    if(NOT asks)
        message(FATAL_ERROR "${name}: does not ask whether the CPU runs its variant: VARIANT_SUITE does")
    endif()
    foreach(row IN LISTS CGT_VARIANTS)
        if(row IN_LIST rows)
            cgt_add_test(${name}_${row} ${ARGN})
        endif()
        if(TARGET ${name}_${row})
            cgt_use_variant(${name}_${row} ${row})
            cgt_shorten_test(${name}_${row} ${row})
        endif()
    endforeach()
endfunction()

function(cgt_add_cluster_test name)
    cmake_parse_arguments(test "VARIANTS" "" "" ${ARGN})
    if(CGT_SANITIZE MATCHES "thread" OR cgt_soft_emulator OR NOT CGT_TEST_CLUSTERS)
        return()
    endif()
    set(programs ${name})
    if(test_VARIANTS)
        list(TRANSFORM CGT_VARIANTS PREPEND "${name}_" OUTPUT_VARIABLE programs)
    endif()
    foreach(program IN LISTS programs)
        if(TARGET ${program})
            string(REPLACE "${name}" "${name}_clusters" again "${program}")
            cgt_add_test(${again} STATIC "$<TARGET_OBJECTS:${program}>" "$<TARGET_OBJECTS:cgt_always_clusters>"
                         ${test_UNPARSED_ARGUMENTS})
            if(TARGET ${again})
                add_dependencies(${again} ${program})
            endif()
            if(CGT_TEST_CLUSTERS STREQUAL "SHORT")
                cgt_run_less(${again})
            elseif(test_VARIANTS)
                string(REPLACE "${name}_" "" row "${program}")
                cgt_shorten_test(${again} ${row})
            endif()
        endif()
    endforeach()
endfunction()

function(cgt_add_profile_tests name)
    cmake_parse_arguments(test "" "TIMEOUT" "LABELS" ${ARGN})
    if(NOT TARGET ${name})
        return()
    endif()
    foreach(profile IN LISTS test_UNPARSED_ARGUMENTS)
        add_test(NAME ${name}_${profile} COMMAND ${name} ${profile} WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
        cgt_set_test_properties(${name}_${profile} ${test_TIMEOUT} ${test_LABELS})
        if(name MATCHES "_clusters" AND CGT_TEST_CLUSTERS STREQUAL "SHORT")
            cgt_run_less(${name}_${profile})
        endif()
    endforeach()
endfunction()

function(cgt_add_script_test name)
    cmake_parse_arguments(test "SLOW" "" "LABELS;INPUTS" ${ARGN})
    list(POP_FRONT test_UNPARSED_ARGUMENTS script)
    cgt_test_selected(selected ${test_LABELS})
    if(selected)
        set(suites test_programs)
        if(NOT test_SLOW)
            list(APPEND test_LABELS quick)
            list(APPEND suites quick_tests)
        endif()
        foreach(argument IN LISTS test_UNPARSED_ARGUMENTS)
            if(argument MATCHES "^\\$<TARGET_FILE:([^<>]*)>$")
                foreach(suite IN LISTS suites)
                    add_dependencies(${suite} ${CMAKE_MATCH_1})
                endforeach()
            endif()
        endforeach()
        set(command sh "${CMAKE_CURRENT_SOURCE_DIR}/${script}" ${test_UNPARSED_ARGUMENTS})
        if(test_INPUTS)
            list(JOIN test_INPUTS " " inputs)
            set(command sh "${PROJECT_SOURCE_DIR}/tests/repository/when_changed.sh" ${name} "${PROJECT_SOURCE_DIR}"
                        "${inputs}" ${command})
        endif()
        add_test(NAME ${name} COMMAND ${command}
                 WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
        cgt_set_test_properties(${name} 240 ${test_LABELS}) # many short runs of a program
    endif()
endfunction()
