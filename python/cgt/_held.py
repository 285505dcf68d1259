# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What C reads of a geometry for as long as a scene or a picture has it."""
from __future__ import annotations

import math

import numpy as np

from . import _arrays
from ._arrays import F4, U4
from ._native import ffi, instance
from .geometry import _Geometry


class Held:
    """What C reads of a geometry: the caller's floats where they lie, and copies of the numbers that it counts by.

    A float that changes moves something. An index that changes after it was checked leads out of its array.
    """

    def __init__(self, geometry: _Geometry):
        instance("geometry", geometry, _Geometry)
        self.geometry, self.kind = geometry, geometry._kind
        self.struct = ffi.new(f"cgt_{self.kind} *", geometry._struct[0])
        self._holds, self._arrays = geometry._holds, geometry._arrays
        self._copies = {name: self._arrays[name].copy() for name in ("indices", "types") if name in self._arrays}
        for name, copy in self._copies.items():
            self._point(name, copy)
        self._lent = False

    def _point(self, name, copy) -> None:
        _arrays.set_array(getattr(self.struct, name), copy, copy.itemsize * math.prod(copy.shape[1:]))

    def lend(self):
        """The copies, for a picture that reads them: the next commit leaves them alone."""
        self._lent = True
        return dict(self._copies)

    def read(self) -> bool:
        """Copies what has to be copied, as it is now. Returns whether C has to be given the struct again."""
        moved, self._lent = self._lent and bool(self._copies), False
        for name, copy in self._copies.items():
            if moved:
                copy = self._copies[name] = np.empty_like(copy)
                self._point(name, copy)
            np.copyto(copy, self._arrays[name])
        return moved

    def check(self) -> None:
        """Refuses arrays whose memory was replaced."""
        for name, hold in self._holds.items():
            hold.check(name)

    def in_place(self) -> list:
        """Names and holds of what calls that trace read in place: float32 that each commit need not convert."""
        return [(name, hold) for name, hold in self._holds.items() if hold.view.dtype == F4]

    def corners(self) -> np.ndarray:
        """Triangles' vertices as the last commit has read them, a copy: (n, 3) uint32."""
        indices = self._copies.get("indices")
        return np.arange(3 * self.struct.count, dtype=U4).reshape(-1, 3) if indices is None else indices.astype(U4)
