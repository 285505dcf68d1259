# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What primitives look like in pictures."""
from __future__ import annotations

from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F4, U1, U2, U4, Hold, numbers
from ._held import Held
from ._native import InvalidArgument, Plain, enum_value, given, load_part, real, switch, three, whole
from .colors import STEPS, entries, light_of, palette as palette_of

_, lib = load_part("picture")


class Look(Plain):
    """What the primitives of a geometry look like.

    A colour is a name, "#rrggbb", bytes (uint8), or three numbers from 0 to 1, as `cgt.colors` tells. What a look is
    made of is copied: for other colours make another one.

    Parameters
    ----------
    color : colour, optional
        Of all; None: a light grey.
    colors : (n, 3) numbers, (n, 3) uint8 or n names, optional
        Of each primitive or, with `per_vertex`, of each vertex. With `map`: n values.
    map : str, optional
        Name of a colour map of `cgt.colors.maps`, from `low` to `high` as in `cgt.colors.entries`.
    linear : bool, optional
        Numbers are shares of light, not sRGB.
    index : (n,) uint16, optional
        In place of colors: the entry of `palette`, (k, 3) colours, such as those of `cgt.colors`.
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

    __slots__ = ("_arrays", "_palette", "_color", "_numbers")

    def __init__(self, color: Any = None, colors: Any = None, *, map: Optional[str] = None,
                 low: Optional[float] = None, high: Optional[float] = None, linear: bool = False,
                 index: Optional[ArrayLike] = None, palette: Any = None, palette_steps: int = 0,
                 ids: Optional[ArrayLike] = None, lineless_from: Optional[int] = None, per_vertex: bool = False,
                 vertex_normals: Optional[ArrayLike] = None, halves: bool = False,
                 material: Union[int, ArrayLike] = 0, bodies: Optional[ArrayLike] = None, sheet: bool = False):
        self._made = False
        per_vertex = switch("per_vertex", per_vertex)
        # C takes black for none
        self._color = (0, 0, 0) if color is None else np.maximum(
            light_of("color", color, linear=linear), 1e-30).tolist()
        if (index is None) != (palette is None):
            raise InvalidArgument("palette: it goes with index")
        if map is None and (low is not None or high is not None):
            raise InvalidArgument("low, high: they go with map")
        self._palette = None if palette is None else light_of("palette", palette, ("k", 3), linear)
        if map is not None:
            if colors is None or index is not None:
                raise InvalidArgument("map: it goes with colors, which are values")
            index, colors = entries(colors, low, high), None
            self._palette, palette_steps = light_of("map", palette_of(map), ("k", 3)), STEPS if per_vertex else 0
        each = None if _arrays.array_of("material", material).ndim == 0 else material
        self._numbers = {
    "palette_steps": whole(
        "palette_steps",
        palette_steps),
        "per_vertex": switch("per_vertex", per_vertex),
        "halves": switch("halves", halves),
        "sheet": switch("sheet", sheet),
        "material": whole(
            "material",
            material,
            0,
            255) if each is None else 0,
            "lineless_from": 0 if lineless_from is None else whole(
                "lineless_from",
                lineless_from,
                0,
                 0xFFFFFFFE) + 1}
        if palette_steps > (0 if self._palette is None else len(self._palette)):
            raise InvalidArgument(f"palette_steps: {palette_steps}: more than the palette has")
        self._arrays = {"colors": None if colors is None else light_of("colors", colors, ("n", 3), linear)}
        for name, member, a, dtype, shape in (
                ("index", "index", index, U2, ("n",)), ("ids", "ids", ids, U4, ("n",)),
                ("vertex_normals", "vertex_normals", vertex_normals, F4, ("m", 3)),
                ("material", "materials", each, U1, ("n",)), ("bodies", "bodies", bodies, U4, ("n",))):
            self._arrays[member] = None if a is None else np.array(numbers(name, a, dtype, shape), order="C")
        self._made = True

    @property
    def colors(self) -> Optional[np.ndarray]:
        """The colours of `colors` as they are read, a copy: linear, (n, 3) float32."""
        a = self._arrays["colors"]
        return None if a is None else a.copy()

    def _arguments(self) -> dict:
        n, a = self._numbers, self._arrays
        return {"color": self._color if any(self._color) else None, "linear": True, "palette": self._palette, **n, **{
            name: a[name] for name in ("colors", "index", "ids", "vertex_normals", "bodies")},
            "lineless_from": n["lineless_from"] - 1 if n["lineless_from"] else None,
            "material": n["material"] if a["materials"] is None else a["materials"]}

    def _told(self) -> dict:
        return {k: v for k, v in self._arguments().items() if isinstance(v, np.ndarray) or v}

    def _fill(self, c, held: Held, keep: list) -> None:
        """The C struct of this look for a geometry, and what must outlive the picture."""
        c.color, arrays = self._color, {name: a for name, a in self._arrays.items() if a is not None}
        for name, value in self._numbers.items():
            setattr(c, name, value)
        index = arrays.get("index")
        if index is not None:
            if len(index) and index.max() >= len(self._palette):
                raise InvalidArgument(f"index: {index.max()}, of {len(self._palette)} colours")
            keep.append(Hold(self._palette))
            c.palette = _arrays.pointer(keep[-1].view)
        is_mesh = held.kind == "triangles"
        keep.append(held.lend())
        vertices, count = held.struct.vertex_count if is_mesh else 0, held.struct.count
        colored = vertices if c.per_vertex else count * (2 if c.halves else 1)
        wanted = {"colors": colored, "index": colored, "materials": count, "vertex_normals": vertices, "bodies": count,
                  "ids": count}
        for name, a in arrays.items():
            if name == "vertex_normals" and not is_mesh:
                continue
            if len(a) != wanted[name]:
                raise InvalidArgument(f"{name}: {len(a)} of them: must be {wanted[name]}")
            keep.append(Hold(a))
            setattr(c, name, _arrays.pointer(keep[-1].view))


class Material(Plain):
    """What surfaces of shading 'bounces' do with light.

    Parameters
    ----------
    kind : {'matte', 'mirror', 'glass'}
        Matte surfaces have the look's colours.
    color : colour, optional
        Mirror: share of the light that is reflected.
    linear : bool, optional
        The numbers of color are shares of light, not sRGB.
    index : float, optional
        Glass: of refraction, 1 to 100.
    absorption : three floats, optional
        Glass: light over a length is multiplied by exp(-absorption * length).
    priority : int, optional
        Glass: where bodies overlap, the one of the highest fills the place.
    gloss : float, optional
        Exponent of the lights' highlights; 0: none.
    """

    __slots__ = ()
    kind, color, index, absorption, priority, gloss = (
        given(name, "As it was passed; color linear.")
        for name in ("kind", "color", "index", "absorption", "priority", "gloss"))

    def __init__(self, kind: str = "matte", *, color: Any = (1, 1, 1), linear: bool = False, index: float = 1.5,
                 absorption: Sequence[float] = (0, 0, 0), priority: int = 0, gloss: float = 0.0):
        self._given = {
    "kind": kind, "color": tuple(
        light_of(
            "color", color, linear=linear).tolist()), "index": real(
                "index", index), "absorption": tuple(
                    three(
                        "absorption", absorption)), "priority": whole(
                            "priority", priority, 0, 255), "gloss": real(
                                "gloss", gloss)}
        enum_value("CGT_MATERIAL_", kind, "kind", lib)
        self._made = True

    def _arguments(self) -> dict:
        return {**self._given, "linear": True}

    def _values(self) -> dict:
        return {**self._given, "kind": enum_value("CGT_MATERIAL_", self.kind, "kind", lib)}
