# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cmake -DPORTFILE=FILE -DWORK=FOLDER -DBUILT=FOLDER -DPROFILE=OPTIONS -P run_portfile.cmake
# What vcpkg does with a port, with stand-ins for its functions; WORK/vcpkg comes of it. It configures, but installs from
# BUILT, a build of the same files and options, so that nothing is compiled twice.
set(PORT libcgt)
set(CURRENT_PACKAGES_DIR "${WORK}/vcpkg")

function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(result)
        message(FATAL_ERROR "${text}")
    endif()
endfunction()

# files_of(<variable> <build>): what it compiles, by paths within the sources
function(files_of variable build)
    file(STRINGS "${build}/compile_commands.json" lines REGEX "\"file\"")
    list(TRANSFORM lines REPLACE ".*/(src|backends|picture|figure)/" "\\1/")
    list(SORT lines)
    set(${variable} "${lines}" PARENT_SCOPE)
endfunction()

function(vcpkg_cmake_configure)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" SOURCE_PATH OPTIONS)
    run("${CMAKE_COMMAND}" -S "${arg_SOURCE_PATH}" -B "${WORK}/vcpkg_build" ${arg_OPTIONS} ${PROFILE})
    files_of(files "${WORK}/vcpkg_build")
    files_of(built "${BUILT}")
    if(NOT files STREQUAL built)
        message(FATAL_ERROR "the port compiles other files than the recipe of Conan:\n${files}\n${built}")
    endif()
endfunction()

function(vcpkg_cmake_install)
    run("${CMAKE_COMMAND}" --install "${BUILT}" --prefix "${CURRENT_PACKAGES_DIR}")
    run("${CMAKE_COMMAND}" --install "${BUILT}" --prefix "${CURRENT_PACKAGES_DIR}/debug")
endfunction()

# The package's files move up a level, to share/NAME, and so does what they find from their own place.
function(vcpkg_cmake_config_fixup)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "PACKAGE_NAME;CONFIG_PATH" "")
    foreach(prefix IN ITEMS "${CURRENT_PACKAGES_DIR}" "${CURRENT_PACKAGES_DIR}/debug")
        file(GLOB files "${prefix}/${arg_CONFIG_PATH}/*.cmake")
        if(NOT files)
            message(FATAL_ERROR "no ${arg_CONFIG_PATH}")
        endif()
        foreach(file IN LISTS files)
            file(READ "${file}" text)
            string(REPLACE "get_filename_component(_IMPORT_PREFIX \"\${_IMPORT_PREFIX}\" PATH)\nget_filename_component"
                           "get_filename_component" text "${text}")
            string(REPLACE "/../../../" "/../../" text "${text}")
            get_filename_component(name "${file}" NAME)
            file(WRITE "${prefix}/share/${arg_PACKAGE_NAME}/${name}" "${text}")
        endforeach()
        file(REMOVE_RECURSE "${prefix}/lib/cmake")
    endforeach()
endfunction()

function(vcpkg_fixup_pkgconfig)
    file(GLOB files "${CURRENT_PACKAGES_DIR}/lib/pkgconfig/*.pc")
    if(NOT files)
        message(FATAL_ERROR "no files of pkg-config")
    endif()
endfunction()

function(vcpkg_install_copyright)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "" FILE_LIST)
    file(COPY ${arg_FILE_LIST} DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
    file(RENAME "${CURRENT_PACKAGES_DIR}/share/${PORT}/LICENSE" "${CURRENT_PACKAGES_DIR}/share/${PORT}/copyright")
endfunction()

include("${PORTFILE}")
foreach(unwanted IN ITEMS debug/include debug/share lib/cmake) # as vcpkg asks of ports
    if(EXISTS "${CURRENT_PACKAGES_DIR}/${unwanted}")
        message(FATAL_ERROR "the port leaves ${unwanted}")
    endif()
endforeach()
