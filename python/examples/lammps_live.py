# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A run of LAMMPS that draws itself, by its module for Python: lammps_live.py [FOLDER [INPUT STEPS EVERY]].

INPUT sets everything up but does not run. Positions are read where LAMMPS has them.
"""
import os
import sys

import numpy as np

import cgt
import png

try:
    from lammps import lammps
except ImportError:
    print("left out: no module lammps (Debian: apt-get install python3-lammps)")
    sys.exit(77)

data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")
source, steps, every = sys.argv[2:5] if len(sys.argv) > 4 else (os.path.join(data, "melt.in"), 40, 20)
run = lammps(cmdargs=["-screen", "none", "-log", "none"])
run.file(source)
low, high = (np.array(corner) for corner in run.extract_box()[:2])
middle, reach = (low + high) / 2, np.linalg.norm(high - low)
camera = cgt.Camera(middle + 2 * reach * np.array((0.62, -0.7, 0.36)), middle, (0, 0, 1), fov=30)
sun = cgt.Light((0.3, -0.8, 1), "directional")
colours = np.array(((0.02, 0.25, 0.45), (0.8, 0.3, 0.05)))
scene = cgt.Scene()
atoms = scene.add(cgt.Spheres(np.zeros((0, 3))))


def draw(_caller, step, _count, _ids, x, _force):
    """What LAMMPS calls from within its run; no force is added."""
    scene.update(atoms, cgt.Spheres(x, 0.5))
    scene.commit()
    frame = scene.trace_camera(camera, 480, 360, ("t", "primitive", "geometry", "normal"))
    lit = ~scene.occluded_frame(frame, sun)[0]
    sky = scene.ambient_occlusion(frame, 16, radius=4)
    cosine = np.clip(frame.normal @ np.array(sun.position) / np.linalg.norm(sun.position), 0, 1)
    picture = np.full(frame.shape + (3,), 0.9)
    kinds = run.numpy.extract_atom("type")[frame.primitive[frame.hit]] - 1
    picture[frame.hit] = colours[kinds % 2] * (0.5 * sky + 0.9 * cosine * lit)[frame.hit][:, None]
    png.write(f"lammps_live_{step:06}.png", picture)


run.command(f"fix cgt all external pf/callback {every} {every}")
run.set_fix_external_callback("cgt", draw, None)
run.command(f"run {steps}")
