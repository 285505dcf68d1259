# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""A run of LAMMPS that draws itself, by its module for Python: lammps_live.py [FOLDER [INPUT STEPS EVERY]].

INPUT sets everything up but does not run. Positions, types, and radii where atoms have some, are read where LAMMPS has
them; bonds go through the periodic boundaries of the box. LAMMPS ends Python at its errors: the end of log.lammps tells
them.
"""
from __future__ import annotations

import os
import sys
from typing import Any

import numpy as np

import cgt

try:
    from lammps import lammps
except ImportError:
    print("left out: no module lammps (Debian: apt-get install python3-lammps)")
    sys.exit(77)

folder = sys.argv[1] if len(sys.argv) > 1 else "."
data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "data")
source, steps, every = sys.argv[2:5] if len(sys.argv) > 4 else (os.path.join(data, "melt.in"), 40, 20)
run = lammps(cmdargs=["-screen", "none"])
run.file(source)
figure = cgt.Figure(size=(480, 360), color="type", style="paper", box=True, bonds=True, bond_radius=0.12)


def find_bonds(ids: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Pairs of atoms, by their places in LAMMPS' arrays."""
    count, table = run.gather_bonds()
    pairs = np.array(table, np.int64).reshape(count, 3)[:, 1:]
    order: np.ndarray[Any, Any] = np.argsort(ids)
    return order[np.searchsorted(ids, pairs, sorter=order)] if count else pairs


def draw(_caller: Any, step: int, _count: int,
         ids: np.ndarray[Any, Any], x: np.ndarray[Any, Any], force: np.ndarray[Any, Any]) -> None:
    """What LAMMPS calls from within its run."""
    force[:] = 0  # which is added to the atoms'
    low, high, xy, yz, xz, periodic, _ = run.extract_box()
    edges = np.diag(np.subtract(high, low)) + np.array([[0, 0, 0], [xy, 0, 0], [xz, yz, 0]])
    bonds, radii = find_bonds(ids), run.numpy.extract_atom("radius")
    figure.show(x, radius=(0.25 if len(bonds) else 0.5) if radii is None else radii[:len(x)],
                columns={"id": ids, "type": run.numpy.extract_atom("type")[:len(x)]}, bonds=bonds, step=step, cell=edges,
                corner=low, pbc=periodic)
    figure.save(os.path.join(folder, f"lammps_live_{step:06}.png"))
    if len(bonds):
        print(f"step {step}: {len(bonds)} bonds")


run.command(f"fix cgt all external pf/callback {every} {every}")
run.set_fix_external_callback("cgt", draw, None)
run.command(f"run {steps}")
