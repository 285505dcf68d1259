# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Objects and programs for an SPU, by its own compiler, in a build for this machine: tests run them in the simulator.
#   CGT_SPU_TOOLCHAIN   folder of spu-elf-gcc, as scripts/spu_toolchain.sh prints it; empty: nothing is built for an SPU
#
#   cgt_add_spu_objects(<target> <level> [ALL] <sources>...)
#       compiles each with the row `spu` of the variant table and an optimisation level, or a list of that and further
#       flags; objects lie in spu/<target>/
#   cgt_add_spu_program(<name> [LEVEL <flags>...] <sources>...)
#       the same at -O2, or with a level of its own, linked to spu/<name>.elf
# Sources are relative to the folder that calls. Warnings are errors, whatever CGT_WERROR says: the compiler is known.
set(CGT_SPU_TOOLCHAIN "" CACHE PATH "Folder of spu-elf-gcc (scripts/spu_toolchain.sh); empty: nothing is built for an SPU")
if(NOT CGT_SPU_TOOLCHAIN)
    return()
endif()
if(CMAKE_VERSION VERSION_LESS 3.20 AND CMAKE_GENERATOR MATCHES "Make")
    message(FATAL_ERROR "CGT_SPU_TOOLCHAIN: needs CMake 3.20, for the dependencies of what it compiles")
endif()
find_program(CGT_SPU_COMPILER spu-elf-gcc PATHS "${CGT_SPU_TOOLCHAIN}" NO_DEFAULT_PATH)
if(NOT CGT_SPU_COMPILER)
    message(FATAL_ERROR "CGT_SPU_TOOLCHAIN: no spu-elf-gcc in ${CGT_SPU_TOOLCHAIN}")
endif()

set(cgt_spu_flags -std=c11 -Wall -Wextra -Wshadow -Werror -fno-math-errno -fno-trapping-math -ffp-contract=off
                  -ffunction-sections -fdata-sections)
foreach(definition IN LISTS CGT_VARIANT_spu_DEFINES)
    list(APPEND cgt_spu_flags -D${definition})
endforeach()
foreach(folder IN ITEMS include simd src tests)
    list(APPEND cgt_spu_flags "-I${PROJECT_SOURCE_DIR}/${folder}")
endforeach()

# cgt_spu_object(<variable> <folder> <level> <source>): the object's path goes to the variable.
function(cgt_spu_object variable folder level source)
    set(object "${PROJECT_BINARY_DIR}/spu/${folder}/${source}.o")
    get_filename_component(path "${source}" ABSOLUTE)
    get_filename_component(parent "${object}" DIRECTORY)
    file(MAKE_DIRECTORY "${parent}")
    add_custom_command(OUTPUT "${object}"
        COMMAND "${CGT_SPU_COMPILER}" ${cgt_spu_flags} ${level} -MMD -MF "${object}.d" -c "${path}" -o "${object}"
        DEPENDS "${path}" DEPFILE "${object}.d" COMMENT "SPU object ${source} ${level}" VERBATIM)
    set(${variable} "${object}" PARENT_SCOPE)
endfunction()

function(cgt_add_spu_objects target level)
    cmake_parse_arguments(row "ALL" "" "" ${ARGN})
    set(all "")
    if(row_ALL)
        set(all ALL)
    endif()
    set(objects "")
    foreach(source IN LISTS row_UNPARSED_ARGUMENTS)
        cgt_spu_object(object "${target}" "${level}" "${source}")
        list(APPEND objects "${object}")
    endforeach()
    add_custom_target(${target} ${all} DEPENDS ${objects})
endfunction()

function(cgt_add_spu_program name)
    cmake_parse_arguments(row "" "" "LEVEL" ${ARGN})
    set(objects "")
    set(level -O2)
    if(row_LEVEL)
        set(level ${row_LEVEL})
    endif()
    foreach(source IN LISTS row_UNPARSED_ARGUMENTS)
        cgt_spu_object(object "${name}" "${level}" "${source}")
        list(APPEND objects "${object}")
    endforeach()
    set(program "${PROJECT_BINARY_DIR}/spu/${name}.elf")
    add_custom_command(OUTPUT "${program}"
        COMMAND "${CGT_SPU_COMPILER}" -Wl,--gc-sections ${objects} -lm -o "${program}"
        DEPENDS ${objects} COMMENT "SPU program ${name}" VERBATIM)
    add_custom_target(${name} ALL DEPENDS "${program}")
endfunction()
