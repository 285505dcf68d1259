# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""What the files of abuse share: how cases are told, and small scenes."""
import inspect
import subprocess
import sys

import numpy as np

import cgt

FIELDS = ("t", "primitive", "geometry", "normal")
ORG = np.random.default_rng(2).uniform(-2, 2, (500, 3)).astype("f4")
DIR = np.random.default_rng(3).normal(size=(500, 3)).astype("f4")


def table():
    """The cases of a file, and what puts a function there: `case(kind, words)` must raise, `case()` must not."""
    cases = {}

    def case(kinds=None, words=""):
        def add(function):
            assert function.__name__ not in cases, function.__name__
            cases[function.__name__] = function, kinds, words
            return function

        return add

    return cases, case


def ball(dtype="f4", count=200):
    """Centres and radii of a cloud."""
    r = np.random.default_rng(1)
    return r.uniform(-1, 1, (count, 3)).astype(dtype), r.uniform(0.05, 0.2, count).astype(dtype)


def mesh(dtype="u4"):
    """A closed mesh: vertices in float, and indices."""
    x, y, z = np.meshgrid([-1, 1], [-1, 1], [-1, 1], indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), z.ravel()], 1).astype("f4")
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return vertices, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], dtype)


def scene_of(*geometries, **options):
    """A committed scene."""
    scene = cgt.Scene(**options)
    for geometry in geometries:
        scene.add(geometry)
    scene.commit()
    return scene


def trace_all(scene):
    """Every call that traces, whatever it says: results, or the library's errors."""
    def frame():
        f = scene.trace_camera(cgt.Camera(), 40, 30, FIELDS)
        scene.occluded_frame(f, [cgt.Light((2, 3, 4))])
        scene.ambient_occlusion(f, 2)

    org, dir = ORG[:100], DIR[:100]
    calls = [frame, lambda: scene.trace_rays(org, dir, ("t", "normal", "uv")), lambda: scene.occluded_rays(org, dir),
             lambda: scene.occluded_points(cgt.Light((2, 3, 4)), org), lambda: scene.points_inside(org),
             lambda: scene.trace_hit_rows(org, dir, 4), lambda: scene.trace_ray(org[0], dir[0]),
             lambda: scene.bounce_rays(org, dir, scene.trace_rays(org, dir, FIELDS), inside=1.5), scene.prepare]
    for call in calls:
        try:
            call()
        except cgt.Error:
            pass


class Lies:
    """Makes another array each time it is asked for one."""

    def __init__(self, *shapes):
        self.shapes = list(shapes)

    def __array__(self, dtype=None, copy=None):
        return np.zeros(self.shapes.pop(0) if len(self.shapes) > 1 else self.shapes[0], "f4")

    def __len__(self):
        return 1


def junk():
    """Values that hardly any argument takes."""
    empty, objects = np.empty((0, 3), "f4"), np.zeros((2, 3), "O")
    return [None, True, -1, 2**70, 10**6, float("nan"), float("inf"), 1e300, 1j, "", "x", "\0", b"x", "\udcff", object(),
            int, [], (), {}, {0: 1}, {"t": 1}, [[1], [2, 3]], [None], range(3), len, np.float32(1), np.array(5), empty,
            np.empty(0), np.zeros((2, 3)), np.zeros((2, 3), ">f4"), np.zeros((4, 3), "f4")[::-1], objects, np.array(["a"]),
            np.zeros(3, "M8[s]"), np.full((2, 3), np.nan, "f4"), np.zeros(2, bool), np.ma.zeros((2, 3)),
            memoryview(b"abc"), cgt.Camera(), cgt.Spheres([[0, 0, 0]]), cgt.Light((1, 2, 3)),
            cgt.Scene.__new__(cgt.Scene), cgt.Frame.__new__(cgt.Frame), Lies((1, 3), (9, 3))]


def sweep(function, *good, kinds=(cgt.Error, OSError), **named):
    """Puts junk in place of each argument, one after another: results, or exceptions of the package's own kinds."""
    parameters = inspect.signature(function).parameters
    only = [n for n, p in parameters.items() if p.kind == p.KEYWORD_ONLY and n not in named]
    places = [*range(len(good)), *only, *named]
    for place in places:
        for value in junk():
            arguments, words = list(good), dict(named)
            if isinstance(place, int):
                arguments[place] = value
            else:
                words[place] = value
            try:
                function(*arguments, **words)
            except Exception as error:
                is_clear = str(error) and isinstance(error, kinds)
                assert is_clear, (function, place, value, error)


def python(code, *arguments, seconds=30):
    """Runs a program of its own; its output, once it has ended well."""
    child = subprocess.run([sys.executable, "-W", "ignore", "-c", code, *arguments], capture_output=True, text=True,
                           timeout=seconds, check=False)
    assert child.returncode == 0, (child.returncode, child.stdout, child.stderr)
    return child.stdout
