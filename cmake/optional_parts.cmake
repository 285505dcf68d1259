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

# Headers alone: programs/mesh/gltf/gltf_module.cpp compiles them.
macro(cgt_find_GLTF)
    include(CheckLanguage)
    check_language(CXX)
    find_path(CGT_tinygltf_INCLUDE_DIR tiny_gltf.h)
    find_path(CGT_json_INCLUDE_DIR nlohmann/json.hpp)
    mark_as_advanced(CGT_tinygltf_INCLUDE_DIR CGT_json_INCLUDE_DIR)
    if(CMAKE_CXX_COMPILER AND CGT_tinygltf_INCLUDE_DIR AND CGT_json_INCLUDE_DIR)
        set(CGT_HAVE_GLTF ON)
    endif()
endmacro()

macro(cgt_find_ARCHIVE)
    cgt_import(cgt_libarchive archive.h archive)
    if(TARGET cgt_libarchive)
        set(CGT_HAVE_ARCHIVE ON)
    endif()
endmacro()

# Compression of PNG: the fastest library that is there.
macro(cgt_find_RENDER)
    cgt_import(cgt_isal isa-l/igzip_lib.h isal)
    cgt_import(cgt_libdeflate libdeflate.h deflate)
    cgt_import(cgt_zlib zlib.h z)
    foreach(name IN ITEMS isal libdeflate zlib)
        if(TARGET cgt_${name} AND NOT CGT_HAVE_RENDER)
            set(CGT_HAVE_RENDER ON)
            set(CGT_DEFLATE ${name})
        endif()
    endforeach()
endmacro()

# CMake's own modules, as projects that link the archive find it. Fontconfig finds other fonts for what one lacks.
macro(cgt_find_TEXT)
    foreach(name IN ITEMS Freetype Fontconfig)
        if(NOT EMSCRIPTEN AND NOT TARGET ${name}::${name})
            find_package(${name} QUIET)
            if(TARGET ${name}::${name}) # for projects that this one lies in
                set_target_properties(${name}::${name} PROPERTIES IMPORTED_GLOBAL TRUE)
            endif()
        endif()
    endforeach()
    if(TARGET Freetype::Freetype)
        set(CGT_HAVE_TEXT ON)
        set(CGT_TEXT_PACKAGES Freetype)
        if(TARGET Fontconfig::Fontconfig)
            set(CGT_HAVE_FONTCONFIG ON)
            list(APPEND CGT_TEXT_PACKAGES Fontconfig)
        endif()
    endif()
endmacro()

macro(cgt_find_VIEW)
    cgt_import(cgt_sdl2 SDL2/SDL.h SDL2)
    if(TARGET cgt_sdl2)
        set(CGT_HAVE_VIEW ON)
    endif()
endmacro()

macro(cgt_find_IMAGES)
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
        set(CGT_HAVE_IMAGES ON)
    endif()
endmacro()

macro(cgt_find_MPI)
    if(NOT CMAKE_CROSSCOMPILING)
        find_package(MPI QUIET COMPONENTS C)
    endif()
    if(MPI_C_FOUND)
        set(CGT_HAVE_MPI ON)
    else() # the names of libraries that half an MPI gave would be believed for ever
        unset(MPI_C_LIB_NAMES CACHE)
    endif()
endmacro()

# cgt_soname(variable library): the name under which the loader finds a shared library.
function(cgt_soname variable library)
    get_filename_component(file "${library}" REALPATH)
    get_filename_component(name "${file}" NAME)
    if(CMAKE_OBJDUMP)
        execute_process(COMMAND "${CMAKE_OBJDUMP}" -p "${file}" OUTPUT_VARIABLE text ERROR_QUIET)
        if(text MATCHES "SONAME +([^ \n]+)")
            set(name "${CMAKE_MATCH_1}")
        endif()
    endif()
    set(${variable} "${name}" PARENT_SCOPE)
endfunction()
