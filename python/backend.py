# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What pip calls: setuptools, and what builds the library where the system has it not."""
import os
import shutil

from setuptools import build_meta
from setuptools.build_meta import *  # noqa: F403

os.chdir(os.path.dirname(os.path.abspath(__file__)))  # from the top of the tree, too


def get_requires_for_build_wheel(config_settings=None):
    """The packages that building takes."""
    wanted = build_meta.get_requires_for_build_wheel(config_settings)
    if "CGT_PREFIX" not in os.environ:
        wanted += [] if shutil.which("cmake") else ["cmake>=3.18"]
        wanted += [] if shutil.which("ninja") or shutil.which("make") else ["ninja"]
    return wanted
