# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""run_conanfile.py CONANFILE WORK BUILT CMAKE [OPTION OF CMAKE]...: what `conan create` does with a recipe, step by step,
with stand-ins for what it imports: WORK/source, WORK/build and WORK/package come of it. Prints name and version.
It configures, but takes the libraries from BUILT, a build of the tree with the same options, once it has shown that it
would compile the same files in the same way, and that what the recipe exports has every file of theirs."""
import fnmatch
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import types

recipe, work, built = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
cmake, profile = sys.argv[4], sys.argv[5:]
tree = recipe.parents[2]
LIBRARIES = ("backends", "cmake", "figure", "include", "picture", "simd", "src")


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
        source, build = pathlib.Path(self.conanfile.source_folder), pathlib.Path(self.conanfile.build_folder)
        here, there = commands(build, source), commands(built, tree)
        assert here, f"{build} compiles nothing"
        assert here == there, f"{build} compiles otherwise than {built}: {sorted(here ^ there)[:4]}"
        for folder in LIBRARIES:
            for path in (tree / folder).rglob("*"):
                name = path.relative_to(tree)
                if path.is_file() and "__pycache__" not in path.parts:
                    assert (source / name).is_file(), f"the recipe does not export {name}"
                    assert (source / name).read_bytes() == path.read_bytes(), name
        shutil.copytree(built / "lib", build / "lib", symlinks=True, dirs_exist_ok=True)

    def install(self):
        run("--install", self.conanfile.build_folder, "--prefix", self.conanfile.package_folder)


def commands(build, source):
    """What a build compiles of the libraries, and how, with the names of its folders taken out, and how a generator of
    CMake's sets spaces."""
    text = (build / "compile_commands.json").read_text(encoding="utf-8")

    def bare(command):
        words = re.sub(r" -o \S+", "", " ".join(command.split()))
        return words.replace(str(source), "SOURCE").replace(str(build), "BUILD")

    return {(os.path.relpath(entry["file"], source), bare(entry["command"]))
            for entry in json.loads(text)
            if re.search(r"/cgt_(objects|\w*archive_objects|\w*exported_objects|kernel_\w+)\.dir/", entry["command"])
            and os.path.relpath(entry["file"], source).split(os.sep)[0] in ("src", "backends", "picture", "figure")}


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
