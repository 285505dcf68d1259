# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Package cgt, with the library in it, or over an installed one: definitions.py says which."""
import os
import shutil
import sys
import tempfile

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import definitions  # noqa: E402

BUILDS = bool({"bdist_wheel", "build", "build_ext", "build_py", "install", "develop", "editable_wheel"} & set(sys.argv))
OWN = BUILDS and definitions.source() is not None


class Package(build_py):
    """Adds the library."""

    def run(self):
        super().run()
        for file, name in definitions.built_files() if OWN else []:
            path = os.path.join(self.build_lib, "cgt", name)
            self.mkpath(os.path.dirname(path))
            shutil.copyfile(file, path)


class Wheel(bdist_wheel):
    """One for all versions of Python: its modules are abi3, or load the library."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = self.root_is_pure and not OWN

    def get_tag(self):
        python, abi, platform = super().get_tag()
        return (python, abi, platform) if definitions.has_compiler() else ("py3", "none", platform)


class Source(sdist):
    """Adds the source of the library."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for name in ("definitions.py", "backend.py", "pyproject.toml"):
            shutil.copyfile(name, os.path.join(base_dir, name))
        for name in definitions.SOURCES if definitions.source() else []:
            path = os.path.join(definitions.source(), name)
            copy = shutil.copytree if os.path.isdir(path) else shutil.copyfile
            self.mkpath(os.path.join(base_dir, "libcgt"))
            copy(path, os.path.join(base_dir, "libcgt", name))


# elsewhere: what an install for another libcgt, or in the other mode, has left would be packed, too
with tempfile.TemporaryDirectory() as folder:
    if OWN:
        definitions.build_library(os.path.join(folder, "libcgt"))
    setup(
        name="cgt",
        version=definitions.version(),
        description="Exact ray casting of scenes that move: spheres and triangles in numpy's arrays",
        license="MIT",
        packages=["cgt"],
        package_data={"cgt": ["py.typed"]},
        python_requires=">=3.9",
        install_requires=["cffi", "numpy"],
        setup_requires=["cffi"],
        cffi_modules=definitions.parts() if BUILDS else [],
        cmdclass={"build_py": Package, "bdist_wheel": Wheel, "sdist": Source},
        zip_safe=False,
        options={"build": {"build_base": folder}, "egg_info": {"egg_base": folder},
                 "bdist_wheel": {"py_limited_api": "cp39"} if definitions.has_compiler() else {}},
    )
