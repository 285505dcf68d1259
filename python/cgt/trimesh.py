# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A ray intersector with trimesh's interface, for any mesh with `vertices` and `faces`; trimesh itself is not needed.

    mesh.ray = cgt.trimesh.RayMeshIntersector(mesh)

Hits are exact for the vertices as floats about the middle of the mesh: none is missed at an edge or a vertex, none is
found twice, and no offset moves a ray from hit to hit.
"""
from typing import Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import F4
from ._native import InvalidArgument
from .geometry import Triangles
from .results import INVALID_ID
from .context import Context
from .scene import Scene

_AFTER_START = np.finfo(F4).smallest_subnormal


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
    call `update` after a change. A ray does not find what it begins on (t = 0). Of triangles that meet where a ray hits
    them, in an edge or a vertex, the one of the lowest index is found, so that a surface counts once.

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
        self._scene = Scene(context, rays="incoherent")
        self._geometry: Optional[int] = None
        self._key = None
        self._origin = np.zeros(3)

    def update(self) -> None:
        """Reads the mesh now."""
        vertices = np.ascontiguousarray(self.mesh.vertices, np.float64).reshape(-1, 3)
        faces = np.asarray(self.mesh.faces).reshape(-1, 3)
        if len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
            raise InvalidArgument(f"mesh.faces: {faces.min()} to {faces.max()}, of {len(vertices)} vertices")
        finite = vertices[np.isfinite(vertices).all(axis=1)]
        # an origin that floats hold, so that the mesh keeps its digits and rays lose none
        self._origin = (finite.min(axis=0) / 2 + finite.max(axis=0) / 2).astype(F4).astype(np.float64) if len(
            finite) else np.zeros(3)
        triangles = Triangles(vertices, faces.astype(np.uint32), origin=self._origin)
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

    def _rays(self, origins, directions) -> Tuple[np.ndarray, np.ndarray]:
        o, d = np.asarray(origins, np.float64), np.asarray(directions, np.float64)
        if o.ndim != 2 or o.shape[1:] != (3,) or d.shape != o.shape:
            raise InvalidArgument(f"ray_origins, ray_directions: shapes {o.shape}, {d.shape}: must be (n, 3) both")
        return (o - self._origin).astype(F4), d.astype(F4)

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
        scene = self._ready()
        org, dir = self._rays(ray_origins, ray_directions)
        if multiple_hits and len(org):
            hits = scene.trace_all_rays(org, dir, t_min=_AFTER_START)
            # neighbours of one ray at the same t lie in the same place
            once = np.ones(len(hits.ray), bool)
            once[1:] = (np.diff(hits.ray) != 0) | (np.diff(hits.t) != 0)
            ray, t, primitive = hits.ray[once], hits.t[once], hits.primitive[once]
            if max_hits is not None and len(ray):
                first = np.flatnonzero(np.r_[True, np.diff(ray) != 0])
                number = np.arange(len(ray)) - np.repeat(first, np.diff(np.r_[first, len(ray)]))
                ray, t, primitive = ray[number < max_hits], t[number < max_hits], primitive[number < max_hits]
        else:
            nearest = scene.trace_rays(org, dir, t_min=_AFTER_START)
            ray = np.flatnonzero(nearest.hit)
            t, primitive = nearest.t[ray], nearest.primitive[ray]
        index_tri, index_ray = primitive.astype(np.int64), ray.astype(np.int64)
        if not return_locations:
            return index_tri, index_ray
        o, d = np.asarray(ray_origins, np.float64), np.asarray(ray_directions, np.float64)
        return index_tri, index_ray, o[ray] + t[:, None].astype(np.float64) * d[ray]

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
        scene = self._ready()
        found = scene.trace_rays(*self._rays(ray_origins, ray_directions), ("primitive",), t_min=_AFTER_START)
        return np.where(found.primitive == INVALID_ID, -1, found.primitive.astype(np.int64))

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> np.ndarray:
        """Returns whether each ray hits anything, (n,) bool."""
        scene = self._ready()
        return scene.occluded_rays(*self._rays(ray_origins, ray_directions), t_min=_AFTER_START)

    def contains_points(self, points: ArrayLike) -> np.ndarray:
        """Returns whether points, (n, 3), are inside of the mesh, which must be closed: (n,) bool."""
        scene = self._ready()
        p = np.asarray(points, np.float64)
        if p.ndim != 2 or p.shape[1:] != (3,):
            raise InvalidArgument(f"points: shape {p.shape}: must be (n, 3)")
        return scene.points_inside((p - self._origin).astype(F4))
