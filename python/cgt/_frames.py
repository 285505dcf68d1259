# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A scene's calls for frames, and a camera's rays."""
from __future__ import annotations

from types import SimpleNamespace
from typing import Callable, Optional, Sequence, Tuple, Union

import numpy as np

from . import _arrays
from ._arrays import F4, Hold, Outputs
from ._calls import Out, _Call, _expand, _bytes_out
from ._gate import nesting
from ._native import (InvalidArgument, TooLarge, enum_value, exception_of, ffi, instance, keep_error, lib, pair, real,
                      several, whole)
from .geometry import Camera, Light
from .results import FRAME_FIELDS, NO_HIT, Frame


class Frames:
    """Frames and what is made of them."""

    __slots__ = ()

    def trace_camera(self, camera: Camera, width: int, height: int, fields: Sequence[str] = ("t", "primitive"), *,
                     out: Out = None, rows: Tuple[int, int] = (0, 0), precision: str = "exact",
                     statistics: bool = False, research=None,
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
        rows : (first, count), optional
            Rows that are traced, here and in what is made of the frame, with the bits that they have in the whole; the
            others stay, or have no hit. count 0: all from the first on.
        precision : {'exact', 'fast'}, optional
            Hits are the same in both; values are within 1 ulp, or of single precision.
        statistics : bool, optional
            Whether the result tells what the call did.
        research : cgt.research.TraceOptions, optional
        visitor : callable, optional
            Gets each finished tile once, from several threads: an object with x, y, width, height and an array for each
            of `visitor_fields`. What it returns true for ends the frame (`Stopped`), and so does an exception. It may
            trace this scene, but not change, commit or close it (`InUse`).
        visitor_fields : sequence of str, optional

        Returns
        -------
        Frame

        Raises
        ------
        NotCommitted
        InvalidArgument, TooLarge
        """
        width, height = _size(width, height)
        first_row, row_count = (whole("rows", row) for row in pair("rows", rows))
        camera = instance("camera", camera, Camera)._copy(frozen=True)  # as it is now
        outputs = Outputs((height, width), _expand(fields), FRAME_FIELDS, out)
        frame = Frame({}, camera, width, height, (first_row, row_count), outputs=outputs)
        struct = frame._struct
        if out is None and (first_row or row_count):
            for name, a in outputs.arrays.items():
                a.fill(NO_HIT.get(name, 0))
        call = _Call(precision, statistics, research)
        errors: list = []
        if visitor is not None:
            if not callable(visitor):
                raise InvalidArgument(f"visitor: {type(visitor).__name__}: must be a function")
            names = _expand(visitor_fields, "visitor_fields")
            callback = _tile_callback(visitor, names, errors)
            struct.visitor = callback
            struct.visitor_fields = _field_bits(names)
        with self._gate.shared:
            result = lib.cgt_trace_camera(self._traced, camera._struct, struct, call.struct)
            if errors:
                raise errors[0]
            self._check(result)
        struct.visitor = ffi.NULL
        frame.statistics = call.statistics()
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
        lights = (lights,) if isinstance(lights, Light) else several("lights", lights, "cgt.Light")
        array = ffi.new("cgt_light[]", [instance("lights", light, Light)._values() for light in lights])
        height, width = instance("frame", frame, Frame).shape
        camera = instance("frame.camera", frame.camera, Camera)._copy()
        options = ffi.new("cgt_shadow_options *", {"t_min": real("t_min", t_min)})
        call = _Call("exact", False, research)
        shape, row = (len(lights), height, width), self._row(frame)
        given = None if out is None else _bytes_out("out", out, shape, map(Hold, frame.arrays.values()))
        full = given
        if full is None or row != width:  # C's rows are as far apart as the frame's
            full = Hold(np.zeros((*shape[:2], row), np.uint8))  # zeros: of rows that are not traced
            if given is not None:
                full.view[:, :, :width] = given.view
        with self._gate.shared:
            self._check(lib.cgt_occluded_frame(self._traced, camera._struct, frame._struct, array, len(lights), options,
                                               _arrays.pointer(full.view), call.struct))
        if given is None:
            return full.view.view(bool)[:, :, :width]
        if given is not full:
            given.view[...] = full.view[:, :, :width]
        return given.view.view(bool)

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
        height, width = instance("frame", frame, Frame).shape
        camera = instance("frame.camera", frame.camera, Camera)._copy()
        options = ffi.new("cgt_ambient_options *", {
            "samples": whole("samples", samples), "radius": real("radius", radius), "seed": whole("seed", seed),
            "first": whole("first", first)})
        full = np.ones((height, self._row(frame)), F4)  # of rows that are not traced
        call = _Call("exact", False, research)
        with self._gate.shared:
            self._check(lib.cgt_ambient_occlusion(self._traced, camera._struct, frame._struct, options,
                                                  _arrays.pointer(full), call.struct))
        return full[:, :width]


def camera_rays(camera: Camera, width: int, height: int) -> Tuple[np.ndarray, np.ndarray]:
    """The rays of a frame's pixels, the bits that `Scene.trace_camera` traces.

    Returns
    -------
    org, dir : (height, width, 3) float32
        Directions are not normalised; t is in their units.
    """
    width, height = _size(width, height)
    org, dir = np.empty((2, height, width, 3), F4)
    pointers = [_arrays.component_pointers(a) for a in (org, dir)]
    result = lib.cgt_camera_get_rays(instance("camera", camera, Camera)._struct, width, height, 0, 0, width, height, 12,
                                     ffi.new("float *[3]", pointers[0]), ffi.new("float *[3]", pointers[1]))
    if result:
        raise exception_of(result, "camera: its values, or width and height, are outside their range")
    return org, dir


def _size(width, height) -> Tuple[int, int]:
    """A frame's, before arrays of it are made; the library refuses others that it does not take."""
    size = whole("width", width), whole("height", height)
    if max(size) > 65536:
        raise TooLarge(f"{size[0]} x {size[1]} pixels: at most 65,536 each")
    return size


def _field_bits(fields) -> int:
    bits = 0
    for name in fields:
        bits |= enum_value("CGT_FIELD_", "uv" if name in ("u", "v") else name, "visitor_fields")
    return bits


def _tile_callback(visitor, fields, errors):
    """A C callback that gives a tile's arrays to a function of Python's, and stops at its first exception."""
    def plane(p, tile, dtype):
        """A copy, which outlives the call as the tile does not."""
        size = 4 * ((tile.height - 1) * tile.row_stride + tile.width)
        flat = np.frombuffer(ffi.buffer(p, size), dtype)
        strides = (4 * tile.row_stride, 4)
        return np.lib.stride_tricks.as_strided(flat, (tile.height, tile.width), strides).copy()

    # what is raised, were it Ctrl-C before the first line, goes to the caller by way of C
    @ffi.callback("cgt_visit(void *, const cgt_tile *)", error=lib.CGT_VISIT_STOP, onerror=keep_error(errors))
    def call(_user, tile):
        arrays = {}
        for name in fields:
            dtype, width = FRAME_FIELDS[name]
            p = getattr(tile, name)
            arrays[name] = plane(p, tile, dtype) if width == 1 else np.stack(
                [plane(p[k], tile, dtype) for k in range(3)], axis=-1)
        seen = SimpleNamespace(x=tile.x, y=tile.y, width=tile.width, height=tile.height, **arrays)
        with nesting:
            return lib.CGT_VISIT_STOP if visitor(seen) else lib.CGT_VISIT_CONTINUE

    return call
