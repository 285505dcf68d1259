# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Arguments of all kinds."""
import os
import tempfile

import numpy as np
from abuse import DIR, FIELDS, ORG, ball, mesh, scene_of, sweep, table

import cgt
import cgt.colors
import cgt.research

CASES, case = table()
CAMERA = cgt.Camera()


@case()
def junk_for_scenes():
    scene = scene_of(cgt.Spheres(*ball()))
    sweep(cgt.Context, 0, "portable")
    sweep(cgt.Scene, None, structure="auto", rays="coherent", research=None)
    sweep(scene.set_options, structure="auto")
    for call in (scene.add, scene.prepare, scene.remove):
        sweep(call, 0)
    sweep(scene.update, 0, cgt.Spheres([[0, 0, 0]]))
    sweep(cgt.research.SceneOptions, (0, 0, 0), "auto", 0)
    sweep(cgt.research.TraceOptions, 0, "auto")
    sweep(cgt.research.scene_statistics, scene)


@case()
def junk_for_geometries():
    x, r = ball()
    sweep(cgt.Spheres, x, r, types=None, mask=0, origin=(0, 0, 0))
    sweep(cgt.Spheres, x, r, types=np.zeros(len(x), "u1"))
    sweep(cgt.Triangles, *mesh())
    sweep(cgt.Capsules, x, r[:100], None)
    sweep(cgt.Capsules, x, r, ends=x)
    sweep(cgt.Light, (1, 2, 3), "point")
    sweep(cgt.Camera, (0, 0, 5), (0, 0, 0), (0, 1, 0), 45)
    sweep(CAMERA.fit, cgt.Spheres(x, r), 64, 48)
    sweep(cgt.Camera().orbit, 5)
    sweep(CAMERA.key_light, 64, 48)
    sweep(cgt.half_bonds, x, [[0, 1]], np.eye(3), (1, 1, 1))


@case()
def junk_for_rays():
    scene = scene_of(cgt.Spheres(*ball()), cgt.Triangles(*mesh()))
    few = ORG[:20], DIR[:20]
    hits = scene.trace_rays(*few, FIELDS)
    sweep(scene.trace_rays, *few, ("t",))
    sweep(scene.occluded_rays, *few)
    sweep(scene.trace_ray, ORG[0], DIR[0])
    sweep(scene.occluded_ray, ORG[0], DIR[0])
    sweep(scene.occluded_points, cgt.Light((1, 2, 3)), few[0])
    sweep(scene.points_inside, few[0])
    sweep(scene.trace_hit_rows, *few, 4)
    sweep(scene.trace_all_rays, *few)
    sweep(scene.bounce_rays, *few, hits)
    sweep(scene.trace_bounced_rays, scene.bounce_rays(*few, hits)[0])


@case()
def junk_for_frames():
    scene = scene_of(cgt.Spheres(*ball()))
    frame = scene.trace_camera(CAMERA, 8, 6, FIELDS)
    sweep(scene.trace_camera, CAMERA, 8, 6, ("t",), kinds=(cgt.Error, TypeError))  # what a visitor raises is passed on
    sweep(scene.occluded_frame, frame, [cgt.Light((1, 2, 3))])
    sweep(scene.ambient_occlusion, frame, 2)
    sweep(cgt.camera_rays, CAMERA, 8, 6)


@case()
def junk_for_figures():
    (x, r), (vertices, corners) = ball(), mesh()
    figure = cgt.Figure(size=(8, 6), style="plain")
    more = {"columns": {"v": r}, "bonds": [[0, 1]], "cell": np.eye(3), "pbc": True, "corner": (0, 0, 0), "unwrapped": 0}
    sweep(figure.show, x, radius=r, number=1, step=2, time=0.5, angstrom=1.0, **more)
    sweep(figure.survey, [x, x], radius=0.5, **more)
    sweep(figure.survey, (vertices, corners))
    for name in ("id", "type", "element", "velocity", "rgb", "normal", "v"):
        sweep(lambda values, name=name: cgt.Figure(size=(8, 6)).show(x, columns={name: values}).draw(), np.ones(9))
    sweep(figure.set_mesh, (vertices, corners))
    sweep(cgt.show, x, r, "red", size=(8, 6), bonds=True, title="a")
    sweep(figure.pick, 1, 1)
    sweep(lambda value: figure.set(zoom=value), 2.0)
    sweep(lambda value: setattr(figure, "camera", value), CAMERA)
    with tempfile.TemporaryDirectory() as folder:
        for picture in (figure, cgt.Picture(8, 6)):
            sweep(lambda dpi, p=picture: p.save(os.path.join(folder, "a.png"), dpi), 300)
    sweep(figure.set, color="red", size=(8, 6), camera=CAMERA, show=["x > 0"], range=(0, 1), type_color={1: "red"})
    figure.set(**{**figure.options, "size": (8, 6)}).show(x).draw()


@case()
def junk_for_pictures():
    scene = scene_of(cgt.Spheres(*ball()), cgt.Triangles(*mesh()))
    sweep(cgt.Picture, 8, 6)
    sweep(cgt.Look, (0, 0, 0), np.zeros((9, 3), "f4"))
    sweep(cgt.Material, "glass")
    sweep(cgt.find_bodies, cgt.Triangles(*mesh()))
    picture = cgt.Picture(8, 6, ambient=4)
    sweep(picture.begin, scene, CAMERA, {0: cgt.Look()})
    sweep(picture.step, 1)
    for name in ("color", "material", "palette_steps", "lineless_from", "per_vertex", "halves", "sheet"):
        def draw(value, name=name):
            look = cgt.Look()
            setattr(look, name, value)
            picture.draw(scene, CAMERA, {1: look})

        sweep(draw, 0, kinds=AttributeError)
    for call in (cgt.colors.palette, cgt.colors.by_type, cgt.colors.by_element):
        sweep(call, 0)
    for call in (cgt.colors.entries, cgt.colors.by_value):
        sweep(call, [0.0], low=0.0, high=1.0)


@case()
def junk_for_files():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "one.xyz")
        with open(path, "w", encoding="utf-8") as file:
            file.write("1\n\nO 0 0 0\n")
        sweep(cgt.read, path)
        sweep(cgt.Trajectory, [path], (), {}, kinds=Exception)  # its options are those of cgt.read, which checks them
        sweep(cgt.sort_series, [path])
        sweep(cgt.TrajectoryFrame, None, kinds=AttributeError)
