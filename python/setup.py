# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Package cgt over the installed shared library. definitions.py says how that is found."""
import os
import sys
import tempfile

from setuptools import setup

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from definitions import find_library, parts  # noqa: E402

# elsewhere: what an install for another libcgt, or in the other mode, has left would be packed, too
with tempfile.TemporaryDirectory() as folder:
    setup(
        name="cgt",
        version=find_library().version,
        description="Exact ray casting of scenes that move: spheres and triangles in numpy's arrays",
        license="MIT",
        packages=["cgt"],
        package_data={"cgt": ["py.typed"]},
        python_requires=">=3.9",
        install_requires=["cffi", "numpy"],
        setup_requires=["cffi"],
        cffi_modules=parts(),
        zip_safe=False,
        options={"build": {"build_base": folder}, "egg_info": {"egg_base": folder}},
    )
