# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Writes water.* into the current folder; README.md says what is in them.
import mdtraj
import numpy

topology = mdtraj.Topology()
chain = topology.add_chain()
for r in range(4):
    residue = topology.add_residue("HOH", chain)
    o = topology.add_atom("O", mdtraj.element.oxygen, residue)
    for name in ("H1", "H2"):
        topology.add_bond(o, topology.add_atom(name, mdtraj.element.hydrogen, residue))

frames = 3
places = numpy.zeros((frames, topology.n_atoms, 3), dtype=numpy.float32)
for f in range(frames):
    for r in range(4):
        o = numpy.array([0.3 * r, 0.1 * r, 0.05 * f + 0.2])
        places[f, 3 * r : 3 * r + 3] = [o, o + [0.096, 0, 0], o + [-0.024, 0.093, 0]]

run = mdtraj.Trajectory(
    places,
    topology,
    time=numpy.array([0, 2, 4], dtype=numpy.float32),
    unitcell_lengths=numpy.full((frames, 3), 1.5) + numpy.arange(frames)[:, None] * 0.01,
    unitcell_angles=numpy.tile([90.0, 80.0, 70.0], (frames, 1)),
)
for ending in ("gro", "pdb", "dcd", "xtc", "trr", "nc"):
    run.save("water." + ending)
