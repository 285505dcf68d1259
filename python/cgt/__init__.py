# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Exact ray casting of scenes that move, over numpy's arrays.

Move your data, commit, trace:

>>> import cgt, numpy
>>> x = numpy.zeros((2, 3))
>>> scene = cgt.Scene()
>>> _ = scene.add(cgt.Spheres(x, 0.5))
>>> for step in range(3):
...     x[1, 0] += 0.4
...     scene.commit()
...     frame = scene.trace_camera(cgt.Camera(), 64, 48, ('t', 'primitive'))
...     print(int(frame.hit.sum()))
164
208
224
"""
import importlib

from ._native import (
    Error, InUse, InvalidArgument, NotCommitted, OutOfMemory, Stopped, ThreadsRefused, TooLarge, Unsupported,
)
from ._frames import camera_rays
from ._bonds import half_bonds
from .context import Context, variants, version
from .geometry import Camera, Capsules, Light, Spheres, Triangles
from .results import INVALID_ID, AllHits, Fields, Frame, HitRows, Hits, SingleHit
from .scene import Scene

__version__ = version()


def __getattr__(name: str):
    """Names of parts that the installed libcgt may lack come with their first use."""
    if name in ("read", "sort_series", "ReadError", "Trajectory", "TrajectoryFrame"):
        from . import trajectory

        return getattr(trajectory, name)
    if name in ("Look", "Material", "Picture", "find_bodies"):
        from . import picture

        return getattr(picture, name)
    if name in ("fit_camera", "show"):
        from . import _show

        return getattr(_show, name)
    if name == "colors":
        return importlib.import_module(".colors", __name__)
    raise AttributeError(f"module 'cgt' has no attribute {name!r}")


__all__ = [
    "AllHits", "Camera", "Capsules", "Context", "Error", "Fields", "Frame", "HitRows", "Hits", "INVALID_ID", "InUse",
    "InvalidArgument", "Light", "NotCommitted", "OutOfMemory", "Scene", "SingleHit", "Spheres", "Stopped",
    "ThreadsRefused", "TooLarge", "Triangles", "Unsupported", "camera_rays", "half_bonds", "variants", "version",
]
