# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Scenes and calls: arrays by reference, outputs, errors, threads; values against formulas and against each other."""
import copy
import gc
import logging
import pickle
import sys
import threading
import weakref

import numpy as np
import pytest

import cgt

N = 400


@pytest.fixture(scope="module")
def cloud():
    """Centres in double, radii in float."""
    r = np.random.default_rng(1)
    return r.uniform(-1, 1, (N, 3)), r.uniform(0.02, 0.1, N).astype("f4")


@pytest.fixture(scope="module")
def scene(cloud):
    s = cgt.Scene()
    s.add(cgt.Spheres(*cloud))
    s.commit()
    return s


@pytest.fixture(scope="module")
def rays():
    r = np.random.default_rng(2)
    return r.uniform(-2, 2, (1000, 3)).astype("f4"), r.normal(size=(1000, 3)).astype("f4")


def nearest(centers, radii, org, dir):
    """The least t of each ray, in double."""
    o = org.astype("f8")[:, None] - centers.astype("f4").astype("f8")
    d, r = dir.astype("f8")[:, None], radii.astype("f8")
    a, b, c = (d * d).sum(-1), (o * d).sum(-1), (o * o).sum(-1) - r * r
    w = b * b - a * c
    root = np.sqrt(np.where(w >= 0, w, np.nan))
    t = np.stack([(-b - root) / a, (-b + root) / a])
    t = np.where(t >= 0, t, np.inf)
    return np.nanmin(np.where(np.isnan(t), np.inf, t), axis=(0, 2))


def test_hits_are_those_of_the_formula(scene, cloud, rays):
    hits = scene.trace_rays(*rays, ("t", "primitive", "geometry", "normal"), statistics=True)
    expected = nearest(*cloud, *rays)
    assert np.array_equal(hits.hit, np.isfinite(expected)) and 50 < hits.hit.sum() < 950
    assert np.allclose(hits.t[hits.hit], expected[hits.hit], rtol=1e-6)
    place = rays[0] + hits.t[:, None] * rays[1]
    normal = (place - cloud[0][hits.primitive % N]) / cloud[1][hits.primitive % N, None]
    assert np.allclose(hits.normal[hits.hit], normal[hits.hit], atol=1e-4)
    assert (hits.primitive[~hits.hit] == cgt.INVALID_ID).all() and (hits.geometry[hits.hit] == 0).all()
    assert hits.statistics.rays == 1000 and hits.statistics.hits == hits.hit.sum()
    assert np.array_equal(scene.occluded_rays(*rays), hits.hit)
    one = scene.trace_ray(rays[0][3], rays[1][3])
    assert np.float32(one.t) == hits.t[3] and one.primitive == hits.primitive[3] and one.hit == hits.hit[3]
    assert scene.occluded_ray(rays[0][3], rays[1][3]) == hits.hit[3]


def test_any_layout_gives_the_same_bits(scene, rays):
    expected = scene.trace_rays(*rays, ("t", "primitive", "normal", "uv"))
    record = np.zeros(1000, [("org", "f4", 3), ("id", "u4"), ("dir", "f4", 3), ("t_max", "f4")])
    record["org"], record["dir"], record["t_max"] = *rays, np.inf
    layouts = [
        (record["org"], record["dir"]),
        (np.asfortranarray(rays[0]), np.asfortranarray(rays[1])),
        (rays[0].astype("f8"), rays[1].tolist()),
        (rays[0][::-1][::-1], rays[1]),
        (rays[0].reshape(10, 100, 3), rays[1].reshape(10, 100, 3)),
    ]
    for org, dir in layouts:
        found = scene.trace_rays(org, dir, ("t", "primitive", "normal", "uv"))
        for name in expected.keys():
            assert found[name].tobytes() == expected[name].tobytes()
    found = scene.trace_rays(record["org"], record["dir"], t_max=record["t_max"])
    assert np.array_equal(found.t, expected.t)


def test_ranges_masks_and_skips(scene, rays):
    first = scene.trace_rays(*rays, ("t", "primitive", "geometry"))
    second = scene.trace_rays(*rays, skip_primitive=first.primitive, skip_geometry=first.geometry)
    assert (second.t >= first.t).all() and (second.primitive[first.hit] != first.primitive[first.hit]).all()
    assert not scene.trace_rays(*rays, t_min=1.0, t_max=0.5).hit.any()
    again = scene.trace_rays(*rays, t_max=first.t)
    assert np.array_equal(again.primitive, first.primitive)
    off = np.where(np.arange(1000) % 2, np.float32(-1), np.float32(np.inf))
    assert np.array_equal(scene.occluded_rays(*rays, t_max=off), first.hit & (np.arange(1000) % 2 == 0))


def test_out_gets_the_results(scene, rays):
    expected = scene.trace_rays(*rays, ("t", "primitive", "normal"))
    record = np.zeros(1000, [("t", "f4"), ("normal", "f4", 3), ("more", "f8"), ("primitive", "u4")])
    hits = scene.trace_rays(*rays, ("t", "primitive", "normal"), out=record)
    for name in expected.keys():
        assert np.array_equal(record[name], expected[name]) and np.shares_memory(hits[name], record)
    assert not record["more"].any()
    t = np.empty(1000, "f4")
    hits = scene.trace_rays(*rays, ("t",), out={"t": t})
    assert hits.t is t and np.array_equal(t, expected.t)
    with pytest.raises(cgt.InvalidArgument, match="out: it lacks 'primitive'"):
        scene.trace_rays(*rays, out={"t": t})
    for bad in (np.empty(999, "f4"), np.empty(1000, "f8"), [0.0] * 1000, t[:0]):
        with pytest.raises(cgt.InvalidArgument, match=r"out\['t'\]"):
            scene.trace_rays(*rays, ("t",), out={"t": bad})
    with pytest.raises(cgt.InvalidArgument, match=r"out\['t'\].*strides"):
        scene.trace_rays(*rays, ("t",), out={"t": t[::-1]})
    t.flags.writeable = False
    with pytest.raises(cgt.InvalidArgument, match="writable"):
        scene.trace_rays(*rays, ("t",), out={"t": t})


def test_frames(scene):
    camera = cgt.Camera((0, 0, 4), fov=40)
    fields = ("t", "primitive", "geometry", "normal", "position", "uv")
    frame = scene.trace_camera(camera, 90, 70, fields, statistics=True)
    assert frame.shape == (70, 90) and frame.normal.shape == frame.position.shape == (70, 90, 3)
    org, dir = cgt.camera_rays(camera, 90, 70)
    hits = scene.trace_rays(org, dir, ("t", "primitive", "normal"))
    for name in hits.keys():
        assert frame[name].tobytes() == hits[name].tobytes()
    place = org + frame.t[..., None] * dir
    assert np.array_equal(frame.position[frame.hit], place[frame.hit])
    assert frame.statistics.hits == frame.hit.sum() > 500
    wide = {"t": np.full((80, 100), -1, "f4"), "normal": np.full((80, 100, 3), -1, "f4")}
    part = {name: a[:70, :90] for name, a in wide.items()}
    scene.trace_camera(camera, 90, 70, ("t", "normal"), out=part)
    assert np.array_equal(part["t"], frame.t) and np.array_equal(part["normal"], frame.normal)
    assert (wide["t"][70:] == -1).all() and (wide["normal"][:, 90:] == -1).all()
    lights = [cgt.Light((1, 3, 2)), cgt.Light((0, 1, 0.5), "directional")]
    shadows = scene.occluded_frame(frame, lights)
    assert shadows.shape == (2, 70, 90) and shadows.dtype == bool
    h = frame.hit
    for light, shadow in zip(lights, shadows):
        points = scene.occluded_points(light, frame.position[h], skip_primitive=frame.primitive[h],
                                       skip_geometry=frame.geometry[h])
        assert np.array_equal(points, shadow[h]) and 0 < points.sum() < len(points)
    seen = scene.ambient_occlusion(frame, 16)
    parts = sum(scene.ambient_occlusion(frame, 4, first=k) for k in (0, 4, 8, 12)) / 4
    assert np.array_equal(seen, parts) and 0 <= seen.min() < 0.9 and (seen[~h] == 1).all()
    apart = scene.trace_camera(camera, 90, 70, ("t", "primitive", "geometry", "normal"), out=wide_out())
    assert np.array_equal(scene.ambient_occlusion(apart, 16), seen)
    assert np.array_equal(scene.occluded_frame(apart, lights), shadows)


def wide_out():
    """Rows apart, so that C sees a row stride."""
    kinds = (("t", "f4", ()), ("primitive", "u4", ()), ("geometry", "u4", ()), ("normal", "f4", (3,)))
    return {name: np.zeros((70, 97) + more, kind)[:, :90] for name, kind, more in kinds}


def test_rows_of_frames(scene):
    camera, fields = cgt.Camera((0, 0, 4), fov=40), ("t", "primitive", "geometry", "normal", "position")
    whole = scene.trace_camera(camera, 90, 70, fields)
    light = cgt.Light((1, 3, 2))
    part = scene.trace_camera(camera, 90, 70, fields, rows=(20, 30))
    own = {"t": np.full((70, 90), -1, "f4")}
    scene.trace_camera(camera, 90, 70, "t", out=own, rows=(20, 30))
    inside = (np.arange(70) >= 20) & (np.arange(70) < 50)
    for name in fields:
        assert part[name][inside].tobytes() == whole[name][inside].tobytes()
    assert not part.hit[~inside].any() and np.isinf(part.t[~inside]).all() and not part.normal[~inside].any()
    assert np.array_equal(own["t"][inside], whole.t[inside]) and (own["t"][~inside] == -1).all()
    for call in (lambda f: scene.occluded_frame(f, light)[0], lambda f: scene.ambient_occlusion(f, 4)):
        assert np.array_equal(call(part)[inside], call(whole)[inside])
    assert not scene.occluded_frame(part, light)[0][~inside].any()
    assert (scene.ambient_occlusion(part, 4)[~inside] == 1).all()


def test_frames_keep_their_camera(scene):
    camera = cgt.Camera((0, 0, 4), fov=40)
    frame = scene.trace_camera(camera, 90, 70, ("t", "primitive", "geometry", "normal"))
    light = cgt.Light((1, 3, 2))
    before = scene.occluded_frame(frame, light)
    camera.eye = (4, 0, 0)
    assert camera.eye.tolist() == [4, 0, 0] and frame.camera.eye.tolist() == [0, 0, 4]
    assert np.array_equal(scene.occluded_frame(frame, light), before)
    with pytest.raises(cgt.InvalidArgument, match="up: .* three numbers"):
        camera.up = 1


def test_tiles_go_to_visitors(scene):
    camera = cgt.Camera((0, 0, 4), fov=40)
    expected = scene.trace_camera(camera, 200, 130, ("t", "normal"))
    t, normal, lock, calls = np.zeros((130, 200), "f4"), np.zeros((130, 200, 3), "f4"), threading.Lock(), []

    def visit(tile):
        place = np.s_[tile.y:tile.y + tile.height, tile.x:tile.x + tile.width]
        t[place], normal[place] = tile.t, tile.normal
        with lock:
            calls.append((tile.x, tile.y))

    scene.trace_camera(camera, 200, 130, (), visitor=visit, visitor_fields=("t", "normal"))
    assert len(set(calls)) == len(calls) > 4
    assert np.array_equal(t, expected.t) and np.array_equal(normal, expected.normal)
    with pytest.raises(cgt.Stopped):
        scene.trace_camera(camera, 200, 130, (), visitor=lambda tile: True, visitor_fields=("t",))
    with pytest.raises(ZeroDivisionError):
        scene.trace_camera(camera, 200, 130, (), visitor=lambda tile: 1 / 0, visitor_fields=("t",))


def test_commits_read_the_arrays_anew(cloud):
    x = np.zeros((2, 3))
    with cgt.Scene() as s:
        s.add(cgt.Spheres(x, 0.5))
        for step in range(4):
            x[:, 0] = step
            s.commit()
            assert s.trace_ray((step, 0, 5), (0, 0, -1)).t == 4.5
            assert s.statistics.bounds_min[0] == pytest.approx(step - 0.5)
    with pytest.raises(cgt.InvalidArgument, match="closed"):
        s.commit()


def test_arrays_live_as_long_as_they_are_read():
    x = np.array([[0, 0, 0]], "f4")
    alive = weakref.ref(x)
    s = cgt.Scene()
    id = s.add(cgt.Spheres(x, 1.0))
    del x
    s.commit()
    gc.collect()
    assert alive() is not None and s.statistics.copied_bytes == 0
    s.update(id, cgt.Spheres(np.zeros((1, 3)), 1.0))
    s.commit()
    assert s.statistics.copied_bytes >= 16
    gc.collect()
    assert alive() is None
    context = cgt.Context(threads=1)
    s = cgt.Scene(context)
    context.close()
    s.close()


def test_geometries(cloud):
    centers, radii = cloud
    record = np.zeros(N, [("x", "f8", 3), ("type", "u2"), ("m", "f8")])
    record["x"], record["type"] = centers, np.arange(N) % 3
    of_types = np.array([0.1, 0.02, 0.05])
    s = cgt.Scene()
    a = s.add(cgt.Spheres(record["x"], of_types, types=record["type"]))
    s.commit()
    typed = s.trace_camera(cgt.Camera((0, 0, 4)), 64, 64, ("t",)).t
    s.update(a, cgt.Spheres(centers.astype("f4"), of_types.astype("f4")[record["type"]]))
    with pytest.raises(cgt.NotCommitted):
        s.trace_ray((0, 0, 0), (0, 0, 1))
    s.commit()
    assert np.array_equal(s.trace_camera(cgt.Camera((0, 0, 4)), 64, 64, ("t",)).t, typed)
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], "f4") + np.float32(100)
    for dtype in ("u4", "i4", "u2"):
        faces = np.array([[0, 1, 2], [0, 2, 3]], dtype)
        b = s.add(cgt.Triangles(corners, faces, origin=(0, 0, 100), mask=2))
        s.commit()
        assert s.trace_ray((100.5, 100.2, 5), (0, 0, -1)).t == 5 and b == 1
        assert not s.trace_rays([[100.5, 100.2, 5]], (0, 0, -1), mask=1).hit.any()
        s.remove(b)
    s.add(cgt.Triangles(corners[[0, 1, 2]]))
    s.commit()
    assert s.statistics.triangles == 1 and len(s.geometries) == 2


def test_capsules():
    ends = np.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "f8")
    bonds = np.array([[0, 1], [1, 2]], "u2")
    record = np.zeros(2, [("p", "f8", 3), ("q", "f8", 3)])
    record["p"], record["q"] = ends[bonds[:, 0]], ends[bonds[:, 1]]
    forms = [
        cgt.Capsules(ends, 0.5, bonds),
        cgt.Capsules(ends.astype("f4"), np.array([0.5, 0.5], "f4"), bonds.astype("i4")),
        cgt.Capsules(ends[bonds].reshape(-1, 3), np.array([0.5, 0.9]), types=np.zeros(2, "u1")),
        cgt.Capsules(record["p"], 0.5, ends=record["q"]),
    ]
    for capsules in forms:
        s = cgt.Scene()
        id = s.add(capsules)
        s.commit()
        hits = s.trace_rays([[1, 0, 5], [4, 3, 5], [-0.25, 0, 5], [2, 2, 5]], (0, 0, -1), ("t", "primitive", "uv"))
        assert len(capsules) == 2 and hits.primitive.tolist() == [0, 1, 0, cgt.INVALID_ID]
        assert hits.t[:2].tolist() == [4.5, 4.5] and hits.u[:3].tolist() == [0.25, 0.75, 0]
        s.update(id, forms[0])
    for make, message in (
        (lambda: cgt.Capsules(ends[:3], 0.5), "vertices: 3 of them without indices: .* multiple of 2"),
        (lambda: cgt.Capsules(ends, 0.5, bonds, ends=ends), "ends: with indices"),
        (lambda: cgt.Capsules(ends, 0.5, ends=ends[:2]), r"ends: shape \(2, 3\)"),
        (lambda: cgt.Capsules(ends, np.ones(3), bonds), "radius: 3 for 2 capsules"),
    ):
        with pytest.raises(cgt.InvalidArgument, match=message):
            make()


@pytest.mark.parametrize("make, message", [
    (lambda: cgt.Spheres(np.zeros((4, 2))), r"centers: shape \(4, 2\): must be \(n, 3\)"),
    (lambda: cgt.Spheres(np.zeros((4, 3), int)), "centers: dtype int64: must be float64 or float32 or float16"),
    (lambda: cgt.Spheres(np.zeros((3, 4)).T), r"centers: strides .*ascontiguousarray"),
    (lambda: cgt.Spheres(np.zeros((4, 3))[::-1]), "centers: strides .* overlap"),
    (lambda: cgt.Spheres(np.zeros((4, 3), ">f8")), "centers: dtype >f8"),
    (lambda: cgt.Spheres(np.zeros((4, 3)), np.ones(3)), "radius: 3 for 4 centers"),
    (lambda: cgt.Spheres(np.zeros((4, 3)), np.ones((4, 1))), r"radius: shape \(4, 1\)"),
    (lambda: cgt.Spheres(np.zeros((4, 3)), np.ones(2), types=np.zeros(4, "i2")), "types: dtype int16"),
    (lambda: cgt.Spheres(np.zeros((4, 3)), origin=(0, 1)), "origin: .* three numbers"),
    (lambda: cgt.Triangles(np.zeros((4, 3))), "vertices: 4 of them without indices"),
    (lambda: cgt.Triangles(np.zeros((4, 3)), np.zeros((1, 3), "f4")), r"indices: dtype float32.*astype\('uint32'\)"),
    (lambda: cgt.Spheres(np.ma.array(np.zeros((4, 3)))), "centers: a masked array"),
    (lambda: cgt.Spheres([[0, 0], [1, 2, 3]]), "centers: "),
    (lambda: cgt.Spheres(np.zeros((4, 3)), "a"), "radius: 'a': must be a number"),
    (lambda: cgt.Spheres(np.zeros((4, 3)), mask=-1), "mask: -1: must be from 0 to 4294967295"),
    (lambda: cgt.Camera("abc"), "eye: 'abc': must be three numbers"),
    (lambda: cgt.Camera(np.zeros((3, 3))), "must be three numbers"),
    (lambda: cgt.Context(threads=-1), "threads: -1: must be from 0"),
    (lambda: cgt.Camera(projection="fisheye"), "projection: 'fisheye': one of orthographic, perspective"),
    (lambda: cgt.Light((0, 0)), "position: .* three numbers"),
    (lambda: cgt.Scene(structure="octree"), "structure: 'octree': one of auto, bih, bvh"),
    (lambda: cgt.Context(variant="mmx"), "mmx"),
])
def test_bad_descriptions_are_named(make, message):
    with pytest.raises((cgt.InvalidArgument, cgt.Unsupported), match=message):
        make()


def test_bad_calls_are_named(scene, rays):
    with pytest.raises(cgt.InvalidArgument, match="fields: 'depth': one of t, primitive"):
        scene.trace_rays(*rays, ("depth",))
    with pytest.raises(cgt.InvalidArgument, match=r"org: shape \(1000, 2\)"):
        scene.trace_rays(rays[0][:, :2], rays[1])
    with pytest.raises(cgt.InvalidArgument, match=r"dir: shape \(999, 3\)"):
        scene.trace_rays(rays[0], rays[1][1:])
    with pytest.raises(cgt.InvalidArgument, match=r"t_max: shape \(3,\)"):
        scene.trace_rays(*rays, t_max=[1, 2, 3])
    with pytest.raises(cgt.InvalidArgument, match="up"):
        scene.trace_camera(cgt.Camera((0, 0, 0), (0, 0, 1), (0, 0, 1)), 8, 8)
    with pytest.raises(cgt.InvalidArgument, match="8 x 0 pixels"):
        scene.trace_camera(cgt.Camera(), 8, 0)
    with pytest.raises(cgt.TooLarge, match="65,536"):
        scene.trace_camera(cgt.Camera(), 65537, 1)
    with pytest.raises(ValueError, match="precision: 'half': one of exact, fast"):
        scene.trace_rays(*rays, precision="half")
    with pytest.raises(AttributeError, match="normal: not among the fields"):
        scene.trace_rays(*rays).normal
    with pytest.raises(cgt.NotCommitted):
        cgt.Scene().trace_ray((0, 0, 0), (0, 0, 1))
    camera = cgt.Camera((0, 0, 4))
    for call, message in (
        (lambda: scene.trace_camera(None, 8, 8), "camera: NoneType: must be cgt.Camera"),
        (lambda: scene.trace_camera(camera, 8.5, 8), "width: 8.5: must be a whole number"),
        (lambda: scene.trace_camera(camera, 8, -8), "height: -8: must be from 0"),
        (lambda: scene.trace_camera(camera, 8, 8, rows=3), "rows: 3: must be two values"),
        (lambda: scene.trace_camera(camera, 8, 8, rows=(9, 1)), "1 rows from row 9"),
        (lambda: scene.occluded_frame(scene.trace_camera(camera, 8, 8), [(1, 1, 1)]), "lights: tuple"),
        (lambda: scene.occluded_frame(None, cgt.Light((1, 1, 1))), "frame: NoneType: must be cgt.Frame"),
        (lambda: scene.ambient_occlusion(scene.trace_camera(camera, 8, 8), -1), "samples: -1: must be from 0"),
        (lambda: scene.trace_hit_rows(*rays, -1), "capacity: -1: must be from 0"),
        (lambda: scene.trace_ray((0, 0, 5), (0, 0, -1), skip=3), "skip: 3: must be two values"),
    ):
        with pytest.raises(cgt.InvalidArgument, match=message):
            call()
    for bad in ([0] * 1000, np.zeros(1000, "f4"), np.zeros(999, bool), np.zeros(2000, bool)[::2]):
        with pytest.raises(cgt.InvalidArgument, match="out: "):
            scene.occluded_rays(*rays, out=bad)
    s = cgt.Scene()
    s.add(cgt.Triangles(np.zeros((3, 3)), np.array([[0, 1, 7]], "u2")))
    with pytest.raises(cgt.InvalidArgument, match="7"):
        s.commit()


def test_warnings_are_logged(caplog):
    with caplog.at_level(logging.INFO, "cgt"), cgt.Scene(cgt.Context(log=True)) as s:
        s.add(cgt.Spheres(np.zeros((100, 3))))
        s.commit()
    levels = {r.levelname: r.message for r in caplog.records}
    assert "100 spheres of radius 0" in levels["WARNING"] and "commit" in levels["INFO"]


def test_threads_trace_at_once(scene, rays):
    expected, found = scene.trace_rays(*rays).t, []

    def work():
        for _ in range(5):
            found.append(np.array_equal(scene.trace_rays(*rays).t, expected))

    workers = [threading.Thread(target=work) for _ in range(4)]
    for w in workers:
        w.start()
    for w in workers:
        w.join()
    assert found == [True] * 20


def test_python_runs_while_c_traces(scene):
    """Only a call that has released the lock can be seen from another thread before it ends."""
    inside, seen = threading.Event(), threading.Event()

    def visit(_tile):
        inside.set()
        return not seen.wait(60)

    def watch():
        inside.wait(60)
        seen.set()

    watcher = threading.Thread(target=watch)
    watcher.start()
    scene.trace_camera(cgt.Camera(), 64, 64, (), visitor=visit, visitor_fields=("t",))
    watcher.join()


def test_all_hits():
    s = cgt.Scene()
    s.add(cgt.Spheres(np.arange(100)[:, None] * np.array([0, 0, -3.0]), 1.0))
    s.commit()
    rows = s.trace_hit_rows([[0, 0, 5], [9, 9, 9]], (0, 0, -1), 3, ("t", "primitive", "surface"))
    assert rows.count.tolist() == [3, 0] and rows.more.tolist() == [True, False]
    assert rows.t[0].tolist() == [4, 6, 7] and rows.surface[0].tolist() == [0, 1, 0]
    further = s.trace_hit_rows([[0, 0, 5]], (0, 0, -1), 2, after={"primitive": [1], "surface": [0]})
    assert further.t[0].tolist() == [9, 10]
    every = s.trace_all_rays([[9, 9, 9], [0, 0, 5], [0.5, 0, -400]], [[0, 0, -1], [0, 0, -1], [0, 0, 1]],
                             ("t", "primitive", "normal"))
    assert every.ray.tolist() == [1] * 200 + [2] * 200
    assert (np.diff(every.t[:200]) > 0).all() and every.primitive[:4].tolist() == [0, 0, 1, 1]
    assert every.normal[:2].tolist() == [[0, 0, 1], [0, 0, -1]]
    none = s.trace_all_rays(np.zeros((0, 3)), np.zeros((0, 3)))
    assert none.ray.shape == none.t.shape == (0,)


def test_crossings():
    """A ray along the diagonal of two faces of a cube, and through its corners: hits there are many, crossings two."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], "f4")
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
                      [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]], "u4")
    s = cgt.Scene()
    s.add(cgt.Triangles(corners, faces))
    s.commit()
    org, dir = [[0, 0, 5], [2, 2, 2], [-0.5, -0.5, 5]], [[0, 0, -1], [-1, -1, -1], [0, 0, -1.0]]
    every = s.trace_all_rays(org, dir)
    assert np.bincount(every.ray).min() > 2
    found = s.trace_all_rays(org, dir, ("t", "surface"), crossings=True)
    assert found.ray.tolist() == [0, 0, 1, 1, 2, 2] and found.surface.tolist() == [0, 1] * 3
    rows = s.trace_hit_rows(org, dir, 1, ("t", "primitive", "geometry", "surface"), crossings=True)
    assert rows.surface[:, 0].tolist() == [0, 0, 0] and rows.more.all()
    after = {name: rows[name][:, 0] for name in ("primitive", "geometry", "surface")}
    assert s.trace_hit_rows(org, dir, 2, ("surface",), after=after, crossings=True).count.tolist() == [1, 1, 1]
    grid = np.zeros((2, 3, 3)) + org[0]
    for call in (lambda: s.trace_hit_rows(grid, dir[0], 1), lambda: s.trace_hit_rows(org[0], grid, 1),
                 lambda: s.trace_all_rays(grid, dir[0]), lambda: s.trace_all_rays(org[0], grid)):
        with pytest.raises(cgt.InvalidArgument, match=r"shape \(2, 3, 3\): must be \(n, 3\)"):
            call()
    with pytest.raises(cgt.InvalidArgument, match="after: it lacks 'primitive'"):
        s.trace_hit_rows(org, dir, 1, after={"surface": [0, 0, 0]})


def test_frames_of_memory_that_cannot_be_written(scene):
    frame = scene.trace_camera(cgt.Camera((0, 0, 4)), 40, 30, ("t", "primitive", "geometry", "normal"))
    buffers = []
    pickled = pickle.dumps(frame, protocol=5, buffer_callback=buffers.append)
    others = [pickle.loads(pickled, buffers=[bytes(b.raw()) for b in buffers])]
    whole = {name: np.zeros((30, 50) + a.shape[2:], a.dtype) for name, a in frame.arrays.items()}
    apart = scene.trace_camera(cgt.Camera((0, 0, 4)), 40, 30, list(whole), out={k: a[:, :40] for k, a in whole.items()})
    apart.t.flags.writeable = frame.normal.flags.writeable = False
    others += [copy.copy(frame), copy.deepcopy(frame), copy.copy(apart)]
    light = cgt.Light((2, 3, 4))
    for other in others:
        assert all(np.array_equal(other[name], a) for name, a in frame.arrays.items()) and set(other) == set(frame)
        assert np.array_equal(scene.occluded_frame(other, light), scene.occluded_frame(frame, light))
        other.t[:] = 0  # of its own


def test_shadows_of_a_padded_frame_go_to_plain_arrays(scene):
    camera, lights = cgt.Camera((0, 0, 4)), [cgt.Light((2, 3, 4)), cgt.Light((0, 1, 0), "directional")]
    wide = {"t": np.zeros((30, 50), "f4")}
    for rows in ((0, 0), (10, 5)):
        frame = scene.trace_camera(camera, 40, 30, "t", rows=rows)
        apart = scene.trace_camera(camera, 40, 30, "t", rows=rows, out={"t": wide["t"][:, :40]})
        wanted = scene.occluded_frame(frame, lights)
        for dtype in (np.uint8, bool):
            out = np.ones((2, 30, 40), dtype)
            found = scene.occluded_frame(apart, lights, out=out)
            inside = slice(10, 15) if rows[1] else slice(None)
            assert np.array_equal(found[:, inside], wanted[:, inside]) and np.shares_memory(found, out)
            assert found.sum() == wanted[:, inside].sum() + (2 * 25 * 40 if rows[1] else 0)
        with pytest.raises(cgt.InvalidArgument, match=r"out: .* shape \(2, 30, 40\)"):
            scene.occluded_frame(apart, lights, out=np.zeros((2, 30, 50), bool))


def test_halves_of_bonds():
    x = np.array([[0.5, 1, 1], [9.5, 1, 1], [4, 4, 4], [4, 9.9, 0.2]])
    pairs = [[0, 1], [1, 2], [2, 3]]
    plain, atoms = cgt.half_bonds(x, pairs)
    assert atoms.tolist() == [0, 1, 2, 1, 2, 3] and np.array_equal(plain[0::2], x[atoms])
    middle = plain[1::2]
    assert np.array_equal(middle[:3], middle[3:]) and middle[0].tolist() == [5, 1, 1]
    box = np.diag([10.0, 10, 10])
    near, _ = cgt.half_bonds(x, pairs, box)
    assert near[1].tolist() == [0, 1, 1] and near[7].tolist() == [10, 1, 1]
    length = np.linalg.norm(near[1::2] - near[0::2], axis=1)
    assert length.max() <= np.sqrt(3) * 5 / 2 and np.allclose(length[:3], length[3:])
    wall, _ = cgt.half_bonds(x, pairs, box, (0, 1, 1))
    assert np.array_equal(wall[1], plain[1]) and not np.array_equal(wall[5], plain[5])
    tilted = np.array([[10, 0, 0], [3, 10, 0], [0, 0, 10.0]])
    # the step is (7.2, -9) - (10, 0) + (3, 10)
    leans, _ = cgt.half_bonds([[1, 9.5, 1], [8.2, 0.5, 1]], [[0, 1]], tilted)
    assert np.allclose(leans[1] - leans[0], (0.1, 0.5, 0))
    half = cgt.half_bonds([[0, 0, 0], [5, 0, 0]], [[0, 1]], box)[0]
    assert half[1].tolist() == [2.5, 0, 0]  # half of an edge is no crossing
    assert cgt.half_bonds(x, np.zeros((0, 2), int), box)[0].shape == (0, 3)
    for bad, edges, message in (([[0, 4]], None, "bonds: 0 to 4, of 4 positions"), ([[0, -1]], None, "bonds: -1 to 0"),
                                ([0, 1, 2], None, r"bonds: shape \(3,\): must be \(m, 2\)"),
                                ([[0.5, 1]], None, "bonds: dtype float64: must be"),
                                (pairs, np.zeros((3, 3)), "edges: .* the periodic edges"),
                                (pairs, np.full((3, 3), np.nan), "edges: .* the periodic edges")):
        with pytest.raises(cgt.InvalidArgument, match=message):
            cgt.half_bonds(x, bad, edges)
    for periodic in ("yes", None, (1.5, 1, 1), (1, 1)):
        with pytest.raises(cgt.InvalidArgument, match="periodic: .*: must be True, False, or three"):
            cgt.half_bonds(x, pairs, box, periodic)


def test_bonds_go_to_the_nearest_image_however_a_box_leans():
    slim = np.array([[4.2857, 0, 0], [-4.0, 1.54, 0], [0, 0, 10.0]])  # and one that is far from reduced
    far = cgt.half_bonds([[1, 1, 1], [1, 2.5, 1]], [[0, 1]], [[10, 0, 0], [40, 10, 0], [0, 0, 10]])[0]
    assert far[1].tolist() == [1, 1.75, 1]
    a, c = 10.473, np.cos(np.radians(24.16))  # Bi2Te3's primitive cell
    y = (c - c * c) / np.sqrt(1 - c * c)
    rhombus = a * np.array([[1, 0, 0], [c, np.sqrt(1 - c * c), 0], [c, y, np.sqrt(1 - c * c - y * y)]])
    x = np.array([[0.4, 0.4, 0.4], [0.7905, 0.7905, -0.2095]]) @ rhombus
    near = cgt.half_bonds(x, [[0, 1]], rhombus)[0]
    assert abs(2 * np.linalg.norm(near[1] - near[0]) - 3.073) < 1e-3
    r = np.random.default_rng(4)
    x, pairs = r.uniform(-20, 20, (40, 3)), r.integers(0, 40, (60, 2))
    times = np.stack(np.meshgrid(*[np.arange(-6, 7)] * 3), axis=-1).reshape(-1, 3)
    for box in (rhombus, slim, *r.normal(0, 3, (20, 3, 3))):
        for periodic in ((1, 1, 1), (1, 0, 1), (0, 1, 0), (0, 0, 0)):
            edges = box[np.array(periodic, bool)]
            near = cgt.half_bonds(x, pairs, box, periodic)[0][:120]
            found = 2 * (near[1::2] - near[0::2])
            whole = (found - x[pairs[:, 1]] + x[pairs[:, 0]]) @ np.linalg.pinv(edges)
            assert np.allclose(whole, np.rint(whole))  # an image
            images = found[:, None] + times[:, np.array(periodic, bool)] @ edges
            assert (np.linalg.norm(found, axis=1) < np.linalg.norm(images, axis=2).min(axis=1) + 1e-4).all()


def test_points_inside(cloud, scene):
    r = np.random.default_rng(3)
    p = r.uniform(-1, 1, (20, 50, 3)).astype("f4")
    distance = np.linalg.norm(p[..., None, :].astype("f8") - cloud[0].astype("f4"), axis=-1)
    inside = (distance < cloud[1]).any(axis=-1)
    assert np.array_equal(scene.points_inside(p), inside) and 10 < inside.sum() < 990


def test_mirrors_and_glass():
    s = cgt.Scene()
    s.add(cgt.Spheres(np.zeros((1, 3)), 1.0))
    s.add(cgt.Triangles([[-9.0, -9, -3], [9, -9, -3], [0, 9, -3]]))
    s.commit()
    org, dir = np.array([[0.5, 0, 5], [8, 8, 5.0]]), np.array([[0, 0, -1.0]] * 2)
    hits = s.trace_rays(org, dir, ("t", "primitive", "geometry"))
    with pytest.raises(cgt.InvalidArgument, match="^surfaces: 'foo'"):
        s.bounce_rays(org, dir, hits, surfaces=("foo",))
    reflected, refracted, surface = s.bounce_rays(org, dir, hits, inside=1.5, surfaces=("position", "normal", "front"))
    height = np.sqrt(0.75)
    assert np.allclose(surface.position[0], (0.5, 0, height)) and surface.front.tolist() == [1, 0]
    assert np.allclose(reflected.dir[0], (2 * height * 0.5, 0, 2 * height * height - 1))
    sine = 0.5 / 1.5
    turn = np.arcsin(0.5) - np.arcsin(sine)
    assert np.allclose(refracted.dir[0], (-np.sin(turn), 0, -np.cos(turn)), atol=1e-6)
    assert np.isclose(reflected.share[0] + refracted.share[0], 1) and reflected.share[1] == 0
    out = s.trace_bounced_rays(refracted)
    assert np.isclose(out.t[0], 2 * np.cos(np.arcsin(sine))) and out.geometry[0] == 0 and not out.hit[1]
    mirrors = s.bounce_rays(org, dir, hits)[0]
    assert mirrors.share.tolist() == [1, 0]


def test_versions_are_compared(monkeypatch):
    from cgt import _native

    class Other:
        """A library of another version."""

        def __getattr__(self, name):
            return getattr(_native.lib, name)

    Other.cgt_get_version = lambda self: _native.ffi.new("char[]", b"7.8.9")
    with pytest.raises(ImportError, match="7.8.9 was loaded"):
        _native.check_library(Other())
    assert cgt.version() == cgt.__version__ and cgt.Context().variant in cgt.variants()


def test_structures_of_the_papers(cloud, rays, scene):
    import cgt.research as research

    expected = scene.trace_rays(*rays).t
    for structure in ("queue_grid", "kd", "kd_ropes", "bih", "bvh", "loose_grid"):
        s = cgt.Scene(structure=structure)
        s.add(cgt.Spheres(*cloud))
        s.commit()
        assert np.array_equal(s.trace_rays(*rays).t, expected)
        assert s.statistics.structure == getattr(cgt._native.lib, "CGT_STRUCTURE_" + structure.upper())
    options = research.TraceOptions(packet=8, cull="frustum")
    s = cgt.Scene(structure="queue_grid", research=research.SceneOptions(resolution=(8, 8, 8)))
    s.add(cgt.Spheres(*cloud))
    s.commit()
    s.trace_camera(cgt.Camera((0, 0, 4)), 64, 64, research=options)
    assert research.scene_statistics(s).resolution == [8, 8, 8] and options.statistics.packet_size == 8


def raised_at_entry(names, call):
    """What a call raises where Ctrl-C comes before the first line of a callback of these names."""
    def interrupt(frame, event, _argument):
        if event == "call" and frame.f_code.co_name in names and frame.f_code.co_filename.startswith(cgt.__path__[0]):
            sys.settrace(None)
            raise KeyboardInterrupt

    sys.settrace(interrupt)
    try:
        with pytest.raises(KeyboardInterrupt):
            call()
    finally:
        sys.settrace(None)


def test_ctrl_c_reaches_the_caller_from_callbacks(cloud):
    with cgt.Scene(cgt.Context(threads=1, log=True)) as s:
        s.add(cgt.Spheres(*cloud))
        raised_at_entry({"_log"}, s.commit)
        s.commit()
        tiles = []
        raised_at_entry({"call"}, lambda: s.trace_camera(cgt.Camera(), 200, 130, (), visitor=tiles.append))
        assert not tiles and s.trace_camera(cgt.Camera(), 200, 130, (), visitor=tiles.append) and tiles


def test_outputs_are_not_what_is_read(scene, rays):
    org, dir = (a[:8].copy() for a in rays)
    both, bytes_ = np.zeros((8, 4), "f4"), np.zeros(96, "u1")
    both[:, :3], read = org, bytes_.view("f4").reshape(8, 3)
    read[:] = org
    frame = scene.trace_camera(cgt.Camera((0, 0, 4)), 8, 6)
    t_max, light = np.full(8, 9, "f4"), cgt.Light((0, 0, 9))
    for call in (
        lambda: scene.trace_rays(org, dir, ("normal",), out={"normal": org}),
        lambda: scene.trace_rays(org, dir, ("t",), t_max=t_max, out={"t": t_max}),
        lambda: scene.trace_rays(org, dir, ("t",), out={"t": dir.reshape(-1)[:8]}),
        lambda: scene.occluded_rays(read, dir, out=bytes_[:8]),
        lambda: scene.occluded_points(light, read, out=bytes_[8:16]),
        lambda: scene.points_inside(read, out=bytes_[-8:]),
        lambda: scene.occluded_frame(frame, light, out=frame.t.view("u1").reshape(-1)[:48].reshape(1, 6, 8)),
    ):
        with pytest.raises(cgt.InvalidArgument, match="^out.*: it overlaps what the call reads"):
            call()
    scene.trace_rays(both[:, :3], dir, ("t",), out={"t": both[:, 3]})  # beside it
    assert np.array_equal(both[:, 3], scene.trace_rays(org, dir).t)


def test_bounced_rays_have_the_shape_of_the_rays(scene, rays):
    org, dir = (a[:48] for a in rays)
    hits, index = scene.trace_rays(org, dir, ("t", "primitive", "geometry")), np.linspace(1.1, 1.6, 48, dtype="f4")
    flat = scene.bounce_rays(org, dir, hits, inside_of_ray=index, surfaces=("normal", "front"))
    for shape in ((6, 8), (2, 4, 6)):
        org, dir, index = (a.reshape(*shape, *tail) for a, tail in ((org, [3]), (dir, [3]), (index, [])))
        hits = scene.trace_rays(org, dir, ("t", "primitive", "geometry"))
        shaped = scene.bounce_rays(org, dir, hits, inside_of_ray=index, surfaces=("normal", "front"))
        for one, other in zip(flat, shaped):
            for name in one:
                assert other[name].shape == shape + one[name].shape[1:]
                assert np.array_equal(other[name].reshape(one[name].shape), one[name], equal_nan=True)
        assert scene.trace_bounced_rays(shaped[0]).t.shape == shape
