# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The parts that need a library of others. Headers and libraries are looked for directly: Debian's CMake packages of
# OpenImageIO and Embree ask for, or warn about, packages that are not needed here.

# cgt_optional_part(PART text what packages): reads CGT_BUILD_<PART>, looks for what the part needs with
# cgt_find_<PART>, and sets CGT_HAVE_<PART>.
macro(cgt_optional_part part text what packages)
    set(CGT_HAVE_${part} OFF)
    if(NOT CGT_BUILD_${part} MATCHES "^(AUTO|ON|OFF|TRUE|FALSE|1|0)$")
        message(FATAL_ERROR "CGT_BUILD_${part}=${CGT_BUILD_${part}}: must be AUTO, ON or OFF")
    endif()
    if(CGT_BUILD_${part})
        cmake_language(CALL cgt_find_${part})
        if(NOT CGT_HAVE_${part})
            set(cgt_missing "${what} not found (Debian: apt-get install ${packages})")
            if(CGT_BUILD_${part} STREQUAL "AUTO")
                message(STATUS "Left out: ${text}: ${cgt_missing}")
            else()
                message(FATAL_ERROR "CGT_BUILD_${part} is ${CGT_BUILD_${part}} and ${cgt_missing}")
            endif()
        endif()
    endif()
endmacro()

# cgt_import(target header library): an imported target from a header and a library, if both are there.
function(cgt_import target header library)
    string(MAKE_C_IDENTIFIER "${library}" name)
    find_path(CGT_${name}_INCLUDE_DIR "${header}")
    find_library(CGT_${name}_LIBRARY "${library}")
    mark_as_advanced(CGT_${name}_INCLUDE_DIR CGT_${name}_LIBRARY)
    if(CGT_${name}_INCLUDE_DIR AND CGT_${name}_LIBRARY)
        add_library(${target} INTERFACE IMPORTED GLOBAL)
        set_target_properties(${target} PROPERTIES
                              INTERFACE_INCLUDE_DIRECTORIES "${CGT_${name}_INCLUDE_DIR}"
                              INTERFACE_LINK_LIBRARIES "${CGT_${name}_LIBRARY}")
    endif()
endfunction()

macro(cgt_find_TESTS)
    cgt_import(cgt_cmocka cmocka.h cmocka)
    if(TARGET cgt_cmocka)
        set(CGT_HAVE_TESTS ON)
    endif()
endmacro()

macro(cgt_find_ORACLE)
    cgt_import(cgt_embree embree3/rtcore.h embree3)
    if(TARGET cgt_embree)
        set(CGT_HAVE_ORACLE ON)
    endif()
endmacro()

macro(cgt_find_MESHES)
    cgt_import(cgt_assimp assimp/cimport.h assimp)
    if(TARGET cgt_assimp)
        set(CGT_HAVE_MESHES ON)
    endif()
endmacro()

macro(cgt_find_ARCHIVE)
    cgt_import(cgt_libarchive archive.h archive)
    if(TARGET cgt_libarchive)
        set(CGT_HAVE_ARCHIVE ON)
    endif()
endmacro()

macro(cgt_find_RENDER)
    include(CheckLanguage)
    check_language(CXX)
    cgt_import(cgt_openimageio OpenImageIO/imageio.h OpenImageIO)
    # its inline functions call into this one, where a version has it apart
    find_library(CGT_OpenImageIO_Util_LIBRARY OpenImageIO_Util)
    mark_as_advanced(CGT_OpenImageIO_Util_LIBRARY)
    if(TARGET cgt_openimageio AND CGT_OpenImageIO_Util_LIBRARY)
        set_property(TARGET cgt_openimageio APPEND PROPERTY
                     INTERFACE_LINK_LIBRARIES "${CGT_OpenImageIO_Util_LIBRARY}")
    endif()
    if(CMAKE_CXX_COMPILER AND TARGET cgt_openimageio)
        set(CGT_HAVE_RENDER ON)
    endif()
endmacro()
