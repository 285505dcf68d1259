# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What calls return: numpy arrays by field."""
from types import SimpleNamespace
from typing import Dict, Optional, Tuple

import numpy as np

from ._arrays import F4, F8, U4
from ._native import Native

INVALID_ID = 0xFFFFFFFF
"""No primitive, no geometry. Beware of indexing with it: look at `Hits.hit` first."""

RAY_FIELDS = {"t": (F4, 1), "primitive": (U4, 1), "geometry": (U4, 1), "normal": (F4, 3), "u": (F4, 1), "v": (F4, 1)}
FRAME_FIELDS = {**RAY_FIELDS, "position": (F4, 3)}
NO_HIT = {"t": np.inf, "position": np.inf, "primitive": INVALID_ID, "geometry": INVALID_ID}  # 0: the others
ROW_FIELDS = {**RAY_FIELDS, "surface": (U4, 1)}
SURFACE_FIELDS = {"position": (F8, 3), "normal": (F8, 3), "start": (F4, 3), "length": (F8, 1), "front": (U4, 1)}
BOUNCED_FIELDS = {
    "org": (F4, 3), "dir": (F4, 3), "t_min": (F4, 1), "t_max": (F4, 1), "skip_primitive": (U4, 1),
    "skip_geometry": (U4, 1), "share": (F4, 1),
}


class Fields:
    """Arrays by name, as attributes and as items.

    Attributes
    ----------
    arrays : dict
        The arrays that were asked for.
    statistics : SimpleNamespace or None
        What the call did (cgt_trace_statistics), if it was asked for.
    """

    def __init__(self, arrays: Dict[str, np.ndarray], statistics: Optional[SimpleNamespace] = None):
        self.arrays = arrays
        self.statistics = statistics

    def __getattr__(self, name: str) -> np.ndarray:
        arrays = self.__dict__.get("arrays", {})  # none while a copy of it is made
        if name not in arrays:
            raise AttributeError(f"{name}: not among the fields of this call: {', '.join(arrays) or 'none'}")
        return arrays[name]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.arrays[name]

    def keys(self):
        """The names of the fields."""
        return self.arrays.keys()

    def __repr__(self) -> str:
        shapes = ", ".join(f"{name} {a.shape}" for name, a in self.arrays.items())
        return f"{type(self).__name__}({shapes})"


class Hits(Fields):
    """The nearest hits of rays; arrays have the shape of the rays.

    t is float32, +inf without a hit; primitive and geometry are uint32, `INVALID_ID` without a hit; normal is float32
    (..., 3), of unit length; u and v are float32.
    """

    @property
    def hit(self) -> np.ndarray:
        """Which rays hit something, as bool."""
        if "primitive" in self.arrays:
            return self.arrays["primitive"] != INVALID_ID
        if "geometry" in self.arrays:
            return self.arrays["geometry"] != INVALID_ID
        return np.isfinite(self.t)


class Frame(Native, Hits):
    """The hits of a camera's pixels: as `Hits`, of shape (height, width), and position, float32 (height, width, 3)."""

    __getattr__ = Fields.__getattr__

    def __init__(self, outputs, statistics, camera, struct):
        Fields.__init__(self, outputs.arrays, statistics)
        self.camera = camera
        self._outputs, self._struct = outputs, struct  # outputs: what struct points to, whatever becomes of `arrays`
        self._made = True

    @property
    def shape(self) -> Tuple[int, int]:
        """Height and width."""
        return self._struct.height, self._struct.width


class HitRows(Fields):
    """The first hits of each ray: row i has ``count[i]`` hits, elements beyond them are undefined.

    Arrays are (n, capacity), normal (n, capacity, 3); count is uint32 (n,), more is bool (n,): whether there are more.
    surface is 0 where the ray enters a sphere, and of triangles; 1 where it leaves one.
    """


class AllHits(Fields):
    """All hits of all rays, in one list, ordered by ray and then along it; ray is int64 (m,), the number of the ray."""


class SingleHit(SimpleNamespace):
    """One ray's hit: t, primitive, geometry, surface (0: near, 1: far), normal, u, v."""

    @property
    def hit(self) -> bool:
        """Whether there is one."""
        return self.primitive != INVALID_ID
