# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# How objects become libraries, and what is installed of them (component "library").

# ---- Objects ----------------------------------------------------------------------------------------------------

# cgt_library_objects(<target> <sources>...): objects that serve both libraries: position independent, everything hidden.
# What CGT_API marks is visible with CGT_SHARED alone: functions of the public API are compiled twice. With the archive's
# in a plugin they stay its own: else the loader would bind them to those of any other libcgt in the process.
function(cgt_library_objects target)
    add_library(${target} OBJECT ${ARGN})
    cgt_use_c11(${target})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden)
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/include")
endfunction()

# ---- Libraries --------------------------------------------------------------------------------------------------

# Before 1.0.0 a minor version may change the binary interface, so it is part of a shared library's name.
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(cgt_soversion "0.${PROJECT_VERSION_MINOR}")
else()
    set(cgt_soversion "${PROJECT_VERSION_MAJOR}")
endif()
include(CheckLinkerFlag)
set(cgt_export_map "${PROJECT_BINARY_DIR}/exports.map")
configure_file("${PROJECT_SOURCE_DIR}/cmake/exports.map.in" "${cgt_export_map}" @ONLY)
check_linker_flag(C "LINKER:--version-script=${cgt_export_map}" CGT_LINKER_HAS_VERSION_SCRIPT)

# cgt_list_exports(<library> <headers>...): on Windows a list names the functions that the headers declare; and the
# library needs no DLL of the compiler's.
function(cgt_list_exports library)
    if(NOT WIN32)
        return()
    endif()
    set(exports "EXPORTS\n")
    foreach(name IN LISTS ARGN)
        set(header "${PROJECT_SOURCE_DIR}/include/cgt/${name}.h")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
        file(READ "${header}" text)
        string(REGEX MATCHALL "CGT_API [^(;]*[ *]cgt_[a-z0-9_]+\\(" declared "${text}")
        list(TRANSFORM declared REPLACE ".*[ *](cgt_[a-z0-9_]+)\\($" "    \\1\n")
        string(APPEND exports ${declared})
    endforeach()
    file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/${library}.def" "${exports}")
    target_sources(${library} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/${library}.def")
    target_link_options(${library} PRIVATE -static)
endfunction()

# cgt_name_library(<target> <name> [<headers>...]): the file name, the folder, and of a shared library its version, its
# symbols', and what the headers export. The target cgt_X is installed as cgt::X.
function(cgt_name_library target name)
    string(REGEX REPLACE "^cgt_" "" exported "${target}")
    set_target_properties(${target} PROPERTIES OUTPUT_NAME "${name}" EXPORT_NAME "${exported}" LINKER_LANGUAGE C
                                               ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib"
                                               LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
    if(target MATCHES "_static$")
        return()
    endif()
    set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${cgt_soversion})
    if(CGT_LINKER_HAS_VERSION_SCRIPT AND NOT WIN32)
        target_link_options(${target} PRIVATE "LINKER:--version-script=${cgt_export_map}")
        set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS "${cgt_export_map}")
    endif()
    cgt_list_exports(${target} ${ARGN})
    get_property(can_share GLOBAL PROPERTY TARGET_SUPPORTS_SHARED_LIBS)
    if(NOT can_share AND target MATCHES "_shared$") # CMake makes a second archive of it (Emscripten)
        set_target_properties(${target} PROPERTIES OUTPUT_NAME "${name}-shared")
    endif()
endfunction()

# Where an installed library finds those that it is made of: beside it, also when a program loads it while it runs. A
# distribution, whose libraries lie where the loader looks, wants none.
set(CGT_RUN_PATH "$ORIGIN" CACHE STRING "run path of the installed libraries that need libcgt")
mark_as_advanced(CGT_RUN_PATH)

# cgt_alias_library(<target> <static> <shared>): the one of both that BUILD_SHARED_LIBS asks for.
function(cgt_alias_library name static shared)
    if(BUILD_SHARED_LIBS)
        add_library(${name} ALIAS ${shared})
    else()
        add_library(${name} ALIAS ${static})
    endif()
endfunction()

# ---- Installation -----------------------------------------------------------------------------------------------

# The .pc file finds its prefix from its own place, so that the tree can be moved.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
    set(cgt_pc_prefix "${CMAKE_INSTALL_PREFIX}")
    set(cgt_pc_libdir "${CMAKE_INSTALL_FULL_LIBDIR}")
    set(cgt_pc_includedir "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
    file(RELATIVE_PATH cgt_pc_up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
    set(cgt_pc_prefix "\${pcfiledir}/${cgt_pc_up}")
    set(cgt_pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
    set(cgt_pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()

# cgt_install_pc(<name> <description> <lines>...): <name>.pc with what tells how to link. The linker prefers the shared
# library wherever both are installed, with pkg-config's --static, too. So the archive has a file of its own, which names
# it by its path.
function(cgt_install_pc name description)
    list(JOIN ARGN "\n" lines)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/library.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
    install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT library)
endfunction()

# cgt_install_library(<header> <targets>...): targets of the CMake package, and their header.
function(cgt_install_library header)
    install(TARGETS ${ARGN} EXPORT cgtTargets
            ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library
            LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library
            RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT library) # a DLL
    install(FILES "${PROJECT_SOURCE_DIR}/include/cgt/${header}.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/cgt"
            COMPONENT library)
endfunction()

# ---- All of it --------------------------------------------------------------------------------------------------

# cgt_add_library(<name> <below> <description> <sources>... [HEADERS <more>...] [NEEDS <libraries>...] [USES <libraries>...]
#                 [REQUIRES <packages>...])
#   libcgt-<name>, over the public API alone: the archive cgt_<name>_static, the shared library cgt_<name>_shared, and all
#   that is installed of them: cgt::<name>_static, cgt::<name>_shared, include/cgt/<name>.h, cgt-<name>.pc and
#   cgt-<name>-static.pc. cgt::<name> is one of them.
#   below   libraries that it is made of, the next one first, such as cgt-picture,cgt
#   NEEDS   what its header needs, too; USES what its sources need
#   REQUIRES   what pkg-config calls that, for who links the archive
function(cgt_add_library name below description)
    cmake_parse_arguments(PARSE_ARGV 3 arg "" "" "NEEDS;USES;HEADERS;REQUIRES")
    string(REPLACE "," ";" below "${below}")
    list(GET below 0 next)
    string(REPLACE "-" "_" next_target "${next}")
    foreach(kind IN ITEMS archive exported)
        cgt_library_objects(cgt_${name}_${kind}_objects ${arg_UNPARSED_ARGUMENTS})
        target_include_directories(cgt_${name}_${kind}_objects PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
        target_link_libraries(cgt_${name}_${kind}_objects PRIVATE ${arg_NEEDS} ${arg_USES})
    endforeach()
    target_compile_definitions(cgt_${name}_exported_objects PRIVATE CGT_SHARED)
    add_library(cgt_${name}_static STATIC $<TARGET_OBJECTS:cgt_${name}_archive_objects>)
    add_library(cgt_${name}_shared SHARED $<TARGET_OBJECTS:cgt_${name}_exported_objects>)
    # the run path within a build names no folder, so that an installation may take the library from another build
    set_target_properties(cgt_${name}_shared PROPERTIES INSTALL_RPATH "${CGT_RUN_PATH}" BUILD_RPATH_USE_ORIGIN ON)
    foreach(kind IN ITEMS static shared)
        cgt_name_library(cgt_${name}_${kind} cgt-${name} ${name} ${arg_HEADERS})
        target_link_libraries(cgt_${name}_${kind} PUBLIC ${next_target}_${kind} ${arg_NEEDS} PRIVATE ${arg_USES})
        add_library(cgt::${name}_${kind} ALIAS cgt_${name}_${kind})
    endforeach()
    cgt_alias_library(cgt::${name} cgt_${name}_static cgt_${name}_shared)
    if(CGT_INSTALL)
        cgt_install_library(${name} cgt_${name}_static cgt_${name}_shared)
        foreach(header IN LISTS arg_HEADERS)
            install(FILES "${PROJECT_SOURCE_DIR}/include/cgt/${header}.h"
                    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/cgt" COMPONENT library)
        endforeach()
        list(JOIN arg_REQUIRES " " packages)
        cgt_install_pc(cgt-${name} "${description}" "Requires: ${next}" "Libs: -L\${libdir} -lcgt-${name}"
                       "Libs.private: -lpthread -lm" "Requires.private: ${packages}")
        set(archives cgt-${name} ${below})
        list(TRANSFORM archives REPLACE "(.+)" "\${libdir}/lib\\1.a")
        list(JOIN archives " " archives)
        cgt_install_pc(cgt-${name}-static "${description}; the archives, also where the shared libraries are installed"
                       "Libs: ${archives} ${cgt_pc_libraries}" "Requires: ${packages}")
    endif()
endfunction()
