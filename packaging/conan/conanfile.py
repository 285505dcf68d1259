# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""The libraries, from the tree that this lies in: conan create packaging/conan.

The test `recipes` runs it with stand-ins for Conan; Conan itself has not run it yet.
"""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class Libcgt(ConanFile):
    name = "libcgt"
    license = "MIT"
    description = "Ray casting of scenes in which every primitive moves every frame"
    topics = ("ray-tracing", "simulation", "particles")
    package_type = "unknown"  # both kinds are in it: cgt::static, cgt::shared, or BUILD_SHARED_LIBS choose
    settings = "os", "arch", "compiler", "build_type"
    options = {"fPIC": [True, False]}
    default_options = {"fPIC": True}

    @property
    def _top(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self._top, "include", "cgt", "version.h"))
        self.version = re.search(r'CGT_VERSION_STRING "([0-9.]+)"', text).group(1)

    def export_sources(self):
        for name in ("CMakeLists.txt", "LICENSE", "NEWS", "README.md", "CONTRIBUTING.md"):
            copy(self, name, self._top, self.export_sources_folder)
        for folder in ("backends", "cmake", "docs", "examples", "figure", "include", "mpi", "picture", "programs", "simd", "src"):
            copy(self, "*", os.path.join(self._top, folder), os.path.join(self.export_sources_folder, folder))

    def configure(self):
        self.settings.rm_safe("compiler.libcxx")  # it is C
        self.settings.rm_safe("compiler.cppstd")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.variables["CGT_ONLY_LIBRARY"] = True
        toolchain.variables["CGT_BUILD_TEXT"] = "OFF"  # what is not required here is not to be found by chance
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # the package's own files for CMake and pkg-config know all libraries
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append(os.path.join("lib", "cmake", "cgt"))
        self.cpp_info.libs = ["cgt-figure", "cgt-picture", "cgt"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread", "m"]
