# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What calls return: numpy arrays by field."""
from __future__ import annotations

from types import MappingProxyType, SimpleNamespace
from typing import Any, Iterator, KeysView, Mapping, Tuple

import numpy as np

from ._arrays import F4, F8, U4, Outputs
from ._native import InvalidArgument, Plain, ffi

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


class Fields(Plain):
    """Arrays by name, as attributes and as items.

    Attributes
    ----------
    statistics : SimpleNamespace or None
        What the call did (cgt_trace_statistics), if it was asked for.
    """

    __slots__ = ("_arrays", "statistics")
    _unmade = {"_made": False, "_arrays": {}}

    def __init__(self, arrays: Mapping[str, np.ndarray], statistics: Any = None):
        self._arrays = arrays
        self.statistics = statistics
        self._made = True

    def __getattr__(self, name: str) -> Any:
        arrays = Plain.__getattr__(self, "_arrays") if name[0] == "_" else self._arrays
        if name not in arrays:
            if name in self._unmade:
                return self._unmade[name]
            raise AttributeError(f"{name}: not among the fields of this call: {', '.join(arrays) or 'none'}")
        return arrays[name]

    @property
    def arrays(self) -> Mapping[str, np.ndarray]:
        """The arrays that were asked for, by name."""
        return MappingProxyType(self._arrays)

    def __getitem__(self, name: str) -> np.ndarray:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def keys(self) -> KeysView[str]:
        """The names of the fields."""
        return self._arrays.keys()

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._arrays]

    def _arguments(self) -> dict:
        return {"arrays": dict(self._arrays), "statistics": self.statistics}

    def __repr__(self) -> str:
        shapes = ", ".join(f"{name} {a.shape}" for name, a in self._arrays.items())
        return f"{type(self).__name__}({shapes})"


class Hits(Fields):
    """The nearest hits of rays; arrays have the shape of the rays.

    t is float32, +inf without a hit; primitive and geometry are uint32, `INVALID_ID` without a hit; normal is float32
    (..., 3), of unit length; u and v are float32.
    """

    __slots__ = ()

    @property
    def hit(self) -> np.ndarray:
        """Which rays hit something, as bool."""
        if "primitive" in self._arrays:
            return self._arrays["primitive"] != INVALID_ID
        if "geometry" in self._arrays:
            return self._arrays["geometry"] != INVALID_ID
        return np.isfinite(self.t)


class Frame(Hits):
    """The hits of a camera's pixels: as `Hits`, of shape (height, width), and position, float32 (height, width, 3).

    Attributes
    ----------
    camera : Camera
        As it was; `copy.copy` gives one that can be changed.
    """

    __slots__ = ("camera", "_outputs", "_struct")

    def __init__(self, arrays: Mapping[str, np.ndarray], camera: Any, width: int, height: int,
                 rows: Tuple[int, int] = (0, 0), statistics: Any = None, *, outputs: Any = None):
        if outputs is None:
            if not all(a.flags.writeable for a in arrays.values()):  # of a pickle that others share
                arrays = {name: np.array(a) for name, a in arrays.items()}
            outputs = Outputs((height, width), tuple(arrays), FRAME_FIELDS, arrays)
        self._arrays, self.statistics = outputs.arrays, statistics
        self.camera, self._outputs = camera, outputs  # outputs: what struct points to
        numbers, vectors = outputs.strides(2)
        s = self._struct = ffi.new("cgt_frame *", {"width": width, "height": height, "first_row": rows[0],
                                                   "row_count": rows[1], **outputs.pointers()})
        if numbers:
            if numbers[1] != 4:
                raise InvalidArgument("out: numbers of a row of pixels must lie side by side")
            s.row_stride = numbers[0] // 4
        if vectors:
            s.vector_stride = vectors[1] // 4
            row = numbers[0] * s.vector_stride if numbers else vectors[0]
            if row != vectors[0] or row % vectors[1]:
                raise InvalidArgument("out: rows of vectors must be as many pixels apart as rows of numbers")
            s.row_stride = row // vectors[1]
        self._made = True

    def _arguments(self) -> dict:
        s = self._struct
        return {"arrays": dict(self._arrays), "statistics": self.statistics, "camera": self.camera, "width": s.width,
                "height": s.height, "rows": (s.first_row, s.row_count)}

    @property
    def shape(self) -> Tuple[int, int]:
        """Height and width."""
        return self._struct.height, self._struct.width


class HitRows(Fields):
    """The first hits of each ray: row i has ``count[i]`` hits, elements beyond them are undefined.

    Arrays are (n, capacity), normal (n, capacity, 3); count is uint32 (n,), more is bool (n,): whether there are more.
    surface is 0 where the ray enters a sphere, and of triangles; 1 where it leaves one.
    """

    __slots__ = ()


class AllHits(Fields):
    """All hits of all rays, in one list, ordered by ray and then along it; ray is int64 (m,), the number of the ray."""

    __slots__ = ()


class SingleHit(SimpleNamespace):
    """One ray's hit: t, primitive, geometry, surface (0: near, 1: far), normal, u, v."""

    @property
    def hit(self) -> bool:
        """Whether there is one."""
        return self.primitive != INVALID_ID
