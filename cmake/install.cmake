# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Headers, both libraries, definitions for bindings, the CMake package, the pkg-config files and the licence: component "library". All of it is
# relocatable. Texts, the example and its data: "documentation". Programs are in component "programs", by the CMakeLists.txt of their
# folders.
set(cgt_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/cgt")

# The headers of the vocabulary (simd/), usable without the library: as <cgt/spu_intrinsics.h>, and with the folder cgt
# itself in the include path as <spu_intrinsics.h>, so that SPU source finds it. What these include lies in cgt/spu.
install(FILES include/cgt/all_hits.h include/cgt/bounces.h include/cgt/cgt.h include/cgt/picture.h
              include/cgt/research.h include/cgt/version.h simd/spu_channels.h simd/spu_host.h simd/spu_intrinsics.h simd/spu_mfcio.h
              simd/vec_types.h
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/cgt" COMPONENT library)
install(DIRECTORY simd/spu DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/cgt" COMPONENT library FILES_MATCHING PATTERN "*.h")
install(TARGETS cgt_static cgt_shared cgt_picture_static cgt_picture_shared EXPORT cgtTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library
        LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library
        RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT library) # a DLL

get_property(cgt_definitions GLOBAL PROPERTY cgt_definitions)
install(FILES ${cgt_definitions} DESTINATION "${CMAKE_INSTALL_DATADIR}/cgt" COMPONENT library)

install(EXPORT cgtTargets NAMESPACE cgt:: DESTINATION "${cgt_package_dir}" COMPONENT library)
configure_package_config_file(cmake/cgtConfig.cmake.in "${PROJECT_BINARY_DIR}/cgtConfig.cmake"
                              INSTALL_DESTINATION "${cgt_package_dir}" NO_SET_AND_CHECK_MACRO)
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(cgt_compatibility SameMinorVersion)
else()
    set(cgt_compatibility SameMajorVersion)
endif()
write_basic_package_version_file("${PROJECT_BINARY_DIR}/cgtConfigVersion.cmake" COMPATIBILITY ${cgt_compatibility})
install(FILES "${PROJECT_BINARY_DIR}/cgtConfig.cmake" "${PROJECT_BINARY_DIR}/cgtConfigVersion.cmake"
        DESTINATION "${cgt_package_dir}" COMPONENT library)

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
# The linker prefers the shared library wherever both are installed, with pkg-config's --static, too. So the archive has a
# file of its own, which names it by its path.
function(cgt_install_pc name)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
    install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT library)
endfunction()
cgt_install_pc(cgt)
cgt_install_pc(cgt-static)
cgt_install_pc(cgt-picture)
cgt_install_pc(cgt-picture-static)

# As in the source tree, so that links between the texts hold.
install(FILES LICENSE NEWS DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT library)
install(FILES README.md CONTRIBUTING.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
install(FILES examples/draw_spheres.c examples/simulate.c DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples" COMPONENT documentation)
install(DIRECTORY examples/data DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples" COMPONENT documentation)
# Whoever installs programs alone gets the licence, too.
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT programs)
