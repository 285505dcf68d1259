# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Makes the module cgt._definitions from the definitions that libcgt has installed, and one for each part beside it.

With a C compiler they are modules that link the libraries (cffi's API mode), else ones that load them (ABI mode).

Environment:
  CGT_PREFIX   where libcgt is installed; else pkg-config is asked, then /usr/local and /usr are tried
  CGT_ABI=1    ABI mode even where there is a compiler
  CGT_RUN_PATH where modules of the API mode look for the libraries when they are loaded; by default where they lie now,
               empty: where the loader looks by itself
"""
import os
import re
import shlex
import shutil
import subprocess
import sysconfig
from typing import NamedTuple

import cffi


CORE = ("bounces", "all_hits", "research")


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
    if "CGT_PREFIX" in os.environ:
        prefixes = [os.environ["CGT_PREFIX"]]
    else:
        prefixes = [p for p in (_pkg_config("prefix"), "/usr/local", "/usr") if p]
    for prefix in prefixes:
        path = os.path.join(prefix, "share", "cgt", "cgt.cdef")
        folders = [os.path.join(prefix, f) for f in ("lib", "lib64", os.path.join("lib", _multiarch()))]
        libdir = next((f for f in folders if os.path.exists(os.path.join(f, "libcgt.so"))), None)
        if os.path.exists(path) and libdir:
            with open(path, encoding="utf-8") as file:
                definitions = file.read()
            return Library(os.path.join(prefix, "include"), libdir, path, definitions, _version(definitions))
    raise SystemExit(
        "cgt: neither share/cgt/cgt.cdef nor libcgt.so in " + ", ".join(prefixes)
        + ": install libcgt (cmake --install), and set CGT_PREFIX if it is elsewhere"
    )


def _multiarch():
    return sysconfig.get_config_var("MULTIARCH") or ""


def _has_compiler():
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
    ffi.cdef(definitions)
    if _has_compiler():
        ffi.set_source(
            "cgt." + module,
            "".join(f"#include <cgt/{header}.h>\n" for header in headers),
            include_dirs=[library.include],
            library_dirs=[library.libdir],
            runtime_library_dirs=[folder] if (folder := os.environ.get("CGT_RUN_PATH", library.libdir)) else [],
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
    for name in ("trajectory", "picture"):
        if os.path.exists(_part_file(library, name)) and os.path.exists(
                os.path.join(library.libdir, f"libcgt-{name}.so")):
            makers.append("make_" + name)
    return ["definitions.py:" + maker for maker in makers]


def _make_part(name):
    """A part whose definitions go on from those of scenes."""
    library, base = find_library(), make_ffi()
    with open(_part_file(library, name), encoding="utf-8") as file:
        return _make(library, file.read(), "_" + name, "cgt-" + name, CORE + (name,), base)


def make_trajectory() -> cffi.FFI:
    """The readers of files."""
    return _make_part("trajectory")


def make_picture() -> cffi.FFI:
    """Pictures."""
    return _make_part("picture")
