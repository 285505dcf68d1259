# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# An overlay port: the libraries, from the tree that it lies in.
# Without FreeType, which it does not ask for: figures have no texts.
#   vcpkg install libcgt --overlay-ports=packaging/vcpkg
# The test `recipes` runs it with stand-ins for vcpkg's functions; vcpkg itself has not run it yet.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS -DCGT_ONLY_LIBRARY=ON -DCGT_BUILD_TEXT=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME cgt CONFIG_PATH lib/cmake/cgt)
vcpkg_fixup_pkgconfig()
# cgt::shared and cgt::static are both there, whichever of them cgt::cgt is.
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
