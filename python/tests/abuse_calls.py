# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Calls within calls, calls of several threads, calls after the end."""
import logging
import os
import tempfile
import threading
import warnings

import numpy as np
from abuse import DIR, FIELDS, ORG, ball, mesh, scene_of, table, trace_all

import cgt
import cgt.research

CASES, case = table()
REFUSED = cgt.InvalidArgument
CAMERA = cgt.Camera()


def visited(act, scene=None, fields=("t", "normal")):
    """Traces a scene whose visitor acts on it, once; then the scene has to be as before."""
    scene = scene or scene_of(cgt.Spheres(*ball()))
    before = scene.trace_camera(CAMERA, 200, 150)
    try:
        return scene.trace_camera(CAMERA, 200, 150, visitor=lambda tile: act(scene), visitor_fields=fields)
    finally:
        assert np.array_equal(before.t, scene.trace_camera(CAMERA, 200, 150).t)


@case(cgt.InUse, "a call is using it")
def a_visitor_closes_the_scene():
    visited(lambda scene: scene.close())


@case(cgt.InUse, "a call is using it")
def a_visitor_commits():
    visited(lambda scene: scene.commit())


@case(cgt.InUse, "a call is using it")
def a_visitor_adds():
    visited(lambda scene: scene.add(cgt.Spheres([[0, 0, 0]])))


@case(cgt.InUse, "a call is using it")
def a_visitor_updates():
    visited(lambda scene: scene.update(0, cgt.Spheres([[0, 0, 0]])))


@case(cgt.InUse, "a call is using it")
def a_visitor_removes():
    visited(lambda scene: scene.remove(0))


@case(cgt.InUse, "a call is using it")
def a_visitor_sets_options():
    visited(lambda scene: scene.set_options(structure="bvh"))


@case(cgt.InUse, "a call is using it")
def a_visitor_leaves_the_scene():
    def leave(scene):
        with scene:
            pass

    visited(leave)


@case(REFUSED, "__init__ has run")
def a_visitor_makes_the_scene_anew():
    visited(lambda scene: scene.__init__())


@case()
def a_visitor_closes_the_context():
    def act(scene):
        scene.context.close()

    visited(act)


@case()
def a_visitor_traces():
    visited(trace_all)


@case()
def a_visitor_draws():
    visited(lambda scene: cgt.Picture(32, 24).draw(scene, CAMERA) and None)


@case(RecursionError, "deep")
def a_visitor_calls_itself():
    def again(scene):
        scene.trace_camera(CAMERA, 100, 80, visitor=lambda tile: again(scene))

    visited(again)


@case(ZeroDivisionError, "")
def a_visitor_raises():
    visited(lambda scene: 1 / 0)


@case(SystemExit, "")
def a_visitor_leaves_python():
    visited(lambda scene: exit())


@case(cgt.Stopped, "")
def a_visitor_stops():
    visited(lambda scene: True)


@case(REFUSED, "visitor: int")
def a_visitor_is_a_number():
    scene_of().trace_camera(CAMERA, 8, 6, visitor=5)


@case(TypeError, "argument")
def a_visitor_takes_nothing():
    scene_of().trace_camera(CAMERA, 8, 6, visitor=lambda: None)


@case(REFUSED, "visitor_fields")
def a_visitor_wants_what_is_not_there():
    scene_of().trace_camera(CAMERA, 8, 6, visitor=print, visitor_fields=("color",))


@case()
def tiles_are_kept():
    tiles = []
    scene = scene_of(cgt.Spheres(*ball()))
    frame = scene.trace_camera(CAMERA, 200, 150, visitor=tiles.append, visitor_fields=FIELDS)
    scene.close()
    scene.context.close()
    del scene
    for tile in tiles:
        part = frame.t[tile.y:tile.y + tile.height, tile.x:tile.x + tile.width]
        assert np.array_equal(tile.t, part)


@case(ValueError, "cannot resize")
def a_visitor_resizes_what_is_filled():
    t = np.zeros((150, 200), "f4")
    scene = scene_of(cgt.Spheres(*ball()))
    scene.trace_camera(CAMERA, 200, 150, ("t",), out={"t": t}, visitor=lambda tile: t.resize((1, 1), refcheck=False))


# ---- loggers ----


def logged(act):
    """Commits a scene whose log's handler acts on it."""
    scene = cgt.Scene(cgt.Context(log=True))
    found = []

    class Handler(logging.Handler):
        """Acts, and keeps what comes of it."""

        def emit(self, record):
            try:
                found.append(act(scene))
            except Exception as error:
                found.append(error)

    logger, handler = logging.getLogger("cgt"), Handler()
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    try:
        scene.add(cgt.Spheres(*ball()))
        scene.commit()
    finally:
        logger.removeHandler(handler)
    assert found
    for error in found:
        if isinstance(error, Exception):
            raise error


@case(cgt.InUse, "another call is changing it")
def a_log_commits():
    logged(lambda scene: scene.commit())


@case(cgt.InUse, "another call is changing it")
def a_log_closes():
    logged(lambda scene: scene.close())


@case(cgt.InUse, "another call is changing it")
def a_log_traces():
    logged(lambda scene: scene.trace_rays(ORG, DIR))


@case()
def a_log_asks():
    logged(lambda scene: scene.statistics)


# ---- threads ----


def during_a_trace(act):
    """Acts while another thread is inside a call."""
    scene = scene_of(cgt.Spheres(*ball()), context=cgt.Context(threads=1))
    entered, go_on = threading.Event(), threading.Event()

    def visit(_tile):
        entered.set()
        go_on.wait(20)

    thread = threading.Thread(target=lambda: scene.trace_camera(CAMERA, 64, 48, visitor=visit))
    thread.start()
    try:
        assert entered.wait(20)
        return act(scene)
    finally:
        go_on.set()
        thread.join()
        scene.commit()
        scene.close()


@case(cgt.InUse, "a call is using it")
def another_thread_closes():
    during_a_trace(lambda scene: scene.close())


@case(cgt.InUse, "a call is using it")
def another_thread_commits():
    during_a_trace(lambda scene: scene.commit())


@case(cgt.InUse, "a call is using it")
def another_thread_adds():
    during_a_trace(lambda scene: scene.add(cgt.Spheres([[0, 0, 0]])))


@case()
def another_thread_asks_and_traces():
    during_a_trace(lambda scene: (scene.statistics, scene.trace_rays(ORG, DIR)))


@case()
def another_thread_ends_the_context():
    def act(scene):
        scene.context.close()
        trace_all(scene)

    during_a_trace(act)


def at_once(*acts, seconds=0.15):
    """Runs each act again and again in a thread of its own; `InUse` and other errors of the library may come of it."""
    ended, wrong = threading.Event(), []

    def run(act):
        while not ended.is_set():
            try:
                act()
            except cgt.Error:
                pass
            except Exception as error:
                wrong.append(error)
                return

    threads = [threading.Thread(target=run, args=(act,)) for act in acts]
    for thread in threads:
        thread.start()
    ended.wait(seconds)
    ended.set()
    for thread in threads:
        thread.join()
    if wrong:
        raise wrong[0]


@case()
def threads_commit_trace_and_change():
    x, r = ball()
    scene = scene_of(cgt.Spheres(x, r))

    def add_and_remove():
        scene.remove(scene.add(cgt.Triangles(*mesh())))

    at_once(scene.commit, lambda: trace_all(scene), add_and_remove, lambda: scene.statistics,
            lambda: scene.update(0, cgt.Spheres(x[:9], 0.1)), lambda: cgt.research.scene_statistics(scene))


@case()
def threads_close():
    for _ in range(8):
        scene = scene_of(cgt.Spheres(*ball()))
        at_once(scene.close, lambda scene=scene: scene.trace_rays(ORG, DIR), scene.commit, seconds=0.01)


@case()
def threads_draw_one_picture():
    scene, picture = scene_of(cgt.Spheres(*ball())), cgt.Picture(64, 48, ambient=16)
    picture.draw(scene, CAMERA)
    at_once(lambda: picture.begin(scene, CAMERA), lambda: picture.step(1), picture.read, lambda: picture.hits,
            scene.commit)


@case()
def threads_read_one_file():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "many.xyz")
        with open(path, "w", encoding="utf-8") as file:
            file.write("3\n\nO 0 0 0\nH 0 0 1\nH 0 1 0\n" * 300)
        run = cgt.read(path)
        at_once(run.read, run.rewind, run.count_frames, lambda: run.progress, run.skip)
        at_once(run.read, run.close, lambda: run.can_rewind, seconds=0.1)


@case()
def a_warning_reads_on():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "odd.xyz")
        with open(path, "w", encoding="utf-8") as file:
            file.write("1\n\nXx 0 0 0\n" * 5)
        run = cgt.read(path)
        with warnings.catch_warnings():
            warnings.simplefilter("always")
            warnings.showwarning = lambda *_a, **_k: run.read()
            while run.read():
                pass


# ---- after the end, before the beginning ----


@case()
def everything_of_a_closed_scene():
    scene = scene_of(cgt.Spheres(*ball()))
    frame = scene.trace_camera(CAMERA, 8, 6, FIELDS)
    scene.close()
    scene.close()
    calls = [scene.commit, scene.prepare, lambda: scene.statistics, lambda: scene.handle, scene.set_options,
             lambda: scene.add(cgt.Spheres([[0, 0, 0]])), lambda: scene.update(0, cgt.Spheres([[0, 0, 0]])),
             lambda: scene.remove(0), lambda: scene.trace_camera(CAMERA, 8, 6),
             lambda: scene.occluded_frame(frame, []), lambda: scene.ambient_occlusion(frame),
             lambda: scene.trace_rays(ORG, DIR), lambda: scene.trace_ray(ORG[0], DIR[0]),
             lambda: cgt.research.scene_statistics(scene), lambda: cgt.Picture(8, 6).draw(scene, CAMERA)]
    for call in calls:
        try:
            call()
        except REFUSED as error:
            assert "it is closed" in str(error)
        else:
            raise AssertionError(call)


@case(REFUSED, "8 x 0|t_min|up|target")
def a_closed_contexts_scene_tells_what_is_wrong():
    context = cgt.Context()
    scene = scene_of(cgt.Spheres(*ball()), context=context)
    context.close()
    context.close()
    scene.trace_camera(cgt.Camera((0, 0, 0), (0, 0, 0), (0, 0, 0), t_min=-1), 8, 0)


@case(REFUSED, "context: it is closed")
def a_scene_of_a_closed_context():
    context = cgt.Context()
    context.close()
    cgt.Scene(context)


@case(cgt.NotCommitted, "committed anew or closed")
def a_picture_of_a_closed_scene():
    scene, picture = scene_of(cgt.Spheres(*ball())), cgt.Picture(64, 48, ambient=16)
    picture.begin(scene, CAMERA)
    scene.close()
    picture.step()


@case()
def a_picture_outlives_its_context():
    scene, picture = scene_of(cgt.Spheres(*ball())), cgt.Picture(64, 48)
    picture.draw(scene, CAMERA)
    expected = picture.pixels.copy()
    scene.close()
    scene.context.close()
    del scene
    assert np.array_equal(expected, picture.read())


@case(REFUSED, "has not begun")
def a_picture_that_has_not_begun():
    cgt.Picture(64, 48).read()


@case(REFUSED, "has not begun")
def a_picture_whose_beginning_failed():
    scene, picture = scene_of(cgt.Spheres(*ball())), cgt.Picture(64, 48)
    picture.draw(scene, CAMERA)
    scene.remove(0)
    try:
        picture.begin(scene, CAMERA)
    except cgt.NotCommitted:
        picture.read()
