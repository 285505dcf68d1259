# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A run of LAMMPS that draws itself, by its module for Python: lammps_live.py [FOLDER [INPUT STEPS EVERY]].

INPUT sets everything up but does not run. Positions, and radii where atoms have some, are read where LAMMPS has them;
bonds go through the periodic boundaries of the box. LAMMPS ends Python at its errors: the end of log.lammps tells them.
"""
from __future__ import annotations

import os
import sys
from typing import Any

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
run = lammps(cmdargs=["-screen", "none"])
run.file(source)
low, high = (np.array(corner) for corner in run.extract_box()[:2])
middle, reach = (low + high) / 2, np.linalg.norm(high - low)
camera = cgt.Camera(middle + 2 * reach * np.array((0.62, -0.7, 0.36)), middle, (0, 0, 1), fov=30)
sun = cgt.Light((0.3, -0.8, 1), "directional")
colours = np.array(((0.02, 0.25, 0.45), (0.8, 0.3, 0.05)))
scene = cgt.Scene()
atoms, sticks = scene.add(cgt.Spheres(np.zeros((0, 3)))), scene.add(cgt.Capsules(np.zeros((0, 3))))


def find_bonds(ids: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Pairs of atoms, by their places in LAMMPS' arrays."""
    count, table = run.gather_bonds()
    pairs = np.array(table, np.int64).reshape(count, 3)[:, 1:]
    order: np.ndarray[Any, Any] = np.argsort(ids)
    return order[np.searchsorted(ids, pairs, sorter=order)] if count else pairs


def box_edges() -> tuple[np.ndarray[Any, Any], Any]:
    """The edges of the box, and along which it is periodic."""
    low, high, xy, yz, xz, periodic, _ = run.extract_box()
    return np.diag(np.subtract(high, low)) + np.array([[0, 0, 0], [xy, 0, 0], [xz, yz, 0]]), periodic


def draw(_caller: Any, step: int, _count: int,
         ids: np.ndarray[Any, Any], x: np.ndarray[Any, Any], _force: np.ndarray[Any, Any]) -> None:
    """What LAMMPS calls from within its run; no force is added."""
    bonds = find_bonds(ids)
    ends, atom_of_half = cgt.half_bonds(x, bonds, *box_edges())
    radii = run.numpy.extract_atom("radius")
    scene.update(atoms, cgt.Spheres(x, (0.25 if len(bonds) else 0.5) if radii is None else radii[:len(x)]))
    scene.update(sticks, cgt.Capsules(ends, 0.12))
    scene.commit()
    frame = scene.trace_camera(camera, 480, 360, ("t", "primitive", "geometry", "normal"))
    lit = ~scene.occluded_frame(frame, sun)[0]
    sky = scene.ambient_occlusion(frame, 16, radius=4)
    cosine = np.clip(frame.normal @ np.array(sun.position) / np.linalg.norm(sun.position), 0, 1)
    picture = np.full(frame.shape + (3,), 0.9)
    atom, on_stick = frame.primitive[frame.hit].astype(np.int64), frame.geometry[frame.hit] == sticks
    atom[on_stick] = atom_of_half[atom[on_stick]]
    kinds = run.numpy.extract_atom("type")[atom] - 1
    picture[frame.hit] = colours[kinds % 2] * (0.5 * sky + 0.9 * cosine * lit)[frame.hit][:, None]
    png.write(f"lammps_live_{step:06}.png", picture)
    if len(bonds):
        longest = 2 * np.linalg.norm(ends[1::2] - ends[0::2], axis=1).max()
        print(f"step {step}: {len(bonds)} bonds, the longest {longest:.3g}")


run.command(f"fix cgt all external pf/callback {every} {every}")
run.set_fix_external_callback("cgt", draw, None)
run.command(f"run {steps}")
