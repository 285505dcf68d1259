# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Contexts and scenes."""
import logging
import math
from types import SimpleNamespace
from typing import Callable, Dict, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F4, F8, U4, Outputs, ray_vectors, scalar_pointers, vector_pointers
from ._native import InvalidArgument, enum_value, exception_of, ffi, lib, struct_values
from .geometry import Camera, Capsules, Light, Spheres, Triangles, _Geometry, _three
from .results import (
    BOUNCED_FIELDS, FRAME_FIELDS, INVALID_ID, RAY_FIELDS, ROW_FIELDS, SURFACE_FIELDS, AllHits, Fields, Frame, HitRows,
    Hits, SingleHit,
)

Out = Optional[Union[Mapping[str, np.ndarray], np.ndarray]]
_LEVELS = (logging.ERROR, logging.WARNING, logging.INFO)
_logger = logging.getLogger("cgt")
_SINGLE_RAY, _SINGLE_HIT = ffi.typeof("cgt_single_ray *"), ffi.typeof("cgt_single_hit *")


@ffi.callback("void(void *, cgt_log_level, const char *)")
def _log(_user, level, message):
    _logger.log(_LEVELS[min(level, 2)], "%s", ffi.string(message).decode())


def version() -> str:
    """The version of the loaded library."""
    return ffi.string(lib.cgt_get_version()).decode()


def variants() -> Tuple[str, ...]:
    """The instruction sets that the library was built for, narrowest first."""
    names, found = lib.cgt_get_variant_names(), []
    while names[len(found)]:
        found.append(ffi.string(names[len(found)]).decode())
    return tuple(found)


class Context:
    """Threads and memory; scenes may share one.

    Parameters
    ----------
    threads : int, optional
        That work, the caller's included; 0: one per CPU that the process may use.
    variant : str, optional
        A name of `variants`; None: the widest that this CPU runs.
    log : bool, optional
        Whether errors, warnings and a line for each commit go to the logger "cgt".

    Notes
    -----
    Without `close` or a ``with`` block it ends with the last reference.
    """

    def __init__(self, threads: int = 0, variant: Optional[str] = None, *, log: bool = False):
        text, made = ffi.new("char[512]"), ffi.new("cgt_context **")
        name = ffi.NULL if variant is None else ffi.new("char[]", variant.encode())
        options = ffi.new("cgt_context_options *", {"threads": threads, "variant": name, "message": text,
                                                    "message_size": 512})
        if log:
            options.log.write = _log
        result = lib.cgt_context_create(options, made)
        if result:
            raise exception_of(result, ffi.string(text).decode())
        self._handle = ffi.gc(made[0], lib.cgt_context_release)

    @property
    def handle(self):
        """The C handle; an error once the context is closed."""
        if self._handle is None:
            raise InvalidArgument("context: it is closed")
        return self._handle

    @property
    def threads(self) -> int:
        """How many threads work for it."""
        return lib.cgt_context_get_threads(self.handle)

    @property
    def variant(self) -> str:
        """The instruction set that it uses."""
        return ffi.string(lib.cgt_context_get_variant(self.handle)).decode()

    def check(self, result: int) -> None:
        """Raises the exception of a cgt_result, with the context's message."""
        if result:
            text = ffi.new("char[512]")
            lib.cgt_context_get_error_message(self.handle, text, 512)
            raise exception_of(result, ffi.string(text).decode(errors="replace"))

    def close(self) -> None:
        """Releases it; scenes that are open keep what they need."""
        if self._handle is not None:
            ffi.release(self._handle)
            self._handle = None

    def __enter__(self) -> "Context":
        return self

    def __exit__(self, *_) -> None:
        self.close()


class _Call:
    """cgt_trace_options of one call, and its statistics."""

    def __init__(self, precision: str, statistics: bool, research):
        self.struct = ffi.new("cgt_trace_options *")
        self.struct.precision = enum_value("CGT_PRECISION_", precision, "precision")
        self.counts = ffi.new("cgt_trace_statistics *") if statistics else None
        if self.counts:
            self.struct.statistics = self.counts
        self.research = research
        if research is not None:
            self.struct.research = research._struct

    def statistics(self) -> Optional[SimpleNamespace]:
        return SimpleNamespace(**struct_values(self.counts[0])) if self.counts else None


def _expand(fields: Sequence[str]) -> Tuple[str, ...]:
    """'uv' stands for u and v, which C gives together."""
    names = (fields,) if isinstance(fields, str) else tuple(fields)
    wanted = []
    for name in names:
        wanted += ["u", "v"] if name in ("uv", "u", "v") else [name]
    return tuple(dict.fromkeys(wanted))


class _Rays:
    """A cgt_rays over arrays."""

    def __init__(self, org, dir, **numbers):
        o, d = ray_vectors("org", org), ray_vectors("dir", dir)
        shapes = np.shape(org)[:-1], np.shape(dir)[:-1]
        if len(o) == 1 and len(shapes[0]) == 0:
            o, shapes = np.broadcast_to(o, d.shape), (shapes[1], shapes[1])
        elif len(d) == 1 and len(shapes[1]) == 0:
            d, shapes = np.broadcast_to(d, o.shape), (shapes[0], shapes[0])
        if shapes[0] != shapes[1]:
            raise InvalidArgument(f"dir: shape {np.shape(dir)}: must be that of org, {np.shape(org)}")
        self.shape = shapes[0]
        (org_p, dir_p), vector_stride, self.keep = vector_pointers(o, d)
        types = {"t_min": F4, "t_max": F4, "mask": U4, "skip_primitive": U4, "skip_geometry": U4}
        given = {name: (a, types[name]) for name, a in numbers.items() if a is not None}
        members, stride, keep = scalar_pointers(given, self.shape)
        self.keep += keep
        self.struct = ffi.new("cgt_rays *", {"count": len(o), "stride": stride, "vector_stride": vector_stride,
                                             "org": org_p, "dir": dir_p, **members})


def _hits_struct(outputs: Outputs, axes: int = 1) -> dict:
    numbers, vectors = outputs.strides(axes)
    members = outputs.pointers()
    members.update(stride=numbers[-1] if numbers else 0, vector_stride=vectors[-1] if vectors else 0)
    return members


def _flat(outputs: Outputs, shape) -> Outputs:
    """The same outputs along one axis; those that cannot be seen so are refused."""
    if len(shape) == 1:
        return outputs
    count = math.prod(shape)
    flat = Outputs((count,), (), {})
    for name, a in outputs.arrays.items():
        view = a.reshape((count,) + a.shape[len(shape):])
        if a.size and not np.shares_memory(view, a):
            raise InvalidArgument(f"out[{name!r}]: strides {a.strides}: rows must follow each other")
        flat.arrays[name] = view
    return flat


class Scene:
    """Geometries over the caller's arrays, and the structure that rays go through.

    Parameters
    ----------
    context : Context, optional
        None: one of its own, with the default threads.
    structure : {'auto', 'loose_grid', 'bvh', 'queue_grid', 'kd', 'kd_ropes', 'bih'}, optional
        The last four are those of published algorithms (see `cgt.research`).
    rays : {'coherent', 'incoherent'}, optional
        What the scene is mostly traced with: cameras, or rays that start anywhere and go anywhere.
    research : cgt.research.SceneOptions, optional

    Notes
    -----
    One thread at a time changes and commits a scene, while none traces it; any number of threads may trace it at once.
    Every call that commits or traces releases Python's lock. Results are the same bits for any number of threads.

    Examples
    --------
    >>> import cgt, numpy
    >>> with cgt.Scene() as scene:
    ...     ball = scene.add(cgt.Spheres([[0, 0, 0]], 1.0))
    ...     scene.commit()
    ...     hits = scene.trace_rays([[0, 0, 5], [0, 3, 5]], [0, 0, -1])
    ...     hits.t.tolist(), hits.hit.tolist()
    ([4.0, inf], [True, False])
    """

    def __init__(self, context: Optional[Context] = None, *, structure: str = "auto", rays: str = "coherent",
                 research=None):
        self.context = Context() if context is None else context
        made = ffi.new("cgt_scene **")
        self.context.check(lib.cgt_scene_create(self.context.handle, self._options(structure, rays, research), made))
        self._handle = ffi.gc(made[0], lib.cgt_scene_release)
        self._geometries: Dict[int, _Geometry] = {}
        self._committed: Tuple[_Geometry, ...] = ()

    def _options(self, structure, rays, research):
        self._research = research
        options = ffi.new("cgt_scene_options *")
        options.structure = enum_value("CGT_STRUCTURE_", structure, "structure")
        options.rays = enum_value("CGT_RAY_KIND_", rays, "rays")
        if research is not None:
            options.research = research._struct
        return options

    def _check(self, result: int) -> None:
        self.context.check(result)

    @property
    def handle(self):
        """The C handle; an error once the scene is closed."""
        if self._handle is None:
            raise InvalidArgument("scene: it is closed")
        return self._handle

    def close(self) -> None:
        """Releases the structure and the arrays; no thread may be using the scene."""
        if self._handle is not None:
            ffi.release(self._handle)
            self._handle, self._geometries, self._committed = None, {}, ()

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_) -> None:
        self.close()

    # ---- geometries ----

    @property
    def geometries(self) -> Dict[int, _Geometry]:
        """The geometries by id."""
        return dict(self._geometries)

    def set_options(self, *, structure: str = "auto", rays: str = "coherent", research=None) -> None:
        """Sets the options of the next commit, as the constructor does."""
        self._check(lib.cgt_scene_set_options(self.handle, self._options(structure, rays, research)))

    def add(self, geometry: Union[Spheres, Triangles, Capsules]) -> int:
        """Adds a geometry and returns its id, the lowest that is free. It counts from the next commit on."""
        out = ffi.new("uint32_t *")
        call = getattr(lib, "cgt_scene_add_" + self._kind(geometry))
        self._check(call(self.handle, geometry._struct, out))
        self._geometries[out[0]] = geometry
        return out[0]

    def update(self, geometry: int, description: Union[Spheres, Triangles, Capsules]) -> None:
        """Replaces a geometry: another count, other arrays. New numbers in the same arrays need `commit` alone."""
        call = getattr(lib, "cgt_scene_update_" + self._kind(description))
        self._check(call(self.handle, geometry, description._struct))
        self._geometries[geometry] = description

    def remove(self, geometry: int) -> None:
        """Removes a geometry. Its id is free again, the others stay."""
        self._check(lib.cgt_scene_remove_geometry(self.handle, geometry))
        del self._geometries[geometry]

    @staticmethod
    def _kind(geometry) -> str:
        if not isinstance(geometry, _Geometry):
            raise InvalidArgument(f"geometry: {type(geometry).__name__}: must be Spheres, Triangles or Capsules")
        return geometry._kind

    def copied_bytes(self, geometry: int) -> int:
        """How many bytes of a geometry's arrays each commit will copy; 0: all are traced where they lie."""
        out = ffi.new("size_t *")
        self._check(lib.cgt_scene_get_copied_bytes(self.handle, geometry, out))
        return out[0]

    def commit(self) -> None:
        """Builds the structure from the arrays as they are now; the scene keeps them alive until the next commit.

        Raises
        ------
        InvalidArgument
            An index or a type is out of range.
        OutOfMemory, TooLarge
        """
        result = lib.cgt_scene_commit(self.handle)
        self._committed = tuple(self._geometries.values())
        self._check(result)

    def prepare(self, rays: str = "incoherent") -> None:
        """Builds the BVH beside a grid now, not in the first call that needs it."""
        self._check(lib.cgt_scene_prepare(self.handle, enum_value("CGT_RAY_KIND_", rays, "rays")))

    @property
    def statistics(self) -> SimpleNamespace:
        """What the last commit found, chose and spent (cgt_scene_statistics); copied_bytes 0: all is read in place."""
        s = ffi.new("cgt_scene_statistics *")
        self._check(lib.cgt_scene_get_statistics(self.handle, s))
        return SimpleNamespace(**struct_values(s[0]))

    # ---- frames ----

    def trace_camera(self, camera: Camera, width: int, height: int, fields: Sequence[str] = ("t", "primitive"), *,
                     out: Out = None, precision: str = "exact", statistics: bool = False, research=None,
                     visitor: Optional[Callable] = None, visitor_fields: Sequence[str] = ()) -> Frame:
        """Traces one ray per pixel to its nearest hit.

        Parameters
        ----------
        camera : Camera
        width, height : int
            Pixels, each 1 to 65,536.
        fields : sequence of str
            Of t, primitive, geometry, normal, position, uv: what the pixels get.
        out : mapping of arrays, optional
            By field: (height, width) or (height, width, 3); rows may be apart.
        precision : {'exact', 'fast'}, optional
            Hits are the same in both; values are within 1 ulp, or of single precision.
        statistics : bool, optional
            Whether the result tells what the call did.
        research : cgt.research.TraceOptions, optional
        visitor : callable, optional
            Gets each finished tile once, from several threads: an object with x, y, width, height and an array for each
            of `visitor_fields`, valid during the call alone. What it returns true for ends the frame (`Stopped`), and
            so does an exception.
        visitor_fields : sequence of str, optional

        Returns
        -------
        Frame

        Raises
        ------
        NotCommitted
        InvalidArgument, TooLarge
        """
        outputs = Outputs((height, width), _expand(fields), FRAME_FIELDS, out)
        numbers, vectors = outputs.strides(2)
        struct = ffi.new("cgt_frame *", {"width": width, "height": height, **outputs.pointers()})
        if numbers:
            if numbers[1] != 4:
                raise InvalidArgument("out: numbers of a row of pixels must lie side by side")
            struct.row_stride = numbers[0] // 4
        if vectors:
            struct.vector_stride = vectors[1] // 4
            row = numbers[0] * struct.vector_stride if numbers else vectors[0]
            if row != vectors[0] or row % vectors[1]:
                raise InvalidArgument("out: rows of vectors must be as many pixels apart as rows of numbers")
            struct.row_stride = row // vectors[1]
        call = _Call(precision, statistics, research)
        errors: list = []
        if visitor is not None:
            callback = _tile_callback(visitor, _expand(visitor_fields), errors)
            struct.visitor = callback
            struct.visitor_fields = _field_bits(visitor_fields)
        result = lib.cgt_trace_camera(self.handle, camera._struct, struct, call.struct)
        if errors:
            raise errors[0]
        self._check(result)
        struct.visitor = ffi.NULL
        frame = Frame(outputs.arrays, call.statistics(), camera, struct)
        return frame

    def occluded_frame(self, frame: Frame, lights: Union[Light, Sequence[Light]], *, t_min: float = 0.0,
                       out: Optional[np.ndarray] = None, research=None) -> np.ndarray:
        """Finds which pixels of a frame lights do not reach.

        Parameters
        ----------
        frame : Frame
            Of this scene, with field t; with primitive and geometry no offset is needed.
        lights : Light or sequence of Light
        t_min : float, optional
            Of the rays to the lights.
        out : (lights, height, width) uint8 or bool, C-contiguous, optional

        Returns
        -------
        (lights, height, width) bool
            Whether anything lies between the pixel's hit and the light.
        """
        lights = [lights] if isinstance(lights, Light) else list(lights)
        array = ffi.new("cgt_light[]", [{"kind": k._kind, "position": k.position} for k in lights])
        height, width = frame.shape
        options = ffi.new("cgt_shadow_options *", {"t_min": t_min})
        call = _Call("exact", False, research)
        row = self._row(frame)
        full = _bytes_out("out", out, (len(lights), height, row))
        self._check(lib.cgt_occluded_frame(self.handle, frame.camera._struct, frame._struct, array, len(lights),
                                           options, _arrays.pointer(full), call.struct))
        return full.view(bool)[:, :, :width]

    @staticmethod
    def _row(frame: Frame) -> int:
        return frame._struct.row_stride or frame._struct.width

    def ambient_occlusion(self, frame: Frame, samples: int = 16, *, radius: float = 0.0, seed: int = 0, first: int = 0,
                          research=None) -> np.ndarray:
        """Finds how much of the sky each pixel of a frame sees.

        Parameters
        ----------
        frame : Frame
            Of this scene, with fields t, primitive, geometry and normal.
        samples : int, optional
            Rays of a pixel, at most 1,024.
        radius : float, optional
            Hits beyond it do not count: world units; 0: no limit.
        seed : int, optional
            Another one gives other directions.
        first : int, optional
            The first of these rays in a pixel's sequence: calls that go on where others ended find together what one
            call finds.

        Returns
        -------
        (height, width) float32
            The share of rays that hit nothing.
        """
        height, width = frame.shape
        options = ffi.new("cgt_ambient_options *", {"samples": samples, "radius": radius, "seed": seed, "first": first})
        full = np.empty((height, self._row(frame)), F4)
        call = _Call("exact", False, research)
        self._check(lib.cgt_ambient_occlusion(self.handle, frame.camera._struct, frame._struct, options,
                                              _arrays.pointer(full), call.struct))
        return full[:, :width]

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
        hits = ffi.new("cgt_hits *", _hits_struct(_flat(outputs, rays.shape)))
        self._check(function(self.handle, rays.struct, hits, call.struct))
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
        occluded = _bytes_out("out", out, rays.shape)
        call = _Call("exact", False, research)
        self._check(lib.cgt_occluded_rays(self.handle, rays.struct, _arrays.pointer(occluded), call.struct))
        return occluded.view(bool)

    @staticmethod
    def _single(org, dir, t_min, t_max, mask, skip):
        ray = ffi.new(_SINGLE_RAY, (_three("org", org), _three("dir", dir), t_min, t_max, mask))
        if skip is not None:
            ray.skips, (ray.skip_primitive, ray.skip_geometry) = True, skip
        return ray

    def trace_ray(self, org: Sequence[float], dir: Sequence[float], *, t_min: float = 0.0, t_max: float = np.inf,
                  mask: int = 0, skip: Optional[Tuple[int, int]] = None) -> SingleHit:
        """Traces one ray on the calling thread; `skip` is a primitive and its geometry. Arrays of rays are faster."""
        hit = ffi.new(_SINGLE_HIT)
        result = lib.cgt_trace_ray(self.handle, self._single(org, dir, t_min, t_max, mask, skip), hit, ffi.NULL)
        if result:
            self._check(result)
        return SingleHit(t=hit.t, primitive=hit.primitive, geometry=hit.geometry, normal=list(hit.normal), u=hit.u,
                         v=hit.v)

    def occluded_ray(self, org: Sequence[float], dir: Sequence[float], *, t_min: float = 0.0, t_max: float = np.inf,
                     mask: int = 0, skip: Optional[Tuple[int, int]] = None) -> bool:
        """Finds whether one ray hits anything in its range."""
        found = ffi.new("bool *")
        ray = self._single(org, dir, t_min, t_max, mask, skip)
        self._check(lib.cgt_occluded_ray(self.handle, ray, found, ffi.NULL))
        return bool(found[0])

    def _points(self, position, **numbers):
        p = ray_vectors("position", position)
        (at,), vector_stride, keep = vector_pointers(p)
        shape = np.shape(position)[:-1]
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
        occluded = _bytes_out("out", out, shape)
        struct = ffi.new("cgt_light *", {"kind": light._kind, "position": light.position})
        result = lib.cgt_occluded_points(self.handle, struct, points, _arrays.pointer(occluded), ffi.NULL)
        del keep
        self._check(result)
        return occluded.view(bool)

    def points_inside(self, position: ArrayLike, *, rule: str = "parity", mask: Optional[ArrayLike] = None,
                      out: Optional[np.ndarray] = None) -> np.ndarray:
        """Finds which points, (..., 3), are inside of spheres and closed meshes.

        Parameters
        ----------
        position : (..., 3)
        rule : {'parity', 'winding'}, optional
            An odd number of surfaces lies ahead; or not as many lead in as out, for meshes that overlap themselves.
        mask : (...) uint32, optional

        Returns
        -------
        (...) bool
        """
        points, shape, keep = self._points(position, mask=mask)
        inside = _bytes_out("out", out, shape)
        how = ffi.new("cgt_inside_options *", {"rule": enum_value("CGT_INSIDE_", rule, "rule")})
        result = lib.cgt_points_inside(self.handle, points, how, _arrays.pointer(inside), ffi.NULL)
        del keep
        self._check(result)
        return inside.view(bool)

    # ---- all hits ----

    def _after(self, after, shape):
        options = ffi.new("cgt_all_hits_options *")
        if after is None:
            return options, []
        members, stride, keep = scalar_pointers(
            {"after_" + name: (after[name], U4) for name in ("primitive", "geometry", "surface") if name in after},
            shape)
        if "after_primitive" not in members:
            raise InvalidArgument("after: it lacks 'primitive'")
        for name, p in members.items():
            setattr(options, name, p)
        options.after_stride = stride
        return options, keep

    def _rows(self, rays, capacity, fields, after, more, call) -> HitRows:
        count = rays.struct.count
        outputs = Outputs((count, capacity), _expand(fields), ROW_FIELDS)
        members = _hits_struct(_flat(outputs, (count, capacity)))
        surface = members.pop("surface", ffi.NULL)
        found, further = np.empty(count, U4), np.empty(count, np.uint8)
        rows = ffi.new("cgt_hit_rows *", {"capacity": capacity, "hits": members, "surface": surface,
                                          "count": _arrays.pointer(found),
                                          "more": _arrays.pointer(further) if more else ffi.NULL})
        options, keep = self._after(after, (count,))
        result = lib.cgt_trace_all_rays(self.handle, rays.struct, options, rows, call.struct)
        del keep
        self._check(result)
        arrays = {**outputs.arrays, "count": found}
        if more:
            arrays["more"] = further.view(bool)
        return HitRows(arrays, call.statistics())

    def trace_hit_rows(self, org: ArrayLike, dir: ArrayLike, capacity: int,
                       fields: Sequence[str] = ("t", "primitive"), *, t_min: Optional[ArrayLike] = None,
                       t_max: Optional[ArrayLike] = None, mask: Optional[ArrayLike] = None,
                       skip_primitive: Optional[ArrayLike] = None, skip_geometry: Optional[ArrayLike] = None,
                       after: Optional[Mapping[str, ArrayLike]] = None, precision: str = "exact",
                       statistics: bool = False) -> HitRows:
        """Traces rays, (n, 3), to their first `capacity` hits each, in the order of exact distance.

        Parameters
        ----------
        after : mapping, optional
            Each ray's hits begin after this hit of its line: primitive, geometry and surface, (n,) uint32.
        fields : sequence of str
            Of t, primitive, geometry, normal, uv, surface.

        The rest is as of `trace_rays`.
        """
        rays = _Rays(org, dir, t_min=t_min, t_max=t_max, mask=mask, skip_primitive=skip_primitive,
                     skip_geometry=skip_geometry)
        return self._rows(rays, capacity, fields, after, True, _Call(precision, statistics, None))

    def trace_all_rays(self, org: ArrayLike, dir: ArrayLike, fields: Sequence[str] = ("t", "primitive"), *,
                       t_min: Optional[ArrayLike] = None, t_max: Optional[ArrayLike] = None,
                       mask: Optional[ArrayLike] = None) -> AllHits:
        """Traces rays, (n, 3), to all their hits: near and far surfaces of spheres, each triangle once.

        Returns
        -------
        AllHits
            ray and `fields`, ordered by ray, then by exact distance, geometry and primitive.
        """
        wanted = _expand(fields)
        asked = tuple(dict.fromkeys(wanted + ("primitive", "geometry", "surface")))
        ray_count = len(ray_vectors("org", org)) if np.ndim(org) > 1 else len(ray_vectors("dir", dir))
        org = np.broadcast_to(np.asarray(org, F4), (ray_count, 3))
        dir = np.broadcast_to(np.asarray(dir, F4), (ray_count, 3))
        ranges = {name: np.broadcast_to(np.asarray(a, dtype), (ray_count,))
                  for name, a, dtype in (("t_min", t_min, F4), ("t_max", t_max, F4), ("mask", mask, U4))
                  if a is not None}
        numbers, after, capacity, found = np.arange(ray_count), None, 8, []
        while len(numbers):
            rays = _Rays(org[numbers], dir[numbers], **{name: a[numbers] for name, a in ranges.items()})
            rows = self._rows(rays, capacity, asked, after, True, _Call("exact", False, None))
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
        inside_of_ray, outside_of_ray : (n,) float32, optional
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
        count = rays.struct.count
        members, stride, keep = scalar_pointers(
            {"t": (hits["t"], F4), "primitive": (hits["primitive"], U4), "geometry": (hits["geometry"], U4)},
            rays.shape)
        found = ffi.new("cgt_hits *", {"stride": stride, **members})
        media = ffi.new("cgt_media *", {"inside": inside, "outside": outside})
        given = {name: (a, F4) for name, a in (("inside_of_ray", inside_of_ray), ("outside_of_ray", outside_of_ray))
                 if a is not None}
        members, media.stride, more = scalar_pointers(given, rays.shape)
        for name, p in members.items():
            setattr(media, name, p)
        new = [Outputs((count,), BOUNCED_FIELDS, BOUNCED_FIELDS) for _ in range(2)]
        structs = [ffi.new("cgt_bounced_rays *", {"stride": 4, "vector_stride": 12, **k.pointers()}) for k in new]
        names = tuple(surfaces)
        # one stride for all of a surface's numbers: a record of 8-byte columns
        record = np.zeros(count, np.dtype({"names": list(SURFACE_FIELDS), "offsets": [0, 24, 48, 64, 72],
                                           "formats": [(d, (w,)) if w > 1 else d
                                                       for d, w in SURFACE_FIELDS.values()], "itemsize": 80}))
        places = Outputs((count,), names, SURFACE_FIELDS, record)
        surface = ffi.new("cgt_surfaces *", {"stride": 80, **places.pointers()}) if names else ffi.NULL
        result = lib.cgt_bounce_rays(self.handle, rays.struct, found, media, surface, structs[0], structs[1], ffi.NULL)
        del keep, more
        self._check(result)
        return Fields(new[0].arrays), Fields(new[1].arrays), Fields(places.arrays)

    def trace_bounced_rays(self, rays: Fields, fields: Sequence[str] = ("t", "primitive", "geometry")) -> Hits:
        """Traces rays of `bounce_rays`; those inside spheres meet these again at their far side."""
        fields = tuple(dict.fromkeys(_expand(fields) + ("t", "primitive", "geometry")))
        made = _Rays(rays["org"], rays["dir"], t_max=rays["t_max"], t_min=rays["t_min"],
                     skip_primitive=rays["skip_primitive"], skip_geometry=rays["skip_geometry"])
        return self._trace(lib.cgt_trace_bounced_rays, made, fields, None, _Call("exact", False, None))


def camera_rays(camera: Camera, width: int, height: int) -> Tuple[np.ndarray, np.ndarray]:
    """The rays of a frame's pixels, the bits that `Scene.trace_camera` traces.

    Returns
    -------
    org, dir : (height, width, 3) float32
        Directions are not normalised; t is in their units.
    """
    org, dir = np.empty((2, height, width, 3), F4)
    pointers = [_arrays.component_pointers(a) for a in (org, dir)]
    result = lib.cgt_camera_get_rays(camera._struct, width, height, 0, 0, width, height, 12,
                                     ffi.new("float *[3]", pointers[0]), ffi.new("float *[3]", pointers[1]))
    if result:
        raise exception_of(result, "camera: its values, or width and height, are outside their range")
    return org, dir


def _bytes_out(name: str, out: Optional[np.ndarray], shape) -> np.ndarray:
    """An array of bytes for a call, its own or the caller's."""
    if out is None:
        return np.empty(shape, np.uint8)
    if out.dtype not in (np.uint8, np.bool_) or out.shape != tuple(shape) or not out.flags.c_contiguous or (
            not out.flags.writeable):
        raise InvalidArgument(f"{name}: dtype {out.dtype}, shape {out.shape}: must be a writable, contiguous array of "
                              f"uint8 or bool, shape {tuple(shape)}")
    return out.view(np.uint8)


def _field_bits(fields) -> int:
    names = ("uv" if f in ("u", "v") else f for f in ((fields,) if isinstance(fields, str) else fields))
    bits = 0
    for name in names:
        bits |= enum_value("CGT_FIELD_", name, "visitor_fields")
    return bits


def _tile_callback(visitor, fields, errors):
    """A C callback that gives a tile's arrays to a function of Python's, and stops at its first exception."""
    def plane(p, tile, dtype):
        size = 4 * ((tile.height - 1) * tile.row_stride + tile.width)
        flat = np.frombuffer(ffi.buffer(p, size), dtype)
        strides = (4 * tile.row_stride, 4)
        return np.lib.stride_tricks.as_strided(flat, (tile.height, tile.width), strides, writeable=False)

    @ffi.callback("cgt_visit(void *, const cgt_tile *)")
    def call(_user, tile):
        try:
            arrays = {}
            for name in fields:
                dtype, width = FRAME_FIELDS[name]
                p = getattr(tile, name)
                arrays[name] = plane(p, tile, dtype) if width == 1 else np.stack(
                    [plane(p[k], tile, dtype) for k in range(3)], axis=-1)
            seen = SimpleNamespace(x=tile.x, y=tile.y, width=tile.width, height=tile.height, **arrays)
            return lib.CGT_VISIT_STOP if visitor(seen) else lib.CGT_VISIT_CONTINUE
        except BaseException as error:  # it goes to the caller, by way of C
            errors.append(error)
            return lib.CGT_VISIT_STOP

    return call
