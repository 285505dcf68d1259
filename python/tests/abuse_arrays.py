# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Arrays that move, shrink or go while something reads them, and arrays that nothing can read."""
import gc
import mmap
import tempfile
import threading
from multiprocessing import shared_memory

import numpy as np
from abuse import DIR, ORG, Lies, ball, mesh, scene_of, table, trace_all

import cgt

CASES, case = table()
REFUSED = cgt.InvalidArgument


# ---- memory that would go ----


@case(ValueError, "cannot resize")
def centres_are_resized():
    x, r = ball()
    scene = scene_of(cgt.Spheres(x, r))
    x.resize((10**6, 3), refcheck=False)
    trace_all(scene)


@case(ValueError, "cannot resize")
def doubles_are_resized_before_the_commit():
    x, r = ball("f8")
    geometry = cgt.Spheres(x, r)
    r.resize(10**6, refcheck=False)
    scene_of(geometry)


@case(ValueError, "cannot resize")
def what_a_view_is_of_is_resized():
    base = np.zeros(10**6, "f4")
    scene = scene_of(cgt.Spheres(base[:3000].reshape(-1, 3), 0.1))
    base.resize(10, refcheck=False)
    trace_all(scene)


@case(ValueError, "cannot resize")
def indices_are_resized():
    v, i = mesh()
    geometry = cgt.Triangles(v, i)
    i.resize((1, 3), refcheck=False)
    scene_of(geometry)


@case()
def colours_are_resized():
    x, r = ball()
    scene, colors = scene_of(cgt.Spheres(x, r)), np.ones((len(x), 3), "f4")
    picture = cgt.Picture(60, 40)
    picture.begin(scene, cgt.Camera(), {0: cgt.Look(colors=colors)})
    colors.resize((1, 3), refcheck=False)
    picture.read()


@case(BufferError, "export")
def a_bytearray_is_extended():
    memory = bytearray(12 * 1000)
    scene = scene_of(cgt.Spheres(np.frombuffer(memory, "f4").reshape(-1, 3), 0.1))
    memory.extend(bytes(10**7))
    trace_all(scene)


@case(BufferError, "export")
def a_mapping_is_closed():
    memory = mmap.mmap(-1, 12 * 4096)
    scene = scene_of(cgt.Spheres(np.ndarray((4096, 3), "f4", memory), 0.1))
    try:
        memory.close()
    finally:
        trace_all(scene)


@case(BufferError, "export")
def a_mapped_file_is_closed():
    with tempfile.NamedTemporaryFile() as file:
        x = np.memmap(file.name, "f4", "w+", shape=(4096, 3))
        scene = scene_of(cgt.Spheres(x, 0.1))
        x._mmap.close()
        trace_all(scene)


@case(BufferError, "export")
def shared_memory_is_closed():
    memory = shared_memory.SharedMemory(create=True, size=12 * 4096)
    try:
        scene = scene_of(cgt.Spheres(np.ndarray((4096, 3), "f4", memory.buf), 0.1))
        memory.close()
    finally:
        trace_all(scene)
        memory.unlink()


def replaced(x, call):
    """Calls after an array got other memory, which this version of numpy may refuse by itself."""
    x.__setstate__((1, (1, 3), x.dtype, False, bytes(3 * x.itemsize)))
    call()


@case(BufferError, "centers: the array's memory was replaced")
def memory_is_replaced_before_a_commit():
    x = np.zeros((10**6, 3))
    scene = scene_of(cgt.Spheres(x, 0.1))
    replaced(x, scene.commit)


@case(BufferError, "vertices: the array's memory was replaced")
def memory_is_replaced_before_a_trace():
    x = np.zeros((3 * 10**5, 3), "f4")
    scene = scene_of(cgt.Triangles(x))
    replaced(x, lambda: scene.trace_camera(cgt.Camera(), 8, 8))


@case(BufferError, "memory was replaced")
def memory_is_replaced_before_a_step():
    x, r = ball(count=10**5)
    scene, picture = scene_of(cgt.Spheres(x, r)), cgt.Picture(60, 40, ambient=4)
    picture.begin(scene, cgt.Camera())
    replaced(x, picture.step)


@case()
def arrays_are_dropped():
    x, r = ball()
    scene = scene_of(cgt.Spheres(x, r))
    expected = scene.trace_rays(ORG, DIR)
    del x, r
    gc.collect()
    _ = [np.full((200, 3), 9, "f4") for _ in range(50)]
    assert np.array_equal(expected.t, scene.trace_rays(ORG, DIR).t)


@case()
def a_geometry_is_made_anew():
    x, r = ball()
    geometry = cgt.Spheres(x, r)
    scene = scene_of(geometry)
    expected = scene.trace_rays(ORG, DIR)
    geometry.__init__(np.zeros((1, 3)), 0.1)
    del x, r
    gc.collect()
    assert np.array_equal(expected.t, scene.trace_rays(ORG, DIR).t)
    scene.commit()


@case()
def an_array_gets_another_shape_and_type():
    x, r = ball()
    scene = scene_of(cgt.Spheres(x, r))
    expected = scene.trace_rays(ORG, DIR)
    x.dtype = "u1"
    x.shape = (-1,)
    scene.commit()
    assert np.array_equal(expected.t, scene.trace_rays(ORG, DIR).t)


# ---- floats that change: other hits, and no more ----


def geometries():
    """One of each kind, over one array of places and one of radii."""
    x, r = ball()
    i = np.random.default_rng(5).integers(0, len(x), (100, 3)).astype("u4")
    return x, r, [cgt.Spheres(x, r), cgt.Triangles(x, i), cgt.Capsules(x, r[:100], i[:, :2].copy())]


def bad_floats(x, r, k):
    """Floats of many kinds."""
    x[...] = [np.nan, 0, np.inf, 1e30, x[::-1] * 1e-30, x.view("u4") * np.uint32(2654435761 + k)][k % 6]
    r[...] = [0, np.nan, -1, 1e30, 0.1][k % 5]


@case()
def floats_change_after_a_commit():
    for structure in ("auto", "bvh"):
        x, r, kinds = geometries()
        good = x.copy()
        for geometry in kinds:
            for k in range(6):
                x[...], r[...] = good, 0.1
                scene = scene_of(geometry, structure=structure)
                bad_floats(x, r, k)
                trace_all(scene)


@case()
def floats_change_while_commits_run():
    x, r, kinds = geometries()
    ended, good = threading.Event(), x.copy()

    def change():
        k = 0
        while not ended.is_set():
            k += 1
            bad_floats(x, r, k)
            x[...], r[...] = good, 0.1

    thread = threading.Thread(target=change)
    thread.start()
    try:
        for geometry in kinds:
            scene = cgt.Scene()
            scene.add(geometry)
            for _ in range(5):
                try:
                    scene.commit()
                except cgt.Error:
                    continue
                trace_all(scene)
    finally:
        ended.set()
        thread.join()


# ---- arrays that cannot be read ----


class Liar(np.ndarray):
    """An array that tells another address and another size."""

    __array_interface__ = {"data": (1, False), "shape": (9, 3), "typestr": "<f4", "version": 3}
    nbytes = 10**9


@case()
def a_subclass_lies():
    x, r = ball()
    scene = scene_of(cgt.Spheres(x.view(Liar), r.view(Liar)))
    expected = scene_of(cgt.Spheres(x, r)).trace_rays(ORG, DIR)
    assert np.array_equal(expected.t, scene.trace_rays(ORG.view(Liar), DIR.view(Liar)).t)


def refused(name, words, make):
    """A case of one array that a geometry refuses."""
    make.__name__ = name
    case(REFUSED, words)(make)


refused("masked", "a masked array", lambda: cgt.Spheres(np.ma.zeros((2, 3))))
refused("whole_numbers", "dtype int64", lambda: cgt.Spheres(np.zeros((2, 3), int)))
refused("long_floats", "dtype float128", lambda: cgt.Spheres(np.zeros((2, 3), "f16")))
refused("other_byte_order", "dtype >f4", lambda: cgt.Spheres(np.zeros((2, 3), ">f4")))
refused("indices_in_other_byte_order", "dtype >u4", lambda: cgt.Triangles(*mesh(">u4")))
refused("objects", "dtype object", lambda: cgt.Spheres(np.zeros((2, 3), "O")))
refused("no_dimensions", r"shape \(\)", lambda: cgt.Spheres(np.array(1.0)))
refused("flat", r"shape \(6,\)", lambda: cgt.Spheres(np.zeros(6)))
refused("pairs", r"shape \(2, 2\)", lambda: cgt.Spheres(np.zeros((2, 2))))
refused("backwards", "strides", lambda: cgt.Spheres(np.zeros((4, 3))[::-1]))
refused("columns_backwards", "side by side", lambda: cgt.Spheres(np.zeros((4, 3))[:, ::-1]))
refused("by_columns", "side by side", lambda: cgt.Spheres(np.zeros((3, 4)).T))
refused("one_row_for_all", "overlap", lambda: cgt.Spheres(np.broadcast_to(np.zeros(3), (2**40, 3))))
refused("one_index_for_all", "overlap",
        lambda: cgt.Triangles(np.zeros((9, 3)), np.broadcast_to(np.uint32([0, 1, 2]), (2**33, 3))))
refused("one_radius_by_stride", "overlap", lambda: cgt.Spheres(np.zeros((4, 3)), np.broadcast_to(np.float32(1), 4)))
refused("ragged", "", lambda: cgt.Spheres([[1, 2, 3], [4]]))
refused("text", "", lambda: cgt.Spheres("abc"))
refused("too_few_radii", "radius: 1 for 4", lambda: cgt.Spheres(np.zeros((4, 3)), np.zeros(1)))
refused("too_few_types", "types: 1 for 4", lambda: cgt.Spheres(np.zeros((4, 3)), np.zeros(1), types=np.zeros(1, "u1")))
refused("too_few_ends", "ends", lambda: cgt.Capsules(np.zeros((4, 3)), 1, ends=np.zeros((1, 3))))
refused("radius_not_a_number", "radius", lambda: scene_of(cgt.Spheres(np.zeros((4, 3)), np.nan)))
refused("rays_that_differ", "dir: shape", lambda: scene_of().trace_rays(Lies((4, 3), (900, 3)), np.zeros((5, 3), "f4")))


@case()
def rays_that_change_while_they_are_read():
    scene = scene_of(cgt.Spheres(*ball()))
    assert scene.occluded_rays(Lies((2, 3), (9, 3)), Lies((2, 3), (9, 3))).shape == (2,)
    assert scene.points_inside(Lies((900, 3), (2, 3))).shape == (900,)
    scene.trace_all_rays(Lies((9, 3), (2, 3)), DIR[0])
