# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""All numbers of all calls, given in every way there is: each means the same, or is refused by its name."""
import ctypes
import inspect
from types import SimpleNamespace

import numpy as np
import pytest

import cgt
import cgt.research
import cgt.trimesh

N = 12
rng = np.random.default_rng(1)
X = rng.integers(-40, 40, (N, 3)).astype("f4") / 32  # floats of all widths hold them
DIR = rng.integers(1, 9, (N, 3)).astype("f4") / 8 - X / 2
R = rng.integers(2, 9, N).astype("f4") / 32
INDEX = rng.integers(0, N, (7, 3)).astype("u4")
GRID = (3, 4)  # of rays; the transposed shape has the same size
SCENE = cgt.Scene(rays="incoherent")
SCENE.add(cgt.Spheres(X.copy(), R.copy()))
SCENE.commit()
HITS = SCENE.trace_rays(X.reshape(*GRID, 3), DIR.reshape(*GRID, 3), ("t", "primitive", "geometry"))

# ---- the kinds of arguments: an array, and whether floats or whole numbers are wanted ----

FLOATS, DOUBLES, WHOLES, NUMBER, WHOLE = "floats", "doubles", "wholes", "number", "whole"
THREE, THREE_WHOLE, VALUES = "three", "three whole", "values"
FOLLOWED, COUNTED = "followed", "counted"  # of geometries: read where they lie, and by each commit


def rays(**more):
    """Arguments of rays."""
    ray = {name: (WHOLES, np.zeros(GRID, "u4")) for name in ("mask", "skip_primitive", "skip_geometry")}
    return {"org": (FLOATS, X.reshape(*GRID, 3)), "dir": (FLOATS, DIR.reshape(*GRID, 3)),
            "t_min": (FLOATS, np.full(GRID, 0.25, "f4")), "t_max": (FLOATS, np.full(GRID, 9, "f4")), **ray, **more}


def flat(arguments):
    """The same in a row."""
    return {name: (kind, a.reshape(N, *a.shape[2:])) for name, (kind, a) in arguments.items()}


def without(arguments, *names):
    """Fewer of them."""
    return {name: a for name, a in arguments.items() if name not in names}


SINGLE = {
    "org": (
        THREE, X[0]), "dir": (
            THREE, DIR[0]), "t_min": (
                NUMBER, 0.25), "t_max": (
                    NUMBER, 9.0), "mask": (
                        WHOLE, 1)}
POINTS = {**without(rays(), "org", "dir"), "position": (FLOATS, X.reshape(*GRID, 3))}
GEOMETRY = {"origin": (THREE, X[0]), "mask": (WHOLE, 1)}
PAIRS = np.arange(2 * N, dtype="u4").reshape(N, 2)
BALLS = {"radius": (FOLLOWED, R), "types": (COUNTED, np.arange(N, dtype="u4")), **GEOMETRY}
LENS = {name: (NUMBER, 2.0) for name in ("fov", "height", "t_min", "t_max")}
PLACES = {name: (THREE, X[k]) for k, name in enumerate(("eye", "target", "up"))}
MESH = SimpleNamespace(vertices=X, faces=INDEX)
MESH_RAYS = cgt.trimesh.RayMeshIntersector
OF_MESH = {"ray_origins": (DOUBLES, X), "ray_directions": (DOUBLES, DIR)}
IN_ALL = {"precision", "statistics", "research", "out", "fields"}  # names, flags, objects, and what is filled
CALLS = {  # each with what is no number of its arguments, and its arguments
    cgt.Scene.trace_rays: (IN_ALL, rays()),
    cgt.Scene.occluded_rays: (IN_ALL, rays()),
    cgt.Scene.trace_hit_rows: (IN_ALL | {"after", "crossings"}, {**flat(rays()), "capacity": (WHOLE, 3)}),
    cgt.Scene.trace_all_rays: (IN_ALL | {"crossings"}, without(flat(rays()), "skip_primitive", "skip_geometry")),
    cgt.Scene.trace_ray: ({"skip"}, SINGLE),
    cgt.Scene.occluded_ray: ({"skip"}, SINGLE),
    cgt.Scene.occluded_points: (IN_ALL | {"light"}, POINTS),
    cgt.Scene.points_inside: (IN_ALL | {"rule"}, {name: POINTS[name] for name in ("position", "mask")}),
    cgt.Scene.bounce_rays: ({"hits", "surfaces"}, {
        **without(rays(), "t_min", "t_max", "mask"), "inside": (NUMBER, 1.5), "outside": (NUMBER, 1.0),
        "inside_of_ray": (FLOATS, np.full(GRID, 1.5, "f4")), "outside_of_ray": (FLOATS, np.ones(GRID, "f4"))}),
    cgt.Scene.trace_camera: (IN_ALL | {"camera", "rows", "visitor", "visitor_fields"},
                             {"width": (WHOLE, 8), "height": (WHOLE, 6)}),
    cgt.Scene.ambient_occlusion: (IN_ALL | {"frame"}, {
        "samples": (WHOLE, 2), "radius": (NUMBER, 1.0), "seed": (WHOLE, 3), "first": (WHOLE, 1)}),
    cgt.Scene.occluded_frame: (IN_ALL | {"frame", "lights"}, {"t_min": (NUMBER, 0.5)}),
    cgt.Scene.update: ({"description"}, {"geometry": (WHOLE, 0)}),
    cgt.Spheres: (set(), {"centers": (FOLLOWED, X), **BALLS}),
    cgt.Triangles: (set(), {"vertices": (FOLLOWED, X), "indices": (COUNTED, INDEX), **GEOMETRY}),
    cgt.Capsules: ({"ends"}, {"vertices": (FOLLOWED, np.repeat(X, 2, 0)), "indices": (COUNTED, PAIRS), **BALLS}),
    cgt.Camera: ({"projection"}, {**PLACES, **LENS, "mask": (WHOLE, 1)}),
    cgt.Light: ({"kind"}, {"position": (THREE, X[0])}),
    cgt.camera_rays: ({"camera"}, {"width": (WHOLE, 8), "height": (WHOLE, 6)}),
    cgt.half_bonds: ({"periodic"}, {"positions": (DOUBLES, X), "bonds": (WHOLES, INDEX[:, :2]),
                                    "edges": (DOUBLES, np.diag([1, 2, 3]).astype("f4"))}),
    cgt.Context: ({"variant", "log"}, {"threads": (WHOLE, 1)}),
    cgt.research.SceneOptions: ({"kd_layout"}, {"resolution": (THREE_WHOLE, [1, 2, 3]), "kd_break_level": (WHOLE, 2)}),
    cgt.colors.entries: (set(), {"values": (VALUES, R), "low": (NUMBER, 0.0), "high": (NUMBER, 1.0)}),
    cgt.colors.by_value: ({"map"}, {"values": (VALUES, R), "low": (NUMBER, 0.0), "high": (NUMBER, 1.0)}),
    cgt.colors.by_type: (set(), {"types": (WHOLES, np.arange(5, dtype="u4"))}),
    cgt.colors.by_element: (set(), {"numbers": (WHOLES, np.arange(5, dtype="u4"))}),
    cgt.Look: ({"color", "colors", "map", "low", "high", "linear", "palette", "per_vertex", "halves", "sheet"}, {
        "index": (WHOLES, np.arange(4, dtype="u2")), "ids": (WHOLES, np.arange(4, dtype="u4")),
        "material": (WHOLES, np.arange(4, dtype="u1")), "bodies": (WHOLES, np.zeros(4, "u4")),
        "palette_steps": (WHOLE, 2), "lineless_from": (WHOLE, 2), "vertex_normals": (FLOATS, X)}),
    cgt.Material: ({"kind", "color", "linear"}, {
        "index": (NUMBER, 1.5), "absorption": (THREE, abs(X[0])), "priority": (WHOLE, 1), "gloss": (NUMBER, 3.0)}),
    cgt.Picture: ({"shading", "lights", "background", "transparent", "outline_color", "cue", "layers", "materials",
                   "rows", "linear"}, {
        **{name: (WHOLE, 4) for name in ("width", "height", "antialias", "ambient", "light_samples", "bounces")},
        **{name: (WHOLE, 4) for name in ("shadow_mask", "glass_mask")}, "up": (THREE, X[0]),
        **{name: (NUMBER, 0.5) for name in ("sky", "head", "ambient_radius", "outline")}}),
    MESH_RAYS.intersects_id: ({"multiple_hits", "return_locations"}, {**OF_MESH, "max_hits": (WHOLE, 1)}),
    MESH_RAYS.intersects_first: (set(), OF_MESH),
    MESH_RAYS.intersects_any: (set(), OF_MESH),
    MESH_RAYS.contains_points: (set(), {"points": (DOUBLES, X)}),
    cgt.show: ({"colors", "bonds", "window", "options", "width", "height", "map", "low", "high"}, {"data": (DOUBLES, X), "radii": (FLOATS, R)}),
    cgt.Figure: ({"context", "options"}, {}),
}
OTHERS = {"camera": cgt.Camera(), "light": cgt.Light((1, 2, 3)), "lights": [cgt.Light((1, 2, 3))], "hits": HITS,
          "frame": SCENE.trace_camera(cgt.Camera(), 8, 6, ("t", "primitive", "geometry", "normal")), "window": False,
          "palette": np.full((4, 3), 0.5), "description": cgt.Spheres([[0, 0, 0]])}


def outcome(call, arguments):
    """What a call gives for arguments, as bytes; geometries: what a ray finds of them."""
    if call is cgt.Scene.update:
        scene = cgt.Scene()
        scene.add(cgt.Spheres(X, R))
        return scene.update(arguments["geometry"], cgt.Spheres(X, R))
    owner = {
    "Rays": SCENE,
    "Frames": SCENE,
    "RayMeshIntersector": MESH_RAYS(MESH)}.get(
        call.__qualname__.split(".")[0])
    needed = [
    name for name,
    p in inspect.signature(call).parameters.items() if name in OTHERS and name not in arguments and (
        p.default is p.empty or name in (
            "window",
             "palette"))]
    named = {**arguments, **{name: OTHERS[name] for name in needed}}
    found = call(owner, **named) if owner is not None and "." in call.__qualname__ else call(**named)
    if isinstance(found, (cgt.Spheres, cgt.Triangles, cgt.Capsules)):
        scene = cgt.Scene(rays="incoherent")
        scene.add(found)
        scene.commit()
        found = scene.trace_rays(X, DIR, ("t", "primitive"))
    if isinstance(found, cgt.Picture):
        return found.pixels.tobytes()
    if isinstance(found, cgt.Camera):
        found = cgt.camera_rays(found, 4, 3)
    if isinstance(found, cgt.Fields):
        return [(name, a.tobytes()) for name, a in found.arrays.items()
                 if call is not cgt.Scene.trace_hit_rows or name == "count"]
    found = found if isinstance(found, tuple) else (found,)
    return [
    a.tobytes() if isinstance(
        a,
        np.ndarray) else repr(
            sorted(
                a.arrays.items()) if isinstance(
                    a,
                     cgt.Fields) else a) for a in found]


# ---- the ways to give them ----


class Interface:
    """What tells where its numbers lie."""

    def __init__(self, a):
        self.__array_interface__, self.a = a.__array_interface__, a


class Array:
    """What gives its array."""

    def __init__(self, a):
        self.a = a

    def __array__(self, dtype=None, copy=None):
        return self.a


class Copies(Array):
    """What gives another array each time."""

    def __array__(self, dtype=None, copy=None):
        return self.a.copy()


class Tensor:
    """What speaks DLPack alone."""

    def __init__(self, a):
        self.a = a

    def __dlpack__(self, **options):
        return self.a.__dlpack__(**options)

    def __dlpack_device__(self):
        return self.a.__dlpack_device__()


def of_ctypes(a):
    """Numbers of ctypes, with their memory."""
    kind = {
    "f": ctypes.c_float,
    "d": ctypes.c_double,
    "I": ctypes.c_uint32,
    "H": ctypes.c_uint16,
    "B": ctypes.c_uint8}[
        a.dtype.char]
    for width in reversed(a.shape):
        kind = kind * width
    return kind.from_buffer(a)


def masked(a):
    """One of its numbers is masked."""
    mask = np.zeros(a.shape, bool)
    mask.flat[0] = True
    return np.ma.masked_array(a, mask)


def first(a, value, dtype):
    """Its first number is another."""
    b = a.astype(dtype)
    b.flat[0] = value
    return b


def strided(a):
    """Every second row of another array."""
    return np.repeat(a, 2, 0)[::2]


def to(dtype):
    """What makes it one of a type."""
    return lambda a: a.astype(dtype)


def with_first(value, dtype):
    """What makes it an array of a type that begins with a value."""
    return lambda a: first(a, value, dtype)


def these(*values):
    """What gives them in its place."""
    return [lambda _, v=v: v for v in values]


BUFFERS = [memoryview, Interface, Array, Tensor, of_ctypes]
LISTS = [lambda a: a.tolist(), lambda a: tuple(a.tolist())]
READ_ONCE = [*LISTS, *BUFFERS, Copies, np.ma.masked_array, np.asfortranarray, strided, lambda a: a.view(np.recarray)]
NO_NUMBERS = [to(str), to(complex), to(object), to("M8[s]"), to(bool), *these("x", {1, 2}, [[1], [2, 3]], object())]
SHAPES = [lambda a: a[..., None], lambda a: a[None], lambda a: a.reshape(-1)[None, None],
          lambda a: a.reshape(-1) if a.ndim > 1 else a[:, None], lambda a: a.reshape(a.size, 1)]
GRIDS = [lambda a: a[:-1], lambda a: a.reshape(a.shape[1], a.shape[0], *a.shape[2:])]
BEYOND = [with_first(1e300, "f8"), with_first(-1e39, "f8")]
NEGATIVE = [with_first(-1, "i8"), with_first(2**32, "i8")]
SINGLES = [str, lambda x: [x], lambda x: np.array([x]), *these(None, True, np.ma.masked, 1j, b"1", object())]
NO_THREE = these("123", {1, 2, 3}, {1: 1, 2: 2, 3: 3}, 1.0, None, [1, 2, "3"], [1, 2, 1e300], np.array([1, 2, 1e300]),
                 [[1], [2], [3]])
RIGHT = {
    FLOATS: [*READ_ONCE, to("f8"), to(">f4"), to("g")],
    DOUBLES: [*READ_ONCE, to("f8")],
    VALUES: [*READ_ONCE, to("f8")],
    WHOLES: [*READ_ONCE, to("i8"), to("u1"), to(">u8")],
    FOLLOWED: [*LISTS, *BUFFERS, strided, to("f8"), lambda a: memoryview(a.astype("f8"))],
    COUNTED: [*LISTS, *BUFFERS, to("i8"), to("u1"), to("u8")],
    THREE: [*LISTS, np.array, lambda a: np.array(a, "f8"), lambda a: list(np.array(a))],
    THREE_WHOLE: [tuple, np.array],
    NUMBER: [np.float32, np.float64, np.array],
    WHOLE: [np.int64, np.uint8, np.array],
}
WRONG = {
    FLOATS: [*NO_NUMBERS, *SHAPES, *BEYOND, masked, lambda a: list(masked(a))],
    DOUBLES: [*NO_NUMBERS, *SHAPES, masked],
    VALUES: [*NO_NUMBERS, lambda a: a[:, None]],
    WHOLES: [*NO_NUMBERS, *SHAPES, *NEGATIVE, with_first(0.5, "f8"), to("f4"), masked],
    FOLLOWED: [*NO_NUMBERS, *SHAPES, masked, np.ma.masked_array, Copies, to(">f4"), to("i8")],
    COUNTED: [*NO_NUMBERS, *SHAPES, *NEGATIVE, masked, np.ma.masked_array, Copies, to("f4")],
    THREE: [lambda a: a[:2], lambda a: a[:, None], lambda a: a[None], lambda a: masked(np.array(a)), to(complex),
            *NO_THREE],
    THREE_WHOLE: these([1, 2], [1, 2, 0.5], [1, 2, -1], "123", [1, 2, 2**32]),
    NUMBER: [*SINGLES, *these(1e300, np.float64(-1e39), 10**400)],
    WHOLE: [*SINGLES, *these(-1, 2**32, 1.0, np.float32(1))],
}
MAY_BE_NONE = {name for call in CALLS for name, p in inspect.signature(call).parameters.items() if p.default is None}
# arguments whose shapes belong together: either may be named; and what C counts by is told by the commit
OTHER_NAMES = {"org": ("dir",), "dir": ("org",), "ray_directions": ("ray_origins",), "centers": ("radius", "types"),
               "radius": ("types", "capsules"), "vertices": ("types", "index", "radius"), "types": ("type", "radius"),
               "indices": ("vertex", "index", "types"), "bonds": ("positions",), "radii": ("radius",),
               "positions": ("bonds", "radi", "centers", "geometries"), "geometry": ("geom",),
               "data": ("positions",),
               "position": tuple(without(rays(), "org", "dir"))}


def cases():
    for call, (_, arguments) in CALLS.items():
        for name in arguments:
            yield pytest.param(call, name, id=f"{call.__qualname__}-{name}")


@pytest.mark.parametrize("call, name", cases())
def test_each_way_means_the_same_or_is_refused(call, name):
    arguments = {k: a for k, (_, a) in CALLS[call][1].items()}
    kind, a = CALLS[call][1][name]
    expected = outcome(call, arguments)
    assert outcome(call, {**arguments, name: a.copy() if isinstance(a, np.ndarray) else a}) == expected
    for way in RIGHT[kind]:
        given = way(a.copy() if isinstance(a, np.ndarray) else a)
        assert outcome(call, {**arguments, name: given}) == expected, (way, given)
    grids = GRIDS if kind in (FLOATS, WHOLES) and np.shape(a)[:2] == GRID else []
    for way in WRONG[kind] + grids:
        given = way(a)
        if given is None and name in MAY_BE_NONE:
            continue
        with pytest.raises(cgt.Error) as found:
            outcome(call, {**arguments, name: given})
        told = str(found.value)
        assert any(word in told for word in (name, *OTHER_NAMES.get(name, ()))), (way, given, told)


def test_no_argument_is_left_out():
    public = [getattr(cgt, name) for name in cgt.__all__ if callable(getattr(cgt, name))]
    public += [getattr(cgt.Scene, name) for name in dir(cgt.Scene) if name[0]
                       != "_" and callable(getattr(cgt.Scene, name))]
    public += [call for name, call in vars(MESH_RAYS).items() if name[:4] in ("inte", "cont")]
    # take paths, words or objects, or are made by calls
    given = set("""read sort_series Trajectory TrajectoryFrame Scene find_bodies fit_camera variants version Fields Hits
        Frame HitRows AllHits SingleHit add remove commit close prepare set_options trace_bounced_rays
        intersects_location
        """.split())
    for call in public:
        if call.__name__ in given or (isinstance(call, type) and issubclass(call, BaseException)):
            continue
        assert call in CALLS, f"{call.__qualname__}: give its arguments to CALLS"
        others, arguments = CALLS[call]
        missing = set(inspect.signature(call).parameters) - {"self"} - set(arguments) - others
        assert not missing, f"{call.__qualname__}: {missing}: give them to CALLS"


@pytest.mark.parametrize("call, name", [p for p in cases() if CALLS[p.values[0]][1][p.values[1]][0] == FOLLOWED])
def test_geometries_follow_every_buffer(call, name):
    arguments = {k: a for k, (_, a) in CALLS[call][1].items() if k != "types"}
    for dtype in ("f4", "f8"):
        for way in BUFFERS:
            a = arguments[name].astype(dtype)
            scene = cgt.Scene(rays="incoherent")
            scene.add(call(**{**arguments, name: way(a)}))
            a *= 2
            scene.commit()
            other = cgt.Scene(rays="incoherent")
            other.add(call(**{**arguments, name: a.copy()}))
            other.commit()
            assert np.array_equal(scene.trace_rays(X, DIR).t, other.trace_rays(X, DIR).t), (dtype, way)
            assert not np.array_equal(scene.trace_rays(X, DIR).t, SCENE.trace_rays(X, DIR).t)


def test_faces_of_64_bits_are_copied_and_told():
    for dtype, copies in (("u4", False), ("i8", True)):
        scene = cgt.Scene()
        scene.add(cgt.Triangles(X, INDEX.astype(dtype)))
        scene.commit()
        assert (scene.statistics.copied_bytes > 0) == copies


def test_one_ray_and_an_array_of_it_are_the_same():
    for t_min, t_max, mask in ((0, np.inf, 0), (0.5, 1, 1), (np.nan, 9, 0), (0, np.nan, 0), (9, 1, 0), (-1, 3, 2)):
        many = SCENE.trace_rays(X, DIR, t_min=t_min, t_max=t_max, mask=mask)
        for k in range(N):
            one = SCENE.trace_ray(X[k], DIR[k], t_min=t_min, t_max=t_max, mask=mask)
            assert (one.primitive, np.float32(one.t)) == (many.primitive[k], many.t[k]), (k, t_min, t_max, mask)
