# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What primitives look like in pictures."""
from typing import Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F4, U1, U2, U4, Hold
from ._held import Held
from ._native import InvalidArgument, enum_value, load_part, real, whole
from .geometry import _three

_, lib = load_part("picture")


class Look:
    """What the primitives of a geometry look like. Colours are linear shares of red, green and blue.

    Arrays are copied where they are not of the type that is named, side by side; numbers that count, such as `index`,
    by each picture that begins.

    Parameters
    ----------
    color : three floats, optional
        Of all.
    colors : (n, 3) float32, optional
        Of each primitive or, with `per_vertex`, of each vertex.
    index : (n,) uint16, optional
        In place of colors: the entry of `palette`, (k, 3) float32, such as those of `cgt.colors`.
    palette_steps : int, optional
        index with per_vertex: entries below it are one row of colours, along which a hit's entry is interpolated; a hit
        on a triangle with another entry takes that one.
    per_vertex : bool, optional
        Colours of triangles are interpolated.
    vertex_normals : (m, 3) float, optional
        Of any length; without them triangles are flat.
    halves : bool, optional
        Colours of capsules: two each, of the half near either end.
    material : int or (n,) uint8, optional
        Shading 'bounces': of all or of each primitive, its place in the picture's `materials`.
    bodies : (n,) uint32, optional
        Triangles of glass: what `find_bodies` gives; None: one closed body.
    sheet : bool, optional
        Opaque triangles that are not closed: both sides are surfaces.
    ids : (n,) uint32, optional
        The number that each primitive has in `Picture.linear`; None: its index.
    lineless_from : int, optional
        The first primitive without outlines, which all behind it lack, too.
    """

    _made = False

    def __init__(self, color: Sequence[float] = (0, 0, 0), colors: Optional[ArrayLike] = None, *,
                 index: Optional[ArrayLike] = None, palette: Optional[ArrayLike] = None, palette_steps: int = 0,
                 ids: Optional[ArrayLike] = None, lineless_from: Optional[int] = None, per_vertex: bool = False,
                 vertex_normals: Optional[ArrayLike] = None, halves: bool = False,
                 material: Union[int, ArrayLike] = 0, bodies: Optional[ArrayLike] = None, sheet: bool = False):
        self.color = _three("color", color)
        self.per_vertex, self.halves, self.sheet = per_vertex, halves, sheet
        self.material = whole("material", material, 0, 255) if np.ndim(material) == 0 else 0
        if (index is None) != (palette is None):
            raise InvalidArgument("palette: it goes with index")
        self._palette = self._dense("palette", palette, F4, 3)
        self.palette_steps = palette_steps
        self.lineless_from = 0 if lineless_from is None else whole("lineless_from", lineless_from, 0, 0xFFFFFFFE) + 1
        self._arrays = {"colors": self._dense("colors", colors, F4, 3),
                        "index": self._dense("index", index, U2, 1), "ids": self._dense("ids", ids, U4, 1),
                        "vertex_normals": self._dense("vertex_normals", vertex_normals, F4, 3),
                        "materials": self._dense("material", material if np.ndim(material) else None, U1, 1),
                        "bodies": self._dense("bodies", bodies, U4, 1)}
        self._check_steps()
        self._made = True

    def _check_steps(self) -> int:
        entries = 0 if self._palette is None else len(self._palette)
        if whole("palette_steps", self.palette_steps) > entries:
            raise InvalidArgument(f"palette_steps: {self.palette_steps}: more than the palette has")
        return self.palette_steps

    @property
    def colors(self) -> Optional[np.ndarray]:
        """The colours as they are read; None: there are none."""
        return self._arrays["colors"]

    @staticmethod
    def _dense(name, a, dtype, width) -> Optional[np.ndarray]:
        if a is None:
            return None
        try:
            given = np.asarray(a)
        except ValueError as error:  # rows of several lengths
            raise InvalidArgument(f"{name}: {error}") from None
        if given.size and given.dtype.kind not in ("fiu" if dtype == F4 else "iu"):
            raise InvalidArgument(f"{name}: dtype {given.dtype}: must be {dtype}")
        if given.size and dtype != F4 and (given.min() < 0 or given.max() > np.iinfo(dtype).max):
            raise InvalidArgument(f"{name}: {given.min()} to {given.max()}: must fit {dtype}")
        a = np.ascontiguousarray(given, dtype)
        if a.ndim != (1 if width == 1 else 2) or (width > 1 and a.shape[1] != width):
            raise InvalidArgument(f"{name}: shape {a.shape}: must be {'(n,)' if width == 1 else f'(n, {width})'}")
        return a

    def _fill(self, c, held: Held, keep: list) -> None:
        """The C struct of this look for a geometry, and what must outlive the picture.

        What C counts by is copied: it checks these numbers once, and reads them until the picture is read.
        """
        c.color, c.per_vertex, c.halves = _three("color", self.color), bool(self.per_vertex), bool(self.halves)
        c.sheet, c.material, c.palette_steps = bool(self.sheet), self.material, self._check_steps()
        c.lineless_from = self.lineless_from
        arrays = {name: a.copy() if name in ("index", "materials", "bodies") else a
                  for name, a in self._arrays.items() if a is not None}
        index = arrays.get("index")
        if index is not None:
            if len(index) and index.max() >= len(self._palette):
                raise InvalidArgument(f"index: {index.max()}, of {len(self._palette)} colours")
            keep.append(Hold(self._palette))
            c.palette = _arrays.pointer(keep[-1].view)
        is_mesh = held.kind == "triangles"
        keep.append(held.lend())
        vertices, count = held.struct.vertex_count if is_mesh else 0, held.struct.count
        colored = vertices if self.per_vertex else count * (2 if self.halves else 1)
        wanted = {"colors": colored, "index": colored, "materials": count, "vertex_normals": vertices, "bodies": count,
                  "ids": count}
        for name, a in arrays.items():
            if name == "vertex_normals" and not is_mesh:
                continue
            if len(a) != wanted[name]:
                raise InvalidArgument(f"{name}: {len(a)} of them: must be {wanted[name]}")
            keep.append(Hold(a))
            setattr(c, name, _arrays.pointer(keep[-1].view))


class Material:
    """What surfaces of shading 'bounces' do with light.

    Parameters
    ----------
    kind : {'matte', 'mirror', 'glass'}
        Matte surfaces have the look's colours.
    color : three floats, optional
        Mirror: share of the light that is reflected, 0 to 1.
    index : float, optional
        Glass: of refraction, 1 to 100.
    absorption : three floats, optional
        Glass: light over a length is multiplied by exp(-absorption * length).
    priority : int, optional
        Glass: where bodies overlap, the one of the highest fills the place.
    gloss : float, optional
        Exponent of the lights' highlights; 0: none.
    """

    _made = False

    def __init__(self, kind: str = "matte", *, color: Sequence[float] = (1, 1, 1), index: float = 1.5,
                 absorption: Sequence[float] = (0, 0, 0), priority: int = 0, gloss: float = 0.0):
        self._values = {"kind": enum_value("CGT_MATERIAL_", kind, "kind", lib), "color": _three("color", color),
                        "index": real("index", index), "absorption": _three("absorption", absorption),
                        "priority": whole("priority", priority, 0, 255), "gloss": real("gloss", gloss)}
        self._made = True
