# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Makes the module cgt._definitions from the definitions that libcgt has installed, and one for each part beside it.

With a C compiler they are modules that link the libraries (cffi's API mode), else ones that load them (ABI mode).

In the source tree of libcgt, or in a distribution that holds it, the library is built, too, and goes with the package.

Environment:
  CGT_PREFIX   where libcgt is installed, in place of building it; away from its source pkg-config is asked, else, then
               /usr/local and /usr are tried
  CGT_CMAKE    further arguments of CMake
  CGT_ABI=1    ABI mode even where there is a compiler
  CGT_RUN_PATH where modules of the API mode look for the libraries when they are loaded; by default where they lie now,
               empty: where the loader looks by itself
"""
from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sysconfig
from typing import NamedTuple

import cffi


CORE = ("bounces", "all_hits", "research")
HERE = os.path.dirname(os.path.abspath(__file__))
SOURCES = ("CMakeLists.txt", "LICENSE", "cmake", "include", "simd", "src", "backends", "figure", "picture", "mpi", "programs")
VERSION_FILE = os.path.join("include", "cgt", "version.h")


def source() -> str | None:
    """The source of libcgt to build: around this folder, or what a distribution has; None: one is installed."""
    if "CGT_PREFIX" not in os.environ:
        for folder in (os.path.join(HERE, "libcgt"), os.path.dirname(HERE)):
            if os.path.exists(os.path.join(folder, VERSION_FILE)):
                return folder
    return None


def build_library(folder: str) -> None:
    """Builds the libraries of `source` in a folder, or ends with a sentence that says what is missing."""
    compiler = shlex.split(os.environ.get("CC", "cc"))[0]
    for tools, package in (((compiler,), "gcc"), (("cmake",), "cmake"), (("ninja", "make"), "make")):
        if not any(map(shutil.which, tools)):
            raise SystemExit(f"cgt: no {tools[-1]} to build libcgt with: install it (Debian: apt-get install {package}), "
                             "or set CGT_PREFIX to where libcgt is installed")
    options = ["CMAKE_BUILD_TYPE=Release", "CMAKE_BUILD_WITH_INSTALL_RPATH=ON", "CGT_ONLY_LIBRARY=ON",
               "CGT_INSTALL=OFF", "CGT_BUILD_READERS=ON", *(f"CGT_BUILD_{part}=AUTO" for part in ("ARCHIVE", "MESHES", "GLTF", "MPI"))]
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    targets = ["cgt_shared", "cgt_picture_shared", "cgt_figure_shared", "cgt_trajectory", "cgt_definitions"]
    for command in (["cmake", "-S", source(), "-B", folder, *generator, *("-D" + o for o in options),
                     *shlex.split(os.environ.get("CGT_CMAKE", ""))],
                    ["cmake", "--build", folder, "--parallel", str(os.cpu_count()), "--target"]):
        if "--build" in command:
            command += targets + (["cgt_mpi_shared"] if os.path.exists(os.path.join(folder, "mpi")) else [])
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode:
            raise SystemExit(f"{done.stdout[-4000:]}\ncgt: libcgt was not built: {' '.join(command)}")
    os.environ["CGT_BUILD"] = folder  # for the functions below, which cffi calls from a copy of this file


def built_files() -> list:
    """What goes with the package: pairs of a file and its name there."""
    folder = os.environ["CGT_BUILD"]
    # the names that the loader asks for
    name = re.compile(r"libcgt.*\.so\.(0\.\d+|[1-9]\d*)")
    libraries = [f for f in os.listdir(os.path.join(folder, "lib")) if name.fullmatch(f)]
    pairs = [(os.path.join(folder, "lib", f), f) for f in libraries]
    modules = os.path.join(folder, "modules")
    version = re.sub(r".*\.so\.", "", libraries[0])
    return pairs + [(os.path.join(modules, f), os.path.join("cgt-" + version, f))
                    for f in (os.listdir(modules) if os.path.exists(modules) else []) if f.endswith(".so")]


def version() -> str:
    """That of the library."""
    folder = source()
    if not folder:
        return find_library().version
    with open(os.path.join(folder, VERSION_FILE), encoding="utf-8") as file:
        return re.search(r'CGT_VERSION_STRING "(.*)"', file.read()).group(1)


class Library(NamedTuple):
    """An installed libcgt."""

    include: str
    libdir: str
    definitions_path: str
    definitions: str
    version: str


def _pkg_config(variable):
    try:
        return subprocess.check_output(["pkg-config", "--variable=" + variable, "cgt"], text=True).strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def _version(definitions):
    number = [re.search(rf"CGT_VERSION_{part} (\d+)", definitions) for part in ("MAJOR", "MINOR", "PATCH")]
    return ".".join(n.group(1) for n in number)


def find_library() -> Library:
    """Finds libcgt, or ends with a sentence that says what is missing."""
    if "CGT_BUILD" in os.environ:
        libdir = os.path.join(os.environ["CGT_BUILD"], "lib")
        return _library(os.path.join(source(), "include"), libdir, os.path.join(libdir, "cgt.cdef"))
    if "CGT_PREFIX" in os.environ:
        prefixes = [os.environ["CGT_PREFIX"]]
    else:
        prefixes = [p for p in (_pkg_config("prefix"), "/usr/local", "/usr") if p]
    for prefix in prefixes:
        path = os.path.join(prefix, "share", "cgt", "cgt.cdef")
        folders = [os.path.join(prefix, f) for f in ("lib", "lib64", os.path.join("lib", _multiarch()))]
        libdir = next((f for f in folders if os.path.exists(os.path.join(f, "libcgt.so"))), None)
        if os.path.exists(path) and libdir:
            return _library(os.path.join(prefix, "include"), libdir, path)
    raise SystemExit(
        "cgt: neither share/cgt/cgt.cdef nor libcgt.so in " + ", ".join(prefixes)
        + ": install libcgt (cmake --install), and set CGT_PREFIX if it is elsewhere"
    )


def _library(include, libdir, path):
    with open(path, encoding="utf-8") as file:
        definitions = file.read()
    return Library(include, libdir, path, definitions, _version(definitions))


def _multiarch():
    return sysconfig.get_config_var("MULTIARCH") or ""


def has_compiler() -> bool:
    """Whether modules of the API mode can be made."""
    command = shlex.split(os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc")
    header = os.path.join(sysconfig.get_path("include"), "Python.h")
    return bool(shutil.which(command[0])) and os.path.exists(header) and os.environ.get("CGT_ABI") != "1"


def make_ffi() -> cffi.FFI:
    """What setup.py calls."""
    library = find_library()
    return _make(library, library.definitions, "_definitions", "cgt", CORE)


def _make(library, definitions, module, name, headers, base=None):
    ffi = cffi.FFI()
    if base:
        ffi.include(base)
    if name == "cgt-mpi":  # its header wants MPI's, whose handles are pointers or ints
        definitions = "typedef intptr_t MPI_Comm;\n" + definitions
    ffi.cdef(definitions)
    run_path = os.environ.get("CGT_RUN_PATH", "$ORIGIN" if "CGT_BUILD" in os.environ else library.libdir)
    if has_compiler():
        ffi.set_source(
            "cgt." + module,
            "".join(f"#include <cgt/{header}.h>\n" for header in headers) + (definitions if name == "cgt-mpi" else ""),
            include_dirs=[library.include],
            library_dirs=[library.libdir],
            runtime_library_dirs=[run_path] if run_path else [],
            libraries=[name],
            # a pointer to const arrays stands without const in the definitions
            extra_compile_args=["-Wno-incompatible-pointer-types"],
        )
    else:
        ffi.set_source("cgt." + module, None)
    return ffi


def _part_file(library, name):
    return os.path.join(os.path.dirname(library.definitions_path), f"cgt-{name}.cdef")


def parts() -> list:
    """The functions of this file that make what the installed libcgt has."""
    library, makers = find_library(), ["make_ffi"]
    for name in ("trajectory", "picture", "figure", "mpi"):
        if os.path.exists(_part_file(library, name)) and os.path.exists(
                os.path.join(library.libdir, f"libcgt-{name}.so")):
            makers.append("make_" + name)
    return ["definitions.py:" + maker for maker in makers]


def _make_part(name, below=None):
    """A part whose definitions go on from those of scenes, or of another part."""
    library, base = find_library(), make_picture() if below else make_ffi()
    with open(_part_file(library, name), encoding="utf-8") as file:
        return _make(library, file.read(), "_" + name, "cgt-" + name, CORE + (below if name == "mpi" else name,), base)


def make_trajectory() -> cffi.FFI:
    """The readers of files."""
    return _make_part("trajectory")


def make_picture() -> cffi.FFI:
    """Pictures."""
    return _make_part("picture")


def make_figure() -> cffi.FFI:
    """Labelled pictures."""
    return _make_part("figure", "picture")


def make_mpi() -> cffi.FFI:
    """Pictures by the ranks of an MPI job."""
    return _make_part("mpi", "picture")
