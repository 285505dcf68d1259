# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Places where results cannot go, frames whose arrays change, numbers of hits that nobody has found."""
import gc

import numpy as np
from abuse import DIR, FIELDS, ORG, ball, mesh, scene_of, table, trace_all
from numpy.lib.stride_tricks import as_strided

import cgt

CASES, case = table()
REFUSED = cgt.InvalidArgument
CAMERA = cgt.Camera()


def scene():
    """A cloud."""
    return scene_of(cgt.Spheres(*ball()))


def sealed(*shape, dtype="f4"):
    """An array that nothing may write to."""
    a = np.zeros(shape, dtype)
    a.flags.writeable = False
    return a


def out(name, words, make, field="t"):
    """A case of an array that a frame's field cannot go to."""
    def call():
        scene().trace_camera(CAMERA, 8, 6, (field,), out=make())

    call.__name__ = name
    case(REFUSED, words)(call)


out("out_is_read_only", "writable", lambda: {"t": sealed(6, 8)})
out("out_of_another_type", "must be a writable array of float32", lambda: {"t": np.zeros((6, 8))})
out("out_in_other_byte_order", "must be a writable array", lambda: {"t": np.zeros((6, 8), ">f4")})
out("out_is_smaller", r"shape \(5, 8\)", lambda: {"t": np.zeros((5, 8), "f4")})
out("out_upside_down", "strides", lambda: {"t": np.zeros((6, 8), "f4")[::-1]})
out("out_mirrored", "strides", lambda: {"t": np.zeros((6, 8), "f4")[:, ::-1]})
out("out_by_columns", "", lambda: {"t": np.zeros((8, 6), "f4").T})
out("out_is_one_pixel", "strides", lambda: {"t": as_strided(np.zeros(1, "f4"), (6, 8), (0, 0))})
out("out_rows_are_one", "strides", lambda: {"t": as_strided(np.zeros(8, "f4"), (6, 8), (0, 4))})
out("out_rows_overlap", "strides", lambda: {"t": as_strided(np.zeros(99, "f4"), (6, 8), (16, 4))})
out("out_pixels_overlap", "strides", lambda: {"t": as_strided(np.zeros(99, "f4"), (6, 8), (32, 2))})
out("out_normals_are_one", "strides", lambda: {"normal": as_strided(np.zeros(3, "f4"), (6, 8, 3), (0, 0, 4))}, "normal")
out("out_is_a_list", "must be arrays by field", lambda: [1, 2])
out("out_is_one_array", "must be arrays by field", lambda: np.zeros((6, 8), "f4"))
out("out_of_lists", "list: must be", lambda: {"t": [[0.0] * 8] * 6})
out("out_lacks_a_field", "it lacks 't'", lambda: {"primitive": np.zeros((6, 8), "u4")})
out("out_of_bytes", "writable", lambda: {"t": np.frombuffer(bytes(192), "f4").reshape(6, 8)})


@case(REFUSED, "overlaps")
def out_arrays_are_one():
    a = np.zeros((6, 8), "f4")
    scene().trace_camera(CAMERA, 8, 6, ("t", "primitive"), out={"t": a, "primitive": a.view("u4")})


@case(REFUSED, "overlaps")
def out_arrays_overlap():
    a = np.zeros(600, "f4")
    scene().trace_rays(ORG, DIR, ("t", "u"), out={"t": a[:500], "u": a[50:550], "v": np.zeros(500, "f4")})


@case()
def out_arrays_of_one_record_do_not_overlap():
    record = np.zeros(500, [("t", "f4"), ("primitive", "u4"), ("normal", "f4", 3)])
    assert scene().trace_rays(ORG, DIR, ("t", "primitive", "normal"), out=record).hit.any()


@case(REFUSED, "out: dtype")
def occlusion_to_read_only():
    scene().occluded_rays(ORG, DIR, out=sealed(500, dtype="u1"))


@case(REFUSED, "out: dtype")
def occlusion_to_every_second_byte():
    scene().occluded_rays(ORG, DIR, out=np.zeros(1000, "u1")[::2])


@case(REFUSED, "out: dtype")
def occlusion_to_fewer_bytes():
    scene().points_inside(ORG, out=np.zeros(499, bool))


@case(REFUSED, "out: dtype")
def occlusion_to_floats():
    scene().occluded_points(cgt.Light((1, 2, 3)), ORG, out=np.zeros(500, "f4"))


@case(REFUSED, "out: dtype")
def shadows_to_one_light_less():
    s = scene()
    f = s.trace_camera(CAMERA, 8, 6, FIELDS)
    s.occluded_frame(f, [cgt.Light((1, 2, 3))] * 2, out=np.zeros((1, 6, 8), "u1"))


# ---- pictures ----


def picture_to(name, words, attribute, make):
    """A case of an array that a picture cannot be read to."""
    def call():
        p = cgt.Picture(64, 48, linear=True)
        p.draw(scene(), CAMERA)
        p.read(**{attribute: make(p.pixels if attribute == "out" else p.linear)})

    call.__name__ = name
    case(REFUSED, words)(call)


def locked(a):
    """The same, read only."""
    a.flags.writeable = False
    return a


picture_to("pixels_are_smaller", r"out: dtype uint8, shape \(4, 4, 3\)", "out", lambda a: a[:4, :4].copy())
picture_to("pixels_are_read_only", "writable", "out", locked)
picture_to("pixels_are_strided", "contiguous", "out", lambda a: np.zeros((96, 64, 3), "u1")[::2])
picture_to("pixels_are_upside_down", "contiguous", "out", lambda a: a[::-1])
picture_to("pixels_are_one", "contiguous", "out", lambda a: as_strided(np.zeros(3, "u1"), (48, 64, 3), (0, 0, 1)))
picture_to("pixels_have_another_channel", "shape", "out", lambda a: np.zeros((48, 64, 4), "u1"))
picture_to("pixels_are_floats", "float32", "out", lambda a: np.zeros((48, 64, 3), "f4"))
picture_to("pixels_are_a_list", "list", "out", lambda a: [])
picture_to("pixels_are_bytes", "writable", "out", lambda a: np.frombuffer(bytes(a), "u1").reshape(a.shape))
picture_to("linear_is_smaller", "linear_out: dtype", "linear_out", lambda a: a[:4])
picture_to("linear_is_read_only", "linear", "linear_out", locked)
picture_to("linear_is_of_bytes", "linear", "linear_out", lambda a: np.zeros((48, 64), "u1"))


@case(REFUSED, "overlaps out")
def linear_overlaps_pixels():
    p = cgt.Picture(64, 48, linear=True)
    p.draw(scene(), CAMERA)
    p.read(p.linear.view("u1").reshape(-1)[:48 * 64 * 3].reshape(48, 64, 3), p.linear)


@case()
def pixels_of_the_callers():
    p, mine = cgt.Picture(64, 48), np.zeros((48, 64, 3), "u1")
    first = p.draw(scene(), CAMERA).pixels
    assert p.read(mine) is mine is p.pixels and np.array_equal(first, mine)
    p.read()[...] = 1
    assert np.array_equal(first, mine)  # which later reads leave alone


@case(REFUSED, "pictures are saved as .png")
def no_picture_is_saved():
    cgt.Picture(64, 48).save("picture.jpg")


# ---- frames ----


@case(ValueError, "cannot resize")
def a_frames_array_is_resized():
    s = scene()
    f = s.trace_camera(CAMERA, 80, 60, FIELDS)
    f.t.resize((1, 1), refcheck=False)
    s.occluded_frame(f, [])


@case(ValueError, "cannot resize")
def an_out_array_is_resized():
    s, t = scene(), np.zeros((60, 80), "f4")
    f = s.trace_camera(CAMERA, 80, 60, ("t",), out={"t": t})
    t.resize((1, 1), refcheck=False)
    s.occluded_frame(f, cgt.Light((1, 2, 3)))


@case()
def a_frames_arrays_are_dropped():
    s = scene()
    f = s.trace_camera(CAMERA, 80, 60, FIELDS)
    expected = s.ambient_occlusion(f, 4)
    f._arrays.clear()
    gc.collect()
    _ = [np.full((60, 80), 9, "f4") for _ in range(20)]
    assert np.array_equal(expected, s.ambient_occlusion(f, 4))


@case(TypeError, "item assignment")
def a_frames_arrays_are_replaced():
    scene().trace_camera(CAMERA, 80, 60, FIELDS).arrays["t"] = np.zeros(1, "f4")


@case(AttributeError, "'t'")
def a_frames_array_is_assigned():
    scene().trace_camera(CAMERA, 80, 60, FIELDS).t = np.zeros(1, "f4")


@case()
def a_frames_numbers_are_garbage():
    s = scene_of(cgt.Triangles(*mesh()), cgt.Spheres(*ball()))
    f = s.trace_camera(CAMERA, 80, 60, FIELDS)
    for k, a in enumerate(f.arrays.values()):
        a.view("u4")[...] = np.random.default_rng(k).integers(0, 2**32, a.shape, dtype="u4")
    s.ambient_occlusion(f, 4)
    s.occluded_frame(f, [cgt.Light((1, 2, 3))])


@case()
def a_frame_of_another_scene():
    f = scene_of(cgt.Spheres(*ball(count=10**5))).trace_camera(CAMERA, 80, 60, FIELDS)
    s = scene_of(cgt.Spheres([[0, 0, 0]], 1.0))
    s.ambient_occlusion(f, 4)
    s.occluded_frame(f, [cgt.Light((1, 2, 3))])


@case(REFUSED, "frame.camera: NoneType")
def a_frame_without_camera():
    s = scene()
    f = s.trace_camera(CAMERA, 8, 6, FIELDS)
    f.camera = None
    s.ambient_occlusion(f, 4)


# ---- numbers of primitives that are not there ----


def garbage():
    """Ids of all kinds."""
    ids = np.random.default_rng(6).integers(0, 2**32, 500, dtype="u4")
    ids[:100] = np.arange(100) * 7
    return ids


@case()
def skipped_ids_are_garbage():
    s = scene_of(cgt.Triangles(*mesh()), cgt.Spheres(*ball()), cgt.Capsules(ball()[0], 0.1))
    for ids in (garbage(), garbage() >> 16):
        s.trace_rays(ORG, DIR, FIELDS, skip_primitive=ids, skip_geometry=ids)
        s.occluded_points(cgt.Light((1, 2, 3)), ORG, skip_primitive=ids, skip_geometry=ids, mask=ids)


@case()
def bounced_hits_are_garbage():
    both = scene_of(cgt.Triangles(*mesh()), cgt.Spheres(*ball()))
    for s in (both, scene_of(cgt.Capsules(ball()[0], 0.1)), scene_of()):
        for t in (1, np.nan, np.inf):
            hits = {"t": np.full(500, t, "f4"), "primitive": garbage(), "geometry": garbage() % 3}
            new = s.bounce_rays(ORG, DIR, hits, inside=1.5, skip_primitive=garbage(), skip_geometry=garbage() % 3,
                                surfaces=("position", "normal", "start", "length", "front"))
            for rays in new[:2]:
                s.trace_bounced_rays(rays)
        rays = {**new[0].arrays, "skip_primitive": garbage(), "skip_geometry": garbage() % 3}
        s.trace_bounced_rays(rays)


@case()
def hits_go_on_after_garbage():
    s = scene_of(cgt.Triangles(*mesh()), cgt.Spheres(*ball()))
    after = {"primitive": garbage(), "geometry": garbage() % 3, "surface": garbage()}
    s.trace_hit_rows(ORG, DIR, 8, after=after)
    s.trace_hit_rows(ORG, DIR, 8, after=after, crossings=True)


@case(REFUSED, "after")
def hits_go_on_after_nothing():
    scene().trace_hit_rows(ORG, DIR, 8, after={"geometry": garbage()})


@case((cgt.Error, MemoryError, ValueError), "")
def more_hits_than_there_is_memory():
    scene().trace_hit_rows(ORG, DIR, 2**32 - 1)


@case(cgt.TooLarge, "65,536")
def a_frame_larger_than_memory():
    scene().trace_camera(CAMERA, 2**31, 2**31)


@case(REFUSED, "width")
def a_picture_larger_than_memory():
    cgt.Picture(2**31, 2**31)


@case(REFUSED, "rows|row")
def rows_beyond_the_frame():
    scene().trace_camera(CAMERA, 8, 6, rows=(2**31, 2**31))


@case(REFUSED, "shape")
def masks_of_another_shape():
    scene().trace_rays(ORG, DIR, mask=np.zeros((1, 1), "u4"))


@case()
def rays_without_end():
    s = scene_of(cgt.Triangles(*mesh()), cgt.Spheres(*ball()))
    for value in (np.nan, np.inf, 0, 1e38, 1e-45):
        s.trace_rays(np.full((9, 3), value), np.full((9, 3), value), FIELDS, t_min=value, t_max=value)
        s.trace_all_rays(np.full((9, 3), value), np.full((9, 3), value))
        s.points_inside(np.full((9, 3), value))
    trace_all(s)
