# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Objects that were not made, were made in part, are copied; processes that end, or fork."""
import copy
import gc
import inspect
import os
import pickle
import weakref

import numpy as np
from abuse import DIR, FIELDS, ORG, ball, mesh, python, scene_of, table

import cgt
import cgt.research
import cgt.trimesh

CASES, case = table()
REFUSED = cgt.InvalidArgument
NATIVE = (cgt.Context, cgt.Scene, cgt.Spheres, cgt.Triangles, cgt.Capsules, cgt.Picture, cgt.Trajectory,
          cgt.research.SceneOptions, cgt.research.TraceOptions)
OTHERS = (cgt.Camera, cgt.Light, cgt.Frame, cgt.Hits, cgt.AllHits, cgt.HitRows, cgt.Fields, cgt.SingleHit, cgt.Look,
          cgt.Material, cgt.TrajectoryFrame, cgt.trimesh.RayMeshIntersector)


@case()
def classes_without_init():
    for kind in NATIVE + OTHERS:
        thing = kind.__new__(kind)
        for name in dir(kind) + ["anything"]:
            if name in ("__class__", "__dict__", "__subclasshook__", "__init_subclass__", "__abstractmethods__"):
                continue
            try:
                value = getattr(thing, name)
                if callable(value) and not name.startswith("_"):
                    value()
            except RecursionError:
                raise
            except Exception as error:
                assert str(error), (kind, name)


def used(thing):
    """Gives a thing to all calls that may take one of its kind."""
    scene = scene_of(cgt.Spheres(*ball()))
    calls = [scene.add, lambda t: scene.update(0, t), cgt.Scene, lambda t: cgt.Scene(research=t),
             lambda t: scene.trace_camera(t, 8, 6), lambda t: scene.trace_rays(ORG, DIR, research=t),
             lambda t: scene.occluded_frame(t, []), scene.ambient_occlusion, lambda t: scene.occluded_points(t, ORG),
             lambda t: scene.bounce_rays(ORG, DIR, t), scene.trace_bounced_rays, cgt.find_bodies, cgt.Camera().fit,
             lambda t: cgt.Picture(8, 6).draw(t, cgt.Camera()), lambda t: cgt.Picture(8, 6).draw(scene, t),
             lambda t: cgt.Picture(8, 6).draw(scene, cgt.Camera(), {0: t}), lambda t: cgt.Picture(8, 6, materials=[t]),
             lambda t: cgt.Picture(8, 6, lights=[(t, (1, 1, 1), 0)])]
    for call in calls:
        try:
            call(thing)
        except RecursionError:
            raise
        except Exception as error:
            assert str(error), (thing, call)


@case()
def things_without_init_are_used():
    for kind in NATIVE + OTHERS:
        used(kind.__new__(kind))


@case(REFUSED, "its __init__ has not run")
def a_subclass_forgets_init():
    class Balls(cgt.Spheres):
        """Forgets."""

        def __init__(self):
            pass

    scene_of(Balls())


@case(REFUSED, "has not run its __init__")
def a_scene_forgets_init():
    class World(cgt.Scene):
        """Forgets."""

        def __init__(self):
            pass

    World().commit()


@case(REFUSED, "its __init__ has not run to its end")
def a_subclass_hides_an_error():
    class Balls(cgt.Spheres):
        """Too few radii, which it does not tell."""

        def __init__(self):
            try:
                super().__init__(np.zeros((10**6, 3)), np.zeros(1))
            except cgt.InvalidArgument:
                pass

    scene_of(Balls())


@case(REFUSED, "its __init__ has not run to its end")
def a_geometry_is_made_anew_in_vain():
    balls = cgt.Spheres(np.zeros((5, 3)), 1.0)
    try:
        balls.__init__(np.zeros((10**6, 3)), np.zeros(1))
    except cgt.InvalidArgument:
        scene_of(balls)


@case(AttributeError, "not run to its end")
def a_context_that_failed():
    class Several(cgt.Context):
        """Keeps what failed."""

        def __init__(self):
            try:
                super().__init__(variant="none")
            except cgt.Error:
                pass

    Several().nothing


@case(REFUSED, "has run")
def a_scene_is_made_twice():
    scene_of(cgt.Spheres(*ball())).__init__()


@case(REFUSED, "has run")
def a_picture_is_made_twice():
    cgt.Picture(8, 6).__init__(9, 9)


@case(AttributeError, "context")
def a_scene_gets_another_context():
    scene_of().context = cgt.Context()


WAYS = copy.copy, copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))


@case()
def what_was_not_made_is_not_copied():
    for kind in (*NATIVE, cgt.Frame, cgt.Hits, cgt.Camera, cgt.Look):
        for make in WAYS:
            try:
                make(kind.__new__(kind))
            except TypeError as error:
                assert "make another one" in str(error)
            else:
                raise AssertionError(kind)


@case()
def results_are_copied():
    scene = scene_of(cgt.Spheres(*ball()))
    frame = scene.trace_camera(cgt.Camera((1, 2, 3)), 8, 6, FIELDS, rows=(1, 4))
    hits = scene.trace_rays(ORG, DIR, FIELDS, statistics=True)
    results = [hits, frame, scene.trace_hit_rows(ORG, DIR, 2), scene.trace_all_rays(ORG, DIR), scene.trace_ray(
        (0, 0, 5), (0, 0, -1)), *scene.bounce_rays(ORG, DIR, hits, inside=1.5, surfaces=("normal",))]
    for make in WAYS:
        for result in results:
            other = make(result)
            assert type(other) is type(result) and repr(other) == repr(result)
            for name, a in getattr(result, "arrays", {}).items():
                assert np.array_equal(other[name], a, equal_nan=a.dtype.kind == "f")
        assert make(hits).statistics.rays == len(ORG)
        assert np.array_equal(scene.ambient_occlusion(make(frame), 4), scene.ambient_occlusion(frame, 4))
        assert make(frame).camera.eye.tolist() == [1, 2, 3]


@case()
def descriptions_are_copied():
    x, r = ball()
    things = [cgt.Camera((1, 2, 3), fov=33, projection="orthographic", mask=5), cgt.Light((1, 2, 3), "directional"),
              cgt.Spheres(x, r, origin=(1, 2, 3), mask=7),
              cgt.Spheres(x, r[:1], types=np.zeros(len(x), "u1")),
              cgt.Triangles(*mesh()), cgt.Capsules(x, 0.1, ends=x + 1), cgt.Look(colors=np.full((9, 3), 0.25)),
              cgt.Look("red", lineless_from=3, material=2), cgt.Look(index=[0, 1], palette=["red", "#00ff00"]),
              cgt.Material("glass", index=1.3, absorption=(1, 2, 3)), cgt.Context(2),
              cgt.research.SceneOptions((1, 2, 3)),
              cgt.research.TraceOptions(8, loop="nested")]
    for make in WAYS:
        for thing in things:
            other = make(thing)
            assert type(other) is type(thing) and repr(other) == repr(thing) and "0x" not in repr(thing)
            for name, a in getattr(thing, "arrays", {}).items():
                assert np.array_equal(other.arrays[name], a)
        other = make(things[0])
        other.eye = (4, 5, 6)
        assert things[0].eye.tolist() == [1, 2, 3]
    assert copy.copy(things[2]).centers is x and copy.deepcopy(things[2]).centers is not x


@case()
def scenes_are_copied_as_data():
    x, r = ball()
    scene = cgt.Scene(rays="incoherent")
    for geometry in (cgt.Spheres(x, r), cgt.Spheres(x + 5, r), cgt.Triangles(*mesh())):
        scene.add(geometry)
    scene.remove(1)
    for make in WAYS:
        try:
            make(scene).trace_rays(ORG, DIR)
        except cgt.NotCommitted:
            continue
        raise AssertionError("it was not committed")
    scene.commit()
    expected = scene.trace_rays(ORG, DIR, FIELDS)
    for make in WAYS:
        other = make(scene)
        found = other.trace_rays(ORG, DIR, FIELDS)
        assert list(other.geometries) == [0, 2] and all(np.array_equal(found[n], expected[n]) for n in FIELDS)


@case()
def pictures_are_copied():
    scene = scene_of(cgt.Spheres(*ball()))
    picture = cgt.Picture(64, 48, background="navy", lights=[(cgt.Light((1, 2, 3)), (1, 1, 1), 0)], linear=True)
    picture.draw(scene, cgt.Camera())
    for make in WAYS:
        other = make(picture)
        assert np.array_equal(other.pixels, picture.pixels) and np.array_equal(other.linear, picture.linear)
        other.draw(scene, cgt.Camera((0, 0, 9)))
        assert not np.array_equal(other.pixels, picture.pixels)
        assert np.array_equal(other.draw(scene, cgt.Camera()).pixels, picture.pixels)


@case()
def what_a_user_makes_of_them_is_copied():
    for make in WAYS:
        other = make(Named("ball"))
        assert type(other) is Named and other.name == "ball" and other.radius == 2


class Named(cgt.Spheres):
    """Has a name, and an __init__ of its own."""

    def __init__(self, name):
        super().__init__([[0, 0, 0]], 2)
        self.name = name


@case()
def a_pool_returns_hits():
    python(WORLD + """
import multiprocessing
def work(x):
    return scene.trace_rays([[x, 0, 5]], [0, 0, -1])
with multiprocessing.get_context("fork").Pool(2) as pool:
    hits = pool.map_async(work, [0.0, 9.0]).get(timeout=20)
assert [h.hit.tolist() for h in hits] == [[True], [False]], hits
""")


@case()
def attributes_take_effect_or_raise():
    scene, picture = scene_of(cgt.Spheres(*ball())), cgt.Picture(8, 6)
    things = [scene, picture, cgt.Camera(), cgt.Light((1, 2, 3)), cgt.Look("red"), cgt.Material(), cgt.Spheres(*ball()),
              cgt.Triangles(*mesh()), cgt.Capsules(ball()[0], 0.1), cgt.Context(), scene.trace_rays(ORG, DIR),
              scene.trace_camera(cgt.Camera(), 8, 6), cgt.research.SceneOptions(), cgt.research.TraceOptions()]
    for thing in things:
        names = set(inspect.signature(type(thing).__init__).parameters) | {"position", "anything"} - {"self"}
        for name in names - ({"statistics", "camera"} if isinstance(thing, cgt.Fields) else set()):
            value = getattr(thing, name, 1)
            try:
                setattr(thing, name, value)
            except (AttributeError, TypeError):
                continue
            assert isinstance(thing, cgt.Camera) and name != "position", (thing, name)
    for name, value in (("fov", 20), ("height", 4), ("t_min", 1), ("t_max", 2), ("mask", 3), ("eye", (0, 1, 4)),
                        ("target", (0, 1, 0)), ("up", (1, 0, 0)), ("projection", "orthographic")):
        changed, made = cgt.Camera(), cgt.Camera(**{name: value})
        setattr(changed, name, value)
        assert repr(changed) == repr(made) != repr(cgt.Camera())
        assert all(np.array_equal(a, b) for a, b in zip(cgt.camera_rays(changed, 8, 6), cgt.camera_rays(made, 8, 6)))


@case(ValueError, "read-only")
def a_cameras_eye_is_written():
    cgt.Camera().eye[2] = 9


@case(AttributeError, "change a copy")
def a_frames_camera_is_changed():
    scene_of(cgt.Spheres(*ball())).trace_camera(cgt.Camera(), 8, 6).camera.fov = 9


@case(TypeError, "item assignment")
def geometries_are_assigned():
    scene_of(cgt.Spheres(*ball())).geometries[0] = cgt.Spheres([[0, 0, 0]])


@case()
def a_cycle_of_all_goes():
    class World(cgt.Scene):
        """Has attributes of its own."""

    scene, picture = World(), cgt.Picture(64, 48)
    scene.add(cgt.Spheres(*ball()))
    scene.commit()
    picture.draw(scene, cgt.Camera())
    frame = scene.trace_camera(cgt.Camera(), 8, 6, FIELDS)
    scene.things = [scene, picture, frame, scene.context]
    gone = [weakref.ref(thing) for thing in (scene, picture, frame)]
    del scene, picture, frame
    gc.collect()
    assert not any(ref() for ref in gone)


@case(AttributeError, "fields of this call")
def fields_that_are_not_there():
    scene_of(cgt.Spheres(*ball())).trace_rays(ORG, DIR).normal


# ---- processes ----

WORLD = """
import threading, time, numpy, cgt
scene = cgt.Scene(cgt.Context(threads=2, log=True))
scene.add(cgt.Spheres(numpy.random.default_rng(1).uniform(-1, 1, (2000, 3)).astype('f4'), 0.05))
scene.commit()
camera = cgt.Camera()
picture = cgt.Picture(64, 48, ambient=4)
picture.begin(scene, camera)
"""


@case()
def python_ends_with_live_things():
    python(WORLD + """
class World(cgt.Scene):
    pass
world = World()
world.me = world, scene, picture
""")


@case()
def python_ends_while_a_thread_traces():
    python(WORLD + """
def trace():
    while True:
        scene.trace_camera(camera, 320, 240, visitor=lambda tile: None)
threading.Thread(target=trace, daemon=True).start()
time.sleep(0.1)
""")


@case()
def python_ends_in_a_visitor():
    python(WORLD + """
import os
scene.trace_camera(camera, 320, 240, visitor=lambda tile: os._exit(0))
""")


@case()
def a_fork_traces():
    python(WORLD + """
import os
before = scene.trace_camera(camera, 64, 48)
child = os.fork()
if not child:
    same = numpy.array_equal(before.t, scene.trace_camera(camera, 64, 48).t)
    picture.step(9)
    scene.commit()
    scene.close()
    os._exit(0 if same else 1)
assert os.waitpid(child, 0)[1] == 0
""")


@case()
def a_fork_while_a_thread_traces():
    python(WORLD + """
import os
entered, go_on = threading.Event(), threading.Event()
def visit(tile):
    entered.set()
    go_on.wait(20)
thread = threading.Thread(target=lambda: scene.trace_camera(camera, 64, 48, visitor=visit))
thread.start()
entered.wait(20)
child = os.fork()
if not child:
    told = 0
    for call in (scene.commit, lambda: scene.trace_camera(camera, 8, 6), scene.close):
        try:
            call()
        except cgt.InUse as error:
            told += 'forked' in str(error)
    os._exit(0 if told == 3 else 1)
go_on.set()
thread.join()
assert os.waitpid(child, 0)[1] == 0
scene.commit()
""")


if not hasattr(os, "fork"):
    del CASES["a_fork_traces"], CASES["a_fork_while_a_thread_traces"]
