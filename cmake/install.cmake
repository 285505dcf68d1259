# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Headers, both libraries of libcgt, definitions for bindings, the CMake package, the pkg-config files and the licence:
# component "library", all of it relocatable. libraries.cmake installs the libraries that lie over libcgt. Texts, the
# example and its data: "documentation". Programs are in component "programs", by the CMakeLists.txt of their folders.
set(cgt_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/cgt")

# The headers of the vocabulary (simd/), usable without the library: as <cgt/spu_intrinsics.h>, and with the folder cgt
# itself in the include path as <spu_intrinsics.h>, so that SPU source finds it. What these include lies in cgt/spu.
install(FILES include/cgt/all_hits.h include/cgt/array.h include/cgt/bounces.h include/cgt/export.h
              include/cgt/research.h include/cgt/version.h
              simd/spu_channels.h simd/spu_host.h simd/spu_intrinsics.h simd/spu_mfcio.h simd/vec_types.h
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/cgt" COMPONENT library)
install(DIRECTORY simd/spu DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/cgt" COMPONENT library FILES_MATCHING PATTERN "*.h")
cgt_install_library(cgt cgt_static cgt_shared)

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

cgt_install_pc(cgt "${PROJECT_DESCRIPTION}" "Libs: -L\${libdir} -lcgt" "Libs.private: ${cgt_pc_libraries}")
cgt_install_pc(cgt-static "${PROJECT_DESCRIPTION}; the archive, also where the shared library is installed"
               "Libs: \${libdir}/libcgt.a ${cgt_pc_libraries}")

# As in the source tree, so that links between the texts hold.
install(FILES LICENSE NEWS DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT library)
install(FILES README.md CONTRIBUTING.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
install(FILES examples/draw_figure.c examples/draw_spheres.c examples/simulate.c
        DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples" COMPONENT documentation)
install(DIRECTORY examples/data DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples" COMPONENT documentation)
# Whoever installs programs alone gets the licence, too.
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT programs)
