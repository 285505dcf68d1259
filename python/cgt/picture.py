# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Pictures of scenes: light, shadows, ambient occlusion, outlines; those of cgt-render, byte for byte."""
from __future__ import annotations

import os
import struct
import zlib
from typing import Any, Mapping, Optional, Sequence, Tuple

import numpy as np

from . import _arrays
from ._arrays import F4, U1, U4, Hold, is_output
from ._gate import Gate
from ._held import Held
from ._looks import Look, Material
from ._native import (
    InvalidArgument,
    NotCommitted,
    Plain,
    enum_value,
    exception_of,
    given,
    instance,
    load_part,
    pair,
    real,
    several,
    switch,
    text_of_path,
    three,
    whole,
     )
from .colors import light_of
from .geometry import Camera, Light, Triangles
from .scene import Scene

ffi, lib = load_part("picture")


def _release_with(context_handle):
    """What ends a picture while there is still its context."""
    def release(picture, _context=context_handle):
        lib.cgt_picture_release(picture)

    return release


def _check(handle, result: int) -> None:
    """Raises the exception of a cgt_result, with the message of this C picture."""
    if result:
        text = ffi.new("char[512]")
        lib.cgt_picture_get_error_message(handle, text, 512)
        raise exception_of(result, ffi.string(text).decode(errors="replace"))


def check_png(path, hint: str = "") -> None:
    """Refuses a path of another kind of file."""
    ending = os.path.splitext(text_of_path("path", path))[1]
    if ending.lower() not in (".png", ""):
        raise InvalidArgument(f"path: {ending}: pictures are saved as .png{hint}")


def encode_png(pixels: np.ndarray, dpi: Optional[float] = None) -> bytes:
    """A PNG file of (height, width, 3) or (height, width, 4) uint8, as bytes; dpi: pixels to an inch, as it tells them."""
    pixels = _arrays.array_of("pixels", pixels)
    if pixels.dtype != U1 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
        has = f"dtype {pixels.dtype}, shape {pixels.shape}"
        raise InvalidArgument(f"pixels: {has}: must be (height, width, 3 or 4) uint8")
    height, width, channels = pixels.shape
    rows = np.zeros((height, 1 + channels * width), np.uint8)  # each begins with its filter: none
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    dpi = None if dpi is None else real("dpi", dpi)
    if dpi is not None and not 0 < dpi <= 1e6:
        raise InvalidArgument(f"dpi: {dpi}: must be above 0 and at most 1,000,000")
    size = b"" if dpi is None else chunk(b"pHYs", struct.pack(">IIB", *[round(dpi / 0.0254)] * 2, 1))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + size + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6))
            + chunk(b"IEND", b""))


def find_bodies(triangles: Triangles) -> Tuple[np.ndarray, int]:
    """Which closed bodies the triangles of a mesh make: the number of each triangle's, and how many there are.

    Raises
    ------
    InvalidArgument
        A body is not closed, or the vertices are not float32, side by side.
    """
    held = Held(instance("triangles", triangles, Triangles))  # its own copy of the indices
    s, count = held.struct, held.struct.count
    dense = s.vertices.format == lib.CGT_FORMAT_FLOAT and s.vertices.stride in (0, 12)
    if count and not dense:
        raise InvalidArgument("triangles: vertices must be float32, side by side")
    indices = held.corners()
    body, bodies, wrong = np.empty(count, U4), ffi.new("uint32_t *"), ffi.new("uint32_t[3]")
    result = lib.cgt_find_bodies(_arrays.pointer(indices), count, ffi.cast("float *", s.vertices.data), s.vertex_count,
                                 _arrays.pointer(body), bodies, wrong)
    if result == lib.CGT_ERROR_INVALID_ARGUMENT and wrong[1] == 0xFFFFFFFF:
        raise InvalidArgument(f"triangle {wrong[0]} has a vertex of {s.vertex_count} or more")
    if result == lib.CGT_ERROR_INVALID_ARGUMENT:
        raise InvalidArgument(f"the mesh is not closed: the edge of triangle {wrong[0]} from vertex {wrong[1]} to "
                              f"{wrong[2]} has no other side, or one that is turned inside out")
    if result:
        raise exception_of(result, ffi.string(lib.cgt_get_result_string(result)).decode())
    return body, bodies[0]


def _own(value):
    """What the caller cannot change."""
    if isinstance(value, np.ndarray):
        return np.array(value)
    return tuple(value) if isinstance(value, list) else value


def _lights_of(lights) -> tuple:
    """Lights, colors and sizes, each as it was passed, checked."""
    found = []
    for one in several("lights", lights, "(light, color, size)"):
        try:
            light, color, size = one
        except (TypeError, ValueError):
            raise InvalidArgument(f"lights: {one!r}: must be a light, its color and its size") from None
        if not isinstance(color, str):
            color = tuple(real("lights: color", x) for x in three("lights: color", color))
        found.append((instance("lights", light, Light), color, None if size is None else real("lights: size", size)))
    if len(found) > lib.CGT_PICTURE_MAX_LIGHTS:
        raise InvalidArgument(f"lights: {len(found)}: at most {lib.CGT_PICTURE_MAX_LIGHTS}")
    return tuple(found)


class Picture(Plain):
    """A picture that shows itself in notebooks.

    Parameters
    ----------
    width, height : int, optional
        Pixels.
    antialias : {1, 2, 4}, optional
        Rays of a pixel along each edge.
    shading : {'full', 'plain', 'bounces'}, optional
        'plain' is the fastest: one light without shadows. 'bounces': mirrors and glass, with hard shadows; geometries
        are spheres and triangles in float32, without origin and types.
    lights : sequence of (Light, color, size) or (Light, color, None), optional
        Color is a name, or three numbers, linear: the brightness of a white surface that faces it; size is 0 for hard
        shadows, the radius of a lamp, or that of a directional one's cone in degrees; None: it shines through
        everything. No lights: one over the camera's left shoulder, and some from the sky.
    sky, head : float, optional
        Light from all sides, which ambient occlusion dims; light from the eye.
    ambient : int, optional
        Rays of a pixel to the sky, at most 256; 0: no ambient occlusion.
    ambient_radius : float, optional
        What is farther off does not occlude: world units; 0: no limit.
    light_samples : int, optional
        Rays of a pixel to each light with a size.
    background : colour, optional
        As all colours: a name, "#rrggbb", bytes (uint8) or three numbers from 0 to 1, sRGB.
    transparent : bool, optional
        Pixels have four channels, and no background.
    outline : float, optional
        Width of outlines in pixels; outline_color is theirs.
    cue : (share, near, far), optional
        Depth cue: how much of the colours at depth `far` becomes the background's, from `near` on.
    layers : sequence of (mask, opacity), optional
        Geometries whose mask has one of these bits are seen through; those of no layer have none of them. At most 8.
    materials : sequence of Material, optional
        Of shading 'bounces', with at most so many `bounces`, and `up`, where its sky is bluest.
    shadow_mask, glass_mask : int, optional
        Of shading 'bounces': geometries that cast shadows, 0: all; and those that cast light ones, which leave 0.6 of
        the light, 0: none.
    rows : (first, count), optional
        Rows that are made, with the bytes that they have in the whole picture; the others are 0, or stay in `out`.
    linear : bool, optional
        Whether `read` fills the attribute `linear` too: r, g, b, depth, id and a of each pixel, before sRGB.

    Notes
    -----
    `draw` makes a whole picture; `begin`, `step` and `read` one that grows by samples. One thread at a time uses it:
    others get `InUse`. All that traces releases Python's lock.

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

    __slots__ = (
    "_handle",
    "_options",
    "_gate",
    "_materials",
    "_context_handle",
    "_scene",
    "_keep",
    "_changes",
     "_read")
    _unmade = {"_made": False, "_handle": None, "_options": None, "_scene": None, "_gate": Gate("picture"),
               "_context_handle": None}
    width, height = given("width", "Pixels."), given("height", "Pixels.")
    _linear = np.dtype([("r", F4), ("g", F4), ("b", F4), ("depth", F4), ("id", U4), ("a", F4)])

    def __init__(self, width: int = 1280, height: int = 720, *, antialias: int = 1, shading: str = "full",
                 lights: Optional[Sequence[Tuple[Light, Sequence[float], Optional[float]]]] = None, sky: float = 0.0,
                 head: float = 0.0, ambient: int = 0, ambient_radius: float = 0.0, light_samples: int = 0,
                 background: Any = (1, 1, 1), transparent: bool = False, outline: float = 0.0,
                 outline_color: Any = (0, 0, 0), cue: Sequence[float] = (0, 0, 0),
                 layers: Sequence[Tuple[int, float]] = (), materials: Sequence[Material] = (), bounces: int = 8,
                 up: Sequence[float] = (0, 1, 0), shadow_mask: int = 0, glass_mask: int = 0,
                 rows: Tuple[int, int] = (0, 0), linear: bool = False):
        if self._options is not None:
            raise InvalidArgument("picture: its __init__ has run")
        arguments = {k: _own(v) for k, v in locals().items() if k != "self"}  # what copies are made of
        materials, layers = several("materials", materials, "cgt.Material"), several("layers", layers, "pairs")
        pairs = tuple((whole("layers", mask), real("layers", opacity)) for mask, opacity in (
            pair("layers", layer) for layer in layers))
        rows = tuple(whole("rows", row) for row in pair("rows", rows))
        cue, up = (tuple(real(name, x) for x in three(name, v)) for name, v in (("cue", cue), ("up", up)))
        lights = None if lights is None else _lights_of(lights)
        self._given = {**arguments, "materials": materials, "layers": pairs, "rows": rows, "cue": cue, "up": up,
                       "lights": lights}
        o = self._options = ffi.new("cgt_picture_options *")
        lib.cgt_picture_options_init(o)
        o.width, o.height = whole("width", width, 1, 65536), whole("height", height, 1, 65536)
        lighting, style, bounced, work = o.lighting, o.style, o.bounces, o.work
        o.antialias, lighting.ambient = whole("antialias", antialias), whole("ambient", ambient)
        lighting.light_samples, bounced.limit = whole("light_samples", light_samples), whole("bounces", bounces)
        work.first_row, work.row_count = rows
        bounced.shadow_mask, bounced.glass_mask = whole("shadow_mask", shadow_mask), whole("glass_mask", glass_mask)
        lighting.sky, lighting.head = real("sky", sky), real("head", head)
        lighting.ambient_radius = real("ambient_radius", ambient_radius)
        o.shading = enum_value("CGT_SHADING_", shading, "shading", lib)
        style.cue, style.cue_range[0], style.cue_range[1] = cue
        if len(pairs) > lib.CGT_PICTURE_MAX_LAYERS:
            raise InvalidArgument(f"layers: {len(pairs)}: at most {lib.CGT_PICTURE_MAX_LAYERS}")
        style.layer_count = len(pairs)
        for c, (mask, opacity) in zip(style.layers, pairs):
            c.mask, c.opacity = mask, opacity
        style.outline, style.outline_color = real("outline", outline), light_of("outline_color", outline_color).tolist()
        style.background = light_of("background", background).tolist()
        style.transparent, linear = switch("transparent", transparent), switch("linear", linear)
        bounced.up = up
        values = [instance("materials", m, Material)._values() for m in materials]
        self._materials = ffi.new("cgt_material[]", values)
        bounced.materials, bounced.material_count = self._materials, len(values)
        if lights is not None:
            self._set_lights(lights)
        self._read = np.zeros(self._shape, U1), np.zeros(self._shape[:2], self._linear) if linear else None
        self._scene: Optional[Scene] = None  # of the picture that has begun
        self._keep: list = []
        self._changes = 0
        self._gate = Gate("picture")
        self._made = True

    def _set_lights(self, lights) -> None:
        o = self._options.lighting
        o.light_count = len(lights)
        for c, (light, color, size) in zip(o.lights, lights):
            c.light, c.shadows, c.size = light._values(), size is not None, size or 0
            c.color = light_of("lights: color", color).tolist() if isinstance(color, str) else color

    @property
    def _shape(self) -> tuple:
        o = self._options
        return o.height, o.width, 4 if o.style.transparent else 3

    @property
    def pixels(self) -> np.ndarray:
        """What was read last: (height, width, 3 or 4) uint8."""
        return self._read[0]

    @property
    def linear(self) -> Optional[np.ndarray]:
        """What was read last, before sRGB: (height, width) of r, g, b, depth, id, a; None unless `linear` is set."""
        return self._read[1]

    def _rest(self) -> dict:
        return {**super()._rest(), "_read": self._read}

    @property
    def _begun(self):
        if self._handle is None or self._scene is None:
            raise InvalidArgument(f"picture: it has not {'begun' if self._made else 'run its __init__'}")
        return self._handle

    def _check_scene(self) -> None:
        """Within the gates of the picture and of its scene: whether that is as it was when the picture began."""
        if self._begun and self._scene._changes != self._changes:
            raise NotCommitted("picture: its scene was committed anew or closed since it began")
        self._scene._traced  # its arrays are where they were

    def _check(self, result: int) -> None:
        _check(self._handle, result)

    def begin(self, scene: Scene, camera: Camera, looks: Optional[Mapping[int, Look]] = None) -> None:
        """Traces the camera's rays and hard shadows; the scene must stay committed until the last step.

        Parameters
        ----------
        scene : Scene
        camera : Camera
        looks : mapping, optional
            Of geometries by their id; others are light grey.
        """
        instance("scene", scene, Scene)
        camera = instance("camera", camera, Camera)._copy()
        if not isinstance({} if looks is None else looks, Mapping):
            raise InvalidArgument(f"looks: {type(looks).__name__}: must be a mapping of geometries' ids")
        looks = dict(looks or {})
        with self._gate.alone, scene._gate.shared:
            traced, committed = scene._traced, scene._committed
            for geometry, look in looks.items():
                if geometry not in committed:
                    raise InvalidArgument(f"looks: geometry {geometry} does not exist, or was not committed")
                instance("looks", look, Look)
            self._create(scene._context_handle)
            count = max(committed, default=-1) + 1
            array, keep = ffi.new("cgt_look[]", count), [committed]
            for id, held in committed.items():
                looks.get(id, Look())._fill(array[id], held, keep)
            # what C has read so far stays until it reads the new
            self._scene, before, self._keep, self._changes = None, self._keep, keep, scene._changes
            self._check(lib.cgt_picture_begin(self._handle, traced, camera._struct, array, count, ffi.NULL))
            self._scene = scene
            del before

    def _create(self, context_handle) -> None:
        """Makes C's picture, unless it is there, for scenes of a context, which lives as long as it does."""
        if self._made and self._context_handle is context_handle:
            return
        made = ffi.new("cgt_picture **")
        result = lib.cgt_picture_create(context_handle, self._options, made)
        handle = ffi.gc(made[0], _release_with(context_handle))
        _check(handle, result)
        self._scene = None
        self._handle, self._context_handle = handle, context_handle

    def step(self, samples: int = 1) -> int:
        """Traces more rays to the sky and to soft lights; returns how many samples are left."""
        left, samples = ffi.new("uint32_t *"), whole("samples", samples)
        with self._gate.alone:
            begun, scene = self._begun, self._scene
            with scene._gate.shared:
                self._check_scene()
                result = lib.cgt_picture_step(begun, samples, left)
        self._check(result)
        return left[0]

    def read(self, out: Optional[np.ndarray] = None, linear_out: Optional[np.ndarray] = None) -> np.ndarray:
        """Makes `pixels` from what is traced so far, and returns them: a new array each time.

        Parameters
        ----------
        out : (height, width, 3 or 4) uint8, optional
            Where pixels go in place of a new array, which then is `pixels`; rows that are not made stay.
        linear_out : optional
            The same for `linear`: contiguous, of the type of that.
        """
        with self._gate.alone:
            begun, scene, o = self._begun, self._scene, self._options
            image, read, keep = self._image_of(out, linear_out)
            if o.shading == lib.CGT_SHADING_PLAIN:
                with scene._gate.shared:
                    self._check_scene()
                    self._check(lib.cgt_picture_read(begun, image))
            else:
                self._check(lib.cgt_picture_read(begun, image))
            self._read = read
            del keep
            return read[0]

    def _image_of(self, out: Optional[np.ndarray], linear_out: Optional[np.ndarray]):
        """A C image over given arrays, or new ones; these; and what keeps them."""
        shape = self._shape
        if linear_out is not None and self._read[1] is None:
            raise InvalidArgument("linear_out: the picture was made without linear")
        pixels = np.zeros(shape, U1) if out is None else out
        linear = linear_out
        if linear is None and self._read[1] is not None:
            linear = np.zeros(shape[:2], self._linear)
        keep = [self._image("out", pixels, U1, shape)]
        image = ffi.new("cgt_image *", {"bytes": _arrays.pointer(keep[0].view), "channels": shape[2]})
        if linear is not None:
            keep.append(self._image("linear_out", linear, self._linear, shape[:2]))
            image.linear = ffi.cast("cgt_linear_pixel *", _arrays.address(keep[1].view))
            if np.may_share_memory(keep[0].view, keep[1].view):
                raise InvalidArgument("linear_out: it overlaps out")
        return image, (pixels, linear), keep

    @staticmethod
    def _image(name: str, a, dtype, shape) -> Hold:
        """An array that a picture is read to."""
        if not is_output(a, dtype, shape) or not np.asarray(a).flags.c_contiguous:
            has = f"dtype {a.dtype}, shape {a.shape}" if isinstance(a, np.ndarray) else type(a).__name__
            raise InvalidArgument(f"{name}: {has}: must be a writable, contiguous array of {dtype}, shape {shape}")
        return Hold(a)

    @property
    def hits(self) -> int:
        """How many of the camera's rays hit something in the picture that was read last."""
        with self._gate.shared:
            return lib.cgt_picture_get_hits(self._begun)

    def draw(self, scene: Scene, camera: Camera, looks: Optional[Mapping[int, Look]] = None, *,
             out: Optional[np.ndarray] = None, linear_out: Optional[np.ndarray] = None) -> "Picture":
        """Makes a whole picture, and returns itself. Arguments are those of `begin` and `read`."""
        self.begin(scene, camera, looks)
        self.step(0xFFFFFFFF)
        self.read(out, linear_out)
        return self

    def _repr_png_(self) -> bytes:
        """What a notebook shows."""
        return encode_png(self.pixels)

    def save(self, path, dpi: Optional[float] = None) -> None:
        """Writes a PNG file. dpi: pixels to an inch, as the file tells them, for programs that print or set it."""
        check_png(path)
        data = encode_png(self.pixels, dpi)
        with open(path, "wb") as file:
            file.write(data)
