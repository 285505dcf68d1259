# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Geometries, cameras and lights: descriptions that refer to numpy's arrays."""
from typing import Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F2, F4, F8, I4, I8, U1, U2, U4, U8
from ._native import InvalidArgument, Native, enum_value, exception_of, ffi, instance, real, three, whole


POINTS, NUMBERS = (F8, F4, F2), (U4, I4, U2, U1, U8, I8)  # what coordinates and radii, indices and types may be


def _three(name: str, value) -> list:
    return value.tolist() if isinstance(value, np.ndarray) and value.shape == (3,) else three(name, value)


class _Geometry(Native):
    """A C struct and the arrays that it points to."""

    def __init__(self, kind: str, origin, mask: int):
        self._made = False
        self._kind = kind
        self._given: dict = {}  # arrays as they were passed
        self._holds: dict = {}  # what keeps them
        self._arrays: dict = {}  # as C reads them
        self._struct = ffi.new(f"cgt_{kind} *")
        self._struct.origin = _three("origin", origin)
        self._struct.mask = whole("mask", mask)

    def _refer(self, name: str, array, dtypes, width: int, member: str = "") -> np.ndarray:
        """Refers to an array of `width` numbers a row: `member` of the struct, by default the one of that name."""
        hold, stride = _arrays.given_rows(name, array, dtypes, width)
        view = hold.view
        self._given[name] = array if isinstance(array, np.ndarray) else view
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
        if np.ndim(radius) == 0 and types is None:
            self._struct.radius = real("radius", radius)
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
        return np.asarray(radii if types is None else radii[types], F8)

    def _balls(self) -> Tuple[np.ndarray, np.ndarray]:
        """Centres and radii of balls that have the geometry's convex hull, relative to its origin, in double."""
        raise NotImplementedError

    @property
    def arrays(self) -> dict:
        """The arrays by name, as each commit reads them."""
        return dict(self._given)

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

    def __init__(
        self,
        centers: ArrayLike,
        radius: Union[float, ArrayLike] = 0.0,
        *,
        types: Optional[ArrayLike] = None,
        origin: Sequence[float] = (0, 0, 0),
        mask: int = 0,
    ):
        super().__init__("spheres", origin, mask)
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

    def __init__(
        self,
        vertices: ArrayLike,
        indices: Optional[ArrayLike] = None,
        *,
        origin: Sequence[float] = (0, 0, 0),
        mask: int = 0,
    ):
        super().__init__("triangles", origin, mask)
        self._struct.count = self._refer_indices(indices, len(self._refer_vertices(vertices)), 3)
        self._made = True

    def _balls(self) -> Tuple[np.ndarray, np.ndarray]:
        corners = self._arrays["vertices"] - np.array(list(self._struct.origin))
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
        super().__init__("capsules", origin, mask)
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
            first, second = vertices[indices[:, 0]], vertices[indices[:, 1]]
        else:
            first, second = vertices[0::2], vertices[1::2]
        return np.concatenate([first, second]) - np.array(list(self._struct.origin)), np.tile(self._radii(len(self)), 2)


def _vector(name: str, doc: str) -> property:
    def get(self) -> np.ndarray:
        return np.array(list(getattr(self._struct, name)))

    def set(self, value) -> None:
        setattr(self._struct, name, _three(name, value))

    return property(get, set, doc=doc)


class Camera(Native):
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
    eye, target and up may be changed; frames and pictures keep the camera that they were made with. `fit`, `orbit`,
    `axes` and `key_light` need the library cgt-picture.
    """

    eye = _vector("eye", "Where it is, (3,) float64.")
    target = _vector("target", "What it looks at, (3,) float64.")
    up = _vector("up", "What is up in pictures, (3,) float64.")

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
        self._struct = ffi.new("cgt_camera *")
        self._struct.projection = enum_value("CGT_PROJECTION_", projection, "projection")
        self._struct.eye = _three("eye", eye)
        self._struct.target = _three("target", target)
        self._struct.up = _three("up", up)
        self._struct.fov, self._struct.height = real("fov", fov), real("height", height)
        self._struct.t_min, self._struct.t_max = real("t_min", t_min), real("t_max", t_max)
        self._struct.mask = whole("mask", mask)
        self._made = True

    def _copy(self) -> "Camera":
        camera = Camera.__new__(Camera)
        camera._struct, camera._made = ffi.new("cgt_camera *", self._struct[0]), True
        return camera

    def __copy__(self) -> "Camera":
        return self._copy()

    def __deepcopy__(self, _memo) -> "Camera":
        return self._copy()

    def __reduce_ex__(self, _protocol):
        s = self._struct
        values = {name: getattr(s, name) for name in ("fov", "height", "t_min", "t_max", "mask")}
        projection = "orthographic" if s.projection else "perspective"
        return _camera, (list(s.eye), list(s.target), list(s.up), {"projection": projection, **values})

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
            There is nothing to show, or floats cannot hold the camera, which stays as it was.
        """
        from .picture import lib

        geometries = [geometries] if isinstance(geometries, _Geometry) else geometries
        parts = [(np.empty((0, 3)), np.empty(0))] + [instance("geometries", g, _Geometry)._balls() for g in geometries]
        balls = Spheres(*(np.concatenate(part) for part in zip(*parts)))
        width, height = whole("width", width), whole("height", height)
        result = lib.cgt_camera_fit_spheres(self._struct, width, height, balls._struct)
        if result:
            raise exception_of(result, "geometries: there is nothing to show, or floats cannot hold its camera")

    def orbit(self, degrees: float) -> None:
        """Turns the eye about the axis through the target along `up`, counter-clockwise seen from the tip of up."""
        from .picture import lib

        lib.cgt_camera_orbit(self._struct, real("degrees", degrees))

    @property
    def axes(self) -> np.ndarray:
        """Unit vectors to the right, up, and along its axis, as rows: (3, 3) float32."""
        from .picture import lib

        rows = np.empty((3, 3), F4)
        lib.cgt_camera_get_axes(self._struct, *(_arrays.pointer(row) for row in rows))
        return rows

    def key_light(self, width: int, height: int) -> np.ndarray:
        """The direction towards a light over its left shoulder, of pictures that name no light: (3,) float32."""
        from .picture import lib

        direction = np.empty(3, F4)
        width, height = whole("width", width, 1), whole("height", height, 1)
        lib.cgt_camera_get_key_light(self._struct, width, height, _arrays.pointer(direction))
        return direction

    def __repr__(self) -> str:
        s = self._struct
        return f"Camera(eye={list(s.eye)}, target={list(s.target)}, up={list(s.up)}, fov={s.fov:g})"


def _camera(eye, target, up, rest) -> Camera:
    """What pickle makes a camera with."""
    return Camera(eye, target, up, **rest)


class Light:
    """A light without extent.

    Parameters
    ----------
    position : three floats
        Where it is; of a directional one, the direction from the scene to it, of any length but zero.
    kind : {'point', 'directional'}, optional
    """

    _made = False

    def __init__(self, position: Sequence[float], kind: str = "point"):
        self.position = _three("position", position)
        self.kind = kind
        self._kind = enum_value("CGT_LIGHT_", kind, "kind")
        self._made = True

    def _values(self) -> dict:
        return {"kind": self._kind, "position": _three("position", self.position)}

    def __repr__(self) -> str:
        return f"Light({self.position}, {self.kind!r})"
