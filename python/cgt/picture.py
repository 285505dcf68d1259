# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Pictures of scenes: light, shadows, ambient occlusion, outlines; those of cgt-render, byte for byte."""
import struct
import zlib
from typing import Dict, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays
from ._arrays import F4, U1, U2, U4
from ._native import InvalidArgument, NotCommitted, enum_value, exception_of, instance, load_part, pair, real, whole
from .geometry import Camera, Light, Spheres, Triangles, _Geometry, _three
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

    Arrays are copied where they are not of the type that is named, side by side.

    Parameters
    ----------
    color : three floats, optional
        Of all.
    colors : (n, 3) float32, optional
        Of each primitive or, with `per_vertex`, of each vertex.
    index : (n,) uint16, optional
        In place of colors: the entry of `palette`, (k, 3) float32, such as those of `cgt.colors`.
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

    def __init__(self, color: Sequence[float] = (0, 0, 0), colors: Optional[ArrayLike] = None, *,
                 index: Optional[ArrayLike] = None, palette: Optional[ArrayLike] = None, palette_steps: int = 0,
                 ids: Optional[ArrayLike] = None, lineless_from: Optional[int] = None, per_vertex: bool = False,
                 vertex_normals: Optional[ArrayLike] = None, halves: bool = False,
                 material: Union[int, ArrayLike] = 0, bodies: Optional[ArrayLike] = None, sheet: bool = False):
        self.color = _three("color", color)
        self.per_vertex, self.halves, self.sheet = per_vertex, halves, sheet
        self.material = whole("material", material, 0, 255) if np.ndim(material) == 0 else 0
        if (index is None) != (palette is None):
            raise InvalidArgument("palette: it goes with index")
        if palette_steps > len(() if palette is None else palette):
            raise InvalidArgument(f"palette_steps: {palette_steps}: more than the palette has")
        self.palette_steps = palette_steps
        self.lineless_from = 0 if lineless_from is None else lineless_from + 1
        self._palette = self._dense("palette", palette, F4, 3)
        self._arrays = {"colors": self._dense("colors", colors, F4, 3),
                        "index": self._dense("index", index, U2, 1), "ids": self._dense("ids", ids, U4, 1),
                        "vertex_normals": self._dense("vertex_normals", vertex_normals, F4, 3),
                        "materials": self._dense("material", material if np.ndim(material) else None, U1, 1),
                        "bodies": self._dense("bodies", bodies, U4, 1)}

    @property
    def colors(self) -> Optional[np.ndarray]:
        """The colours as they are read; None: there are none."""
        return self._arrays["colors"]

    @staticmethod
    def _dense(name, a, dtype, width) -> Optional[np.ndarray]:
        if a is None:
            return None
        given = np.asarray(a)
        if given.size and given.dtype.kind not in ("fiu" if dtype == F4 else "iu"):
            raise InvalidArgument(f"{name}: dtype {given.dtype}: must be {dtype}")
        if given.size and dtype != F4 and (given.min() < 0 or given.max() > np.iinfo(dtype).max):
            raise InvalidArgument(f"{name}: {given.min()} to {given.max()}: must fit {dtype}")
        a = np.ascontiguousarray(given, dtype)
        if a.ndim != (1 if width == 1 else 2) or (width > 1 and a.shape[1] != width):
            raise InvalidArgument(f"{name}: shape {a.shape}: must be {'(n,)' if width == 1 else f'(n, {width})'}")
        return a

    def _fill(self, c, geometry: _Geometry, keep: list) -> None:
        """The C struct of this look for a geometry, and what must outlive the picture."""
        c.color, c.per_vertex, c.halves, c.sheet = self.color, self.per_vertex, self.halves, self.sheet
        c.material, c.palette_steps, c.lineless_from = self.material, self.palette_steps, self.lineless_from
        index = self._arrays["index"]
        if index is not None:
            if len(index) and index.max() >= len(self._palette):
                raise InvalidArgument(f"index: {index.max()}, of {len(self._palette)} colours")
            c.palette = _arrays.pointer(self._palette)
        is_mesh = isinstance(geometry, Triangles)
        vertices, count = geometry._struct.vertex_count if is_mesh else 0, len(geometry)
        colored = vertices if self.per_vertex else count * (2 if self.halves else 1)
        wanted = {"colors": colored, "index": colored, "materials": count, "vertex_normals": vertices, "bodies": count,
                  "ids": count}
        for name, a in self._arrays.items():
            if a is None or (name == "vertex_normals" and not is_mesh):
                continue
            if len(a) != wanted[name]:
                raise InvalidArgument(f"{name}: {len(a)} of them: must be {wanted[name]}")
            setattr(c, name, _arrays.pointer(a))
        if is_mesh:
            indices = geometry.arrays.get("indices")
            flat = np.arange(3 * len(geometry), dtype=U4) if indices is None else np.ascontiguousarray(indices, U4)
            keep.append(flat)
            c.indices = _arrays.pointer(flat)
            c.triangles = geometry._struct
        elif isinstance(geometry, Spheres):
            c.spheres = geometry._struct
        keep.append(self)


class Material:
    """What surfaces of shading 'bounces' do with light.

    Parameters
    ----------
    kind : {'matte', 'mirror', 'glass'}
        Matte surfaces have the look's colours.
    color : three floats, optional
        Mirror: share of the light that is reflected, 0 to 1.
    index : float, optional
        Glass: of refraction, 1 to 100.
    absorption : three floats, optional
        Glass: light over a length is multiplied by exp(-absorption * length).
    priority : int, optional
        Glass: where bodies overlap, the one of the highest fills the place.
    gloss : float, optional
        Exponent of the lights' highlights; 0: none.
    """

    def __init__(self, kind: str = "matte", *, color: Sequence[float] = (1, 1, 1), index: float = 1.5,
                 absorption: Sequence[float] = (0, 0, 0), priority: int = 0, gloss: float = 0.0):
        self._values = {"kind": enum_value("CGT_MATERIAL_", kind, "kind", lib), "color": _three("color", color),
                        "index": real("index", index), "absorption": _three("absorption", absorption),
                        "priority": whole("priority", priority, 0, 255), "gloss": real("gloss", gloss)}


def find_bodies(triangles: Triangles) -> Tuple[np.ndarray, int]:
    """Which closed bodies the triangles of a mesh make: the number of each triangle's, and how many there are.

    Raises
    ------
    InvalidArgument
        A body is not closed, or the mesh is not of float32 and 32-bit indices, side by side.
    """
    s, count = triangles._struct, len(triangles)
    dense = s.vertices and s.vertex_stride in (0, 12) and s.index_stride in (0, 12) and not s.indices16
    if count and not dense:
        raise InvalidArgument("triangles: float32 vertices and 32-bit indices, side by side")
    indices = triangles.arrays.get("indices", np.arange(3 * count, dtype=U4))
    body, bodies, text = np.empty(count, U4), ffi.new("uint32_t *"), ffi.new("char[512]")
    result = lib.cgt_find_bodies(ffi.cast("uint32_t *", _arrays.address(indices)), count, s.vertices, s.vertex_count,
                                 _arrays.pointer(body), bodies, text, 512)
    if result:
        raise exception_of(result, ffi.string(text).decode())
    return body, bodies[0]


class Picture:
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
        Color is the brightness of a white surface that faces it; size is 0 for hard shadows, the radius of a lamp, or
        that of a direction's cone in degrees; None: it shines through everything. No lights: one over the camera's left
        shoulder, and some from the sky.
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
    cue : (share, near, far), optional
        Depth cue: how much of the colours at depth `far` becomes the background's, from `near` on.
    front : (opacity, mask), optional
        Geometries that a camera with this mask does not see are transparent so far.
    materials : sequence of Material, optional
        Of shading 'bounces', with at most so many `bounces`, and `up`, where its sky is bluest.
    shadow_mask, glass_mask : int, optional
        Of shading 'bounces': geometries that cast shadows, 0: all; and those that cast light ones, which leave 0.6 of
        the light, 0: none.
    rows : (first, count), optional
        Rows that are made, with the bytes that they have in the whole picture; the others stay.
    linear : bool, optional
        Whether `read` fills the attribute `linear` too: r, g, b, depth, id and a of each pixel, before sRGB.

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
                 lights: Optional[Sequence[Tuple[Light, Sequence[float], Optional[float]]]] = None, sky: float = 0.0,
                 head: float = 0.0, ambient: int = 0, ambient_radius: float = 0.0, light_samples: int = 0,
                 background: Sequence[float] = (1, 1, 1), transparent: bool = False, outline: float = 0.0,
                 outline_color: Sequence[float] = (0, 0, 0), cue: Sequence[float] = (0, 0, 0),
                 front: Tuple[float, int] = (1, 0), materials: Sequence[Material] = (), bounces: int = 8,
                 up: Sequence[float] = (0, 1, 0), shadow_mask: int = 0, glass_mask: int = 0,
                 rows: Tuple[int, int] = (0, 0), linear: bool = False):
        o = self._options = ffi.new("cgt_picture_options *")
        lib.cgt_picture_options_init(o)
        o.width, o.height = whole("width", width, 1), whole("height", height, 1)
        o.antialias, o.ambient = whole("antialias", antialias), whole("ambient", ambient)
        o.light_samples, o.bounces = whole("light_samples", light_samples), whole("bounces", bounces)
        o.first_row, o.row_count = (whole("rows", row) for row in pair("rows", rows))
        o.shadow_mask, o.glass_mask = whole("shadow_mask", shadow_mask), whole("glass_mask", glass_mask)
        o.sky, o.head, o.ambient_radius = real("sky", sky), real("head", head), real("ambient_radius", ambient_radius)
        o.shading = enum_value("CGT_SHADING_", shading, "shading", lib)
        o.cue, o.cue_near, o.cue_far = _three("cue", cue)
        opacity, mask = pair("front", front)
        o.front, o.behind_mask = real("front", opacity), whole("front", mask)
        o.outline, o.outline_color = real("outline", outline), _three("outline_color", outline_color)
        o.background, o.transparent, o.up = _three("background", background), bool(transparent), _three("up", up)
        self._materials = ffi.new("cgt_material[]", [instance("materials", m, Material)._values for m in materials])
        o.materials, o.material_count = self._materials, len(materials)
        if lights is not None:
            self._set_lights(lights)
        self.pixels = np.zeros((o.height, o.width, 4 if transparent else 3), np.uint8)
        kinds = [("r", F4), ("g", F4), ("b", F4), ("depth", F4), ("id", U4), ("a", F4)]
        self.linear = np.zeros((o.height, o.width), kinds) if linear else None
        self._handle = None
        self._context = None
        self._keep: list = []  # the scene first
        self._changes = 0

    def _set_lights(self, lights) -> None:
        o = self._options
        if len(lights) > lib.CGT_PICTURE_MAX_LIGHTS:
            raise InvalidArgument(f"lights: {len(lights)}: at most {lib.CGT_PICTURE_MAX_LIGHTS}")
        o.light_count = len(lights)
        for c, given in zip(o.lights, lights):
            try:
                light, color, size = given
            except (TypeError, ValueError):
                raise InvalidArgument(f"lights: {given!r}: must be a light, its color and its size") from None
            c.light.kind, c.light.position = instance("lights", light, Light)._kind, light.position
            c.color, c.shadows = _three("lights: color", color), size is not None
            c.size = real("lights: size", size or 0)

    @property
    def _begun(self):
        if self._handle is None:
            raise InvalidArgument("picture: it has not begun")
        return self._handle

    def _check_scene(self) -> None:
        if self._begun and self._keep[0]._changes != self._changes:
            raise NotCommitted("picture: its scene was committed anew or closed since it began")

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
        instance("scene", scene, Scene)
        instance("camera", camera, Camera)
        if self._context is not scene.context:
            text, made = ffi.new("char[512]"), ffi.new("cgt_picture **")
            self._options.message, self._options.message_size = text, 512
            result = lib.cgt_picture_create(scene.context.handle, self._options, made)
            self._options.message = ffi.NULL
            if result:
                raise exception_of(result, ffi.string(text).decode())
            self._handle, self._context = ffi.gc(made[0], lib.cgt_picture_release), scene.context
        geometries: Dict[int, _Geometry] = scene.geometries
        if not isinstance(looks or {}, Mapping):
            raise InvalidArgument(f"looks: {type(looks).__name__}: must be a mapping of geometries' ids")
        for geometry, look in (looks or {}).items():
            if geometry not in geometries:
                raise InvalidArgument(f"looks: geometry {geometry} does not exist")
            instance("looks", look, Look)
        count = max(geometries, default=-1) + 1
        array, keep = ffi.new("cgt_look[]", count), [scene]
        for id, geometry in geometries.items():
            (looks or {}).get(id, Look())._fill(array[id], geometry, keep)
        self._keep, self._changes = keep, scene._changes
        self._check(lib.cgt_picture_begin(self._handle, scene.handle, camera._struct, array, count, ffi.NULL))

    def step(self, samples: int = 1) -> int:
        """Traces more rays to the sky and to soft lights; returns how many samples are left."""
        self._check_scene()
        left = ffi.new("uint32_t *")
        self._check(lib.cgt_picture_step(self._begun, whole("samples", samples), left))
        return left[0]

    def read(self) -> np.ndarray:
        """Makes `pixels` from what is traced so far, and returns them."""
        if self._options.shading == lib.CGT_SHADING_PLAIN:
            self._check_scene()
        height, width, channels = self.pixels.shape
        image = ffi.new("cgt_image *", {"bytes": ffi.cast("uint8_t *", _arrays.address(self.pixels)),
                                        "channels": channels})
        if self.linear is not None:
            image.linear = ffi.cast("cgt_linear_pixel *", _arrays.address(self.linear))
        self._check(lib.cgt_picture_read(self._begun, image))
        return self.pixels

    @property
    def hits(self) -> int:
        """How many of the camera's rays hit something in the picture that was read last."""
        return lib.cgt_picture_get_hits(self._begun)

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
