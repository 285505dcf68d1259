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
from __future__ import annotations

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any

from ._native import (
    Error, InUse, InvalidArgument, NotCommitted, OutOfMemory, Stopped, ThreadsRefused, TooLarge, Unsupported,
)
from ._bonds import half_bonds
from ._frames import camera_rays
from .context import Context, variants, version
from .geometry import Camera, Capsules, Light, Spheres, Triangles
from .results import INVALID_ID, AllHits, Fields, Frame, HitRows, Hits, SingleHit
from .scene import Scene

if TYPE_CHECKING:
    from . import colors, figure, research, trimesh
    from ._show import fit_camera, show
    from .figure import Figure
    from .picture import Look, Material, Picture, find_bodies
    from .trajectory import ReadError, Trajectory, TrajectoryFrame, read, sort_series

__version__ = version()
# Names of parts that the installed libcgt may lack come with their first use: their module, and the part.
_LATER = {
    **dict.fromkeys(("read", "sort_series", "ReadError", "Trajectory", "TrajectoryFrame"),
                    (".trajectory", "._trajectory")),
    **dict.fromkeys(("Look", "Material", "Picture", "find_bodies"), (".picture", "._picture")),
    **dict.fromkeys(("fit_camera", "show"), ("._show", "._figure")), "Figure": (".figure", "._figure"), "figure": (".figure", "._figure"),
    "colors": (".colors", "._picture"),
    "trimesh": (".trimesh", "._definitions"), "mpi": (".mpi", "._mpi"),
}
__all__ = [
    "AllHits", "Camera", "Capsules", "Context", "Error", "Fields", "Figure", "Frame", "HitRows", "Hits", "INVALID_ID",
    "InUse", "InvalidArgument", "Light", "Look", "Material", "NotCommitted", "OutOfMemory", "Picture", "ReadError", "Scene",
    "SingleHit", "Spheres", "Stopped", "ThreadsRefused", "TooLarge", "Trajectory", "TrajectoryFrame", "Triangles",
    "Unsupported", "camera_rays", "colors", "figure", "find_bodies", "fit_camera", "half_bonds", "read",
    "show", "sort_series", "variants", "version",
]

if not TYPE_CHECKING:  # to which a name that is not there is an error
    __all__ = [n for n in __all__ if n not in _LATER or importlib.util.find_spec(_LATER[n][1], __name__)]

    def __getattr__(name: str) -> Any:
        if name not in _LATER:
            raise AttributeError(f"module 'cgt' has no attribute {name!r}")
        module = importlib.import_module(_LATER[name][0], __name__)
        found = globals()[name] = module if name in ("colors", "figure", "trimesh", "mpi") else getattr(module, name)
        return found


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__", "research", "trimesh"])
