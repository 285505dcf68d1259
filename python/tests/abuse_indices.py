# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Indices, types and numbers of looks that change after they were checked, or are out of range."""
import threading

import numpy as np
from abuse import DIR, FIELDS, ORG, ball, mesh, scene_of, table, trace_all

import cgt

CASES, case = table()
REFUSED = cgt.InvalidArgument


# ---- what is counted by, after a commit ----


def same_after(geometry, array, value):
    """Hits stay when an array gets another value that no commit has seen."""
    scene = scene_of(geometry)
    before = scene.trace_rays(ORG, DIR, FIELDS)
    assert before.hit.any()
    array[...] = value
    after = scene.trace_rays(ORG, DIR, FIELDS)
    assert all(np.array_equal(before[name], after[name]) for name in FIELDS)
    trace_all(scene)


def bonds(dtype):
    """Indices of capsules."""
    return np.random.default_rng(4).integers(0, 200, (100, 2)).astype(dtype)


@case()
def triangle_indices_change():
    v, i = mesh()
    same_after(cgt.Triangles(v, i), i, 10**9)


@case()
def triangle_indices_change_through_their_base():
    v, i = mesh()
    base = np.zeros((len(i), 4), "u4")
    base[:, :3] = i
    view = base[:, :3]
    view.flags.writeable = False
    same_after(cgt.Triangles(v, view), base, 10**9)


@case()
def triangle_indices_become_negative():
    v, i = mesh("i4")
    same_after(cgt.Triangles(v, i), i, -1)


@case()
def short_triangle_indices_change():
    v, i = mesh("u2")
    same_after(cgt.Triangles(v, i), i, 65535)


@case()
def capsule_indices_change():
    x, _ = ball()
    i = bonds("u4")
    same_after(cgt.Capsules(x, 0.05, i), i, 2**32 - 1)


@case()
def types_change():
    x, _ = ball()
    types = np.zeros(len(x), "u1")
    same_after(cgt.Spheres(x, [0.1], types=types), types, 255)


@case(REFUSED, "index")
def indices_beyond_at_the_commit():
    v, i = mesh()
    i[3, 1] = 8
    scene_of(cgt.Triangles(v, i))


@case(REFUSED, "index")
def negative_indices_at_the_commit():
    v, i = mesh("i4")
    i[3, 1] = -1
    scene_of(cgt.Triangles(v, i))


@case(REFUSED, "index")
def capsule_indices_beyond_at_the_commit():
    x, _ = ball()
    i = bonds("u2")
    i[0] = 200
    scene_of(cgt.Capsules(x, 0.1, i))


@case(REFUSED, "type")
def types_beyond_at_the_commit():
    x, _ = ball()
    scene_of(cgt.Spheres(x, [0.1, 0.2], types=np.full(len(x), 2, "u2")))


@case(cgt.NotCommitted, "commit")
def trace_after_a_commit_that_failed():
    v, i = mesh()
    scene = scene_of(cgt.Triangles(v, i))
    i[:] = 99
    try:
        scene.commit()
    except REFUSED:
        scene.trace_rays(ORG, DIR)


@case()
def indices_change_while_commits_run():
    v, i = mesh()
    i = np.tile(i, (500, 1))
    scene, wrong, ended = cgt.Scene(), i.copy(), threading.Event()
    wrong[::3] = 2**31
    scene.add(cgt.Triangles(v, i))
    right = i.copy()

    def change():
        while not ended.is_set():
            i[:] = wrong
            i[:] = right

    thread = threading.Thread(target=change)
    thread.start()
    for _ in range(30):
        try:
            scene.commit()
            scene.trace_rays(ORG, DIR)
        except REFUSED:
            pass
    ended.set()
    thread.join()


# ---- what pictures count by ----


def same_picture(look, geometry, *changes, **options):
    """Bytes stay when arrays get other values after the picture has begun."""
    scene = scene_of(geometry)
    options.setdefault("shading", "full")
    first, second = (cgt.Picture(60, 40, **options) for _ in range(2))
    camera = cgt.Camera((1, 2, 4))
    first.draw(scene, camera, {0: look})
    second.begin(scene, camera, {0: look})
    for array, value in changes:
        array[...] = value
    second.step(100)
    assert np.array_equal(first.pixels, second.read())


@case()
def look_index_changes():
    x, r = ball()
    index = np.zeros(len(x), "u2")
    same_picture(cgt.Look(index=index, palette=[[1, 0, 0]]), cgt.Spheres(x, r), (index, 65535))


@case()
def mesh_of_a_look_changes():
    v, i = mesh()
    colors, normals = np.random.default_rng(1).uniform(0, 1, (8, 3)).astype("f4"), v.copy()
    look = cgt.Look(colors=colors, per_vertex=True, vertex_normals=normals)
    same_picture(look, cgt.Triangles(v, i), (i, 2**31))


@case()
def mesh_of_a_plain_picture_changes():
    v, i = mesh()
    look = cgt.Look(colors=np.full((8, 3), 0.5, "f4"), per_vertex=True, vertex_normals=v.copy())
    same_picture(look, cgt.Triangles(v, i), (i, 2**31), shading="plain")


@case()
def materials_of_a_look_change():
    x, r = ball()
    number = np.zeros(len(x), "u1")
    same_picture(cgt.Look(color=(1, 0, 0), material=number), cgt.Spheres(x, r), (number, 255), shading="bounces",
                 materials=[cgt.Material("mirror")])


@case(REFUSED, "index: 7, of 1 colours")
def look_index_beyond_its_palette():
    x, r = ball()
    same_picture(cgt.Look(index=np.full(len(x), 7), palette=[[1, 0, 0]]), cgt.Spheres(x, r))


@case(REFUSED, "palette_steps")
def palette_steps_beyond_the_palette():
    x, r = ball()
    same_picture(cgt.Look(index=np.zeros(len(x), int), palette=[[1, 0, 0]], palette_steps=10**6), cgt.Spheres(x, r))


@case(REFUSED, "material")
def materials_beyond_those_of_the_picture():
    x, r = ball()
    same_picture(cgt.Look(material=np.full(len(x), 9)), cgt.Spheres(x, r), shading="bounces",
                 materials=[cgt.Material("mirror")])


@case(REFUSED, "bodies: 3 of them")
def bodies_of_another_mesh():
    same_picture(cgt.Look(bodies=[0, 0, 0]), cgt.Triangles(*mesh()), shading="bounces",
                 materials=[cgt.Material("glass")])


@case(REFUSED, "")
def bodies_of_indices_beyond():
    v, i = mesh()
    i[0] = 2**31
    cgt.find_bodies(cgt.Triangles(v, i))


@case()
def picture_is_read_after_indices_and_commit_changed():
    v, i = mesh()
    scene = scene_of(cgt.Triangles(v, i))
    picture = cgt.Picture(60, 40)
    picture.draw(scene, cgt.Camera((1, 2, 4)), {0: cgt.Look(colors=np.ones((8, 3), "f4"), per_vertex=True)})
    i[:] = 2**31
    try:
        scene.commit()
    except REFUSED:
        picture.read()
