# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Pictures of scenes: light, shadows, ambient occlusion, outlines; those of cgt-render, byte for byte."""
import struct
import zlib
from typing import Dict, Mapping, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F4, U4
from ._native import InvalidArgument, exception_of, load_part
from .geometry import Camera, Light, Triangles, _Geometry, _three
from .scene import Scene

ffi, lib = load_part("picture")


def encode_png(pixels: np.ndarray) -> bytes:
    """A PNG file of (height, width, 3) or (height, width, 4) uint8, as bytes."""
    height, width, channels = pixels.shape
    rows = np.zeros((height, 1 + channels * width), np.uint8)  # each begins with its filter: none
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6))
            + chunk(b"IEND", b""))


class Look:
    """What the primitives of a geometry look like. Colours are linear shares of red, green and blue.

    Parameters
    ----------
    color : three floats, optional
        Of all.
    colors : (n, 3) float, optional
        Of each primitive or, with `per_vertex`, of each vertex; copied where it is not float32 side by side.
    per_vertex : bool, optional
        Colours of triangles are interpolated.
    vertex_normals : (m, 3) float, optional
        Of any length; without them triangles are flat.
    """

    def __init__(self, color: Sequence[float] = (0, 0, 0), colors: Optional[ArrayLike] = None, *,
                 per_vertex: bool = False, vertex_normals: Optional[ArrayLike] = None):
        self.color = _three("color", color)
        self.per_vertex = per_vertex
        self.colors = None if colors is None else self._dense("colors", colors)
        self.vertex_normals = None if vertex_normals is None else self._dense("vertex_normals", vertex_normals)

    @staticmethod
    def _dense(name, a) -> np.ndarray:
        a = np.ascontiguousarray(a, F4)
        if a.ndim != 2 or a.shape[1] != 3:
            raise InvalidArgument(f"{name}: shape {a.shape}: must be (n, 3)")
        return a

    def _fill(self, c, geometry: _Geometry, keep: list) -> None:
        """The C struct of this look for a geometry, and what must outlive the picture."""
        c.color, c.per_vertex = self.color, self.per_vertex
        vertices = geometry._struct.vertex_count if isinstance(geometry, Triangles) else 0
        wanted = vertices if self.per_vertex else len(geometry)
        if self.colors is not None:
            if len(self.colors) != wanted:
                raise InvalidArgument(f"colors: {len(self.colors)} of them: must be {wanted}")
            c.colors = ffi.cast("float *", _arrays.address(self.colors))
        if isinstance(geometry, Triangles):
            indices = geometry.arrays.get("indices")
            flat = np.arange(3 * len(geometry), dtype=U4) if indices is None else np.ascontiguousarray(indices, U4)
            keep.append(flat)
            c.indices = ffi.cast("uint32_t *", _arrays.address(flat))
            if self.vertex_normals is not None:
                if len(self.vertex_normals) != vertices:
                    raise InvalidArgument(f"vertex_normals: {len(self.vertex_normals)} of them: must be {vertices}")
                c.vertex_normals = ffi.cast("float *", _arrays.address(self.vertex_normals))
        keep.append(self)


class Picture:
    """A picture that shows itself in notebooks.

    Parameters
    ----------
    width, height : int, optional
        Pixels.
    antialias : {1, 2, 4}, optional
        Rays of a pixel along each edge.
    shading : {'full', 'plain'}, optional
        'plain' is the fastest: one light without shadows.
    lights : sequence of (Light, color, size), optional
        Color is the brightness of a white surface that faces it; size is 0 for hard shadows, the radius of a lamp, or
        that of a direction's cone in degrees. None: one over the camera's left shoulder, and some from the sky.
    sky, head : float, optional
        Light from all sides, which ambient occlusion dims; light from the eye.
    ambient : int, optional
        Rays of a pixel to the sky, at most 256; 0: no ambient occlusion.
    ambient_radius : float, optional
        What is farther off does not occlude: world units; 0: no limit.
    light_samples : int, optional
        Rays of a pixel to each light with a size.
    background : three floats, optional
        Linear.
    transparent : bool, optional
        Pixels have four channels, and no background.
    outline : float, optional
        Width of outlines in pixels; outline_color is linear.

    Notes
    -----
    `draw` makes a whole picture; `begin`, `step` and `read` one that grows by samples. One thread at a time uses it.
    All that traces releases Python's lock.

    Examples
    --------
    >>> import cgt
    >>> scene = cgt.Scene()
    >>> ball = scene.add(cgt.Spheres([[0, 0, 0]], 1.0))
    >>> scene.commit()
    >>> picture = cgt.Picture(64, 48, ambient=4)
    >>> picture.draw(scene, cgt.Camera(), {ball: cgt.Look((0.8, 0.2, 0.1))}).pixels.shape
    (48, 64, 3)
    """

    def __init__(self, width: int = 1280, height: int = 720, *, antialias: int = 1, shading: str = "full",
                 lights: Optional[Sequence[Tuple[Light, Sequence[float], float]]] = None, sky: float = 0.0,
                 head: float = 0.0, ambient: int = 0, ambient_radius: float = 0.0, light_samples: int = 0,
                 background: Sequence[float] = (1, 1, 1), transparent: bool = False, outline: float = 0.0,
                 outline_color: Sequence[float] = (0, 0, 0)):
        o = self._options = ffi.new("cgt_picture_options *")
        lib.cgt_picture_options_init(o)
        o.width, o.height, o.antialias = width, height, antialias
        shadings = {"full": lib.CGT_SHADING_FULL, "plain": lib.CGT_SHADING_PLAIN}
        if shading not in shadings:
            raise InvalidArgument(f"shading: {shading!r}: one of {', '.join(shadings)}")
        o.shading = shadings[shading]
        if lights is not None:
            if len(lights) > lib.CGT_PICTURE_MAX_LIGHTS:
                raise InvalidArgument(f"lights: {len(lights)}: at most {lib.CGT_PICTURE_MAX_LIGHTS}")
            o.light_count = len(lights)
            for c, (light, color, size) in zip(o.lights, lights):
                c.light.kind, c.light.position = light._kind, light.position
                c.color, c.shadows, c.size = _three("lights: color", color), True, size
        o.sky, o.head, o.ambient, o.ambient_radius, o.light_samples = sky, head, ambient, ambient_radius, light_samples
        o.background, o.transparent = _three("background", background), transparent
        o.outline, o.outline_color = outline, _three("outline_color", outline_color)
        self.pixels = np.zeros((height, width, 4 if transparent else 3), np.uint8)
        self._handle = None
        self._context = None
        self._keep: list = []

    @property
    def _begun(self):
        if self._handle is None:
            raise InvalidArgument("picture: it has not begun")
        return self._handle

    def _check(self, result: int) -> None:
        if result:
            text = ffi.new("char[512]")
            lib.cgt_picture_get_error_message(self._handle, text, 512)
            raise exception_of(result, ffi.string(text).decode(errors="replace"))

    def begin(self, scene: Scene, camera: Camera, looks: Optional[Mapping[int, Look]] = None) -> None:
        """Traces the camera's rays and hard shadows; the scene must stay committed until the last step.

        Parameters
        ----------
        scene : Scene
        camera : Camera
        looks : mapping, optional
            Of geometries by their id; others are light grey.
        """
        if self._context is not scene.context:
            text, made = ffi.new("char[512]"), ffi.new("cgt_picture **")
            self._options.message, self._options.message_size = text, 512
            result = lib.cgt_picture_create(scene.context.handle, self._options, made)
            self._options.message = ffi.NULL
            if result:
                raise exception_of(result, ffi.string(text).decode())
            self._handle, self._context = ffi.gc(made[0], lib.cgt_picture_release), scene.context
        geometries: Dict[int, _Geometry] = scene.geometries
        for geometry in looks or {}:
            if geometry not in geometries:
                raise InvalidArgument(f"looks: geometry {geometry} does not exist")
        count = max(geometries, default=-1) + 1
        array, keep = ffi.new("cgt_look[]", count), [scene]
        for id, geometry in geometries.items():
            (looks or {}).get(id, Look())._fill(array[id], geometry, keep)
        self._keep = keep
        self._check(lib.cgt_picture_begin(self._handle, scene.handle, camera._struct, array, count, ffi.NULL))

    def step(self, samples: int = 1) -> int:
        """Traces more rays to the sky and to soft lights; returns how many samples are left."""
        left = ffi.new("uint32_t *")
        self._check(lib.cgt_picture_step(self._begun, samples, left))
        return left[0]

    def read(self) -> np.ndarray:
        """Makes `pixels` from what is traced so far, and returns them."""
        height, width, channels = self.pixels.shape
        image = ffi.new("cgt_image *", {"bytes": ffi.cast("uint8_t *", _arrays.address(self.pixels)),
                                        "channels": channels})
        self._check(lib.cgt_picture_read(self._begun, image))
        return self.pixels

    def draw(self, scene: Scene, camera: Camera, looks: Optional[Mapping[int, Look]] = None) -> "Picture":
        """Makes a whole picture, and returns itself. Arguments are those of `begin`."""
        self.begin(scene, camera, looks)
        self.step(0xFFFFFFFF)
        self.read()
        return self

    def _repr_png_(self) -> bytes:
        """What a notebook shows."""
        return encode_png(self.pixels)

    def save(self, path) -> None:
        """Writes a PNG file."""
        with open(path, "wb") as file:
            file.write(encode_png(self.pixels))
