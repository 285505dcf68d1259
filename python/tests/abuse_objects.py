# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Objects that were not made, were made in part, are copied; processes that end, or fork."""
import copy
import gc
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


@case()
def things_of_c_are_not_copied():
    for thing in (cgt.Context(), scene_of(cgt.Spheres(*ball())), cgt.Spheres(*ball()), cgt.Triangles(*mesh()),
                  cgt.Capsules(ball()[0]), cgt.Picture(8, 6), cgt.research.SceneOptions(), cgt.research.TraceOptions(),
                  scene_of().trace_camera(cgt.Camera(), 8, 6), *(kind.__new__(kind) for kind in NATIVE)):
        for make in (copy.copy, copy.deepcopy, pickle.dumps):
            try:
                make(thing)
            except TypeError as error:
                assert "make another one" in str(error)
            else:
                raise AssertionError(thing)


@case()
def what_is_pythons_is_copied():
    hits = scene_of(cgt.Spheres(*ball())).trace_rays(ORG, DIR, statistics=True)
    camera = cgt.Camera((1, 2, 3), fov=33, projection="orthographic", mask=5)
    for make in (copy.copy, copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))):
        assert np.array_equal(make(hits).t, hits.t) and make(hits).statistics.rays == len(ORG)
        other = make(camera)
        other.eye = (4, 5, 6)
        assert camera.eye.tolist() == [1, 2, 3] and repr(make(camera)) == repr(camera)
        assert make(cgt.Light((1, 2, 3))).position == [1, 2, 3]
        assert make(cgt.Look(colors=[[1, 0, 0]])).colors.shape == (1, 3)


@case()
def a_cycle_of_all_goes():
    scene, picture = scene_of(cgt.Spheres(*ball())), cgt.Picture(64, 48)
    picture.draw(scene, cgt.Camera())
    frame = scene.trace_camera(cgt.Camera(), 8, 6, FIELDS)
    scene.things = picture.things = frame.things = [scene, picture, frame, scene.context]
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
    python(WORLD + "scene.me = scene; picture.me = scene")


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
