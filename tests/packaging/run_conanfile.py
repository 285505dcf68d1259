# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""run_conanfile.py CONANFILE WORK CMAKE [OPTION OF CMAKE]...: what `conan create` does with a recipe, step by step, with
stand-ins for what it imports: WORK/source, WORK/build and WORK/package come of it. Prints name and version."""
import fnmatch
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import types

recipe, work, cmake = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
profile = sys.argv[4:]


class Settings(types.SimpleNamespace):
    def rm_safe(self, name):
        assert name in ("compiler.libcxx", "compiler.cppstd"), name


class CppInfo:
    def __init__(self):
        self.properties, self.builddirs, self.libs, self.system_libs = {}, [], [], []

    def set_property(self, name, value):
        self.properties[name] = value


class ConanFile:
    def __init__(self):
        self.settings = Settings(os="Linux", build_type="Release")
        self.cpp_info = CppInfo()
        self.recipe_folder = str(recipe.parent)
        self.export_sources_folder = self.source_folder = str(work / "source")
        self.package_folder = str(work / "package")


class CMakeToolchain:
    def __init__(self, conanfile):
        self.conanfile, self.variables = conanfile, {}

    def generate(self):
        self.conanfile.toolchain = self.variables


class CMake:
    def __init__(self, conanfile):
        self.conanfile = conanfile

    def configure(self):
        variables = [f"-D{name}={'ON' if value is True else value}" for name, value in self.conanfile.toolchain.items()]
        run("-S", self.conanfile.source_folder, "-B", self.conanfile.build_folder, *variables, *profile)

    def build(self):
        run("--build", self.conanfile.build_folder, "-j2")

    def install(self):
        run("--install", self.conanfile.build_folder, "--prefix", self.conanfile.package_folder)


def run(*command):
    done = subprocess.run([cmake, *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        sys.exit(done.stdout)


def cmake_layout(conanfile):
    conanfile.build_folder = str(work / "build")


def copy(conanfile, pattern, src, dst):
    copied = 0
    for path in sorted(pathlib.Path(src).rglob("*")):
        name = path.relative_to(src)
        if path.is_file() and fnmatch.fnmatch(str(name).lower(), pattern.lower()):
            (pathlib.Path(dst) / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, pathlib.Path(dst) / name)
            copied += 1
    assert copied, f"{pattern} is not in {src}"


def load(conanfile, path):
    return pathlib.Path(path).read_text(encoding="utf-8")


for name, members in {"conan": [ConanFile], "conan.tools": [], "conan.tools.cmake": [CMake, CMakeToolchain, cmake_layout],
                      "conan.tools.files": [copy, load]}.items():
    module = sys.modules[name] = types.ModuleType(name)
    for member in members:
        setattr(module, member.__name__, member)
spec = importlib.util.spec_from_file_location("conanfile", recipe)
conanfile = importlib.util.module_from_spec(spec)
spec.loader.exec_module(conanfile)
package = next(c for c in vars(conanfile).values() if isinstance(c, type) and issubclass(c, ConanFile) and c is not ConanFile)()

package.set_version()
package.export_sources()
package.recipe_folder = str(work)  # Conan goes on from its cache, without the tree
for step in ("configure", "layout", "generate", "build", "package", "package_info"):
    getattr(package, step)()
for library in package.cpp_info.libs:
    assert os.path.exists(os.path.join(package.package_folder, "lib", f"lib{library}.a")), library
for folder in package.cpp_info.builddirs:
    assert os.listdir(os.path.join(package.package_folder, folder)), folder
assert os.listdir(os.path.join(package.package_folder, "licenses"))
print(package.name, package.version)
