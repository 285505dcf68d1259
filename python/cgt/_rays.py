# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A scene's calls for rays and points: nearest hits, all hits, mirrors and glass."""
from __future__ import annotations

from typing import Mapping, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F4, U4, Outputs, ray_vectors, refuse_overlap, scalar_pointers, vector_pointers
from ._calls import Out, _Call, _Rays, _hits_struct, _flat, _expand, _bytes_out, _names, _taken
from ._native import InvalidArgument, enum_value, ffi, instance, lib, pair, real, switch, three, whole
from .geometry import Light
from .results import BOUNCED_FIELDS, RAY_FIELDS, ROW_FIELDS, SURFACE_FIELDS, AllHits, Fields, HitRows, Hits, SingleHit

_SINGLE_RAY, _SINGLE_HIT = ffi.typeof("cgt_single_ray *"), ffi.typeof("cgt_hit *")
_FAR = np.inf


def _rows_of(name: str, a: np.ndarray, shape) -> np.ndarray:
    """Rows for all rays: their own, or one for all."""
    return a if a.shape == shape else np.broadcast_to(a.reshape(shape[1:]), shape)


class Rays:
    """Rays and points; all hits of rays; rays that go on from hits."""

    __slots__ = ()

    # ---- rays ----

    def trace_rays(self, org: ArrayLike, dir: ArrayLike, fields: Sequence[str] = ("t", "primitive"), *,
                   t_min: Optional[ArrayLike] = None, t_max: Optional[ArrayLike] = None,
                   mask: Optional[ArrayLike] = None, skip_primitive: Optional[ArrayLike] = None,
                   skip_geometry: Optional[ArrayLike] = None, out: Out = None, precision: str = "exact",
                   statistics: bool = False, research=None) -> Hits:
        """Traces rays to their nearest hits; neighbours in the arrays should be neighbours in space.

        Parameters
        ----------
        org, dir : (..., 3)
            Origins and directions, these of any length but zero; float32 is read in place, all else copied. Either may
            be three numbers for all.
        fields : sequence of str
            Of t, primitive, geometry, normal, uv.
        t_min, t_max : (...) float32, optional
            Range in which hits count, closed at both ends; below t_min, the ray is off.
        mask : (...) uint32, optional
            A ray sees a geometry if their masks share a bit; 0: all.
        skip_primitive, skip_geometry : (...) uint32, optional
            A primitive that the ray does not find, such as the one that it leaves; `INVALID_ID`: none.
        out : mapping or structured array, optional
            Arrays by field.
        precision, statistics, research : optional
            As of `trace_camera`.

        Returns
        -------
        Hits
        """
        rays = _Rays(org, dir, t_min=t_min, t_max=t_max, mask=mask, skip_primitive=skip_primitive,
                     skip_geometry=skip_geometry)
        return self._trace(lib.cgt_trace_rays, rays, fields, out, _Call(precision, statistics, research))

    def _trace(self, function, rays, fields, out, call) -> Hits:
        outputs = Outputs(rays.shape, _expand(fields), RAY_FIELDS, out)
        for name, a in () if out is None else outputs.arrays.items():
            refuse_overlap(f"out[{name!r}]", a, rays.keep)
        flat = _flat(outputs, rays.shape)
        hits = ffi.new("cgt_hits *", _hits_struct(flat))
        with self._gate.shared:
            self._check(function(self._traced, rays.struct, hits, call.struct))
        return Hits(outputs.arrays, call.statistics())

    def occluded_rays(self, org: ArrayLike, dir: ArrayLike, *, t_min: Optional[ArrayLike] = None,
                      t_max: Optional[ArrayLike] = None, mask: Optional[ArrayLike] = None,
                      skip_primitive: Optional[ArrayLike] = None, skip_geometry: Optional[ArrayLike] = None,
                      out: Optional[np.ndarray] = None, research=None) -> np.ndarray:
        """Finds which rays hit anything in their range, faster than `trace_rays`, whose arguments these are.

        Returns
        -------
        (...) bool
        """
        rays = _Rays(org, dir, t_min=t_min, t_max=t_max, mask=mask, skip_primitive=skip_primitive,
                     skip_geometry=skip_geometry)
        occluded = _bytes_out("out", out, rays.shape, rays.keep)
        call = _Call("exact", False, research)
        with self._gate.shared:
            self._check(lib.cgt_occluded_rays(self._traced, rays.struct, _arrays.pointer(occluded.view), call.struct))
        return occluded.view.view(bool)

    @staticmethod
    def _single(org, dir, t_min, t_max, mask, skip):
        t_min, t_max = real("t_min", t_min), t_max if t_max is _FAR else real("t_max", t_max)
        if mask.__class__ is not int or not 0 <= mask <= 0xFFFFFFFF:
            mask = whole("mask", mask)
        ray, hit = ffi.new(_SINGLE_RAY, (three("org", org), three("dir", dir), t_min, t_max, mask)), None
        if skip is not None:
            primitive, geometry = pair("skip", skip)
            hit = ray.skip = ffi.new(_SINGLE_HIT, {"primitive": whole("skip", primitive),
                                                    "geometry": whole("skip", geometry)})
        return ray, hit  # which the ray points to

    def trace_ray(self, org: Sequence[float], dir: Sequence[float], *, t_min: float = 0.0, t_max: float = _FAR,
                  mask: int = 0, skip: Optional[Tuple[int, int]] = None) -> SingleHit:
        """Traces one ray on the calling thread; `skip` is a primitive and its geometry. Arrays of rays are faster."""
        hit, (ray, _skip) = ffi.new(_SINGLE_HIT), self._single(org, dir, t_min, t_max, mask, skip)
        with self._gate.shared:
            self._check(lib.cgt_trace_ray(self._traced, ray, hit, ffi.NULL))
        return SingleHit(t=hit.t, primitive=hit.primitive, geometry=hit.geometry, surface=hit.surface,
                         normal=list(hit.normal), u=hit.u, v=hit.v)

    def occluded_ray(self, org: Sequence[float], dir: Sequence[float], *, t_min: float = 0.0, t_max: float = _FAR,
                     mask: int = 0, skip: Optional[Tuple[int, int]] = None) -> bool:
        """Finds whether one ray hits anything in its range."""
        found = ffi.new("bool *")
        ray, _skip = self._single(org, dir, t_min, t_max, mask, skip)
        with self._gate.shared:
            self._check(lib.cgt_occluded_ray(self._traced, ray, found, ffi.NULL))
        return bool(found[0])

    def _points(self, position, **numbers):
        p, shape = ray_vectors("position", position)
        (at,), vector_stride, keep = vector_pointers(p)
        types = {"t_min": F4, "t_max": F4, "mask": U4, "skip_primitive": U4, "skip_geometry": U4}
        given = {name: (a, types[name]) for name, a in numbers.items() if a is not None}
        members, stride, more = scalar_pointers(given, shape)
        struct = ffi.new("cgt_points *", {"count": len(p), "stride": stride, "vector_stride": vector_stride,
                                          "position": at, **members})
        return struct, shape, keep + more

    def occluded_points(self, light: Light, position: ArrayLike, *, t_min: Optional[ArrayLike] = None,
                        t_max: Optional[ArrayLike] = None, mask: Optional[ArrayLike] = None,
                        skip_primitive: Optional[ArrayLike] = None, skip_geometry: Optional[ArrayLike] = None,
                        out: Optional[np.ndarray] = None) -> np.ndarray:
        """Finds which points, (..., 3), a light does not reach; the rest is as of `trace_rays`.

        Returns
        -------
        (...) bool
        """
        points, shape, keep = self._points(position, t_min=t_min, t_max=t_max, mask=mask,
                                           skip_primitive=skip_primitive, skip_geometry=skip_geometry)
        occluded = _bytes_out("out", out, shape, keep)
        struct = ffi.new("cgt_light *", instance("light", light, Light)._values())
        with self._gate.shared:
            self._check(lib.cgt_occluded_points(self._traced, struct, points, _arrays.pointer(occluded.view), ffi.NULL))
        del keep
        return occluded.view.view(bool)

    def points_inside(self, position: ArrayLike, *, rule: str = "parity", mask: Optional[ArrayLike] = None,
                      out: Optional[np.ndarray] = None) -> np.ndarray:
        """Finds which points, (..., 3), are inside of spheres and closed meshes.

        Parameters
        ----------
        position : (..., 3)
        rule : {'parity', 'winding'}, optional
            When a point is inside of a mesh, each geometry by itself: an odd number of its surfaces lies ahead; or not
            as many lead in as out, for meshes that overlap themselves. Inside of any geometry is inside.
        mask : (...) uint32, optional

        Returns
        -------
        (...) bool

        Raises
        ------
        Unsupported
            A geometry is one of capsules.
        """
        points, shape, keep = self._points(position, mask=mask)
        inside = _bytes_out("out", out, shape, keep)
        how = ffi.new("cgt_inside_options *", {"rule": enum_value("CGT_INSIDE_", rule, "rule")})
        with self._gate.shared:
            self._check(lib.cgt_points_inside(self._traced, points, how, _arrays.pointer(inside.view), ffi.NULL))
        del keep
        return inside.view.view(bool)

    # ---- all hits ----

    def _after(self, after, crossings, shape):
        options = ffi.new("cgt_all_hits_options *", {"crossings": switch("crossings", crossings)})
        if after is None:
            return options, []
        if not isinstance(after, Mapping) or "primitive" not in after:
            raise InvalidArgument("after: it lacks 'primitive'")
        members, options.after_stride, keep = scalar_pointers({name: (a, U4) for name, a in after.items()}, shape)
        options.after_primitive = members["primitive"]
        options.after_geometry, options.after_surface = (members.get(k, ffi.NULL) for k in ("geometry", "surface"))
        return options, keep

    def _rows(self, rays, capacity, fields, after, crossings, call) -> HitRows:
        count, capacity = rays.struct.count, whole("capacity", capacity)
        outputs = Outputs((count, capacity), _expand(fields), ROW_FIELDS)
        flat = _flat(outputs, (count, capacity))
        members = _hits_struct(flat)
        surface = members.pop("surface", ffi.NULL)
        found, further = np.empty(count, U4), np.empty(count, np.uint8)
        rows = ffi.new("cgt_hit_rows *", {"capacity": capacity, "hits": members, "surface": surface,
                                          "count": _arrays.pointer(found), "more": _arrays.pointer(further)})
        options, keep = self._after(after, crossings, (count,))
        with self._gate.shared:
            self._check(lib.cgt_trace_all_rays(self._traced, rays.struct, options, rows, call.struct))
        del keep, flat
        return HitRows({**outputs.arrays, "count": found, "more": further.view(bool)}, call.statistics())

    def trace_hit_rows(self, org: ArrayLike, dir: ArrayLike, capacity: int,
                       fields: Sequence[str] = ("t", "primitive"), *, t_min: Optional[ArrayLike] = None,
                       t_max: Optional[ArrayLike] = None, mask: Optional[ArrayLike] = None,
                       skip_primitive: Optional[ArrayLike] = None, skip_geometry: Optional[ArrayLike] = None,
                       after: Optional[Mapping[str, ArrayLike]] = None, crossings: bool = False,
                       precision: str = "exact", statistics: bool = False) -> HitRows:
        """Traces rays, (n, 3), to their first `capacity` hits each, in the order of exact distance.

        Parameters
        ----------
        after : mapping, optional
            Each ray's hits begin after this hit of its line: primitive, geometry and surface, (n,) uint32.
        crossings : bool, optional
            Only hits where the ray goes into a closed surface, surface 0, or out of it, 1: along a ray from outside to
            outside each closed mesh has as many of both, at its edges and vertices, too.
        fields : sequence of str
            Of t, primitive, geometry, normal, uv, surface.

        The rest is as of `trace_rays`.
        """
        rays = _Rays(org, dir, t_min=t_min, t_max=t_max, mask=mask, skip_primitive=skip_primitive,
                     skip_geometry=skip_geometry)
        if len(rays.shape) > 1:
            raise InvalidArgument(f"org, dir: shape {rays.shape + (3,)}: must be (n, 3)")
        return self._rows(rays, capacity, fields, after, crossings, _Call(precision, statistics, None))

    def trace_all_rays(self, org: ArrayLike, dir: ArrayLike, fields: Sequence[str] = ("t", "primitive"), *,
                       t_min: Optional[ArrayLike] = None, t_max: Optional[ArrayLike] = None,
                       mask: Optional[ArrayLike] = None, crossings: bool = False) -> AllHits:
        """Traces rays, (n, 3), to all their hits: near and far surfaces of spheres, each triangle once.

        With `crossings` only those of `trace_hit_rows` with the same.

        Returns
        -------
        AllHits
            ray and `fields`, ordered by ray, then by exact distance, geometry and primitive.
        """
        wanted = _expand(fields)
        asked = tuple(dict.fromkeys(wanted + ("primitive", "geometry", "surface")))
        (org, of_org), (dir, of_dir) = ray_vectors("org", org), ray_vectors("dir", dir)
        for name, shape in (("org", of_org), ("dir", of_dir)):
            if len(shape) > 1:
                raise InvalidArgument(f"{name}: shape {shape + (3,)}: must be (n, 3)")
        if of_org and of_dir and of_org != of_dir:
            raise InvalidArgument(f"dir: shape {of_dir + (3,)}: must be that of org, {of_org + (3,)}")
        ray_count = len(org) if of_org else len(dir)
        org, dir = _rows_of("org", org, (ray_count, 3)), _rows_of("dir", dir, (ray_count, 3))
        ranges = {}
        for name, a, dtype in (("t_min", t_min, F4), ("t_max", t_max, F4), ("mask", mask, U4)):
            if a is not None:
                a = _arrays.numbers(name, a, dtype)
                if a.shape not in ((), (ray_count,)):
                    raise InvalidArgument(f"{name}: shape {a.shape}: must be {(ray_count,)}, or one number")
                ranges[name] = np.broadcast_to(a, (ray_count,))
        numbers, after, capacity, found = np.arange(ray_count), None, 8, []
        while len(numbers):
            rays = _Rays(org[numbers], dir[numbers], **{name: a[numbers] for name, a in ranges.items()})
            rows = self._rows(rays, capacity, asked, after, crossings, _Call("exact", False, None))
            taken = np.arange(capacity) < rows.count[:, None]
            found.append({"ray": np.broadcast_to(numbers[:, None], taken.shape)[taken],
                          **{name: rows[name][taken] for name in wanted}})
            further = np.flatnonzero(rows.more)
            after = {name: rows[name][further, capacity - 1] for name in ("primitive", "geometry", "surface")}
            numbers, capacity = numbers[further], min(4 * capacity, 1024)
        empty = {"ray": np.empty(0, np.int64),
                 **{n: np.empty((0, 3) if ROW_FIELDS[n][1] > 1 else 0, ROW_FIELDS[n][0]) for n in wanted}}
        merged = {name: np.concatenate([part[name] for part in found] or [a]) for name, a in empty.items()}
        order = np.argsort(merged["ray"], kind="stable")
        return AllHits({name: a[order] for name, a in merged.items()})

    # ---- mirrors and glass ----

    def bounce_rays(self, org: ArrayLike, dir: ArrayLike, hits: Fields, *, inside: float = 0.0, outside: float = 0.0,
                    inside_of_ray: Optional[ArrayLike] = None, outside_of_ray: Optional[ArrayLike] = None,
                    skip_primitive: Optional[ArrayLike] = None, skip_geometry: Optional[ArrayLike] = None,
                    surfaces: Sequence[str] = ()) -> Tuple[Fields, Fields, Fields]:
        """Makes the rays that go on from what rays have hit: mirrored, and refracted by Snell's law.

        Parameters
        ----------
        org, dir, skip_primitive, skip_geometry
            The rays, as `trace_rays` got them.
        hits : Hits
            Their hits, with t, primitive and geometry.
        inside, outside : float, optional
            Indices of refraction; inside 0: opaque, a mirror. outside 0: 1.
        inside_of_ray, outside_of_ray : (...) float32, optional
            The same of the surface that each ray hits.
        surfaces : sequence of str, optional
            Of position, normal, start, length, front: what is wanted of the surfaces.

        Returns
        -------
        reflected, refracted : Fields
            org, dir, t_min, t_max, skip_primitive, skip_geometry, share; off where there is no such ray. Their t_max
            and skips go to `trace_bounced_rays`.
        surfaces : Fields
        """
        rays = _Rays(org, dir, skip_primitive=skip_primitive, skip_geometry=skip_geometry)
        count, names = rays.struct.count, _names("surfaces", surfaces)
        taken = _taken("hits", hits, ("t", "primitive", "geometry"))
        members, stride, keep = scalar_pointers({k: (a, F4 if k == "t" else U4) for k, a in taken.items()}, rays.shape)
        found = ffi.new("cgt_hits *", {"stride": stride, **members})
        media = ffi.new("cgt_media *", {"inside": real("inside", inside), "outside": real("outside", outside)})
        given = {name: (a, F4) for name, a in (("inside_of_ray", inside_of_ray), ("outside_of_ray", outside_of_ray))
                 if a is not None}
        members, media.stride, more = scalar_pointers(given, rays.shape)
        for name, p in members.items():
            setattr(media, name, p)
        new = [Outputs((count,), BOUNCED_FIELDS, BOUNCED_FIELDS) for _ in range(2)]
        structs = [ffi.new("cgt_bounced_rays *", {"stride": 4, "vector_stride": 12, **k.pointers()}) for k in new]
        # one stride for all of a surface's numbers: a record of 8-byte columns
        record = np.zeros(count, np.dtype({"names": list(SURFACE_FIELDS), "offsets": [0, 24, 48, 64, 72],
                                           "formats": [(d, (w,)) if w > 1 else d
                                                       for d, w in SURFACE_FIELDS.values()], "itemsize": 80}))
        places = Outputs((count,), names, SURFACE_FIELDS, record, "surfaces")
        surface = ffi.new("cgt_surfaces *", {"stride": 80, **places.pointers()}) if names else ffi.NULL
        with self._gate.shared:
            self._check(lib.cgt_bounce_rays(self._traced, rays.struct, found, media, surface, *structs, ffi.NULL))
        del keep, more
        reflected, refracted, found_surfaces = (
            Fields({name: a.reshape(rays.shape + a.shape[1:]) for name, a in outputs.arrays.items()})
            for outputs in (*new, places))
        return reflected, refracted, found_surfaces

    def trace_bounced_rays(self, rays: Fields, fields: Sequence[str] = ("t", "primitive", "geometry")) -> Hits:
        """Traces rays of `bounce_rays`; those inside spheres meet these again at their far side."""
        fields = tuple(dict.fromkeys(_expand(fields) + ("t", "primitive", "geometry")))
        made = _Rays(**_taken("rays", rays, ("org", "dir", "t_max", "t_min", "skip_primitive", "skip_geometry")))
        return self._trace(lib.cgt_trace_bounced_rays, made, fields, None, _Call("exact", False, None))
