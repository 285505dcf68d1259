# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A ray intersector with trimesh's interface, for any mesh with `vertices` and `faces`; trimesh itself is not needed.

    mesh.ray = cgt.trimesh.RayMeshIntersector(mesh)

Rays are moved to the mesh in double, wherever they begin, and traced exactly for its vertices as floats about its
middle; then distances and places are found in double. None is missed at an edge or a vertex, none is found twice, walls
of a closed mesh come in pairs however thin it is, and no offset moves a ray from hit to hit.
"""
from __future__ import annotations

from typing import Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import F4, F8, I8, U4, check_shape, numbers
from ._native import InvalidArgument, switch, whole
from .geometry import Triangles
from .results import INVALID_ID
from .context import Context
from .scene import Scene

_BEFORE = 2.0 ** -16  # of a mesh's size: how far behind their origins rays begin


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _rows(name: str, a: ArrayLike, dtype: np.dtype) -> np.ndarray:
    """Threes of numbers; where there are none, of whatever shape."""
    found = numbers(name, a, dtype)
    if found.size:
        check_shape(name, found, ("n", 3))
    return found.reshape(-1, 3)


class _Moved:
    """Rays that begin near a mesh: where one enters the ball around it, or just behind its own origin within that.

    Then floats hold them to the digits that they have for the mesh, however far off they begin. Vectors are (3, n), and
    distances in units of the directions.
    """

    def __init__(self, org: np.ndarray, dir: np.ndarray, middle: np.ndarray, reach: float):
        place, step = np.empty((2, 3, len(org)))
        for k in range(3):
            np.subtract(org[:, k], middle[k], out=place[k])
            step[k] = dir[:, k]
        with np.errstate(all="ignore"):
            square = _dot(step, step)
            if len(org) and not (square.min() > 1e-20 and square.max() < 1e20):  # floats hold others badly
                size = np.abs(step).max(axis=0)
                step /= np.where(size > 0, size, 1)
                square = _dot(step, step)
            middle_at, ball = -_dot(place, step) / square, reach / np.sqrt(square)
            start = np.maximum(middle_at - ball, -_BEFORE * ball)
            at = np.empty((3, len(org)), F4)
            for k in range(3):
                at[k] = place[k] + start * step[k]
            ahead = middle_at >= -ball
        if not ahead.all():
            at[:, ~ahead] = np.nan  # it leads away
        self.place, self.step, self.start, self.ball, self.at, self.to = place, step, start, ball, at, step.astype(F4)

    def __getitem__(self, rays: np.ndarray) -> _Moved:
        some = object.__new__(_Moved)
        vars(some).update((name, a[..., rays]) for name, a in vars(self).items())
        return some


class RayMeshIntersector:
    """Rays against a mesh.

    Parameters
    ----------
    mesh : object
        With vertices, (m, 3) float, and faces, (n, 3) int.
    context : cgt.Context, optional
        Threads; None: one of its own.

    Notes
    -----
    The mesh is read anew when ``hash(mesh)`` differs: trimesh's meshes have one of their contents. For other meshes
    call `update` after a change. A ray does not find what it begins on. Where triangles meet in an edge or a vertex
    that a ray hits, a surface counts once; one that only touches an edge crosses nothing, or twice.

    Examples
    --------
    >>> import cgt.trimesh, types
    >>> mesh = types.SimpleNamespace(vertices=[[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces=[[0, 1, 2]])
    >>> rays = cgt.trimesh.RayMeshIntersector(mesh)
    >>> rays.intersects_first([[0.2, 0.2, 1], [2, 2, 1]], [[0, 0, -1], [0, 0, -1]]).tolist()
    [0, -1]
    """

    def __init__(self, mesh, context: Optional[Context] = None):
        self.mesh = mesh
        self._context = context
        self._scene = Scene(context, rays="incoherent")
        self._geometry: Optional[int] = None
        self._key = None

    def __getstate__(self):
        return self.mesh, self._context  # copies and pickles read the mesh anew

    def __setstate__(self, state):
        self.__init__(*state)

    def update(self) -> None:
        """Reads the mesh now."""
        vertices = np.ascontiguousarray(_rows("mesh.vertices", self.mesh.vertices, F8))
        faces = _rows("mesh.faces", self.mesh.faces, I8)
        if len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
            raise InvalidArgument(f"mesh.faces: {faces.min()} to {faces.max()}, of {len(vertices)} vertices")
        finite = vertices[np.isfinite(vertices).all(axis=1)]
        low, high = (finite.min(axis=0), finite.max(axis=0)) if len(finite) else (np.zeros(3), np.zeros(3))
        self._origin = (low / 2 + high / 2).astype(F4).astype(F8)  # an origin that floats hold
        self._reach = 1.01 * float(np.linalg.norm(np.maximum(high - self._origin, self._origin - low))) or 1e-30
        a, b, c = (vertices[faces[:, k]] - self._origin for k in range(3))
        self._normals = np.ascontiguousarray(np.cross(b - a, c - a).T)
        self._offsets = _dot(self._normals, a.T)
        triangles = Triangles(vertices, faces.astype(U4), origin=self._origin)
        if self._geometry is None:
            self._geometry = self._scene.add(triangles)
        else:
            self._scene.update(self._geometry, triangles)
        self._scene.commit()
        self._key = hash(self.mesh) if self.mesh.__hash__ else None

    def _ready(self) -> Scene:
        if self._geometry is None or (self.mesh.__hash__ and hash(self.mesh) != self._key):
            self.update()
        return self._scene

    def _rays(self, origins, directions) -> _Moved:
        o = numbers("ray_origins", origins, F8)
        d = numbers("ray_directions", directions, F8)
        if o.ndim != 2 or o.shape[1:] != (3,) or d.shape != o.shape:
            raise InvalidArgument(f"ray_origins, ray_directions: shapes {o.shape}, {d.shape}: must be (n, 3) both")
        return _Moved(o, d, self._origin, self._reach)

    def _distances(self, rays: _Moved, ray: np.ndarray, t: np.ndarray, triangle: np.ndarray):
        """The distances of hits in double, and which of them lie ahead of the origin."""
        normal, place, step = self._normals[:, triangle], rays.place[:, ray], rays.step[:, ray]
        near, ball = rays.start[ray] + t, rays.ball[ray]
        with np.errstate(all="ignore"):
            far = (self._offsets[triangle] - _dot(normal, place)) / _dot(normal, step)
        # where a plane is nearly parallel to the ray, what floats found is nearer
        good = np.abs(far - near) < 1e-4 * ball
        found = np.where(good, far, near)
        ahead = found > np.where(good, 2.0 ** -44 * (1 + np.abs(place).max(axis=0) / self._reach), 2.0 ** -20) * ball
        return found, ahead

    def _nearest(self, rays: _Moved):
        """The first triangle of each ray, -1 without, and its distance in single precision."""
        hits = self._scene.trace_rays(rays.at.T, rays.to.T, ("t", "primitive", "uv"))
        triangle, t = hits.primitive.astype(I8), hits.t.astype(F8)
        triangle[triangle == INVALID_ID] = -1
        u, v = hits.u, hits.v
        # what may be a touch, or lie where the ray begins
        on_edge = np.minimum(np.minimum(u, v), 1 - u - v) < 1e-6
        doubtful = np.flatnonzero((triangle >= 0) & (on_edge | (t < 2 * _BEFORE * rays.ball) & (rays.start < 0)))
        if len(doubtful):
            triangle[doubtful] = -1
            ray, distance, found = self._all(rays[doubtful])
            if len(ray):
                first = np.flatnonzero(np.r_[True, np.diff(ray) != 0])
                at = doubtful[ray[first]]
                triangle[at], t[at] = found[first], distance[first] - rays.start[at]
        return triangle, t

    def _all(self, rays: _Moved):
        """All crossings: rays, distances and triangles, ordered by ray, then along it."""
        hits = self._scene.trace_all_rays(rays.at.T, rays.to.T, crossings=True)
        ray, triangle = hits.ray, hits.primitive.astype(I8)
        t, ahead = self._distances(rays, ray, hits.t, triangle)
        if not ahead.all():
            ray, t, triangle = ray[ahead], t[ahead], triangle[ahead]
        if ((np.diff(t) < 0) & (np.diff(ray) == 0)).any():
            order = np.lexsort((t, ray))
            ray, t, triangle = ray[order], t[order], triangle[order]
        return ray, t, triangle

    def intersects_id(self, ray_origins: ArrayLike, ray_directions: ArrayLike, multiple_hits: bool = True,
                      max_hits: Optional[int] = None, return_locations: bool = False):
        """Finds the triangles that rays hit.

        Parameters
        ----------
        ray_origins, ray_directions : (n, 3) float
            Directions of any length but zero.
        multiple_hits : bool, optional
            Every hit along a ray, in order, or the first alone.
        max_hits : int, optional
            At most so many of a ray.
        return_locations : bool, optional

        Returns
        -------
        index_tri, index_ray : (m,) int64
            Ordered by ray, then along it.
        locations : (m, 3) float64
            With `return_locations`: origin + t direction, in double.
        """
        multiple_hits = switch("multiple_hits", multiple_hits)
        return_locations = switch("return_locations", return_locations)
        self._ready()
        rays = self._rays(ray_origins, ray_directions)
        max_hits = None if max_hits is None else whole("max_hits", max_hits)
        if multiple_hits and rays.start.size:
            ray, t, triangle = self._all(rays)
            if max_hits is not None and len(ray):
                first = np.flatnonzero(np.r_[True, np.diff(ray) != 0])
                number = np.arange(len(ray)) - np.repeat(first, np.diff(np.r_[first, len(ray)]))
                ray, t, triangle = (a[number < max_hits] for a in (ray, t, triangle))
        else:
            triangle, t = self._nearest(rays)
            ray = np.flatnonzero((triangle >= 0) & (max_hits != 0))
            triangle = triangle[ray]
            t, _ = self._distances(rays, ray, t[ray], triangle)
        if not return_locations:
            return triangle, ray
        return triangle, ray, (rays.place[:, ray] + t * rays.step[:, ray]).T + self._origin

    def intersects_location(self, ray_origins: ArrayLike, ray_directions: ArrayLike, multiple_hits: bool = True,
                            **kwargs):
        """Finds where rays hit the mesh.

        Returns
        -------
        locations : (m, 3) float64
        index_ray, index_tri : (m,) int64
            As of `intersects_id`, whose arguments these are.
        """
        index_tri, index_ray, locations = self.intersects_id(ray_origins, ray_directions, multiple_hits=multiple_hits,
                                                             return_locations=True, **kwargs)
        return locations, index_ray, index_tri

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> np.ndarray:
        """Returns the first triangle of each ray, (n,) int64, -1 without a hit."""
        self._ready()
        return self._nearest(self._rays(ray_origins, ray_directions))[0]

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> np.ndarray:
        """Returns whether each ray hits anything, (n,) bool."""
        return self.intersects_first(ray_origins, ray_directions) >= 0

    def contains_points(self, points: ArrayLike) -> np.ndarray:
        """Returns whether points, (n, 3), are inside of the mesh, which must be closed: (n,) bool."""
        scene = self._ready()
        p = numbers("points", points, F8, ("n", 3))
        with np.errstate(over="ignore"):  # what floats cannot hold is far away
            return scene.points_inside((p - self._origin).astype(F4))
