# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Geometries, cameras and lights: descriptions that refer to numpy's arrays."""
from __future__ import annotations

from types import MappingProxyType
from typing import Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F2, F4, F8, I4, I8, U1, U2, U4, U8
from ._native import (InvalidArgument, Plain, enum_value, exception_of, ffi, given, instance, lib, real, several, three,
                      whole)


POINTS, NUMBERS = (F8, F4, F2), (U4, I4, U2, U1, U8, I8)  # what coordinates and radii, indices and types may be


class _Geometry(Plain):
    """A C struct and the arrays that it points to."""

    __slots__ = ("_kind", "_holds", "_arrays", "_struct")
    origin = given("origin", "What is subtracted from places.")
    mask = given("mask", "Which rays see it.")

    def __init__(self, kind: str, given: dict):
        self._made = False
        self._kind = kind
        self._given = given  # arguments as they were passed
        self._holds: dict = {}  # what keeps arrays
        self._arrays: dict = {}  # as C reads them
        self._struct = ffi.new(f"cgt_{kind} *")
        self._struct.origin = given["origin"] = tuple(three("origin", given["origin"]))
        self._struct.mask = whole("mask", given["mask"])

    def _refer(self, name: str, array, dtypes, width: int, member: str = "") -> np.ndarray:
        """Refers to an array of `width` numbers a row: `member` of the struct, by default the one of that name."""
        hold, stride = _arrays.given_rows(name, array, dtypes, width)
        view = hold.view
        if isinstance(array, (list, tuple, range)):
            self._given[name] = view
        self._holds[name], self._arrays[name] = hold, view
        _arrays.set_array(getattr(self._struct, member or name), view, stride)
        return view

    def _refer_vertices(self, vertices) -> np.ndarray:
        vertices = self._refer("vertices", vertices, POINTS, 3)
        self._struct.vertex_count = len(vertices)
        return vertices

    def _refer_indices(self, indices, vertices: int, corners: int) -> int:
        """How many primitives there are, of `corners` vertices each: those of indices, or one after another."""
        if indices is not None:
            return len(self._refer("indices", indices, NUMBERS, corners))
        if vertices % corners:
            raise InvalidArgument(f"vertices: {vertices} of them without indices: must be a multiple of {corners}")
        return vertices // corners

    def _refer_radii(self, radius, types, count: int, what: str) -> None:
        """Refers to one radius, to one each, or to one each type."""
        if types is None and (radius.__class__ in (float, int) or _arrays.array_of("radius", radius).ndim == 0):
            self._struct.radius = self._given["radius"] = real("radius", radius)  # an array of one may change
            return
        radii = self._refer("radius", radius, POINTS, 1, "radii")
        name, each = "radius", radii
        if types is not None:
            name, each = "types", self._refer("types", types, NUMBERS, 1)
            self._struct.type_count = len(radii)
        if len(each) != count:
            raise InvalidArgument(f"{name}: {len(each)} for {count} {what}")

    def _radii(self, count: int) -> np.ndarray:
        """The radius of each primitive, in double."""
        radii, types = self._arrays.get("radius"), self._arrays.get("types")
        if radii is None:
            return np.full(count, self._struct.radius, F8)
        return np.asarray(radii if types is None else radii[self._places("types", len(radii))], F8)

    def _places(self, name: str, count: int) -> np.ndarray:
        """Indices or types, of which each is one of so many."""
        places = self._arrays[name]
        if places.size and (places.min() < 0 or places.max() >= count):
            raise InvalidArgument(f"{name}: {places.min()} to {places.max()}, of {count}")
        return places.astype(np.intp)

    def _balls(self) -> Tuple[np.ndarray, np.ndarray]:
        """Centres and radii of balls that have the geometry's convex hull, relative to its origin, in double."""
        raise NotImplementedError

    @property
    def arrays(self) -> Mapping[str, np.ndarray]:
        """The arrays by name, as each commit reads them."""
        return MappingProxyType({name: self._given[name] for name in self._arrays})

    def __len__(self) -> int:
        return self._struct.count


class Spheres(_Geometry):
    """Spheres in arrays that each commit reads anew.

    Parameters
    ----------
    centers : (n, 3) float32, float64 or float16
        World units. Rows may be apart, as in a column of a structured array; the numbers of a row lie side by side.
    radius : float or (n,) float32, float64 or float16
        Of all spheres, or of each; with `types`, of each type. World units, 0 or more.
    types : (n,) uint8, uint16, uint32, int32, uint64 or int64, optional
        The radius of sphere i is ``radius[types[i]]``.
    origin : three floats, optional
        Subtracted from the centres in double before they are rounded; hits, cameras and rays are relative to it.
    mask : int, optional
        A ray sees the geometry if this and the ray's mask share a bit; 0: all bits set.

    Notes
    -----
    Arrays are referenced, never copied here: change them, and commit. float32 without origin and types is also traced
    where it lies, so it must stay unchanged until the last trace before the next commit.

    Examples
    --------
    >>> import cgt, numpy
    >>> len(cgt.Spheres(numpy.zeros((5, 3)), 0.1))
    5
    """

    __slots__ = ()
    centers = given("centers", "As they were passed.")
    radius = given("radius", "As it was passed; `Scene.update` takes other spheres.")
    types = given("types", "As they were passed.")

    def __init__(
        self,
        centers: ArrayLike,
        radius: Union[float, ArrayLike] = 0.0,
        *,
        types: Optional[ArrayLike] = None,
        origin: Sequence[float] = (0, 0, 0),
        mask: int = 0,
    ):
        super().__init__("spheres", {"centers": centers, "radius": radius,
              "types": types, "origin": origin, "mask": mask})
        centers = self._refer("centers", centers, POINTS, 3)
        self._struct.count = len(centers)
        self._refer_radii(radius, types, len(centers), "centers")
        self._made = True

    def _balls(self) -> Tuple[np.ndarray, np.ndarray]:
        return self._arrays["centers"] - np.array(list(self._struct.origin)), self._radii(len(self))


class Triangles(_Geometry):
    """Triangles in arrays that each commit reads anew.

    Parameters
    ----------
    vertices : (m, 3) float32, float64 or float16
        World units.
    indices : (n, 3) of the types of `Spheres.types`, optional
        The vertices of each triangle; without it, three vertices each follow each other.
    origin, mask : optional
        As of `Spheres`.

    Notes
    -----
    As `Spheres`: referenced, and traced in place where vertices are float32 without origin and indices have 32 bits.
    Faces of 64 bits, such as trimesh's, are copied by each commit.
    """

    __slots__ = ()
    vertices = given("vertices", "As they were passed.")
    indices = given("indices", "As they were passed.")

    def __init__(
        self,
        vertices: ArrayLike,
        indices: Optional[ArrayLike] = None,
        *,
        origin: Sequence[float] = (0, 0, 0),
        mask: int = 0,
    ):
        super().__init__("triangles", {"vertices": vertices, "indices": indices, "origin": origin, "mask": mask})
        self._struct.count = self._refer_indices(indices, len(self._refer_vertices(vertices)), 3)
        self._made = True

    def _balls(self) -> Tuple[np.ndarray, np.ndarray]:
        corners = self._arrays["vertices"]
        if "indices" in self._arrays:
            is_seen = np.zeros(len(corners), bool)
            is_seen[self._places("indices", len(corners))] = True
            corners = corners[is_seen]
        corners = corners - np.array(list(self._struct.origin))
        return corners, np.zeros(len(corners))


class Capsules(_Geometry):
    """Capsules, all points within a radius of a segment, in arrays that each commit reads anew.

    Parameters
    ----------
    vertices : (m, 3) float32, float64 or float16
        World units.
    radius : float or (n,) float32, float64 or float16
        Of all capsules, or of each; with `types`, of each type.
    indices : (n, 2) of the types of `Spheres.types`, optional
        The two ends of each capsule, such as a molecule's bonds; without them and `ends`, two vertices each follow each
        other.
    ends : (m, 3) float32, float64 or float16, optional
        Capsule i goes from vertex i to end i.
    types, origin, mask : optional
        As of `Spheres`.

    Notes
    -----
    As `Spheres`.
    """

    __slots__ = ()
    vertices = given("vertices", "As they were passed.")
    radius = given("radius", "As it was passed.")
    indices = given("indices", "As they were passed.")
    ends = given("ends", "As they were passed.")
    types = given("types", "As they were passed.")

    def __init__(
        self,
        vertices: ArrayLike,
        radius: Union[float, ArrayLike] = 0.0,
        indices: Optional[ArrayLike] = None,
        *,
        ends: Optional[ArrayLike] = None,
        types: Optional[ArrayLike] = None,
        origin: Sequence[float] = (0, 0, 0),
        mask: int = 0,
    ):
        super().__init__("capsules", {"vertices": vertices, "radius": radius, "indices": indices, "ends": ends,
                                      "types": types, "origin": origin, "mask": mask})
        vertices = self._refer_vertices(vertices)
        count = len(vertices)
        if ends is not None and indices is not None:
            raise InvalidArgument("ends: with indices: one of them")
        if ends is not None:
            ends = self._refer("ends", ends, POINTS, 3)
            if len(ends) != count:
                raise InvalidArgument(f"ends: shape {ends.shape}: must be that of vertices")
        else:
            count = self._refer_indices(indices, count, 2)
        self._struct.count = count
        self._refer_radii(radius, types, count, "capsules")
        self._made = True

    def _balls(self) -> Tuple[np.ndarray, np.ndarray]:
        vertices, indices, ends = (self._arrays.get(name) for name in ("vertices", "indices", "ends"))
        if ends is not None:
            first, second = vertices, ends
        elif indices is not None:
            first, second = (vertices[places] for places in self._places("indices", len(vertices)).T)
        else:
            first, second = vertices[0::2], vertices[1::2]
        return np.concatenate([first, second]) - np.array(list(self._struct.origin)), np.tile(self._radii(len(self)), 2)


def _member(name: str, doc: str, read, check) -> property:
    """A camera's value, in its struct alone."""
    def set(self, value) -> None:
        if self._frozen:
            raise AttributeError("Camera: a frame was traced with it: change a copy (copy.copy)")
        setattr(self._struct, name, check(name, value))

    return property(lambda self: read(getattr(self._struct, name)), set, doc=doc)


def _fixed(values) -> np.ndarray:
    """What tells a vector, and cannot be written: it is no part of what it is of."""
    a = np.array(list(values))
    a.flags.writeable = False
    return a


def _vector(name: str, doc: str) -> property:
    return _member(name, doc + " Assign another one to change it.", _fixed, three)


def _number(name: str, doc: str) -> property:
    return _member(name, doc, lambda value: value, real)


class Camera(Plain):
    """A camera; pixels are rows from the top.

    Parameters
    ----------
    eye, target : three floats
        Where it is and what it looks at.
    up : three floats, optional
        Not parallel to target - eye.
    fov : float, optional
        Perspective: vertical angle in degrees, below 180.
    projection : {'perspective', 'orthographic'}, optional
    height : float, optional
        Orthographic: height of the picture in world units.
    t_min, t_max : float, optional
        Hits outside this range are ignored; t_max 0: no limit.
    mask : int, optional
        Of its rays, as of `Spheres`; 0: all bits set.

    Notes
    -----
    All of them may be assigned; frames and pictures keep the camera that they were made with. `fit`, `orbit`, `axes`
    and `key_light` need the library cgt-picture.
    """

    __slots__ = ("_struct", "_frozen")

    eye = _vector("eye", "Where it is, (3,) float64.")
    target = _vector("target", "What it looks at, (3,) float64.")
    up = _vector("up", "What is up in pictures, (3,) float64.")
    fov = _number("fov", "Perspective: vertical angle in degrees.")
    height = _number("height", "Orthographic: height of the picture in world units.")
    t_min = _number("t_min", "Hits before it are ignored.")
    t_max = _number("t_max", "Hits beyond it are ignored; 0: none.")
    mask = _member("mask", "Of its rays; 0: all bits set.", int, whole)
    projection = _member("projection", "'perspective' or 'orthographic'.", lambda p: _PROJECTIONS[p],
                         lambda name, value: enum_value("CGT_PROJECTION_", value, name))

    def __init__(
        self,
        eye: Sequence[float] = (0, 0, 5),
        target: Sequence[float] = (0, 0, 0),
        up: Sequence[float] = (0, 1, 0),
        fov: float = 45.0,
        *,
        projection: str = "perspective",
        height: float = 2.0,
        t_min: float = 0.0,
        t_max: float = 0.0,
        mask: int = 0,
    ):
        s = self._struct = ffi.new("cgt_camera *")
        s.eye, s.target, s.up = three("eye", eye), three("target", target), three("up", up)
        s.projection = enum_value("CGT_PROJECTION_", projection, "projection")
        s.fov, s.height = real("fov", fov), real("height", height)
        s.t_min, s.t_max, s.mask = real("t_min", t_min), real("t_max", t_max), whole("mask", mask)
        self._frozen, self._made = False, True

    def _copy(self, frozen: bool = False) -> "Camera":
        """One of its own; frozen: that what was traced keeps."""
        camera = Camera.__new__(Camera)
        camera._struct, camera._frozen, camera._made = ffi.new("cgt_camera *", self._struct[0]), frozen, True
        return camera

    def _changed(self):
        """The struct, to be changed."""
        self.eye = self.eye  # a frozen one says so
        return self._struct

    def _arguments(self) -> dict:
        return {name: getattr(self, name).tolist() if name in ("eye", "target", "up") else getattr(self, name)
                for name in ("eye", "target", "up", "fov", "projection", "height", "t_min", "t_max", "mask")}

    def _told(self) -> dict:
        return {k: v for k, v in self._arguments().items() if k in ("eye", "target", "up", "fov") or v != getattr(
            _DEFAULT, k)}

    def fit(self, geometries: Union[_Geometry, Sequence[_Geometry]], width: int, height: int) -> None:
        """Moves it so that it shows all of some geometries, in the middle, with a margin of 4 percent.

        Its direction, up, angle and projection stay. What is not finite is left out.

        Parameters
        ----------
        geometries : Spheres, Triangles, Capsules or a sequence of them
        width, height : int
            Pixels of the picture.

        Raises
        ------
        InvalidArgument
            There is nothing to show, an index or a type is out of range, or floats cannot hold the camera, which stays
            as it was.
        """
        from .picture import lib as library

        geometries = [geometries] if isinstance(geometries, _Geometry) else several(
            "geometries", geometries, "geometries")
        parts = [(np.empty((0, 3)), np.empty(0))] + [instance("geometries", g, _Geometry)._balls() for g in geometries]
        balls = Spheres(*(np.concatenate(part) for part in zip(*parts)))
        width, height = whole("width", width), whole("height", height)
        result = library.cgt_camera_fit_spheres(self._changed(), width, height, balls._struct)
        if result:
            raise exception_of(result, "geometries: there is nothing to show, or floats cannot hold its camera")

    def orbit(self, degrees: float) -> None:
        """Turns the eye about the axis through the target along `up`, counter-clockwise seen from the tip of up."""
        from .picture import lib as library

        library.cgt_camera_orbit(self._changed(), real("degrees", degrees))

    @property
    def axes(self) -> np.ndarray:
        """Unit vectors to the right, up, and along its axis, as rows: (3, 3) float32."""
        from .picture import lib as library

        rows = np.empty((3, 3), F4)
        library.cgt_camera_get_axes(self._struct, *(_arrays.pointer(row) for row in rows))
        return rows

    def key_light(self, width: int, height: int) -> np.ndarray:
        """The direction towards a light over its left shoulder, of pictures that name no light: (3,) float32."""
        from .picture import lib as library

        direction = np.empty(3, F4)
        width, height = whole("width", width, 1), whole("height", height, 1)
        library.cgt_camera_get_key_light(self._struct, width, height, _arrays.pointer(direction))
        return direction


_PROJECTIONS = {lib.CGT_PROJECTION_PERSPECTIVE: "perspective", lib.CGT_PROJECTION_ORTHOGRAPHIC: "orthographic"}
_DEFAULT = Camera()


class Light(Plain):
    """A light without extent.

    Parameters
    ----------
    position : three floats
        Where it is; of a directional one, the direction from the scene to it, of any length but zero.
    kind : {'point', 'directional'}, optional
    """

    __slots__ = ()
    position = given("position", "Where it is, three floats.")
    kind = given("kind", "'point' or 'directional'.")

    def __init__(self, position: Sequence[float], kind: str = "point"):
        enum_value("CGT_LIGHT_", kind, "kind")
        self._given = {"position": tuple(three("position", position)), "kind": kind}
        self._made = True

    def _values(self) -> dict:
        return {"kind": enum_value("CGT_LIGHT_", self.kind, "kind"), "position": self.position}
